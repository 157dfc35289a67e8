// Keeping the store small: what is in it, what goes first, and what stays.
//
// Order of collection. Losing an artifact costs its node's seconds, keeping it costs its bytes for as long as
// it is not used; how long it has not been used is the best guess of how long that will last. So every
// artifact has a
//     score = seconds / (bytes * age)
// and the lowest score goes first. `seconds`: what the node took that made it; `bytes`: of all outputs of
// that node that are in the store (they are lost and made again together), in blocks of 4 KiB; `age`: since
// the last use, at least a second. An artifact of several actions has the best score among them. One that no
// action names any more has the score 0; equal scores go by age, then by digest. Before the artifacts go
// quarantined files; the records of runs may take a twentieth of the limit, action entries and memoised
// digests a tenth, beyond it those go that ended, or were used, longest ago. An action entry without its
// artifacts is still a hit, so it stays otherwise.
//
// Last use is the mtime of a file: of the entry that was a hit, of the artifact that was mapped. It is set at
// most once an hour, so a hit does not cost a write.
//
// What stays: what a pin names, with the action entries that name it, and what live runs may use. A live run
// holds a Lease; everything used since an hour before the oldest live lease stays. (Were an artifact lost
// nevertheless, because a file system cannot lock, it would be made again: collection never harms a result.)
//
// A lease that is locked is live. On a mount whose locks stay on their host (nfs with nolock or
// local_lock=flock) those of other hosts always look free; there a lease of another host counts as live for
// as long as its file is there, however old it is, and what was used within the last hour stays in any case.
// A run removes its lease at its end; what a killed run left goes with the next collection on its own host,
// or by the user's hand.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/store.hpp"

namespace ballflow {

/// Says that a run is alive. Held by an flock, which the kernel frees when the process dies.
class Maker;
class OpenFile;

class Lease {
 public:
  /// Null when the store is read-only or cannot lock.
  static std::unique_ptr<Lease> take(const std::shared_ptr<Store>& store);
  ~Lease();
  Lease(const Lease&) = delete;
  Lease& operator=(const Lease&) = delete;

 private:
  Lease() = default;
  std::shared_ptr<Store> store_;
  std::string name_;
  std::unique_ptr<OpenFile> file_;
  std::unique_ptr<Maker> maker_;
};

/// An artifact in the store.
struct CachedArtifact {
  Digest digest;
  std::string type, node;  // type of the artifact and id of the node; empty when no action names it
  std::uint64_t bytes = 0;
  double seconds = 0;         // of the node
  std::int64_t last_use = 0;  // nanoseconds since 1970; of itself or of an action that names it
  bool pinned = false;
  double score = 0;
  std::vector<Digest> actions;  // keys
};

/// An action entry in the store.
struct CachedAction {
  Digest key;
  std::string node;
  std::uint64_t bytes = 0;  // of the entry
  double seconds = 0;
  std::int64_t last_use = 0;
  std::vector<OutputEntry> outputs;
};

struct CacheContents {
  std::vector<CachedArtifact> artifacts;  // in the order of collection
  std::vector<CachedAction> actions;      // not used for longest first; damaged entries are absent
};
/// Reads every folder and every action entry. `now`: nanoseconds since 1970; negative: the clock.
CacheContents read_contents(Store& store, std::int64_t now = -1);

constexpr std::uint64_t no_limit = UINT64_MAX;
/// "5G", "1.5T", "800M", "64K", "4096" (bytes) with powers of 1024, or "none"; empty for anything else.
std::optional<std::uint64_t> parse_size(std::string_view text);
/// 20 GiB or a tenth of the disk, the smaller.
std::uint64_t default_limit(Store& store);

struct CollectOptions {
  std::uint64_t limit = no_limit;   // collect when there is more than this in the store
  std::uint64_t target = no_limit;  // down to this; not more than `limit`
  bool dry_run = false;
  bool wait = true;  // while another process collects; else say `busy`
};
/// A lease of another host, where locks say nothing about that host: its run may be alive or dead.
struct UnseenRun {
  std::string file;        // "leases/<host>-..."
  std::string host;        // empty when the name does not say it
  std::int64_t since = 0;  // nanoseconds since 1970
};
struct Collected {
  bool busy = false;                                // another process is at it; nothing was done
  bool complete = false;                            // at most `limit` is left
  std::uint64_t bytes_before = 0, bytes_after = 0;  // of everything that counts, in blocks of 4 KiB
  std::uint64_t artifacts = 0, actions = 0, memos = 0, quarantined = 0, runs = 0;  // removed, or would be
  std::uint64_t pinned_bytes = 0;                                                  // of pinned artifacts
  std::uint64_t live_runs = 0;                                                     // `unseen` are among them
  std::vector<UnseenRun> unseen;
  /// Why locks exclude processes of this host only ("/scratch is mounted as nfs4 with local_lock=flock");
  /// empty when they reach as far as the store.
  std::string locks_stay_here;
  std::vector<Digest> removed;  // the artifacts, in order
};
/// Counts what is in the store and removes what is too much. Safe beside any number of runs and collectors,
/// and when killed at any point. Does nothing in a store that cannot be written (but a dry run says what it
/// would).
Collected collect(Store& store, const CollectOptions& options);

/// At the end of a run: collects down to nine tenths of the limit when there is more than that in the store.
/// Costs the reading of one small file when nothing has to be done. Never throws.
void keep_within(Store& store, std::uint64_t limit) noexcept;

/// keep_within at the end of a scope.
class KeepWithin {
 public:
  KeepWithin(std::shared_ptr<Store> store, std::uint64_t limit) : store_(std::move(store)), limit_(limit) {}
  ~KeepWithin() { keep_within(*store_, limit_); }
  KeepWithin(const KeepWithin&) = delete;
  KeepWithin& operator=(const KeepWithin&) = delete;

 private:
  std::shared_ptr<Store> store_;
  std::uint64_t limit_;
};

/// Digests of artifacts in the store (or of pins) that start with these hexadecimal digits, sorted. A whole
/// digest is looked up without listing a folder.
std::vector<Digest> find_artifacts(Store& store, std::string_view prefix);
std::vector<Digest> find_pins(Store& store, std::string_view prefix);
/// Throws Error (code store) when the store cannot be written.
void pin(Store& store, const Digest& digest);
void unpin(Store& store, const Digest& digest);

struct Finding {
  std::string file;  // "cas/ab/cdef..."
  std::string what;
  bool moved = false;  // to quarantine
};
struct Verified {
  std::uint64_t artifacts = 0, bytes = 0, actions = 0, memos = 0, without_artifacts = 0;
  std::vector<Finding> bad;
};
/// Reads everything: the checksum, structure and size of artifacts, and action entries and memoised digests
/// as a whole. Moves what is bad to quarantine, where it is a miss that the next run heals. `full`: also the
/// SHA-256 of every artifact; else only of those that have no entry with a checksum.
Verified verify(Store& store, bool full);

}  // namespace ballflow
