#include "ballflow/store.hpp"

#include <fcntl.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <random>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "ballflow/error.hpp"
#include "ballflow/file_system.hpp"
#include "store/run_folders.hpp"
#include "store/store_folders.hpp"
#include "store/store_format.hpp"

namespace ballflow {
namespace {

constexpr std::uint64_t entry_limit = 64u << 20;  // no honest entry comes near it
constexpr std::size_t write_at_once = 8 << 20;
constexpr mode_t folder_mode = 0755, file_mode = 0444, private_mode = 0700;
constexpr std::uint64_t account_at = 64u
                                     << 20;  // bytes that may be lost from the count when a process is killed

std::string message(int negative_errno) { return std::generic_category().message(-negative_errno); }

OutputEntry entry_of(const Artifact& artifact) {
  return {{},
          artifact.type(),
          artifact.version(),
          artifact.digest(),
          artifact.file_size(),
          artifact.checksum(),
          artifact.summary()};
}

bool describes(const OutputEntry& output, const Artifact& artifact) {
  return output.bytes == artifact.file_size() && output.checksum == artifact.checksum() &&
         output.type == artifact.type() && output.type_version == artifact.version() &&
         output.summary == artifact.summary();
}

}  // namespace

std::string distrust(const struct stat& status) {
  if (status.st_uid != ::geteuid() && status.st_uid != 0) {
    return "belongs to another user (id " + std::to_string(status.st_uid) + ")";
  }
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    std::string mode = "0000";
    for (std::size_t i = 0; i < mode.size(); ++i) {
      mode[i] = static_cast<char>('0' + (status.st_mode >> (9 - 3 * i) & 7));
    }
    return "can be written by other users (mode " + mode + ")";
  }
  return {};
}

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

class StoreParts {
 public:
  std::shared_ptr<FileSystem> files;
  OpenFile root, cas, ac, runs, pins, tmp, quarantine, memos, locks, leases;
  bool writing = false;

  /// tmp/<host>-<boot>-<pid>-<random>/ of this process: made when first needed, locked while it lives.
  struct Workspace {
    FileSystem& files;
    int parent;
    std::string name;
    OpenFile folder;
    pid_t owner = ::getpid();

    ~Workspace() {
      if (::getpid() == owner) files.remove_folder(parent, name);  // not by a fork that inherited it
    }
  };
  std::mutex workspace_mutex;
  std::shared_ptr<Workspace> workspace;
  std::atomic<std::uint64_t> next_file = 0;
  std::atomic<std::uint64_t> added = 0;  // bytes written and not yet in `usage`

  mutable std::mutex trouble_mutex;
  std::string trouble;

  ~StoreParts() {
    account();
    workspace.reset();
  }

  /// Appends what this process has written to `usage` (one write: lines of several processes do not mix).
  void account() {
    const std::uint64_t bytes = added.exchange(0);
    if (bytes == 0) return;
    const OpenFile file(*files, files->open(root.get(), "usage",
                                            O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK, 0644));
    if (!file.is_open()) return;
    const std::string line = '+' + std::to_string(bytes) + '\n';
    files->write(file.get(), line.data(), line.size());
  }

  /// Records that an open file is used now.
  void touch(int file, const struct stat& status) {
    if (writing && files->now() - nanoseconds(status.st_mtim) >= touch_interval) files->touch(file);
  }

  bool failed(const std::string& what, int error) {
    const std::lock_guard lock(trouble_mutex);
    if (trouble.empty()) trouble = "cannot write " + what + ": " + message(error);
    return false;
  }

  std::string host_and_boot() {
    std::array<char, 256> host{};
    if (::gethostname(host.data(), host.size() - 1) != 0 || host[0] == '\0') host = {"unknown"};
    std::string name = host.data();
    for (char& c : name) {
      if (c == '/') c = '_';
    }
    std::array<char, 64> boot{};
    const OpenFile source(
        *files, files->open(FileSystem::working_folder, "/proc/sys/kernel/random/boot_id", O_RDONLY));
    const ssize_t size = source.is_open() ? files->read(source.get(), boot.data(), boot.size()) : 0;
    std::string id;
    for (ssize_t i = 0; i < size; ++i) {
      if (std::isxdigit(static_cast<unsigned char>(boot[static_cast<std::size_t>(i)]))) {
        id += boot[static_cast<std::size_t>(i)];
      }
    }
    return name + '-' + (id.empty() ? "0" : id);
  }

  std::shared_ptr<Workspace> open_workspace(int& error) {
    const std::lock_guard lock(workspace_mutex);
    if (workspace != nullptr && workspace->owner == ::getpid()) return workspace;
    const std::string name = host_and_boot() + '-' + std::to_string(::getpid()) + '-' + random_hex();
    error = files->make_folder(tmp.get(), name, private_mode);
    if (error < 0) return nullptr;
    OpenFile folder(*files, files->open(tmp.get(), name, folder_flags));
    error = folder.get();
    if (error < 0) {
      files->remove_folder(tmp.get(), name);
      return nullptr;
    }
    // Tells cleaners that this process lives even where they cannot see its id (another container). Some
    // network file systems do not lock folders; there the id has to do.
    files->try_lock(folder.get());
    workspace = std::shared_ptr<Workspace>(new Workspace{*files, tmp.get(), name, std::move(folder)});
    return workspace;
  }

  void remove_stale_workspaces() {
    std::vector<std::string> names;
    if (files->list(tmp.get(), names) < 0 || names.empty()) return;
    const std::string here = host_and_boot();
    const std::string host = here.substr(0, here.rfind('-'));
    for (const std::string& name : names) {
      // <host>-<boot>-<pid>-<random>, taken apart from the end: host names may contain '-'.
      const std::size_t random = name.rfind('-');
      const std::size_t pid =
          random == std::string::npos || random == 0 ? random : name.rfind('-', random - 1);
      if (pid == std::string::npos || pid == 0) continue;
      const std::string owner = name.substr(0, pid);
      pid_t process = 0;
      const auto parsed = std::from_chars(name.data() + pid + 1, name.data() + random, process);
      if (parsed.ec != std::errc() || parsed.ptr != name.data() + random || process <= 0) continue;
      const std::size_t boot = owner.rfind('-');
      if (boot == std::string::npos || owner.substr(0, boot) != host) continue;
      if (owner == here && files->process_alive(process)) continue;
      OpenFile folder(*files, files->open(tmp.get(), name, folder_flags));
      if (!folder.is_open() || files->try_lock(folder.get()) == -EWOULDBLOCK) continue;
      std::vector<std::string> left;
      files->list(folder.get(), left);
      for (const std::string& file : left) files->remove(folder.get(), file);
      files->remove_folder(tmp.get(), name);
    }
  }

  /// The subfolder of a hexadecimal name; a symbolic link or one that others may write is as good as none.
  OpenFile open_shard(const OpenFile& top, const std::string& hex, bool create) {
    if (!top.is_open()) return {*files, -ENOENT};
    const std::string name = shard_of(hex);
    OpenFile shard(*files, files->open(top.get(), name, folder_flags));
    if (shard.get() == -ENOENT && create) {
      const int made = files->make_folder(top.get(), name, folder_mode);
      if (made < 0 && made != -EEXIST) return {*files, made};
      shard = {*files, files->open(top.get(), name, folder_flags)};
    }
    struct stat status {};
    if (shard.is_open() && (files->status(shard.get(), status) < 0 || !distrust(status).empty())) {
      return {*files, -EACCES};
    }
    return shard;
  }

  std::optional<std::string> read_entry(const OpenFile& top, const std::string& hex, bool use) {
    const OpenFile shard = open_shard(top, hex, false);
    if (!shard.is_open()) return std::nullopt;
    const OpenFile file(*files, files->open(shard.get(), rest_of(hex), file_flags));
    struct stat status {};
    if (!file.is_open() || files->status(file.get(), status) < 0) return std::nullopt;
    if (!S_ISREG(status.st_mode) || !distrust(status).empty()) return std::nullopt;
    if (static_cast<std::uint64_t>(status.st_size) > entry_limit) return std::nullopt;
    std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
    for (std::size_t have = 0; have < bytes.size();) {
      const ssize_t got = files->read(file.get(), bytes.data() + have, bytes.size() - have);
      if (got <= 0) return std::nullopt;
      have += static_cast<std::size_t>(got);
    }
    if (use) touch(file.get(), status);
    return bytes;
  }

  /// A file being written; disappears unless it is published.
  struct Draft {
    FileSystem& files;
    std::shared_ptr<Workspace> place;
    std::string name;
    bool gone = false;
    Draft(FileSystem& f, std::shared_ptr<Workspace> p, std::string n)
        : files(f), place(std::move(p)), name(std::move(n)) {}
    Draft(const Draft&) = delete;
    ~Draft() {
      if (!gone) files.remove(place->folder.get(), name);
    }
  };

  /// -ECANCELED when it was given up.
  int write_draft(const std::vector<std::span<const std::byte>>& pieces, bool sync,
                  const std::function<bool()>& give_up, std::optional<Draft>& draft) {
    int error = 0;
    OpenFile file;
    for (int attempt = 0; attempt < 2 && !file.is_open(); ++attempt) {
      const std::shared_ptr<Workspace> place = open_workspace(error);
      if (place == nullptr) return error;
      const std::string name = std::to_string(next_file++);
      file = {*files,
              files->open(place->folder.get(), name, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, file_mode)};
      if (file.is_open()) {
        draft.emplace(*files, place, name);
      } else if (file.get() == -ENOENT) {  // someone removed the folder: make another
        const std::lock_guard lock(workspace_mutex);
        if (workspace == place) workspace.reset();
      } else {
        break;
      }
    }
    if (!file.is_open()) return file.get();
    for (std::span<const std::byte> piece : pieces) {
      while (!piece.empty()) {
        if (give_up && give_up()) return -ECANCELED;
        const ssize_t written = files->write(file.get(), piece.data(), std::min(piece.size(), write_at_once));
        if (written <= 0) return written < 0 ? static_cast<int>(written) : -EIO;
        piece = piece.subspan(static_cast<std::size_t>(written));
      }
    }
    if (sync && (error = files->sync(file.get())) < 0) return error;
    return file.close();
  }

  /// Writes a file under its hexadecimal name. Without `replace` a file that is there already wins.
  bool publish(const OpenFile& top, const std::string& folder, const std::string& hex,
               const std::vector<std::span<const std::byte>>& pieces, bool sync, bool replace,
               const std::function<bool()>& give_up = {}) {
    const std::string shown = folder + '/' + shard_of(hex) + '/' + rest_of(hex);
    std::optional<Draft> draft;
    int result = write_draft(pieces, sync, give_up, draft);
    if (result == -ECANCELED) return false;
    if (result < 0) return failed(shown, result);
    const OpenFile shard = open_shard(top, hex, true);
    if (!shard.is_open()) return failed(shown, shard.get());
    const int from = draft->place->folder.get();
    result = files->rename(from, draft->name, shard.get(), rest_of(hex), replace);
    if (!replace && (result == -EINVAL || result == -ENOSYS || result == -EOPNOTSUPP)) {
      result = files->link(from, draft->name, shard.get(), rest_of(hex));
      if (result == -EPERM || result == -ENOSYS || result == -EOPNOTSUPP) {
        // No hard links either: the file that may be replaced has the same name, hence the same bytes.
        result = files->rename(from, draft->name, shard.get(), rest_of(hex), true);
        draft->gone = result == 0;
      }
    } else {
      draft->gone = result == 0;
    }
    if (result == -EEXIST) return true;
    if (result < 0) return failed(shown, result);
    std::uint64_t size = 0;
    for (const std::span<const std::byte> piece : pieces) size += piece.size();
    if ((added += disk_bytes(size)) >= account_at) account();
    return true;
  }

  bool set_aside(const OpenFile& shard, const std::string& hex) {
    return writing && quarantine.is_open() &&
           files->rename(shard.get(), rest_of(hex), quarantine.get(), hex + '-' + random_hex(), true) == 0;
  }

  struct Fetched {
    ArtifactPtr artifact;
    bool damaged = false;
  };

  Fetched fetch(const OutputEntry& output) {
    const std::string hex = output.digest.hex();
    const OpenFile shard = open_shard(cas, hex, false);
    if (!shard.is_open()) return {};
    const OpenFile file(*files, files->open(shard.get(), rest_of(hex), file_flags));
    bool damaged = file.get() == -ELOOP;  // a symbolic link
    if (!file.is_open() && !damaged) return {};
    struct stat status {};
    if (!damaged && files->status(file.get(), status) < 0) return {};
    damaged = damaged || !S_ISREG(status.st_mode) || !distrust(status).empty();
    if (!damaged) {
      try {
        const std::string shown = "cas/" + shard_of(hex) + '/' + rest_of(hex);
        // The checksum in `output` vouches for the digest; only when it does not, the file is hashed.
        const ArtifactPtr artifact = Artifact::map(file.get(), shown, output.digest);
        if (describes(output, *artifact)) {
          touch(file.get(), status);
          return {artifact, false};
        }
        damaged = Artifact::map(file.get(), shown)->digest() != output.digest;
      } catch (const BadArtifact&) {
        damaged = true;
      } catch (const Error&) {  // no memory or no descriptors left: says nothing about the blob
      }
    }
    if (damaged) set_aside(shard, hex);
    return {nullptr, damaged};
  }

  void write_memo(const FileState& state, const Digest& digest) {
    const std::string bytes = encode(Memo{state, digest});
    publish(memos, "files", state.memo_name(), {std::as_bytes(std::span(bytes))}, false, true);
  }
};

std::shared_ptr<Store> Store::open(const StoreOptions& options, std::shared_ptr<FileSystem> files) {
  const std::shared_ptr<Store> store(new Store);
  store->parts_ = std::make_shared<StoreParts>();
  StoreParts& impl = *store->parts_;
  impl.files = files != nullptr ? std::move(files) : std::make_shared<FileSystem>();
  store->read_only_ = true;
  if (options.root.empty()) {
    store->why_ = "there is no cache folder";
    return store;
  }
  std::error_code ignored;
  const std::filesystem::path path = std::filesystem::absolute(options.root, ignored);
  store->root_ = path.string();
  while (store->root_.size() > 1 && store->root_.back() == '/') store->root_.pop_back();
  const std::string& root = store->root_;

  const auto open_folder = [&](int parent, const std::string& name, int flags) {
    return OpenFile(*impl.files, impl.files->open(parent, name, flags));
  };
  constexpr int root_flags = O_RDONLY | O_DIRECTORY;  // the root itself may be reached through a link
  impl.root = open_folder(FileSystem::working_folder, root, root_flags);
  if (impl.root.get() == -ENOENT && !options.read_only) {
    std::filesystem::path folder;
    int made = 0;
    for (const std::filesystem::path& component : path) {
      folder /= component;
      made = impl.files->make_folder(FileSystem::working_folder, folder.string(), folder_mode);
      if (made < 0 && made != -EEXIST) break;
    }
    if (made < 0 && made != -EEXIST) {
      store->why_ = "cannot create " + root + ": " + message(made);
      return store;
    }
    impl.root = open_folder(FileSystem::working_folder, root, root_flags);
  }
  if (!impl.root.is_open()) {
    store->why_ = "cannot open " + root + ": " + message(impl.root.get());
    return store;
  }

  const auto check = [&](const OpenFile& folder, const std::string& name) {
    struct stat status {};
    const int error = impl.files->status(folder.get(), status);
    const std::string reason = error < 0 ? "cannot be examined: " + message(error) : distrust(status);
    if (reason.empty()) return;
    throw Error(ExitCode::store, "refused cache folder " + name + ": it " + reason,
                "what is in a cache is believed; make it yours alone (chown, chmod go-w " + name +
                    ") or choose another folder with BALLFLOW_CACHE");
  };
  check(impl.root, root);
  int writable = impl.files->writable(impl.root.get());
  if (options.read_only) {
    store->why_ = "read-only as requested";
  } else if (writable < 0) {
    store->why_ = "cannot write to " + root + ": " + message(writable);
  }
  impl.writing = store->why_.empty();

  const std::pair<OpenFile*, const char*> tops[] = {
      {&impl.cas, "cas"},     {&impl.ac, "ac"},       {&impl.runs, "runs"},
      {&impl.pins, "pins"},   {&impl.tmp, "tmp"},     {&impl.quarantine, "quarantine"},
      {&impl.memos, "files"}, {&impl.locks, "locks"}, {&impl.leases, "leases"}};
  for (const auto& [folder, name] : tops) {
    *folder = open_folder(impl.root.get(), name, folder_flags);
    if (folder->get() == -ENOENT && impl.writing) {
      const int made = impl.files->make_folder(impl.root.get(), name, folder_mode);
      if (made < 0 && made != -EEXIST) {
        store->why_ = "cannot create " + root + '/' + name + ": " + message(made);
        impl.writing = false;
      } else {
        *folder = open_folder(impl.root.get(), name, folder_flags);
        if (folder == &impl.cas) {
          constexpr std::string_view tag = "Signature: 8a477f597d28d172789f06886806bc55\n";
          const OpenFile file(*impl.files, impl.files->open(impl.root.get(), "CACHEDIR.TAG",
                                                            O_WRONLY | O_CREAT | O_EXCL, 0644));
          if (file.is_open()) impl.files->write(file.get(), tag.data(), tag.size());
        }
      }
    }
    if (folder->get() == -ELOOP || folder->get() == -ENOTDIR) {
      throw Error(ExitCode::store,
                  "refused cache folder " + root + ": its \"" + name + "\" is a link or not a folder",
                  "remove " + root + '/' + name + " or choose another folder with BALLFLOW_CACHE");
    }
    if (folder->is_open()) {
      check(*folder, root + '/' + name);
    } else if (folder->get() != -ENOENT && impl.writing) {
      store->why_ = "cannot open " + root + '/' + name + ": " + message(folder->get());
      impl.writing = false;
    }
  }
  store->read_only_ = !impl.writing;
  if (impl.writing) impl.remove_stale_workspaces();
  return store;
}

Store::~Store() = default;

std::string Store::default_root() {
  const auto variable = [](const char* name) {
    const char* const value = std::getenv(name);
    return std::string(value != nullptr ? value : "");
  };
  if (const std::string cache = variable("BALLFLOW_CACHE"); !cache.empty()) return cache;
  // The XDG base directory specification: a relative path is invalid and ignored.
  if (const std::string cache = variable("XDG_CACHE_HOME"); cache.starts_with('/'))
    return cache + "/ballflow";
  std::string home = variable("HOME");
  if (home.empty()) {
    std::array<char, 4096> buffer{};
    passwd entry{};
    passwd* found = nullptr;
    if (::getpwuid_r(::geteuid(), &entry, buffer.data(), buffer.size(), &found) == 0 && found != nullptr) {
      home = found->pw_dir;
    }
  }
  return home.empty() ? home : home + "/.cache/ballflow";
}

std::optional<ActionEntry> Store::peek_action(const Digest& key) {
  const auto bytes = parts_->read_entry(parts_->ac, key.hex(), false);
  return bytes ? decode_action(key, *bytes) : std::nullopt;
}

std::optional<ActionEntry> Store::find_action(const Digest& key) {
  const auto bytes = parts_->read_entry(parts_->ac, key.hex(), true);
  return bytes ? decode_action(key, *bytes) : std::nullopt;
}

ActionPut Store::put_action(const Digest& key, const ActionEntry& entry, bool sync) {
  if (!parts_->writing) return {};
  auto there = find_action(key);
  if (there && there->manifest == entry.manifest && there->outputs == entry.outputs &&
      there->warnings == entry.warnings) {
    return {true, std::nullopt};
  }
  const std::string bytes = encode(key, entry);
  if (bytes.size() > entry_limit) return {parts_->failed("ac/" + key.hex(), -EFBIG), std::nullopt};
  ActionPut put;
  put.stored = parts_->publish(parts_->ac, "ac", key.hex(), {std::as_bytes(std::span(bytes))}, sync, true);
  if (put.stored && there && there->outputs != entry.outputs) put.disagreed = std::move(there);
  return put;
}

bool Store::has_blob(const OutputEntry& output) {
  const std::string hex = output.digest.hex();
  const OpenFile shard = parts_->open_shard(parts_->cas, hex, false);
  struct stat status {};
  return shard.is_open() && parts_->files->status(shard.get(), rest_of(hex), status) == 0 &&
         S_ISREG(status.st_mode) && distrust(status).empty() &&
         static_cast<std::uint64_t>(status.st_size) == output.bytes;
}

ArtifactPtr Store::load(const OutputEntry& output) { return parts_->fetch(output).artifact; }

bool Store::put_blob(const Artifact& artifact, bool sync, const std::function<bool()>& give_up) {
  if (!parts_->writing) return false;
  const StoreParts::Fetched there = parts_->fetch(entry_of(artifact));
  if (there.artifact != nullptr) return true;
  return parts_->publish(parts_->cas, "cas", artifact.digest().hex(), artifact.pieces(), sync, there.damaged,
                         give_up);
}

Digest Store::file_digest(const std::string& path) {
  FileSystem& files = *parts_->files;
  const auto fail = [&](const std::string& why, const std::string& hint) {
    throw Error(ExitCode::store, "cannot read " + path + ": " + why, hint);
  };
  constexpr int attempts = 3;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const OpenFile file(files,
                        files.open(FileSystem::working_folder, path, O_RDONLY | O_NONBLOCK | O_NOCTTY));
    struct stat status {};
    const int error = file.is_open() ? files.status(file.get(), status) : file.get();
    if (error < 0) fail(message(error), "check the path and the permissions of the file");
    if (!S_ISREG(status.st_mode)) {
      fail(S_ISDIR(status.st_mode) ? "it is a directory" : "it is not a regular file",
           "name a file, not a folder, pipe or device");
    }
    const FileState state(status);
    if (state.settled(files.now())) {
      if (const auto memo = parts_->read_entry(parts_->memos, state.memo_name(), true)) {
        const auto known = decode_memo(*memo);
        if (known && known->state == state) return known->digest;
      }
    }

    Digest digest;
    const std::int64_t size = sha256_of_file(files, file.get(), state.size, digest);
    if (size < 0) fail(message(static_cast<int>(size)), "check the disk");
    if (files.status(file.get(), status) < 0 || FileState(status) != state ||
        static_cast<std::uint64_t>(size) != state.size) {
      continue;
    }
    if (parts_->writing && state.settled(files.now())) parts_->write_memo(state, digest);
    return digest;
  }
  fail("it changes while it is being read", "wait until its writer is done");
  return {};
}

bool Store::memo_intact(const Digest& name) {
  const auto bytes = parts_->read_entry(parts_->memos, name.hex(), false);
  const auto memo = bytes ? decode_memo(*bytes) : std::nullopt;
  return memo && memo->state.memo_name() == name.hex();
}

namespace {

class FileLock final : public KeyLock {
 public:
  /// `keep` keeps `locks`, the folder that the file is in, open.
  FileLock(std::shared_ptr<FileSystem> files, std::shared_ptr<const void> keep, int locks, std::string name,
           int file)
      : files_(std::move(files)),
        keep_(std::move(keep)),
        locks_(locks),
        name_(std::move(name)),
        file_(file) {}
  ~FileLock() override {
    // Removed while it is locked: whoever waits for it finds out that its file has no name any more.
    files_->remove(locks_, name_);
    files_->close(file_);
  }

 private:
  std::shared_ptr<FileSystem> files_;
  std::shared_ptr<const void> keep_;
  int locks_;
  std::string name_;
  int file_;
};

}  // namespace

LockAttempt Store::try_lock(const Digest& key) {
  if (!parts_->writing) return {};
  FileSystem& files = *parts_->files;
  const std::string name = key.hex();
  for (;;) {
    OpenFile file(files, files.open(parts_->locks.get(), name, O_RDWR | O_CREAT | O_NOFOLLOW, lock_mode));
    if (!file.is_open()) {
      parts_->failed("locks/" + name, file.get());
      return {};
    }
    const int result = files.try_lock(file.get());
    if (result == -EWOULDBLOCK) return {nullptr, true};
    if (result < 0) return {};
    struct stat held {
    }, named{};
    if (files.status(file.get(), held) < 0) return {};
    if (files.status(parts_->locks.get(), name, named) < 0 || named.st_ino != held.st_ino ||
        named.st_dev != held.st_dev) {
      continue;  // its previous owner has removed it
    }
    return {std::make_unique<FileLock>(parts_->files, parts_, parts_->locks.get(), name, file.release()),
            false};
  }
}

std::unique_ptr<KeyLock> Store::lock(const Digest& key, const std::function<bool()>& give_up) {
  using namespace std::chrono_literals;
  auto pause = 1ms;
  for (;;) {
    LockAttempt attempt = try_lock(key);
    if (!attempt.busy || (give_up && give_up())) return std::move(attempt.lock);
    std::this_thread::sleep_for(pause);
    pause = std::min(2 * pause, 20ms);
  }
}

bool Store::put_run(const std::string& id, const std::vector<std::pair<std::string, std::string>>& files) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  if (id.empty() || id.front() == '.' || !std::all_of(id.begin(), id.end(), plain)) {
    throw Error(ExitCode::store, "\"" + id + "\" cannot be the name of a run folder");
  }
  if (!parts_->writing || parts_->files->make_folder(parts_->runs.get(), id, folder_mode) < 0) return false;
  std::uint64_t bytes = 0;
  const bool written = [&] {
    const OpenFile folder(*parts_->files, parts_->files->open(parts_->runs.get(), id, folder_flags));
    if (!folder.is_open()) return false;
    for (const auto& [name, text] : files) {
      std::optional<StoreParts::Draft> draft;
      if (parts_->write_draft({std::as_bytes(std::span(text))}, false, {}, draft) < 0) return false;
      if (parts_->files->rename(draft->place->folder.get(), draft->name, folder.get(), name, true) < 0)
        return false;
      draft->gone = true;
      bytes += disk_bytes(text.size());
    }
    return true;
  }();
  if ((parts_->added += bytes) >= account_at) account();
  if (!written) remove_run(StoreFolders(*this), id);
  return written;
}

void Store::account() { parts_->account(); }

Store::Statistics Store::statistics() {
  Statistics total;
  FileSystem& files = *parts_->files;
  const auto names_in = [&files](const OpenFile& folder) {
    std::vector<std::string> names;
    if (folder.is_open()) files.list(folder.get(), names);
    return names;
  };
  const auto add = [&](const OpenFile& top, std::uint64_t& count, std::uint64_t& bytes) {
    for (const std::string& name : names_in(top)) {
      const OpenFile shard(files, files.open(top.get(), name, folder_flags));
      for (const std::string& file : names_in(shard)) {
        struct stat status {};
        if (files.status(shard.get(), file, status) < 0 || !S_ISREG(status.st_mode)) continue;
        ++count;
        bytes += static_cast<std::uint64_t>(status.st_size);
      }
    }
  };
  add(parts_->cas, total.blobs, total.blob_bytes);
  add(parts_->ac, total.actions, total.action_bytes);
  total.quarantined = names_in(parts_->quarantine).size();
  total.runs = names_in(parts_->runs).size();
  return total;
}

StoreFolders::StoreFolders(Store& store)
    : files(store.parts().files.get()),
      root(store.parts().root.get()),
      cas(store.parts().cas.get()),
      ac(store.parts().ac.get()),
      runs(store.parts().runs.get()),
      pins(store.parts().pins.get()),
      quarantine(store.parts().quarantine.get()),
      memos(store.parts().memos.get()),
      locks(store.parts().locks.get()),
      leases(store.parts().leases.get()),
      writing(store.parts().writing) {}

std::string Store::trouble() const {
  const std::lock_guard lock(parts_->trouble_mutex);
  return parts_->trouble;
}

}  // namespace ballflow
