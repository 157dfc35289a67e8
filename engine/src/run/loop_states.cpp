#include "run/loop_states.hpp"

#include <algorithm>
#include <utility>

#include "ballflow/json.hpp"
#include "ballflow/run.hpp"
#include "run/runner.hpp"

namespace ballflow {
namespace {

constexpr const char* state_of_a_loop = "state of a loop";

/// Numbers that may be missing in a row: an entry that was damaged and moved aside leaves a gap.
constexpr int gap = 3;

Digest state_key(const Digest& loop, std::int64_t number) {
  return sha256(std::string(state_of_a_loop) + '\n' + loop.hex() + '\n' + std::to_string(number) + '\n');
}

struct Found {
  std::int64_t iterations = 0;
  ActionEntry entry;
};

/// Nothing when the entry is not of this loop.
std::optional<Found> found_in(ActionEntry entry, const Digest& loop, const std::vector<PortDecl>& states) {
  const Json manifest = Json::parse(entry.manifest, nullptr, false);
  if (!manifest.is_object() || manifest.value("loop", "") != loop.hex() ||
      !gives_declared(entry.outputs, states))
    return std::nullopt;
  const auto iterations = manifest.find("iterations");
  if (iterations == manifest.end() || !iterations->is_number_integer()) return std::nullopt;
  return Found{iterations->get<std::int64_t>(), std::move(entry)};
}

}  // namespace

std::optional<KeptLoop> LoopStates::latest(const std::function<void(const std::string&)>& tell) {
  std::vector<Found> found;
  std::int64_t free = 0;
  for (std::int64_t number = 1, missing = 0; missing < gap; ++number) {
    auto entry = store_.find_state(state_key(key_, number));
    missing = entry ? 0 : missing + 1;
    if (!entry && free == 0) free = number;
    if (!entry) continue;
    if (auto state = found_in(std::move(*entry), key_, loop_.outputs)) found.push_back(std::move(*state));
  }
  next_ = free;
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.iterations > b.iterations; });
  for (const Found& one : found) {
    KeptLoop kept{{one.iterations, {}, one.entry.warnings}, one.entry.seconds, one.entry.cpu_seconds};
    for (const OutputEntry& output : one.entry.outputs) {
      ArtifactPtr artifact = store_.load(output);
      if (artifact != nullptr) kept.state.states[output.port] = std::move(artifact);
    }
    if (kept.state.states.size() == one.entry.outputs.size()) return kept;
    tell("what was kept after iteration " + std::to_string(one.iterations) + " is damaged or lost");
  }
  return std::nullopt;
}

void LoopStates::put(const KeptLoop& kept) {
  ActionEntry entry;
  entry.seconds = kept.seconds;
  entry.cpu_seconds = kept.cpu_seconds;
  entry.warnings = kept.state.warnings;
  for (const auto& [name, artifact] : kept.state.states) {
    entry.outputs.push_back(output_entry(name, *artifact));
    store_.put_blob(*artifact, true);
  }
  for (;; ++next_) {
    entry.manifest = Json{{"node", state_of_a_loop},
                          {"loop", key_.hex()},
                          {"number", next_},
                          {"iterations", kept.state.iterations}}
                         .dump();
    const auto other = store_.put_state(state_key(key_, next_), entry);
    if (!other) return;
    const auto found = found_in(*other, key_, loop_.outputs);
    if (found && found->iterations >= kept.state.iterations) return;  // a copy of this job was faster
  }
}

}  // namespace ballflow
