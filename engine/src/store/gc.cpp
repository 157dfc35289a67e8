#include "ballflow/gc.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <thread>
#include <unordered_map>

#include "ballflow/error.hpp"
#include "ballflow/json.hpp"
#include "store/run_folders.hpp"
#include "store/store_folders.hpp"

namespace ballflow {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t second = 1'000'000'000;
constexpr std::int64_t clock_slack = 60 * second;  // between this machine and a file server
// Nobody else writes `usage` while a count is under way, and files go without being subtracted (by hand, by a
// collector that was killed): count anew now and then.
constexpr std::int64_t recount_after = 7 * 24 * 3600 * second;
// A collection that cannot reach its target (pins, live runs) is not tried again by runs that write nothing.
constexpr std::int64_t retry_after = 3600 * second;
constexpr std::uint64_t usage_limit = 1u << 20;  // bytes of the file `usage`
constexpr std::size_t batch = 32;                // files removed while new runs wait

std::vector<std::string> names_in(const StoreFolders& folders, int folder) {
  std::vector<std::string> names;
  if (folder >= 0) folders.files->list(folder, names);
  std::sort(names.begin(), names.end());
  return names;
}

struct StoredFile {
  Digest name;
  std::uint64_t bytes = 0;
  std::int64_t modified = 0;
};

/// The regular files of cas/, ac/ or files/ with names that the store gives.
std::vector<StoredFile> files_below(const StoreFolders& folders, int top) {
  std::vector<StoredFile> found;
  for (const std::string& shard : names_in(folders, top)) {
    const OpenFile folder(*folders.files, folders.files->open(top, shard, folder_flags));
    for (const std::string& rest : names_in(folders, folder.get())) {
      const auto name = Digest::from_hex(shard + rest);
      struct stat status {};
      if (!name || shard.size() != 2 || folders.files->status(folder.get(), rest, status) < 0) continue;
      if (!S_ISREG(status.st_mode)) continue;
      found.push_back({*name, static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim)});
    }
  }
  return found;
}

std::set<Digest> pinned_digests(const StoreFolders& folders) {
  std::set<Digest> digests;
  for (const std::string& name : names_in(folders, folders.pins)) {
    if (const auto digest = Digest::from_hex(name)) digests.insert(*digest);
  }
  return digests;
}

std::string node_of(const std::string& manifest) {
  const Json json = Json::parse(manifest, nullptr, false);
  const auto node = json.is_object() ? json.find("node") : json.end();
  return node != json.end() && node->is_string() ? node->get<std::string>() : std::string();
}

/// An flock on a file of locks/ that stays there.
class NamedLock {
 public:
  NamedLock(const StoreFolders& folders, const char* name, std::chrono::milliseconds patience)
      : file_(*folders.files,
              folders.files->open(folders.locks, name, O_RDWR | O_CREAT | O_NOFOLLOW, lock_mode)) {
    if (!file_.is_open()) return;
    auto pause = 1ms;
    while ((result_ = folders.files->try_lock(file_.get())) == -EWOULDBLOCK && patience > 0ms) {
      std::this_thread::sleep_for(pause);
      patience -= pause;
      pause = std::min(2 * pause, 20ms);
    }
  }
  /// Somebody else has it. (A file system that cannot lock does not keep anybody from working.)
  bool busy() const { return result_ == -EWOULDBLOCK; }

 private:
  OpenFile file_;
  int result_ = 0;
};

constexpr auto forever = std::chrono::milliseconds(std::chrono::hours(24 * 365));

struct LiveRuns {
  std::uint64_t count = 0;
  std::int64_t since = INT64_MAX;  // start of the oldest
};

LiveRuns live_runs(const StoreFolders& folders, bool remove_dead) {
  LiveRuns live;
  for (const std::string& name : names_in(folders, folders.leases)) {
    const OpenFile file(*folders.files, folders.files->open(folders.leases, name, file_flags));
    struct stat status {};
    if (!file.is_open() || folders.files->status(file.get(), status) < 0) continue;
    if (folders.files->try_lock(file.get()) == 0) {
      if (remove_dead) folders.files->remove(folders.leases, name);
      continue;
    }
    ++live.count;
    live.since = std::min(live.since, nanoseconds(status.st_mtim));
  }
  return live;
}

/// Lock files of keys whose process was killed.
void remove_dead_locks(const StoreFolders& folders) {
  for (const std::string& name : names_in(folders, folders.locks)) {
    if (!Digest::from_hex(name)) continue;
    const OpenFile file(*folders.files, folders.files->open(folders.locks, name, file_flags));
    // Whoever waits for it meanwhile finds out that it has lost its name.
    if (file.is_open() && folders.files->try_lock(file.get()) == 0)
      folders.files->remove(folders.locks, name);
  }
}

struct Usage {
  bool known = false;
  std::uint64_t bytes = 0;
  bool written = false;      // since the count
  std::int64_t counted = 0;  // nanoseconds since 1970
};

Usage read_usage(const StoreFolders& folders) {
  Usage usage;
  const OpenFile file(*folders.files, folders.files->open(folders.root, "usage", file_flags));
  struct stat status {};
  if (!file.is_open() || folders.files->status(file.get(), status) < 0 || !S_ISREG(status.st_mode)) return {};
  if (static_cast<std::uint64_t>(status.st_size) > usage_limit || !distrust(status).empty()) return {};
  std::string text(static_cast<std::size_t>(status.st_size), '\0');
  const ssize_t size = folders.files->read(file.get(), text.data(), text.size());
  if (size < 0) return {};
  text.resize(static_cast<std::size_t>(size));
  // A line that is cut off or unknown is skipped: the total is approximate anyway.
  for (std::size_t begin = 0, end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const char* const last = text.data() + end;
    const char* next = text.data() + begin;
    if (next == last) continue;
    const char kind = *next++;
    std::uint64_t bytes = 0;
    const auto number = std::from_chars(next, last, bytes);
    if (number.ec != std::errc()) continue;
    if (kind == '+') {
      usage.bytes = bytes > no_limit - usage.bytes ? no_limit : usage.bytes + bytes;
      usage.written = true;
    } else if (kind == '=' && number.ptr != last) {
      std::int64_t seconds = 0;
      if (std::from_chars(number.ptr + 1, last, seconds).ec != std::errc()) continue;
      usage = {true, bytes, false, std::clamp<std::int64_t>(seconds, 0, INT64_MAX / second) * second};
    }
  }
  return usage;
}

/// Under the lock of collectors. A reader that sees the file empty counts as if there were none.
void write_usage(const StoreFolders& folders, std::uint64_t bytes) {
  const OpenFile file(
      *folders.files,
      folders.files->open(folders.root, "usage",
                          O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_NOFOLLOW | O_NONBLOCK, 0644));
  if (!file.is_open()) return;
  const std::string line =
      '=' + std::to_string(bytes) + ' ' + std::to_string(folders.files->now() / second) + '\n';
  folders.files->write(file.get(), line.data(), line.size());
}

/// Scores the artifacts by those actions that `counts` and sorts them.
template <class Counts>
void weigh(CacheContents& contents, std::int64_t now, Counts counts) {
  std::unordered_map<Digest, CachedArtifact*> by_digest;
  for (CachedArtifact& artifact : contents.artifacts) {
    artifact.score = 0;
    by_digest[artifact.digest] = &artifact;
  }
  const auto score = [now](double seconds, std::uint64_t bytes, std::int64_t last_use) {
    const double age = static_cast<double>(std::max(now - last_use, second)) / static_cast<double>(second);
    return std::max(seconds, 0.0) / (static_cast<double>(std::max(bytes, std::uint64_t{1})) * age);
  };
  for (const CachedAction& action : contents.actions) {
    if (!counts(action)) continue;
    std::set<Digest> there;
    std::uint64_t bytes = 0;
    for (const OutputEntry& output : action.outputs) {
      const auto found = by_digest.find(output.digest);
      if (found == by_digest.end() || !there.insert(output.digest).second) continue;
      bytes += disk_bytes(found->second->bytes);
    }
    for (const Digest& digest : there) {
      CachedArtifact& artifact = *by_digest[digest];
      artifact.score = std::max(artifact.score, score(action.seconds, bytes, artifact.last_use));
    }
  }
  std::sort(contents.artifacts.begin(), contents.artifacts.end(),
            [](const CachedArtifact& a, const CachedArtifact& b) {
              if (a.score != b.score) return a.score < b.score;
              if (a.last_use != b.last_use) return a.last_use < b.last_use;
              return a.digest < b.digest;
            });
}

/// Removes files in batches; between batches new runs may take their leases.
class Remover {
 public:
  struct Place {
    int top;  // folder of the store
    Digest name;
  };

  Remover(const StoreFolders& folders, bool dry_run) : folders_(folders), dry_run_(dry_run) {}

  /// Removes a file last used at `known`; not when a live run may use it, nor when it or one of `witnesses`
  /// (files whose use is a use of it) was used after `known`.
  bool remove(const Place& place, const std::vector<Place>& witnesses, std::int64_t known) {
    if (left_ == 0) begin_batch();
    --left_;
    if (live_.count > 0 && known >= live_.since - touch_interval - clock_slack) return false;
    if (dry_run_) return true;
    const auto used_since = [&](const Place& file) { return last_use(file) > known; };
    if (used_since(place) || std::any_of(witnesses.begin(), witnesses.end(), used_since)) return false;
    const OpenFile shard = open_shard(place);
    const int result =
        shard.is_open() ? folders_.files->remove(shard.get(), rest_of(place.name.hex())) : shard.get();
    return result == 0 || result == -ENOENT;  // gone is gone
  }
  std::uint64_t live() const { return live_.count; }

 private:
  void begin_batch() {
    if (lock_ != nullptr) {
      lock_.reset();
      std::this_thread::sleep_for(2ms);  // who waits looks every millisecond at first
    }
    if (folders_.writing) lock_ = std::make_unique<NamedLock>(folders_, "leases", 1000ms);
    live_ = live_runs(folders_, !dry_run_);
    left_ = batch;
  }
  OpenFile open_shard(const Place& place) const {
    return {*folders_.files, folders_.files->open(place.top, shard_of(place.name.hex()), folder_flags)};
  }
  std::int64_t last_use(const Place& place) const {
    const OpenFile shard = open_shard(place);
    struct stat status {};
    if (!shard.is_open()) return 0;
    const int error = folders_.files->status(shard.get(), rest_of(place.name.hex()), status);
    return error < 0 ? 0 : nanoseconds(status.st_mtim);
  }

  const StoreFolders& folders_;
  const bool dry_run_;
  std::unique_ptr<NamedLock> lock_;
  std::size_t left_ = 0;
  LiveRuns live_;
};

}  // namespace

std::unique_ptr<Lease> Lease::take(const std::shared_ptr<Store>& store) {
  const StoreFolders folders(*store);
  if (!folders.writing || folders.leases < 0) return nullptr;
  // Collectors look at leases under this lock: from now on they see this one before they remove anything.
  const NamedLock quiet(folders, "leases", 1000ms);
  std::unique_ptr<Lease> lease(new Lease);
  lease->name_ = std::to_string(::getpid()) + '-' + random_hex();
  OpenFile file(*folders.files, folders.files->open(folders.leases, lease->name_,
                                                    O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, lock_mode));
  if (!file.is_open()) return nullptr;
  if (folders.files->try_lock(file.get()) < 0) {
    folders.files->remove(folders.leases, lease->name_);
    return nullptr;
  }
  lease->store_ = store;
  lease->file_ = file.release();
  return lease;
}

Lease::~Lease() {
  if (store_ == nullptr) return;
  const StoreFolders folders(*store_);
  folders.files->remove(folders.leases, name_);
  folders.files->close(file_);
}

CacheContents read_contents(Store& store, std::int64_t now) {
  const StoreFolders folders(store);
  CacheContents contents;
  std::unordered_map<Digest, std::size_t> place;
  const std::set<Digest> pins = pinned_digests(folders);
  for (const StoredFile& file : files_below(folders, folders.cas)) {
    CachedArtifact artifact;
    artifact.digest = file.name;
    artifact.bytes = file.bytes;
    artifact.last_use = file.modified;
    artifact.pinned = pins.count(file.name) != 0;
    place[file.name] = contents.artifacts.size();
    contents.artifacts.push_back(std::move(artifact));
  }
  for (const StoredFile& file : files_below(folders, folders.ac)) {
    auto entry = store.peek_action(file.name);
    if (!entry) continue;
    CachedAction action;
    action.key = file.name;
    action.node = node_of(entry->manifest);
    action.bytes = file.bytes;
    action.seconds = std::isfinite(entry->seconds) ? entry->seconds : 0;
    action.last_use = file.modified;
    action.outputs = std::move(entry->outputs);
    for (const OutputEntry& output : action.outputs) {
      const auto found = place.find(output.digest);
      if (found == place.end()) continue;
      CachedArtifact& artifact = contents.artifacts[found->second];
      if (artifact.actions.empty() || action.seconds > artifact.seconds) {
        artifact.type = output.type;
        artifact.node = action.node;
        artifact.seconds = action.seconds;
      }
      artifact.last_use = std::max(artifact.last_use, action.last_use);
      artifact.actions.push_back(action.key);
    }
    contents.actions.push_back(std::move(action));
  }
  std::sort(contents.actions.begin(), contents.actions.end(),
            [](const CachedAction& a, const CachedAction& b) {
              return a.last_use != b.last_use ? a.last_use < b.last_use : a.key < b.key;
            });
  weigh(contents, now >= 0 ? now : folders.files->now(), [](const CachedAction&) { return true; });
  return contents;
}

std::optional<std::uint64_t> parse_size(std::string_view text) {
  if (text == "none") return no_limit;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number, std::chars_format::fixed);
  if (parsed.ec != std::errc() || !std::isfinite(number) || number < 0 || std::signbit(number))
    return std::nullopt;
  std::string_view unit(parsed.ptr, static_cast<std::size_t>(end - parsed.ptr));
  double factor = 1;
  if (!unit.empty()) {
    const std::size_t power = std::string_view("KMGT").find(unit.front() & ~0x20);
    if (power == std::string_view::npos) return std::nullopt;
    factor = std::ldexp(1, 10 * static_cast<int>(power + 1));
    unit.remove_prefix(1);
    if (!unit.empty() && unit != "iB" && unit != "B") return std::nullopt;
  }
  const double bytes = std::floor(number * factor);
  if (bytes >= 0x1p63) return std::nullopt;
  return static_cast<std::uint64_t>(bytes);
}

std::uint64_t default_limit(Store& store) {
  const StoreFolders folders(store);
  constexpr std::uint64_t at_most = std::uint64_t{20} << 30;
  std::uint64_t disk = 0;
  if (folders.root < 0 || folders.files->capacity(folders.root, disk) < 0 || disk == 0) return at_most;
  return std::min(at_most, disk / 10);
}

Collected collect(Store& store, const CollectOptions& options) {
  Collected result;
  const StoreFolders folders(store);
  if (folders.root < 0 || (!folders.writing && !options.dry_run)) return result;
  std::unique_ptr<NamedLock> alone;
  if (!options.dry_run) {
    alone = std::make_unique<NamedLock>(folders, "gc", options.wait ? forever : 0ms);
    if (alone->busy()) {
      result.busy = true;
      return result;
    }
    remove_dead_locks(folders);
  }
  store.account();
  const std::int64_t now = folders.files->now();
  CacheContents contents = read_contents(store, now);
  Remover remover(folders, options.dry_run);

  struct SmallFile {
    Remover::Place place;
    std::uint64_t bytes;
    std::int64_t last_use;
    bool action;
  };
  // Also damaged entries, which are in no list of actions.
  std::vector<SmallFile> small;
  std::uint64_t small_bytes = 0, total = 0;
  for (const int top : {folders.ac, folders.memos}) {
    for (const StoredFile& file : files_below(folders, top)) {
      small.push_back({{top, file.name}, disk_bytes(file.bytes), file.modified, top == folders.ac});
      small_bytes += small.back().bytes;
    }
  }
  total = small_bytes;
  for (const CachedArtifact& artifact : contents.artifacts) {
    total += disk_bytes(artifact.bytes);
    if (artifact.pinned) result.pinned_bytes += disk_bytes(artifact.bytes);
  }
  std::vector<std::pair<std::string, std::uint64_t>> quarantined;
  for (const std::string& name : names_in(folders, folders.quarantine)) {
    struct stat status {};
    if (folders.files->status(folders.quarantine, name, status) < 0 || !S_ISREG(status.st_mode)) continue;
    quarantined.emplace_back(name, disk_bytes(static_cast<std::uint64_t>(status.st_size)));
    total += quarantined.back().second;
  }
  const std::vector<RunFolder> runs = run_folders(folders);
  std::uint64_t run_bytes = 0;
  for (const RunFolder& run : runs) run_bytes += run.bytes;
  total += run_bytes;
  result.bytes_before = total;

  if (total > options.limit) {
    const std::uint64_t target = std::min(options.target, options.limit);
    for (const auto& [name, bytes] : quarantined) {
      if (total <= target) break;
      if (!options.dry_run && folders.files->remove(folders.quarantine, name) < 0) continue;
      total -= bytes;
      ++result.quarantined;
    }
    for (std::size_t i = 0; i + 1 < runs.size() && run_bytes > target / 20; ++i) {  // the latest stays
      if (!options.dry_run) remove_run(folders, runs[i].name);
      run_bytes -= runs[i].bytes;
      total -= runs[i].bytes;
      ++result.runs;
    }
    std::set<Digest> keep, gone;
    for (const CachedArtifact& artifact : contents.artifacts) {
      if (artifact.pinned) keep.insert(artifact.actions.begin(), artifact.actions.end());
    }
    std::sort(small.begin(), small.end(), [](const SmallFile& a, const SmallFile& b) {
      return a.last_use != b.last_use ? a.last_use < b.last_use : a.place.name < b.place.name;
    });
    for (const SmallFile& file : small) {
      if (small_bytes <= target / 10) break;
      if (file.action && keep.count(file.place.name) != 0) continue;
      if (!remover.remove(file.place, {}, file.last_use)) continue;
      small_bytes -= file.bytes;
      total -= file.bytes;
      ++(file.action ? result.actions : result.memos);
      if (file.action) gone.insert(file.place.name);
    }
    if (!gone.empty()) {
      weigh(contents, now, [&gone](const CachedAction& action) { return gone.count(action.key) == 0; });
    }
    for (const CachedArtifact& artifact : contents.artifacts) {
      if (total <= target) break;
      if (artifact.pinned) continue;
      std::vector<Remover::Place> witnesses;
      for (const Digest& key : artifact.actions) witnesses.push_back({folders.ac, key});
      if (!remover.remove({folders.cas, artifact.digest}, witnesses, artifact.last_use)) continue;
      total -= disk_bytes(artifact.bytes);
      ++result.artifacts;
      result.removed.push_back(artifact.digest);
    }
  }
  result.live_runs = remover.live();
  result.bytes_after = total;
  result.complete = total <= options.limit;
  if (!options.dry_run) write_usage(folders, total);
  return result;
}

void keep_within(Store& store, std::uint64_t limit) noexcept {
  try {
    const StoreFolders folders(store);
    if (!folders.writing || limit == no_limit) return;
    store.account();
    const Usage usage = read_usage(folders);
    const std::int64_t age = folders.files->now() - usage.counted;
    const bool fits = usage.bytes <= limit;
    if (usage.known && age < recount_after && (fits || (!usage.written && age < retry_after))) return;
    collect(store, {limit, limit / 10 * 9, false, false});
  } catch (...) {
    // The run is done and its results are safe; the next one tries again.
  }
}

std::vector<Digest> find_artifacts(Store& store, std::string_view prefix) {
  const StoreFolders folders(store);
  std::vector<Digest> found;
  for (const StoredFile& file : files_below(folders, folders.cas)) {
    if (file.name.hex().compare(0, prefix.size(), prefix) == 0) found.push_back(file.name);
  }
  return found;
}

std::vector<Digest> find_pins(Store& store, std::string_view prefix) {
  std::vector<Digest> found;
  for (const Digest& digest : pinned_digests(StoreFolders(store))) {
    if (digest.hex().compare(0, prefix.size(), prefix) == 0) found.push_back(digest);
  }
  return found;
}

void pin(Store& store, const Digest& digest) {
  const StoreFolders folders(store);
  const OpenFile file(*folders.files,
                      !folders.writing
                          ? -EROFS
                          : folders.files->open(folders.pins, digest.hex(),
                                                O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK, 0444));
  if (file.is_open()) return;
  throw Error(ExitCode::store,
              "cannot pin in " + store.root() + ": " + std::generic_category().message(-file.get()),
              store.why());
}

void unpin(Store& store, const Digest& digest) {
  const StoreFolders folders(store);
  const int result = folders.writing ? folders.files->remove(folders.pins, digest.hex()) : -EROFS;
  if (result == 0 || result == -ENOENT) return;
  throw Error(ExitCode::store,
              "cannot unpin in " + store.root() + ": " + std::generic_category().message(-result),
              store.why());
}

}  // namespace ballflow
