// What the system says of a file without reading it: which state it is in, and whom it belongs to.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <string>

namespace ballflow {

class RecordReader;
class RecordWriter;

inline std::int64_t nanoseconds(const timespec& time) { return time.tv_sec * 1'000'000'000 + time.tv_nsec; }

/// What tells one state of a file from another without reading it.
struct FileState {
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t modified = 0, changed = 0;  // nanoseconds since 1970

  FileState() = default;
  explicit FileState(const struct stat& status);
  friend bool operator==(const FileState&, const FileState&) = default;

  /// Old enough that any later write gives another time stamp.
  bool settled(std::int64_t now) const;
  /// Where the digest of the file is kept, in files/ of the store.
  std::string memo_name() const;
};

/// Device, inode, size and both times, in this order.
void encode(const FileState& state, RecordWriter& writer);
FileState decode_state(RecordReader& reader);

/// Why the owner or the mode of a file or folder makes it unfit for a cache; empty when they do not.
std::string distrust(const struct stat& status);

}  // namespace ballflow
