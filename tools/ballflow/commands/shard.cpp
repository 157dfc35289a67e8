#include "commands/shard.hpp"

#include <charconv>

namespace ballflow::cli {

std::set<std::size_t> nodes_of_shard(const Dag& dag, const std::string& shard) {
  std::size_t part = 0, parts = 0;
  const char* const end = shard.data() + shard.size();
  const auto first = std::from_chars(shard.data(), end, part);
  const bool divided = first.ec == std::errc() && first.ptr != end && *first.ptr == '/';
  const auto second = divided ? std::from_chars(first.ptr + 1, end, parts) : first;
  if (!divided || second.ec != std::errc() || second.ptr != end || part == 0 || part > parts) {
    throw Error(ExitCode::usage, "--shard " + shard + ": not a part",
                "write it as 2/5: the second of five parts of the variants");
  }
  std::set<std::size_t> nodes;
  for (std::size_t i = part - 1; i < dag.variants.size(); i += parts)
    nodes.insert(dag.variants[i].nodes.begin(), dag.variants[i].nodes.end());
  if (!nodes.empty()) return nodes;
  throw Error(ExitCode::usage,
              "--shard " + shard + ": there are only " + std::to_string(dag.variants.size()) + " variants",
              "take fewer parts");
}

}  // namespace ballflow::cli
