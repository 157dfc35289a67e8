#include <cstdio>

#include "commands.hpp"
#include "terminal.hpp"

namespace ballflow::cli {
namespace {

int show_statistics(const Common& common) {
  const auto store = common.store();
  if (store->root().empty()) {
    std::printf("there is no cache: %s\n", store->why().c_str());
    return 0;
  }
  const Store::Statistics s = store->statistics();
  const auto megabytes = [](std::uint64_t bytes) {
    return grouped(static_cast<std::int64_t>(bytes >> 20)) + " MB";
  };
  const auto count = [](std::uint64_t n) { return grouped(static_cast<std::int64_t>(n)); };
  std::vector<std::vector<std::string>> rows = {
      {"folder", store->root()},
      {"artifacts", count(s.blobs) + " (" + megabytes(s.blob_bytes) + ")"},
      {"actions", count(s.actions) + " (" + megabytes(s.action_bytes) + ")"},
      {"quarantined", count(s.quarantined)},
      {"run records", count(s.runs)},
  };
  if (store->read_only()) rows.push_back({"read only", store->why()});
  print_table(rows);
  return 0;
}

}  // namespace

void add_cache(CLI::App& app, Common& common, Action& action) {
  CLI::App* command = app.add_subcommand("cache", "look at the cache");
  command->require_subcommand(1);
  CLI::App* stat = command->add_subcommand("stat", "say where the cache is and what is in it");
  stat->add_option("--cache", common.cache, "cache folder")->type_name("DIR");
  stat->callback([&common, &action] { action = [&common] { return show_statistics(common); }; });
}

void add_version(CLI::App& app, Common& common, Action& action) {
  CLI::App* command =
      app.add_subcommand("version", "print the version, the plugin ABI and the node libraries");
  command->callback([&common, &action] {
    action = [&common] {
      std::printf("ballflow %s, plugin ABI %u\n", BALLFLOW_VERSION, BALLFLOW_ABI_VERSION);
      const auto registry = common.registry();
      for (const PluginCandidate& candidate : registry->candidates()) {
        if (candidate.refused.empty()) {
          std::printf("  %s %s  %s\n", candidate.name.c_str(), candidate.version.c_str(),
                      candidate.path.c_str());
        } else {
          std::printf("  not loaded: %s: %s\n", candidate.path.c_str(), candidate.refused.c_str());
        }
      }
      return 0;
    };
  });
}

}  // namespace ballflow::cli
