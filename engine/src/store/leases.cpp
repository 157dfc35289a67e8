#include "store/leases.hpp"

#include <algorithm>
#include <thread>

#include "store/locks.hpp"
#include "store/owner.hpp"
#include "store/parts.hpp"

namespace ballflow {
namespace {

using namespace std::chrono_literals;

/// A new locked file of leases/; not open when the store cannot lock.
OpenFile lock_new_file(const StoreFolders& folders, const std::string& name) {
  FileSystem& files = *folders.files;
  OpenFile file(files, files.open(folders.leases.get(), name, lock_flags | O_CREAT | O_EXCL, lock_mode));
  if (!file.is_open()) return file;
  int result = 0;
  // Somebody who only counts leases holds it for a moment.
  for (auto patience = 1000ms; (result = files.try_lock(file.get())) == -EWOULDBLOCK && patience > 0ms;) {
    std::this_thread::sleep_for(1ms);
    patience -= 1ms;
  }
  if (result < 0) {
    files.remove(folders.leases.get(), name);
    return {files, result};
  }
  return file;
}

}  // namespace

std::unique_ptr<Lease> Lease::take(const std::shared_ptr<Store>& store) {
  const StoreFolders& folders = store->parts().folders;
  if (!folders.writing || !folders.leases.is_open()) return nullptr;
  // Collectors look at leases under this lock: from now on they see this one before they remove anything.
  const NamedLock quiet(folders, leases_lock, 1000ms);
  constexpr int attempts = 3;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const std::string name = owned_name(*folders.files);
    OpenFile file = lock_new_file(folders, name);
    if (!file.is_open()) return nullptr;
    struct stat status {};
    if (folders.files->status(file.get(), status) < 0) return nullptr;
    // Taken for dead before it was locked, by a collector that we did not wait for: once more.
    if (!still_names(folders, folders.leases, name, status)) continue;
    std::unique_ptr<Lease> lease(new Lease);
    lease->store_ = store;
    lease->name_ = name;
    lease->file_ = std::make_unique<OpenFile>(std::move(file));
    lease->maker_ = std::make_unique<Maker>();
    return lease;
  }
  return nullptr;
}

Lease::~Lease() {
  if (store_ == nullptr || !maker_->is_this_process()) return;
  const StoreFolders& folders = store_->parts().folders;
  folders.files->remove(folders.leases.get(), name_);  // while it is locked
}

LiveRuns live_runs(const StoreFolders& folders, bool remove_dead) {
  FileSystem& files = *folders.files;
  const bool blind = !locks_stay_here(folders).empty();
  const std::string here = host_of(files.machine());
  LiveRuns live;
  for (const std::string& name : names_in(folders, folders.leases)) {
    // For writing, see locks.hpp; whoever may only read the store asks as well as that goes.
    OpenFile file(files, files.open(folders.leases.get(), name, folders.writing ? lock_flags : file_flags));
    struct stat status {};
    if (!file.is_open() || files.status(file.get(), status) < 0) continue;
    const auto owner = owner_of(name);
    const bool ours = owner && owner->host == here;
    if (files.try_lock(file.get()) == 0) {
      if (!blind || ours) {
        if (remove_dead) files.remove(folders.leases.get(), name);
        continue;
      }
      // Free for us, and perhaps held on its own host. Its age tells nothing: runs take hours.
      live.unseen.push_back({"leases/" + name, owner ? owner->host : "", nanoseconds(status.st_mtim)});
    }
    ++live.count;
    live.since = std::min(live.since, nanoseconds(status.st_mtim));
  }
  return live;
}

}  // namespace ballflow
