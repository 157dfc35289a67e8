#include "ballflow/upstream_gc.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <unordered_set>
#include <vector>

#include "ballflow/error.hpp"
#include "store/store_format.hpp"
#include "store/upstream_folder.hpp"
#include "store/upstream_http.hpp"

namespace ballflow {
namespace {

/// A regular file two folders below the root.
struct Found {
  const OpenFile& shard;
  const std::string& below;  // the folder: "/ac/ab"
  const std::string& name;
  std::uint64_t bytes;
  bool old;
};

std::optional<Digest> name_of(const Found& file) {
  return Digest::from_hex(file.below.substr(file.below.size() - 2) + file.name);
}

/// Whether the name is one that publishers give besides those of results: "<62 digits>.tmp-..." (draft.hpp),
/// "<62 digits>.damaged-..." (UpstreamFolder::set_aside).
bool is_leftover(const Found& file) {
  const std::size_t end = std::min(file.name.find('.'), file.name.size());
  return Digest::from_hex(file.below.substr(file.below.size() - 2) + file.name.substr(0, end)) &&
         (file.name.compare(end, 5, ".tmp-") == 0 || file.name.compare(end, 9, ".damaged-") == 0);
}

class UpstreamCollection {
 public:
  UpstreamCollection(const std::string& place, const UpstreamCollectOptions& options, FileSystem& files)
      : place_(place),
        dry_run_(options.dry_run),
        files_(files),
        older_(files.now() - options.older_than * second),
        root_(files, files.open(FileSystem::working_folder, place, O_RDONLY | O_DIRECTORY)) {
    if (!root_.is_open()) fail("", root_.get());
    refuse_local_cache();
    each_file("ac", [this](const Found& file) { collect_entry(file); });
    each_file("cas", [this](const Found& file) { collect_blob(file); });
  }
  UpstreamCollected result() && { return std::move(result_); }

 private:
  [[noreturn]] void fail(const std::string& below, int error) const {
    throw Error(ExitCode::store, "cannot read " + place_ + below + ": " + system_message(error),
                "it stays, and so does every artifact that it may name; collect as the owner of the files");
  }

  void refuse_local_cache() const {
    struct stat status {};
    for (const char* room : {"leases", "locks"}) {
      if (files_.status(root_.get(), room, status) != 0) continue;
      throw Error(ExitCode::store, place_ + " is the cache of a machine, no upstream",
                  "collect it with its locks: \"ballflow cache gc --cache " + place_ + "\"");
    }
  }

  /// Regular files only; a link is neither followed nor removed.
  void each_file(const std::string& room, const std::function<void(const Found&)>& act) const {
    const OpenFile top(files_, files_.open(root_.get(), room, folder_flags));
    if (top.get() == -ENOENT) return;
    for (const std::string& shard_name : names_in(top, '/' + room)) {
      if (shard_name.size() != 2 || shard_name.find_first_not_of("0123456789abcdef") != std::string::npos)
        continue;
      const std::string below = '/' + room + '/' + shard_name;
      const OpenFile shard(files_, files_.open(top.get(), shard_name, folder_flags));
      if (shard.get() == -ELOOP || shard.get() == -ENOTDIR || shard.get() == -ENOENT) continue;
      for (const std::string& name : names_in(shard, below)) {
        struct stat status {};
        const int error = files_.status(shard.get(), name, status);
        if (error == -ENOENT) continue;
        if (error < 0) fail(below + '/' + name, error);
        if (!S_ISREG(status.st_mode)) continue;
        act({shard, below, name, static_cast<std::uint64_t>(status.st_size),
             nanoseconds(status.st_mtim) < older_});
      }
    }
  }
  std::vector<std::string> names_in(const OpenFile& folder, const std::string& below) const {
    std::vector<std::string> names;
    const int error = folder.is_open() ? files_.list(folder.get(), names) : folder.get();
    if (error < 0) fail(below, error);
    return names;
  }

  /// Whether it is gone, or would be; counts it.
  bool remove(const Found& file, FileCount& removed) {
    if (!file.old) return false;
    const int error = dry_run_ ? 0 : files_.remove(file.shard.get(), file.name);
    const bool gone = error == 0 || error == -ENOENT;
    if (!gone && result_.failed.files == 0)
      result_.why = file.below.substr(1) + '/' + file.name + ": " + system_message(error);
    add(gone ? removed : result_.failed, file);
    return gone;
  }
  static void add(FileCount& count, const Found& file) {
    ++count.files;
    count.bytes += file.bytes;
  }

  void collect_entry(const Found& file) {
    const auto key = name_of(file);
    if (!key) {
      if (is_leftover(file)) remove(file, result_.leftovers);
      return;
    }
    if (remove(file, result_.entries)) return;
    add(result_.entries_left, file);
    // A damaged entry names nothing: it is a miss for everybody.
    const auto entry = decode_action(*key, content(file));
    if (!entry) return;
    for (const OutputEntry& output : entry->outputs) named_.insert(output.digest);
  }

  void collect_blob(const Found& file) {
    const auto digest = name_of(file);
    if (!digest) {
      if (is_leftover(file)) remove(file, result_.leftovers);
      return;
    }
    if (named_.count(*digest) != 0 || !remove(file, result_.blobs)) add(result_.blobs_left, file);
  }

  std::string content(const Found& found) const {
    const std::string below = found.below + '/' + found.name;
    if (found.bytes > entry_limit) return {};
    const OpenFile file(files_, files_.open(found.shard.get(), found.name, file_flags));
    if (!file.is_open()) fail(below, file.get());
    std::string bytes(static_cast<std::size_t>(found.bytes), '\0');
    for (std::size_t have = 0; have < bytes.size();) {
      const ssize_t got = files_.read(file.get(), bytes.data() + have, bytes.size() - have);
      if (got < 0) fail(below, static_cast<int>(got));
      if (got == 0) return {};
      have += static_cast<std::size_t>(got);
    }
    return bytes;
  }

  const std::string place_;
  const bool dry_run_;
  FileSystem& files_;
  const std::int64_t older_;
  const OpenFile root_;
  std::unordered_set<Digest> named_;  // blobs, by the entries that are left
  UpstreamCollected result_;
};

}  // namespace

std::optional<std::int64_t> parse_age(std::string_view text) {
  constexpr std::int64_t most = std::int64_t{100} * 365 * 86400;
  std::int64_t number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (parsed.ec != std::errc() || number < 0 || end - parsed.ptr != 1) return std::nullopt;
  std::int64_t unit = 0;
  switch (*parsed.ptr) {
    case 'h':
      unit = 3600;
      break;
    case 'd':
      unit = 86400;
      break;
    case 'w':
      unit = 7 * 86400;
      break;
    case 'y':
      unit = 365 * 86400;
      break;
    default:
      return std::nullopt;
  }
  if (number > most / unit) return std::nullopt;
  return number * unit;
}

UpstreamCollected collect_upstream(const std::string& place, const UpstreamCollectOptions& options,
                                   std::shared_ptr<FileSystem> files) {
  if (is_address(place)) {
    throw Error(ExitCode::usage, place + " is a server; only an upstream in a folder can be collected",
                "remove old files where the server keeps them while nobody computes, those of ac/ before "
                "those of cas/");
  }
  if (files == nullptr) files = std::make_shared<FileSystem>();
  const std::string path = Upstream::open(place, files)->place();
  return UpstreamCollection(path, options, *files).result();
}

}  // namespace ballflow
