// Making an upstream in a folder smaller, while nobody computes with it. There are no times of use upstream
// (upstream.hpp), so what counts is how long ago a file was written. Entries go first and blobs last, so what
// is left is whole whenever the work is interrupted.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ballflow {

class FileSystem;

/// "36h", "90d", "8w" or "1y" (365 days) in seconds; empty for anything else, and for more than a
/// hundred years.
std::optional<std::int64_t> parse_age(std::string_view text);

struct UpstreamCollectOptions {
  std::int64_t older_than = 0;  // seconds since a file was written, by the clock of this machine; >= 0
  bool dry_run = false;
};

/// Files and the bytes in them.
struct FileCount {
  std::uint64_t files = 0, bytes = 0;
};

struct UpstreamCollected {
  FileCount entries, blobs, leftovers;  // removed, or would be
  FileCount entries_left, blobs_left;   // leftovers are not among them
  FileCount failed;                     // should have been removed
  std::string why;                      // of the first that failed: "ac/ab/cdef...: Permission denied"
};

/// Removes from an upstream in a folder, in this order:
/// - entries (ac/) that are older,
/// - blobs (cas/) that are older and that no entry names which is left, an entry that could not be removed
/// too,
/// - on the way leftovers that are older: drafts of publishers that were killed, and damaged files that were
///   set aside.
///
/// Everything else stays: files with other names, links (none is followed), other folders. The caller sees to
/// it that no job reads or publishes: one that publishes an old result anew relies on the blobs that are
/// there. Killed at any point it leaves a store in which every entry has the blobs that it had.
///
/// Throws Error: code store for what Upstream::open refuses, for a folder that is somebody's local cache
/// (collected by collect() of gc.hpp, with its locks), and for a folder or an entry that cannot be read, in
/// ac/ before any blob is removed, since it might name it; code usage for the address of a server.
UpstreamCollected collect_upstream(const std::string& place, const UpstreamCollectOptions& options,
                                   std::shared_ptr<FileSystem> files = {});

}  // namespace ballflow
