#include "ballflow/gc.hpp"

#include <algorithm>
#include <set>
#include <thread>

#include "store/contents.hpp"
#include "store/leases.hpp"
#include "store/locks.hpp"
#include "store/parts.hpp"
#include "store/run_records.hpp"

namespace ballflow {
namespace {

using namespace std::chrono_literals;

constexpr std::int64_t clock_slack = 60 * second;  // between this machine and a file server
// Nobody else writes `usage` while a count is under way, and files go without being subtracted (by hand, by a
// collector that was killed): count anew now and then.
constexpr std::int64_t recount_after = 7 * 24 * 3600 * second;
// A collection that cannot reach its target (pins, live runs) is not tried again by runs that write nothing.
constexpr std::int64_t retry_after = 3600 * second;
constexpr std::size_t batch = 32;  // files removed while new runs wait
constexpr auto forever = std::chrono::milliseconds(std::chrono::hours(24 * 365));

/// A file of cas/, ac/ or files/.
struct Place {
  const OpenFile* top;
  Digest name;
};

/// Removes files in batches; between batches new runs may take their leases.
class Remover {
 public:
  /// `blind`: the leases of other hosts say little (locks_stay_here).
  Remover(const StoreFolders& folders, bool dry_run, bool blind)
      : folders_(folders), dry_run_(dry_run), blind_(blind) {}

  /// Removes a file last used at `known`; not when a live run may use it, nor when it or one of `witnesses`
  /// (files whose use is a use of it) was used after `known`.
  bool remove(const Place& place, const std::vector<Place>& witnesses, std::int64_t known) {
    if (left_ == 0) begin_batch();
    --left_;
    if (keeps(known)) return false;
    if (dry_run_) return true;
    const auto used_since = [&](const Place& file) { return last_use(file) > known; };
    if (used_since(place) || std::any_of(witnesses.begin(), witnesses.end(), used_since)) return false;
    const OpenFile shard = open(place);
    const int result =
        shard.is_open() ? folders_.files->remove(shard.get(), rest_of(place.name.hex())) : shard.get();
    return result == 0 || result == -ENOENT;  // gone is gone
  }
  /// As it was when the last batch began; nothing when none has.
  const std::optional<LiveRuns>& live() const { return live_; }

 private:
  bool keeps(std::int64_t last_use) const { return last_use >= since_ - touch_interval - clock_slack; }

  void begin_batch() {
    if (lock_ != nullptr) {
      lock_.reset();
      std::this_thread::sleep_for(2ms);  // who waits looks every millisecond at first
    }
    if (folders_.writing) lock_ = std::make_unique<NamedLock>(folders_, leases_lock, 1000ms);
    live_ = live_runs(folders_, !dry_run_);
    // Where locks stay on their host no lock keeps a run of another one from taking its lease right now, and
    // this machine may still see the folder as it was: act as if a run had begun at this moment.
    since_ = blind_ ? std::min(live_->since, folders_.files->now()) : live_->since;
    left_ = batch;
  }
  OpenFile open(const Place& place) const {
    return {*folders_.files,
            folders_.files->open(place.top->get(), shard_of(place.name.hex()), folder_flags)};
  }
  std::int64_t last_use(const Place& place) const {
    const OpenFile shard = open(place);
    struct stat status {};
    if (!shard.is_open()) return 0;
    const int error = folders_.files->status(shard.get(), rest_of(place.name.hex()), status);
    return error < 0 ? 0 : nanoseconds(status.st_mtim);
  }

  const StoreFolders& folders_;
  const bool dry_run_, blind_;
  std::unique_ptr<NamedLock> lock_;
  std::size_t left_ = 0;
  std::optional<LiveRuns> live_;
  std::int64_t since_ = INT64_MAX;
};

/// An action entry or a memoised digest.
struct SmallFile {
  Place place;
  std::uint64_t bytes;
  std::int64_t last_use;
  bool action;
};

/// One collection: what there is, then what goes, in the order of ballflow/gc.hpp.
class Collection {
 public:
  Collection(Store& store, const CollectOptions& options)
      : folders_(store.parts().folders),
        dry_run_(options.dry_run),
        now_(folders_.files->now()),
        contents_(read_contents(store, now_)),
        remover_(folders_, dry_run_, !locks_stay_here_.empty()) {
    count();
    result_.bytes_before = total_;
    if (total_ > options.limit) remove_down_to(std::min(options.target, options.limit));
    look_at_leases();
    result_.bytes_after = total_;
    result_.complete = total_ <= options.limit;
  }
  Collected result() && { return std::move(result_); }

 private:
  void count() {
    // Also damaged entries, which are in no list of actions.
    for (const OpenFile* top : {&folders_.ac, &folders_.memos}) {
      for (const StoredFile& file : files_below(folders_, *top)) {
        small_.push_back({{top, file.name}, disk_bytes(file.bytes), file.modified, top == &folders_.ac});
        small_bytes_ += small_.back().bytes;
      }
    }
    std::sort(small_.begin(), small_.end(), [](const SmallFile& a, const SmallFile& b) {
      return a.last_use != b.last_use ? a.last_use < b.last_use : a.place.name < b.place.name;
    });
    total_ = small_bytes_;
    for (const CachedArtifact& artifact : contents_.artifacts) {
      total_ += disk_bytes(artifact.bytes);
      if (artifact.pinned) result_.pinned_bytes += disk_bytes(artifact.bytes);
    }
    for (const std::string& name : names_in(folders_, folders_.quarantine)) {
      struct stat status {};
      if (folders_.files->status(folders_.quarantine.get(), name, status) < 0) continue;
      if (!S_ISREG(status.st_mode)) continue;
      quarantined_.emplace_back(name, disk_bytes(static_cast<std::uint64_t>(status.st_size)));
      total_ += quarantined_.back().second;
    }
    runs_ = run_folders(folders_);
    for (const RunFolder& run : runs_) run_bytes_ += run.bytes;
    total_ += run_bytes_;
  }

  void remove_down_to(std::uint64_t target) {
    remove_quarantined(target);
    remove_runs(target / 20);
    remove_small_files(target / 10);
    remove_artifacts(target);
  }

  void remove_quarantined(std::uint64_t target) {
    for (const auto& [name, bytes] : quarantined_) {
      if (total_ <= target) break;
      if (!dry_run_ && folders_.files->remove(folders_.quarantine.get(), name) < 0) continue;
      total_ -= bytes;
      ++result_.quarantined;
    }
  }

  void remove_runs(std::uint64_t most) {
    for (std::size_t i = 0; i + 1 < runs_.size() && run_bytes_ > most; ++i) {  // the latest stays
      if (!dry_run_) remove_run(folders_, runs_[i].name);
      run_bytes_ -= runs_[i].bytes;
      total_ -= runs_[i].bytes;
      ++result_.runs;
    }
  }

  void remove_small_files(std::uint64_t most) {
    std::set<Digest> keep, gone;
    for (const CachedArtifact& artifact : contents_.artifacts) {
      if (artifact.pinned) keep.insert(artifact.actions.begin(), artifact.actions.end());
    }
    for (const SmallFile& file : small_) {
      if (small_bytes_ <= most) break;
      if (file.action && keep.count(file.place.name) != 0) continue;
      if (!remover_.remove(file.place, {}, file.last_use)) continue;
      small_bytes_ -= file.bytes;
      total_ -= file.bytes;
      ++(file.action ? result_.actions : result_.memos);
      if (file.action) gone.insert(file.place.name);
    }
    if (gone.empty()) return;
    weigh(contents_, now_, [&gone](const CachedAction& action) { return gone.count(action.key) == 0; });
  }

  void remove_artifacts(std::uint64_t target) {
    for (const CachedArtifact& artifact : contents_.artifacts) {
      if (total_ <= target) break;
      if (artifact.pinned) continue;
      std::vector<Place> witnesses;
      for (const Digest& key : artifact.actions) witnesses.push_back({&folders_.ac, key});
      if (!remover_.remove({&folders_.cas, artifact.digest}, witnesses, artifact.last_use)) continue;
      total_ -= disk_bytes(artifact.bytes);
      ++result_.artifacts;
      result_.removed.push_back(artifact.digest);
    }
  }

  void look_at_leases() {
    const LiveRuns live = remover_.live() ? *remover_.live() : live_runs(folders_, false);
    result_.live_runs = live.count;
    result_.unseen = live.unseen;
    result_.locks_stay_here = locks_stay_here_;
  }

  const StoreFolders& folders_;
  const bool dry_run_;
  const std::int64_t now_;
  CacheContents contents_;
  const std::string locks_stay_here_ = ballflow::locks_stay_here(folders_);
  Remover remover_;
  Collected result_;
  std::vector<SmallFile> small_;                                    // not used for longest first
  std::vector<std::pair<std::string, std::uint64_t>> quarantined_;  // with its bytes
  std::vector<RunFolder> runs_;
  std::uint64_t small_bytes_ = 0, run_bytes_ = 0, total_ = 0;
};

}  // namespace

Collected collect(Store& store, const CollectOptions& options) {
  const StoreFolders& folders = store.parts().folders;
  if (!folders.root.is_open() || (!folders.writing && !options.dry_run)) return {};
  std::unique_ptr<NamedLock> alone;
  if (!options.dry_run) {
    alone = std::make_unique<NamedLock>(folders, "gc", options.wait ? forever : 0ms);
    if (alone->busy()) {
      Collected result;
      result.busy = true;
      return result;
    }
    remove_dead_locks(folders);
  }
  store.account();
  Collected result = Collection(store, options).result();
  if (!options.dry_run) write_usage(folders, result.bytes_after);
  return result;
}

void keep_within(Store& store, std::uint64_t limit) noexcept {
  try {
    const StoreFolders& folders = store.parts().folders;
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

}  // namespace ballflow
