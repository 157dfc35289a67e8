// An open file or folder of a FileSystem that closes itself.
#pragma once

#include <fcntl.h>

#include <cerrno>
#include <utility>

#include "ballflow/file_system.hpp"

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
  int close() { return is_open() ? files_->close(std::exchange(file_, -EBADF)) : 0; }

 private:
  FileSystem* files_ = nullptr;
  int file_ = -EBADF;
};

inline constexpr int folder_flags = O_RDONLY | O_DIRECTORY | O_NOFOLLOW;
// Not blocking: a pipe in the place of a file must not stop the program.
inline constexpr int file_flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK;

}  // namespace ballflow
