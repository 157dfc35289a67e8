// What the store and its collector (cache_gc.cpp, cache_verify.cpp) share: open files and folders of a store.
#pragma once

#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdint>
#include <string>
#include <utility>

#include "ballflow/file_system.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

class OpenFile {
 public:
  OpenFile() = default;
  OpenFile(FileSystem& files, int file) : files_(&files), file_(file) {}
  OpenFile(OpenFile&& other) noexcept : files_(other.files_), file_(std::exchange(other.file_, -EBADF)) {}
  OpenFile& operator=(OpenFile&& other) noexcept {
    std::swap(files_, other.files_);
    std::swap(file_, other.file_);
    return *this;
  }
  ~OpenFile() { close(); }

  /// The descriptor, or the negative errno value of the attempt to open it.
  int get() const { return file_; }
  bool is_open() const { return file_ >= 0; }
  int release() { return std::exchange(file_, -EBADF); }
  int close() { return is_open() ? files_->close(std::exchange(file_, -EBADF)) : 0; }

 private:
  FileSystem* files_ = nullptr;
  int file_ = -EBADF;
};

inline constexpr int folder_flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW;
// Not blocking: a pipe in the place of a file must not stop the program.
inline constexpr int file_flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK;
inline constexpr mode_t lock_mode = 0600;

inline std::string shard_of(const std::string& hex) { return hex.substr(0, 2); }
inline std::string rest_of(const std::string& hex) { return hex.substr(2); }

inline std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

/// Why the owner or the mode of a file or folder makes it unfit for a cache; empty when they do not.
std::string distrust(const struct stat& status);

std::string random_hex();

/// What a file costs on the disk: whole blocks of 4 KiB.
inline std::uint64_t disk_bytes(std::uint64_t size) { return (size + 4095) / 4096 * 4096; }

/// The time of last use of an action entry or a blob is the mtime of its file, set anew when it is used and
/// older than this (nanoseconds).
inline constexpr std::int64_t touch_interval = std::int64_t{3600} * 1'000'000'000;

/// The open folders of a store; negative when a folder is absent.
struct StoreFolders {
  FileSystem* files;
  int root, cas, ac, runs, pins, quarantine, memos, locks, leases;
  bool writing;

  explicit StoreFolders(Store& store);
};

}  // namespace ballflow
