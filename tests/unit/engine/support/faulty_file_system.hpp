// The real file system with faults, counters and a clock that can be turned.
#pragma once

#include <algorithm>
#include <cerrno>
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "ballflow/file_system.hpp"

namespace ballflow::test {

class FaultyFileSystem : public FileSystem {
 public:
  /// Asked before every call, by name; a negative value is returned instead of making the call.
  std::function<int(const std::string& call)> fault;
  std::size_t write_at_most = SIZE_MAX;  // bytes per call
  std::int64_t clock_offset = 0;
  bool lose_reply = false;  // of a link that was made: the server sees the request again, as NFS may do
  std::uint64_t disk = 0;   // bytes of the disk; 0: of the real one
  std::function<void()> before_read;
  std::function<void(struct stat&)> after_status;

  int count(const std::string& call) const {
    const auto found = counts_.find(call);
    return found == counts_.end() ? 0 : found->second;
  }
  int total() const {
    int sum = 0;
    for (const auto& [call, number] : counts_) sum += number;
    return sum;
  }
  void reset_counts() { counts_.clear(); }

  int open(int folder, const std::string& name, int flags, mode_t mode) override {
    const int error = enter("open");
    return error < 0 ? error : FileSystem::open(folder, name, flags, mode);
  }
  int close(int file) override {
    const int error = enter("close");
    const int result = FileSystem::close(file);  // also when it reports an error, as on Linux
    return error < 0 ? error : result;
  }
  ssize_t read(int file, void* data, std::size_t size) override {
    const int error = enter("read");
    if (before_read) before_read();
    return error < 0 ? error : FileSystem::read(file, data, size);
  }
  ssize_t write(int file, const void* data, std::size_t size) override {
    const int error = enter("write");
    return error < 0 ? error : FileSystem::write(file, data, std::min(size, write_at_most));
  }
  int sync(int) override { return enter("sync"); }  // tests need not wait for a disk
  int status(int file, struct stat& status) override {
    int error = enter("status");
    if (error == 0) error = FileSystem::status(file, status);
    if (error == 0 && after_status) after_status(status);
    return error;
  }
  int status(int folder, const std::string& name, struct stat& status) override {
    const int error = enter("status");
    return error < 0 ? error : FileSystem::status(folder, name, status);
  }
  int set_mode(int file, mode_t mode) override {
    const int error = enter("set_mode");
    return error < 0 ? error : FileSystem::set_mode(file, mode);
  }
  int writable(int folder) override {
    const int error = enter("writable");
    return error < 0 ? error : FileSystem::writable(folder);
  }
  int make_folder(int folder, const std::string& name, mode_t mode) override {
    const int error = enter("make_folder");
    return error < 0 ? error : FileSystem::make_folder(folder, name, mode);
  }
  int rename(int from_folder, const std::string& from, int to_folder, const std::string& to,
             bool replace) override {
    const int error = enter(replace ? "rename_replace" : "rename");
    return error < 0 ? error : FileSystem::rename(from_folder, from, to_folder, to, replace);
  }
  int link(int from_folder, const std::string& from, int to_folder, const std::string& to) override {
    const int error = enter("link");
    if (error < 0) return error;
    const int linked = FileSystem::link(from_folder, from, to_folder, to);
    return linked == 0 && lose_reply ? -EEXIST : linked;
  }
  int remove(int folder, const std::string& name) override {
    const int error = enter("remove");
    return error < 0 ? error : FileSystem::remove(folder, name);
  }
  int remove_folder(int folder, const std::string& name) override {
    const int error = enter("remove_folder");
    return error < 0 ? error : FileSystem::remove_folder(folder, name);
  }
  int list(int folder, std::vector<std::string>& names) override {
    const int error = enter("list");
    return error < 0 ? error : FileSystem::list(folder, names);
  }
  int touch(int file) override {
    const int error = enter("touch");
    return error < 0 ? error : FileSystem::touch(file);
  }
  int capacity(int folder, std::uint64_t& bytes) override {
    const int error = enter("capacity");
    if (error == 0 && disk != 0) bytes = disk;
    return error < 0 || disk != 0 ? error : FileSystem::capacity(folder, bytes);
  }
  int try_lock(int file) override {
    const int error = enter("try_lock");
    return error < 0 ? error : FileSystem::try_lock(file);
  }
  bool process_alive(pid_t process) override {
    return enter("process_alive") == 0 && FileSystem::process_alive(process);
  }
  std::int64_t now() override { return FileSystem::now() + clock_offset; }

 private:
  int enter(const std::string& call) {
    const std::lock_guard lock(mutex_);
    ++counts_[call];
    return fault ? std::min(fault(call), 0) : 0;
  }

  std::mutex mutex_;
  std::map<std::string, int> counts_;
};

}  // namespace ballflow::test
