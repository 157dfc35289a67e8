#include <algorithm>

#include "run/runner.hpp"

namespace ballflow {

const OutputEntry* find_output(const std::vector<OutputEntry>& outputs, const std::string& port) {
  for (const OutputEntry& output : outputs) {
    if (output.port == port) return &output;
  }
  return nullptr;
}

bool same_digests(const std::vector<OutputEntry>& entries, const ExecutionOutcome& outcome) {
  return std::all_of(entries.begin(), entries.end(), [&](const OutputEntry& entry) {
    const auto made = outcome.outputs.find(entry.port);
    return made != outcome.outputs.end() && made->second->digest() == entry.digest;
  });
}

OutputEntry output_entry(const std::string& port, const Artifact& artifact) {
  return {port,
          artifact.type(),
          artifact.version(),
          artifact.digest(),
          artifact.file_size(),
          artifact.checksum(),
          artifact.summary()};
}

std::optional<ActionEntry> find_entry(Store& store, const NodeKind& kind, const Digest& key) {
  std::optional<ActionEntry> entry = store.find_action(key);
  const auto gives = [&entry](const PortDecl& port) {
    return std::any_of(entry->outputs.begin(), entry->outputs.end(), [&port](const OutputEntry& output) {
      return output.port == port.name && output.type == port.type && output.type_version == port.type_version;
    });
  };
  if (entry && !std::all_of(kind.outputs().begin(), kind.outputs().end(), gives)) entry.reset();
  return entry;
}

}  // namespace ballflow
