// cas/: artifacts under the SHA-256 of their bytes.
#pragma once

#include <functional>
#include <optional>

#include "store/folders.hpp"
#include "store/publisher.hpp"

namespace ballflow {

/// What Store::has_blob, load and put_blob promise.
class Blobs {
 public:
  Blobs(const StoreFolders& folders, Publisher& publisher) : folders_(folders), publisher_(publisher) {}

  bool has(const OutputEntry& output) const;
  /// Whether there is a file of this name.
  bool has(const Digest& digest) const { return size(digest).has_value(); }
  ArtifactPtr load(const OutputEntry& output) { return fetch(output).artifact; }
  bool put(const Artifact& artifact, bool sync, const std::function<bool()>& give_up);

 private:
  struct Fetched {
    ArtifactPtr artifact;
    bool damaged = false;
  };
  std::optional<std::uint64_t> size(const Digest& digest) const;
  Fetched fetch(const OutputEntry& output);

  const StoreFolders& folders_;
  Publisher& publisher_;
};

/// Whether an artifact is what an entry says of it, its digest aside.
bool describes(const OutputEntry& output, const Artifact& artifact);

}  // namespace ballflow
