// The content-addressed store on disk.
//
//   <root>/cas/ab/cdef...   artifacts, named by the SHA-256 of their bytes (sha256sum verifies the cache)
//   <root>/ac/ab/cdef...    action entries, named by action key: what a node produced for that key
//   <root>/runs/            one folder per recorded run (history.hpp)
//   <root>/pins/            one empty file per digest that is never collected
//   <root>/tmp/             files being written, <host>-<boot>-<pid>-<random>/
//   <root>/quarantine/      blobs that failed their check
//   <root>/files/ab/cdef... memoised digests of input files, named by the SHA-256 of device and inode
//   <root>/locks/           one file per key that is being computed
//   <root>/leases/          one file per live run, locked by it: what it uses is not collected (gc.hpp)
//   <root>/usage            bytes in the store, roughly, so that nobody has to count them after every run:
//                           lines "=<bytes> <seconds since 1970>", a count, and "+<bytes>", written since
//   <root>/libraries        what node libraries declare (plugin/library_index.hpp)
//   <root>/CACHEDIR.TAG     tells backup programs to skip the folder
//
// Readers see whole files or none (written in tmp/, moved into place). A bad blob goes to quarantine and is
// a miss. A full disk, a read-only or missing store mean "not cached"; they never fail a run.
//
// Trust: what is read from the store is believed (checksums find accidents, not forgeries), so nobody else
// may have written it. Root, top folders, their subfolders and files must belong to the user or to the
// superuser and must not be writable for group or others; that is asked of the opened folder, and everything
// else is reached from there without following a symbolic link. The folders above the root do not matter: who
// swaps the root between two runs presents a folder that fails the check. A sticky bit does not help (anyone
// may still add files to a sticky folder), so it is no excuse.
//
// Behind it there may be an upstream (upstream.hpp) that many machines share. What is not here is looked for
// there and kept here; what is written here is published there too. A full upstream or a dead server mean
// "not shared"; they fail a run only where the upstream is the transport between jobs.
//
// Every function may be called from several threads at once.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/digest.hpp"
#include "ballflow/upstream.hpp"

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

  friend bool operator==(const OutputEntry&, const OutputEntry&) = default;
};

/// What a node produced for one key.
struct ActionEntry {
  std::string manifest;  // the full key manifest (key.hpp), so that explain is a diff
  std::vector<OutputEntry> outputs;
  std::vector<std::string> warnings;  // shown again on every hit
  double seconds = 0, cpu_seconds = 0;
};

/// What became of an entry that was put.
struct ActionPut {
  bool stored = false;  // it is there now: written, or there already and saying the same
  /// The entry that it replaced because it named other outputs for the same key: a node whose result depends
  /// on more than its key, or a machine that computes wrongly.
  std::optional<ActionEntry> disagreed;
  /// What the upstream has for the same key, where it names other outputs. It stays there: first come, first
  /// kept.
  std::optional<ActionEntry> upstream_disagreed = {};

  explicit operator bool() const { return stored; }
};

/// Held by who computes a key (Store::lock). Freed at the end of the object, and by the kernel when the
/// process dies.
class KeyLock {
 public:
  KeyLock() = default;
  virtual ~KeyLock() = default;
  KeyLock(const KeyLock&) = delete;
  KeyLock& operator=(const KeyLock&) = delete;
};

struct LockAttempt {
  std::unique_ptr<KeyLock> lock;  // null: not now, or never
  bool busy = false;              // another process or thread has it: try again later
};

/// Key manifests of an earlier run by node path: what reasons are compared with.
using Manifests = std::map<std::string, std::string>;

struct StoreOptions {
  std::string root;  // empty: no store, everything is a miss
  bool read_only = false;
  UpstreamUse upstream = {};
};

/// The side effects of the store (file_system.hpp), so that tests can fake a full disk or an odd file system.
class FileSystem;

/// The rooms of the store (store/parts.hpp), of which Store is the face: blobs, actions, locks, ...
class StoreParts;

class Store {
 public:
  /// Opens or creates. Throws Error (code store) when the folder cannot be trusted (see above). A folder that
  /// cannot be created or written is used read-only; why() says so. Removes what dead processes of this
  /// machine left in tmp/; scans nothing else.
  static std::shared_ptr<Store> open(const StoreOptions& options, std::shared_ptr<FileSystem> files = {});
  ~Store();

  /// $BALLFLOW_CACHE, else $XDG_CACHE_HOME/ballflow, else ~/.cache/ballflow; empty when there is no home.
  static std::string default_root();

  /// A damaged, truncated or foreign entry (another key, another format) is a miss. Its blobs may be missing.
  /// Counts as a use of the entry, and so of its blobs. Asks the upstream when it is not here.
  /// Where the upstream is the transport, an entry counts when it is upstream with all its blobs; what is
  /// here is published for that.
  std::optional<ActionEntry> find_action(const Digest& key);
  /// find_action() for an entry that must be there: asks the upstream again for as long as
  /// UpstreamUse::patience.
  std::optional<ActionEntry> await_action(const Digest& key);
  /// The same without counting as a use and without the upstream.
  std::optional<ActionEntry> peek_action(const Digest& key);
  /// To be called last, after its blobs. An entry that is there and says the same (times aside) is kept; one
  /// that is damaged or names other outputs is replaced at once and as a whole: the newest computation
  /// counts, and readers see the old entry or the new one. Not stored when it could not be written (full
  /// disk, read-only).
  ActionPut put_action(const Digest& key, const ActionEntry& entry, bool sync = false);
  /// Entries of work that is not at its end: others may have got further, and all are right. Here or
  /// upstream; its blobs may be missing.
  std::optional<ActionEntry> find_state(const Digest& key);
  /// The first entry stays upstream; gives that one where it is another. To be called after its blobs.
  std::optional<ActionEntry> put_state(const Digest& key, const ActionEntry& entry);

  /// Whether a file of the right name and size is there, or upstream; load() may still find it damaged.
  bool has_blob(const OutputEntry& output);
  /// Maps a blob, checks size, checksum, structure, type and summary. Null on a miss; a blob that is damaged
  /// is moved to quarantine first. (A blob that is what its name says, but not what `output` says, stays.)
  /// A blob that only the upstream has is copied here first, and verified by its SHA-256.
  ArtifactPtr load(const OutputEntry& output);
  /// Copies a blob of the upstream here unless it is; false when neither has it.
  bool fetch_blob(const Digest& digest);
  /// Writes the blob unless a good one is there; a damaged one is replaced. `sync`: flush to the disk before
  /// it is published. `give_up` is polled every few megabytes. False when it could not be written or was
  /// given up; nothing of it is left then.
  bool put_blob(const Artifact& artifact, bool sync, const std::function<bool()>& give_up = {});

  /// SHA-256 of a file's content, memoised by device, inode, size, mtime and ctime (not trusted when the
  /// file is younger than 2 s). Throws Error when it is no regular file, cannot be read or keeps changing.
  Digest file_digest(const std::string& path);
  /// Serialises computations of one key between processes: blocks until this process holds the lock of the
  /// key (flock). `give_up` is polled while it waits. Null when it gave up, when the store is read-only or
  /// cannot lock: then compute without.
  std::unique_ptr<KeyLock> lock(const Digest& key, const std::function<bool()>& give_up);
  /// The same without waiting. Neither a lock nor busy: the store is read-only or cannot lock; compute
  /// without.
  LockAttempt try_lock(const Digest& key);

  /// Puts texts by file name into a new folder runs/<id>/, in this order (history.hpp). False, and nothing is
  /// left, when that is there already or cannot be written. `id`: letters, digits, '.', '_' and '-', not
  /// starting with a dot; else throws Error.
  bool put_run(const std::string& id, const std::vector<std::pair<std::string, std::string>>& files);

  struct Statistics {
    std::uint64_t blobs = 0, blob_bytes = 0, actions = 0, action_bytes = 0, quarantined = 0, runs = 0;
  };
  /// Reads every folder of the store.
  Statistics statistics();

  /// Adds what was written through this store to `usage`; happens by itself now and then, and at the end.
  void account();

  const std::string& root() const;  // its absolute path; empty when there is no store
  bool read_only() const;
  const std::string& why() const;  // why it is read-only or absent
  /// The first failure to write since open ("cannot write cas/...: No space left on device"), or empty.
  std::string trouble() const;
  /// Whether results travel to other jobs through the upstream (UpstreamUse::transport).
  bool is_transport() const;
  /// What was odd about the upstream since open, in words: damaged files, other results than one's own,
  /// failures to read and to write (the first of each kind).
  std::vector<std::string> upstream_notes() const;

  /// For the collector, the verifier and the history, which work on the files of all rooms.
  StoreParts& parts() const { return *parts_; }

 private:
  Store() = default;
  bool shares() const;
  std::optional<ActionEntry> find_anywhere(const Digest& key);
  bool hand_on(const Digest& key, const ActionEntry& entry);

  std::unique_ptr<StoreParts> parts_;
};

}  // namespace ballflow
