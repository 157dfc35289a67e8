#include "store/folders.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include "ballflow/error.hpp"
#include "base/draft.hpp"

namespace ballflow {
namespace {

OpenFile open_folder(FileSystem& files, int parent, const std::string& name, int flags) {
  return {files, files.open(parent, name, flags)};
}

/// Makes `folder` and those above it; a negative errno value when that cannot be.
int make_folders(FileSystem& files, const std::filesystem::path& folder) {
  std::filesystem::path above;
  for (const std::filesystem::path& component : folder) {
    above /= component;
    const int made = files.make_folder(FileSystem::working_folder, above.string(), folder_mode);
    if (made < 0 && made != -EEXIST) return made;
  }
  return 0;
}

void check_trust(FileSystem& files, const OpenFile& folder, const std::string& name) {
  struct stat status {};
  const int error = files.status(folder.get(), status);
  const std::string reason = error < 0 ? "cannot be examined: " + system_message(error) : distrust(status);
  if (reason.empty()) return;
  throw Error(ExitCode::store, "refused cache folder " + name + ": it " + reason,
              "what is in a cache is believed; make it yours alone (chown, chmod go-w " + name +
                  ") or choose another folder with BALLFLOW_CACHE");
}

/// Tells backup programs to skip the folder.
void tag(FileSystem& files, const OpenFile& root) {
  constexpr std::string_view text = "Signature: 8a477f597d28d172789f06886806bc55\n";
  const OpenFile file(files, files.open(root.get(), "CACHEDIR.TAG", O_WRONLY | O_CREAT | O_EXCL, 0644));
  if (file.is_open()) files.write(file.get(), text.data(), text.size());
}

/// Opens, or makes, one of the folders in the root.
void open_top(StoreFolders& store, OpenFile& folder, const std::string& name) {
  FileSystem& files = *store.files;
  const std::string shown = store.path + '/' + name;
  const auto cannot = [&](const char* what, int error) {
    store.why = std::string("cannot ") + what + ' ' + shown + ": " + system_message(error);
    store.writing = false;
  };
  folder = open_folder(files, store.root.get(), name, folder_flags);
  if (folder.get() == -ENOENT && store.writing) {
    const int made = files.make_folder(store.root.get(), name, folder_mode);
    if (made < 0 && made != -EEXIST) {
      cannot("create", made);
    } else {
      folder = open_folder(files, store.root.get(), name, folder_flags);
      if (&folder == &store.cas) tag(files, store.root);
    }
  }
  if (folder.get() == -ELOOP || folder.get() == -ENOTDIR) {
    throw Error(ExitCode::store,
                "refused cache folder " + store.path + ": its \"" + name + "\" is a link or not a folder",
                "remove " + shown + " or choose another folder with BALLFLOW_CACHE");
  }
  if (folder.is_open()) {
    check_trust(files, folder, shown);
  } else if (folder.get() != -ENOENT && store.writing) {
    cannot("open", folder.get());
  }
}

}  // namespace

std::shared_ptr<const StoreFolders> open_folders(const StoreOptions& options,
                                                 std::shared_ptr<FileSystem> file_system) {
  const auto store = std::make_shared<StoreFolders>();
  store->files = file_system != nullptr ? std::move(file_system) : std::make_shared<FileSystem>();
  FileSystem& files = *store->files;
  if (options.root.empty()) {
    store->why = "there is no cache folder";
    return store;
  }
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::absolute(options.root, ignored);
  std::string& root = store->path = path.string();
  while (root.size() > 1 && root.back() == '/') root.pop_back();

  constexpr int root_flags = O_RDONLY | O_DIRECTORY;  // the root itself may be reached through a link
  store->root = open_folder(files, FileSystem::working_folder, root, root_flags);
  if (store->root.get() == -ENOENT && !options.read_only) {
    if (const int error = make_folders(files, path); error < 0) {
      store->why = "cannot create " + root + ": " + system_message(error);
      return store;
    }
    store->root = open_folder(files, FileSystem::working_folder, root, root_flags);
  }
  if (!store->root.is_open()) {
    store->why = "cannot open " + root + ": " + system_message(store->root.get());
    return store;
  }
  check_trust(files, store->root, root);
  const int writable = files.writable(store->root.get());
  if (options.read_only) {
    store->why = "read-only as requested";
  } else if (writable < 0) {
    store->why = "cannot write to " + root + ": " + system_message(writable);
  }
  store->writing = store->why.empty();
  const std::pair<OpenFile*, const char*> tops[] = {
      {&store->cas, "cas"},     {&store->ac, "ac"},       {&store->runs, "runs"},
      {&store->pins, "pins"},   {&store->tmp, "tmp"},     {&store->quarantine, "quarantine"},
      {&store->memos, "files"}, {&store->locks, "locks"}, {&store->leases, "leases"}};
  for (const auto& [folder, name] : tops) open_top(*store, *folder, name);
  return store;
}

OpenFile open_shard(const StoreFolders& folders, const OpenFile& top, const std::string& hex, bool create) {
  FileSystem& files = *folders.files;
  if (!top.is_open()) return {files, -ENOENT};
  const std::string name = shard_of(hex);
  OpenFile shard = open_folder(files, top.get(), name, folder_flags);
  if (shard.get() == -ENOENT && create) {
    const int made = files.make_folder(top.get(), name, folder_mode);
    if (made < 0 && made != -EEXIST) return {files, made};
    shard = open_folder(files, top.get(), name, folder_flags);
  }
  struct stat status {};
  if (shard.is_open() && (files.status(shard.get(), status) < 0 || !distrust(status).empty())) {
    return {files, -EACCES};
  }
  return shard;
}

std::optional<std::string> read_trusted(const StoreFolders& folders, const OpenFile& folder,
                                        const std::string& name, std::uint64_t limit, bool used) {
  if (!folder.is_open()) return std::nullopt;
  FileSystem& files = *folders.files;
  const OpenFile file(files, files.open(folder.get(), name, file_flags));
  struct stat status {};
  if (!file.is_open() || files.status(file.get(), status) < 0) return std::nullopt;
  if (!S_ISREG(status.st_mode) || !distrust(status).empty()) return std::nullopt;
  if (static_cast<std::uint64_t>(status.st_size) > limit) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t have = 0; have < bytes.size();) {
    const ssize_t got = files.read(file.get(), bytes.data() + have, bytes.size() - have);
    if (got <= 0) return std::nullopt;
    have += static_cast<std::size_t>(got);
  }
  if (used) touch(folders, file, status);
  return bytes;
}

std::vector<std::string> names_in(const StoreFolders& folders, const OpenFile& folder) {
  std::vector<std::string> names;
  if (folder.is_open()) folders.files->list(folder.get(), names);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<StoredFile> files_below(const StoreFolders& folders, const OpenFile& top) {
  std::vector<StoredFile> found;
  for (const std::string& shard : names_in(folders, top)) {
    const OpenFile folder = open_folder(*folders.files, top.get(), shard, folder_flags);
    for (const std::string& rest : names_in(folders, folder)) {
      const auto name = Digest::from_hex(shard + rest);
      struct stat status {};
      if (!name || shard.size() != 2 || folders.files->status(folder.get(), rest, status) < 0) continue;
      if (!S_ISREG(status.st_mode)) continue;
      found.push_back({*name, static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim)});
    }
  }
  return found;
}

bool to_quarantine(const StoreFolders& folders, const OpenFile& shard, const std::string& hex) {
  return folders.writing && folders.quarantine.is_open() &&
         folders.files->rename(shard.get(), rest_of(hex), folders.quarantine.get(), hex + '-' + random_hex(),
                               true) == 0;
}

void touch(const StoreFolders& folders, const OpenFile& file, const struct stat& status) {
  if (folders.writing && folders.files->now() - nanoseconds(status.st_mtim) >= touch_interval) {
    folders.files->touch(file.get());
  }
}

}  // namespace ballflow
