#include "store/locks.hpp"

#include <algorithm>
#include <thread>

#include "base/mounts.hpp"
#include "store/owner.hpp"

namespace ballflow {
namespace {

using namespace std::chrono_literals;

class FileLock final : public KeyLock {
 public:
  FileLock(std::shared_ptr<const StoreFolders> folders, std::string name, OpenFile file)
      : folders_(std::move(folders)), name_(std::move(name)), file_(std::move(file)) {}
  ~FileLock() override {
    if (!maker_.is_this_process()) return;
    // Removed while it is locked: whoever waits for it finds out that its file has no name any more.
    folders_->files->remove(folders_->locks.get(), name_);
  }

 private:
  std::shared_ptr<const StoreFolders> folders_;
  std::string name_;
  OpenFile file_;
  Maker maker_;
};

}  // namespace

LockAttempt KeyLocks::try_lock(const Digest& key) {
  if (!folders_->writing) return {};
  FileSystem& files = *folders_->files;
  const std::string name = key.hex();
  for (;;) {
    OpenFile file(files, files.open(folders_->locks.get(), name, lock_flags | O_CREAT, lock_mode));
    if (!file.is_open()) {
      failed_("locks/" + name, file.get());
      return {};
    }
    const int result = files.try_lock(file.get());
    if (result == -EWOULDBLOCK) return {nullptr, true};
    if (result < 0) return {};
    struct stat status {};
    if (files.status(file.get(), status) < 0) return {};
    if (!still_names(*folders_, folders_->locks, name, status)) continue;
    return {std::make_unique<FileLock>(folders_, name, std::move(file)), false};
  }
}

std::unique_ptr<KeyLock> KeyLocks::lock(const Digest& key, const std::function<bool()>& give_up) {
  auto pause = 1ms;
  for (;;) {
    LockAttempt attempt = try_lock(key);
    if (!attempt.busy || (give_up && give_up())) return std::move(attempt.lock);
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, 20ms);
  }
}

void remove_dead_locks(const StoreFolders& folders) {
  // Another host's lock looks free here; taken away, it would not keep its own processes apart any more.
  if (!locks_stay_here(folders).empty()) return;
  for (const std::string& name : names_in(folders, folders.locks)) {
    if (!Digest::from_hex(name)) continue;
    const OpenFile file(*folders.files, folders.files->open(folders.locks.get(), name, lock_flags));
    // Whoever waits for it meanwhile finds out that it has lost its name.
    if (file.is_open() && folders.files->try_lock(file.get()) == 0) {
      folders.files->remove(folders.locks.get(), name);
    }
  }
}

NamedLock::NamedLock(const StoreFolders& folders, const char* name, std::chrono::milliseconds patience)
    : file_(*folders.files, folders.files->open(folders.locks.get(), name, lock_flags | O_CREAT, lock_mode)) {
  if (!file_.is_open()) return;
  auto pause = 1ms;
  while ((result_ = folders.files->try_lock(file_.get())) == -EWOULDBLOCK && patience > 0ms) {
    std::this_thread::sleep_for(pause);
    patience -= pause;
    pause = std::min(2 * pause, 20ms);
  }
}

bool still_names(const StoreFolders& folders, const OpenFile& folder, const std::string& name,
                 const struct stat& locked) {
  struct stat named {};
  return folders.files->status(folder.get(), name, named) == 0 && named.st_ino == locked.st_ino &&
         named.st_dev == locked.st_dev;
}

std::string locks_stay_here(const StoreFolders& folders) {
  if (!folders.root.is_open()) return {};
  const Mount mount = folders.files->mount(folders.root.get());
  const std::string option = host_local_locks(mount);
  if (option.empty()) return {};
  return mount.point + " is mounted as " + mount.type + (option == mount.type ? "" : " with " + option);
}

}  // namespace ballflow
