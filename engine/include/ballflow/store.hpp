// The content-addressed store on disk.
//
//   <root>/cas/ab/cdef...   artifacts, named by the SHA-256 of their bytes (sha256sum verifies the cache)
//   <root>/ac/ab/cdef...    action entries, named by action key: what a node produced for that key
//   <root>/runs/            one folder per run: its report
//   <root>/pins/            digests that are never collected
//   <root>/tmp/             files being written, <host>-<boot>-<pid>-<random>/
//   <root>/quarantine/      blobs that failed their check
//   <root>/files/           memoised digests of input files
//
// Readers see whole files or none (written in tmp/, moved into place). A bad blob goes to quarantine and is
// a miss. A full disk, a read-only or missing store mean "not cached"; they never fail a run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/digest.hpp"

namespace ballflow {

/// One output of an action: enough to plan and to report without reading the artifact.
struct OutputEntry {
  std::string port;
  std::string type;
  int type_version = 0;
  Digest digest;
  std::uint64_t bytes = 0;
  Checksum checksum;
  std::string summary;  // canonical JSON
};

/// What a node produced for one key.
struct ActionEntry {
  std::string manifest;  // the full key manifest (key.hpp), so that explain is a diff
  std::vector<OutputEntry> outputs;
  std::vector<std::string> warnings;  // shown again on every hit
  double seconds = 0, cpu_seconds = 0;
};

struct StoreOptions {
  std::string root;       // empty: no store, everything is a miss
  bool read_only = false;
};

/// The side effects of the store, so that tests can fake a full disk or an odd file system.
class FileSystem;

class Store {
 public:
  /// Opens or creates. Throws Error (code store) when the folder belongs to another user or others may
  /// write to it. A folder that cannot be created or written is used read-only; why() says so.
  static std::shared_ptr<Store> open(const StoreOptions& options, std::shared_ptr<FileSystem> files = {});
  ~Store();

  /// $BALLFLOW_CACHE, else $XDG_CACHE_HOME/ballflow, else ~/.cache/ballflow.
  static std::string default_root();

  std::optional<ActionEntry> find_action(const Digest& key);
  /// Publishes last, after its blobs. False when it could not be written (full disk, read-only).
  bool put_action(const Digest& key, const ActionEntry& entry);

  bool has_blob(const OutputEntry& output);
  /// Maps a blob, checks size and checksum. Null on a miss; a bad blob is moved to quarantine first.
  ArtifactPtr load(const OutputEntry& output);
  /// Writes the blob unless it is there. `sync`: flush to the disk before it is published.
  bool put_blob(const Artifact& artifact, bool sync);

  /// SHA-256 of a file's content, memoised by device, inode, size, mtime and ctime (not trusted when the
  /// file is younger than 2 s). Throws Error when the file cannot be read.
  Digest file_digest(const std::string& path);

  /// Serialises computations of one key between processes: blocks until this process holds the lock of the
  /// key (flock, freed by the kernel when a process dies). `give_up` is polled. Null when it gave up or the
  /// store is read-only.
  class Lock;
  std::unique_ptr<Lock> lock(const Digest& key, const std::function<bool()>& give_up);

  /// A new folder runs/<id>/ for the report of a run; empty when nothing can be written.
  std::string new_run_folder(const std::string& id);

  struct Statistics {
    std::uint64_t blobs = 0, blob_bytes = 0, actions = 0, action_bytes = 0, quarantined = 0, runs = 0;
  };
  Statistics statistics();

  const std::string& root() const { return root_; }
  bool read_only() const { return read_only_; }
  const std::string& why() const { return why_; }  // why it is read-only or absent

 private:
  Store() = default;
  std::string root_, why_;
  bool read_only_ = false;
  std::shared_ptr<FileSystem> files_;
};

}  // namespace ballflow
