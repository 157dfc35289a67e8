// Artifacts and entries for the tests of the store.
#pragma once

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/store.hpp"

namespace ballflow::test {

template <class T>
NamedArray array_of(std::string name, std::uint32_t dtype, std::vector<std::uint64_t> shape,
                    const std::vector<T>& data) {
  return {std::move(name), dtype, std::move(shape), data.data()};
}

/// A small artifact whose content follows from `seed`.
inline ArtifactPtr make_probe(int seed, std::size_t length = 12) {
  struct Data {
    std::vector<double> values;
    std::vector<std::uint8_t> flags;
  };
  const auto data = std::make_shared<Data>();
  for (std::size_t i = 0; i < length; ++i) {
    data->values.push_back(seed + 0.125 * static_cast<double>(i));
    data->flags.push_back(static_cast<std::uint8_t>(seed + 7 * static_cast<int>(i)));
  }
  return Artifact::seal(
      "Probe", 1,
      {array_of("flags", BF_U8, {length}, data->flags), array_of("values", BF_F64, {length}, data->values)},
      "{\"seed\":" + std::to_string(seed) + "}", data);
}

inline OutputEntry entry_for(const Artifact& artifact, const std::string& port = "out") {
  return {port,
          artifact.type(),
          artifact.version(),
          artifact.digest(),
          artifact.file_size(),
          artifact.checksum(),
          artifact.summary()};
}

inline ActionEntry action_for(const Artifact& artifact) {
  ActionEntry entry;
  entry.manifest = R"({"node":"Probe","digest":")" + artifact.digest().hex() + "\"}";
  entry.outputs.push_back(entry_for(artifact));
  entry.warnings = {"first \xc3\xa9", ""};
  entry.seconds = 1.5;
  entry.cpu_seconds = 2.25;
  return entry;
}

inline bool equal(const ActionEntry& a, const ActionEntry& b) {
  return a.manifest == b.manifest && a.outputs == b.outputs && a.warnings == b.warnings &&
         a.seconds == b.seconds && a.cpu_seconds == b.cpu_seconds;
}

/// The file of an artifact in one piece.
inline std::string file_bytes(const Artifact& artifact) {
  std::string bytes;
  for (const std::span<const std::byte> piece : artifact.pieces()) {
    bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
  }
  return bytes;
}

inline bool same(const Artifact& a, const Artifact& b) { return file_bytes(a) == file_bytes(b); }

inline std::string place_of(const std::string& root, const std::string& folder, const Digest& digest) {
  const std::string hex = digest.hex();
  return root + '/' + folder + '/' + hex.substr(0, 2) + '/' + hex.substr(2);
}

}  // namespace ballflow::test
