// What a store does with its upstream: verify what comes, keep it here, publish what is made here, and say
// once what goes wrong.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "store/blobs.hpp"

namespace ballflow {

/// What Store promises of its upstream.
class SharedResults {
 public:
  SharedResults(const UpstreamUse& use, const StoreFolders& folders, Publisher& publisher, Blobs& blobs)
      : use_(use), folders_(folders), publisher_(publisher), blobs_(blobs) {}

  explicit operator bool() const { return use_.upstream != nullptr; }
  bool is_transport() const { return use_.upstream != nullptr && use_.transport; }

  /// Nothing when there is none, or none that is whole.
  std::optional<ActionEntry> find(const Digest& key);
  /// Looks again for as long as the patience lasts.
  std::optional<ActionEntry> await(const Digest& key);
  bool has(const OutputEntry& output);
  bool has(const Digest& key);  // an entry
  /// Copies the blob here and maps it; into memory where the disk cannot take it. Null on a miss.
  ArtifactPtr load(const OutputEntry& output);
  /// Copies a blob of any size here.
  bool fetch(const Digest& digest);

  /// Whether the blob is there now. Throws Error (code store) when it is not and has to be.
  bool put(const Artifact& artifact, bool sync, const std::function<bool()>& give_up);
  enum class Others { wrong, right };  // what an entry with other outputs is
  /// Not where one of the blobs failed. The entry that is there and names other outputs, if so. Throws as
  /// above.
  std::optional<ActionEntry> put(const Digest& key, const ActionEntry& entry, bool sync,
                                 Others others = Others::wrong);

  std::vector<std::string> notes() const;

 private:
  using Room = Upstream::Room;

  /// Whether nobody should wait for a server that did not answer just now.
  bool is_resting();
  void rest(const std::string& why);
  void note(const std::string& text);
  /// Only the first of its kind.
  void note_failure(const char* kind, const std::string& text);
  /// Says so, and takes it out of the way where that may be.
  void damaged(Room room, const Digest& name);
  Upstream::Got read(Room room, const Digest& name, const Upstream::Sink& sink,
                     const std::function<void()>& restart, bool afresh);
  bool write(Room room, const Digest& name, const std::vector<std::span<const std::byte>>& pieces,
             const Upstream::PutOptions& options, bool& there);
  bool is_whole(const Digest& digest, std::uint64_t bytes);
  std::optional<ActionEntry> read_entry(const Digest& key, bool afresh = false);
  enum class Copied { no, damaged, yes };
  Copied copy_to_disk(const Digest& digest, std::optional<std::uint64_t> bytes, bool afresh,
                      bool& disk_failed);
  Copied copy_to_memory(const OutputEntry& output, ArtifactPtr& artifact);

  const UpstreamUse use_;
  const StoreFolders& folders_;
  Publisher& publisher_;
  Blobs& blobs_;
  mutable std::mutex mutex_;  // guards what follows
  std::vector<std::string> notes_;
  std::set<std::string> noted_;
  std::set<Digest> unpublished_;  // blobs
  std::set<Digest> damaged_;      // what could not be set aside: to be replaced
  std::chrono::steady_clock::time_point resting_until_;
};

}  // namespace ballflow
