// locks/: who computes which key, and who collects. All are flocks, on files that are open for writing: NFS
// makes byte-range locks of them and refuses those of a file that is open for reading only.
#pragma once

#include <chrono>
#include <functional>
#include <memory>

#include "store/folders.hpp"

namespace ballflow {

/// Opens, and perhaps makes, a file that is there to be locked.
inline constexpr int lock_flags = O_RDWR | O_NOFOLLOW | O_NONBLOCK;

/// What Store::lock and try_lock promise.
class KeyLocks {
 public:
  /// `failed` is told why a lock file cannot be made.
  KeyLocks(std::shared_ptr<const StoreFolders> folders,
           std::function<void(const std::string& what, int error)> failed)
      : folders_(std::move(folders)), failed_(std::move(failed)) {}

  LockAttempt try_lock(const Digest& key);
  std::unique_ptr<KeyLock> lock(const Digest& key, const std::function<bool()>& give_up);

 private:
  std::shared_ptr<const StoreFolders> folders_;
  std::function<void(const std::string&, int)> failed_;
};

/// Removes the lock files of keys whose process was killed.
void remove_dead_locks(const StoreFolders& folders);

/// An flock on a file of locks/ that stays there.
class NamedLock {
 public:
  NamedLock(const StoreFolders& folders, const char* name, std::chrono::milliseconds patience);

  /// Somebody else has it. (A file system that cannot lock does not keep anybody from working.)
  bool busy() const { return result_ == -EWOULDBLOCK; }

 private:
  OpenFile file_;
  int result_ = 0;
};

/// Whether `name` is still the name of a locked file: its owner removes the file before it lets go.
bool still_names(const StoreFolders& folders, const OpenFile& folder, const std::string& name,
                 const struct stat& locked);

/// Why locks exclude processes of this host only, although other hosts may use the store: "/scratch is an
/// nfs4 mount with local_lock=flock"; empty when they reach as far as the store.
std::string locks_stay_here(const StoreFolders& folders);

}  // namespace ballflow
