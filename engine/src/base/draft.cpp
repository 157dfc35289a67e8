#include "base/draft.hpp"

#include <algorithm>
#include <cstdint>
#include <random>

namespace ballflow {
namespace {

constexpr std::size_t write_at_once = 8 << 20;
constexpr std::size_t longest_name = 255, longest_host = 64;  // bytes; NAME_MAX of every file system of Linux

}  // namespace

std::string random_hex() {
  static thread_local std::random_device device;
  static constexpr char digits[] = "0123456789abcdef";
  std::string text;
  for (int word = 0; word < 2; ++word) {
    std::uint32_t bits = device();
    for (int i = 0; i < 8; ++i, bits >>= 4) text += digits[bits & 15];
  }
  return text;
}

std::string temporary_name(FileSystem& files, const std::string& name) {
  const std::string machine = files.machine();
  const std::string suffix =
      ".tmp-" + machine.substr(0, std::min(machine.rfind('-'), longest_host)) + '-' + random_hex();
  return name.substr(0, longest_name - suffix.size()) + suffix;
}

Draft::Draft(FileSystem& files, int folder, std::string name, mode_t mode)
    : files_(files),
      folder_(folder),
      name_(std::move(name)),
      file_(files, files.open(folder, name_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, mode)),
      there_(file_.is_open()) {}

Draft::~Draft() {
  if (there_) files_.remove(folder_, name_);
}

int Draft::write(std::span<const std::byte> bytes, const std::function<bool()>& give_up) {
  while (!bytes.empty()) {
    if (give_up && give_up()) return -ECANCELED;
    const ssize_t written = files_.write(file_.get(), bytes.data(), std::min(bytes.size(), write_at_once));
    if (written <= 0) return written < 0 ? static_cast<int>(written) : -EIO;
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
  return 0;
}

int Draft::sync() { return files_.sync(file_.get()); }

int Draft::publish(int folder, const std::string& name, bool replace) {
  if (const int error = file_.close(); error < 0) return error;
  int result = files_.rename(folder_, name_, folder, name, replace);
  if (!replace && (result == -EINVAL || result == -ENOSYS || result == -EOPNOTSUPP)) {
    // The file system cannot promise not to replace: a second name can (the first one goes with the draft).
    result = files_.link(folder_, name_, folder, name);
    if (result != -EPERM && result != -ENOSYS && result != -EOPNOTSUPP) return result;
    // No hard links either: look, and leave a gap in which another may come first and be replaced.
    struct stat status {};
    if (files_.status(folder, name, status) == 0) return -EEXIST;
    result = files_.rename(folder_, name_, folder, name, true);
  }
  there_ = result < 0;
  return result;
}

}  // namespace ballflow
