#include "export/output_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "ballflow/error.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t buffer_size = 1 << 16;

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  std::error_code ignored;
  // A link keeps pointing at the file that is replaced.
  if (fs::is_symlink(path, ignored)) {
    const fs::path target = fs::canonical(path, ignored);
    if (!ignored) path_ = target.string();
  }
  const fs::file_status status = fs::status(path_, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
  } else {
    static std::atomic<unsigned> count{0};
    temporary_ = path_ + ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(count++);
    file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  }
  if (file_ < 0) {
    const int error = errno;
    temporary_.clear();  // not ours
    fail(error);
  }
  buffer_.reserve(buffer_size);
}

OutputFile::~OutputFile() {
  if (file_ >= 0) ::close(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::write(const void* data, std::size_t size) {
  if (buffer_.size() + size > buffer_size) flush();
  if (size > buffer_size) {
    write_through(static_cast<const char*>(data), size);
  } else {
    buffer_.append(static_cast<const char*>(data), size);
  }
}

OutputFile& OutputFile::operator<<(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return *this << std::string_view(text, static_cast<std::size_t>(end - text));
}

void OutputFile::commit() {
  flush();
  const int closed = ::close(file_);
  file_ = -1;
  if (closed != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

void OutputFile::flush() {
  write_through(buffer_.data(), buffer_.size());
  buffer_.clear();
}

void OutputFile::write_through(const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(file_, data, size);
    if (written < 0 && errno != EINTR) fail(errno);
    if (written <= 0) continue;
    data += written;
    size -= static_cast<std::size_t>(written);
  }
}

void OutputFile::fail(int error) const {
  throw Error(ExitCode::store, "cannot write " + path_ + ": " + std::strerror(error),
              "choose a place that exists, can be written and has space left");
}

}  // namespace ballflow
