#include "ballflow/file_system.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>

#include "base/mounts.hpp"

namespace ballflow {
namespace {

/// Repeats an interrupted call; turns -1 into -errno.
template <class Call>
auto call(Call function) -> decltype(function()) {
  for (;;) {
    const auto result = function();
    if (result >= 0) return result;
    if (errno != EINTR) return -errno;
  }
}

/// The text of a small file of /proc; empty when there is none.
std::string proc_text(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return {};
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t got = 0; (got = call([&] { return ::read(file, buffer.data(), buffer.size()); })) > 0;) {
    text.append(buffer.data(), static_cast<std::size_t>(got));
  }
  ::close(file);
  return text;
}

}  // namespace

const int FileSystem::working_folder = AT_FDCWD;

int FileSystem::open(int folder, const std::string& name, int flags, mode_t mode) {
  return call([&] { return ::openat(folder, name.c_str(), flags | O_CLOEXEC, mode); });
}

// Not repeated: Linux has closed the file even when it reports an interruption.
int FileSystem::close(int file) { return ::close(file) == 0 || errno == EINTR ? 0 : -errno; }

ssize_t FileSystem::read(int file, void* data, std::size_t size) {
  return call([&] { return ::read(file, data, size); });
}

ssize_t FileSystem::write(int file, const void* data, std::size_t size) {
  return call([&] { return ::write(file, data, size); });
}

int FileSystem::sync(int file) {
  return call([&] { return ::fsync(file); });
}

int FileSystem::status(int file, struct stat& status) {
  return call([&] { return ::fstat(file, &status); });
}

int FileSystem::status(int folder, const std::string& name, struct stat& status) {
  return call([&] { return ::fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW); });
}

int FileSystem::set_mode(int file, mode_t mode) {
  return call([&] { return ::fchmod(file, mode); });
}

int FileSystem::writable(int folder) {
  return call([&] { return ::faccessat(folder, ".", W_OK | X_OK, AT_EACCESS); });
}

int FileSystem::make_folder(int folder, const std::string& name, mode_t mode) {
  return call([&] { return ::mkdirat(folder, name.c_str(), mode); });
}

int FileSystem::rename(int from_folder, const std::string& from, int to_folder, const std::string& to,
                       bool replace) {
  return call([&] {
    return ::renameat2(from_folder, from.c_str(), to_folder, to.c_str(), replace ? 0 : RENAME_NOREPLACE);
  });
}

int FileSystem::link(int from_folder, const std::string& from, int to_folder, const std::string& to) {
  return call([&] { return ::linkat(from_folder, from.c_str(), to_folder, to.c_str(), 0); });
}

int FileSystem::remove(int folder, const std::string& name) {
  return call([&] { return ::unlinkat(folder, name.c_str(), 0); });
}

int FileSystem::remove_folder(int folder, const std::string& name) {
  return call([&] { return ::unlinkat(folder, name.c_str(), AT_REMOVEDIR); });
}

int FileSystem::list(int folder, std::vector<std::string>& names) {
  names.clear();
  // A description of its own: reading moves the position, which dup() would share.
  const int own = open(folder, ".", O_RDONLY | O_DIRECTORY);
  if (own < 0) return own;
  DIR* const entries = ::fdopendir(own);
  if (entries == nullptr) {
    const int error = -errno;
    ::close(own);
    return error;
  }
  errno = 0;
  while (const dirent* entry = ::readdir(entries)) {
    const char* const name = entry->d_name;
    if (std::strcmp(name, ".") != 0 && std::strcmp(name, "..") != 0) names.emplace_back(name);
    errno = 0;
  }
  const int error = -errno;
  ::closedir(entries);
  return error;
}

int FileSystem::touch(int file) {
  constexpr timespec keep_access_modify_now[2] = {{0, UTIME_OMIT}, {0, UTIME_NOW}};
  return call([&] { return ::futimens(file, keep_access_modify_now); });
}

int FileSystem::capacity(int folder, std::uint64_t& bytes) {
  struct statvfs disk {};
  const int result = call([&] { return ::fstatvfs(folder, &disk); });
  bytes = result == 0 ? std::uint64_t{disk.f_blocks} * disk.f_frsize : 0;
  return result;
}

Mount FileSystem::mount(int folder) {
  constexpr std::string_view label = "mnt_id:";
  const std::string info = proc_text("/proc/self/fdinfo/" + std::to_string(folder));
  const std::size_t at = info.find(label);
  if (at == std::string::npos) return {};
  const std::size_t begin = info.find_first_not_of(" \t", at + label.size());
  long id = 0;
  if (begin == std::string::npos ||
      std::from_chars(info.data() + begin, info.data() + info.size(), id).ec != std::errc()) {
    return {};
  }
  return find_mount(proc_text("/proc/self/mountinfo"), id).value_or(Mount());
}

std::string FileSystem::machine() {
  std::array<char, 256> host{};
  if (::gethostname(host.data(), host.size() - 1) != 0 || host[0] == '\0') host = {"unknown"};
  std::string name = host.data();
  for (char& c : name) {
    if (c == '/') c = '_';
  }
  std::string boot;
  for (const char c : proc_text("/proc/sys/kernel/random/boot_id")) {
    if (std::isxdigit(static_cast<unsigned char>(c))) boot += c;
  }
  return name + '-' + (boot.empty() ? "0" : boot);
}

int FileSystem::try_lock(int file) {
  return call([&] { return ::flock(file, LOCK_EX | LOCK_NB); });
}

bool FileSystem::process_alive(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

std::int64_t FileSystem::now() {
  timespec time{};
  ::clock_gettime(CLOCK_REALTIME, &time);
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace ballflow
