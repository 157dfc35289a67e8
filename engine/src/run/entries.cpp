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

bool same_digests(const std::vector<OutputEntry>& a, const std::vector<OutputEntry>& b) {
  return std::all_of(a.begin(), a.end(), [&](const OutputEntry& entry) {
    const OutputEntry* other = find_output(b, entry.port);
    return other != nullptr && other->digest == entry.digest;
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

bool gives_declared(const std::vector<OutputEntry>& outputs, const std::vector<PortDecl>& declared) {
  return std::all_of(declared.begin(), declared.end(), [&outputs](const PortDecl& port) {
    const OutputEntry* output = find_output(outputs, port.name);
    return output != nullptr && output->type == port.type && output->type_version == port.type_version;
  });
}

std::uint64_t bytes_of(const std::vector<OutputEntry>& outputs) {
  std::uint64_t bytes = 0;
  for (const OutputEntry& output : outputs) bytes += output.bytes;
  return bytes;
}

std::optional<ActionEntry> find_entry(Store& store, const NodeKind& kind, const Digest& key) {
  std::optional<ActionEntry> entry = store.find_action(key);
  if (entry && !gives_declared(entry->outputs, kind.outputs())) entry.reset();
  return entry;
}

std::optional<ActionEntry> entry_of_manifest(Store& store, const std::string& manifest) {
  try {
    return store.peek_action(key_of(manifest));
  } catch (const Error&) {  // the record of the earlier run is damaged
    return std::nullopt;
  }
}

}  // namespace ballflow
