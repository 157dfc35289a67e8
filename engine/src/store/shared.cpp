#include "store/shared.hpp"

#include <algorithm>
#include <cstring>
#include <thread>

#include "ballflow/error.hpp"
#include "store/store_format.hpp"

namespace ballflow {
namespace {

/// How long a server that did not answer is left alone: a dead one then costs a timeout in so many seconds.
constexpr std::chrono::seconds rest_time(30);

/// Between two looks for a blob that must be there: caches of NFS hold for 3 to 60 s.
constexpr std::chrono::milliseconds first_look_again(50), longest_look_again(2000);

std::string shown(Upstream::Room room, const Digest& name) {
  return (room == Upstream::Room::actions ? "ac/" : "cas/") + name.hex().substr(0, 16) + "...";
}

/// Waits ever longer, until there is none of it left.
class Patience {
 public:
  explicit Patience(double seconds)
      : until_(Clock::now() +
               std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds))) {}

  /// False when it is at its end.
  bool wait() {
    if (Clock::now() >= until_) return false;
    std::this_thread::sleep_for(pause_);
    pause_ = std::min(pause_ * 2, longest_look_again);
    return true;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point until_;
  std::chrono::milliseconds pause_ = first_look_again;
};

/// Verifies what passes: at most `most` bytes, the SHA-256 at the end.
class Check {
 public:
  explicit Check(std::optional<std::uint64_t> bytes) : expected_(bytes) {}

  bool add(std::span<const std::byte> piece) {
    seen_ += piece.size();
    if (expected_ && seen_ > *expected_) return false;
    hasher_.add(piece.data(), piece.size());
    return true;
  }
  bool is(const Digest& digest) { return (!expected_ || seen_ == *expected_) && hasher_.finish() == digest; }

 private:
  std::optional<std::uint64_t> expected_;
  std::uint64_t seen_ = 0;
  Hasher hasher_;
};

}  // namespace

std::vector<std::string> SharedResults::notes() const {
  const std::lock_guard lock(mutex_);
  return notes_;
}

void SharedResults::note(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (noted_.insert(text).second) notes_.push_back("upstream " + use_.upstream->place() + ": " + text);
}

void SharedResults::note_failure(const char* kind, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (noted_.insert(kind).second) notes_.push_back("upstream " + use_.upstream->place() + ": " + text);
}

bool SharedResults::is_resting() {
  if (use_.transport) return false;  // who has nothing else asks again
  const std::lock_guard lock(mutex_);
  return std::chrono::steady_clock::now() < resting_until_;
}

void SharedResults::rest(const std::string& why) {
  note_failure("unreachable", "does not answer: " + why + "; what it has is computed here");
  const std::lock_guard lock(mutex_);
  resting_until_ = std::chrono::steady_clock::now() + rest_time;
}

void SharedResults::damaged(Room room, const Digest& name) {
  const bool aside = !use_.read_only && use_.upstream->set_aside(room, name);
  if (!aside) {
    const std::lock_guard lock(mutex_);
    damaged_.insert(name);
  }
  note(shown(room, name) + " is damaged: its content is not what its name says; it counts as missing" +
       (aside ? " and was moved aside" : ""));
}

Upstream::Got SharedResults::read(Room room, const Digest& name, const Upstream::Sink& sink,
                                  const std::function<void()>& restart, bool afresh) {
  using Got = Upstream::Got;
  if (is_resting()) return Got::unreachable;
  Upstream::Read read = use_.upstream->get(room, name, sink, afresh);
  for (int again = 0; read.got == Got::stale && again < 3; ++again) {
    restart();
    read = use_.upstream->get(room, name, sink, true);
  }
  if (read.got == Got::unreachable) rest(read.why);
  if (read.got == Got::failed || read.got == Got::stale)
    note_failure("read", "cannot read " + shown(room, name) + ": " + read.why);
  return read.got;
}

std::optional<ActionEntry> SharedResults::read_entry(const Digest& key, bool afresh) {
  using Got = Upstream::Got;
  // What cannot be decoded is read a second time before it is called damaged.
  for (int attempt = 0; attempt < 2; ++attempt) {
    std::string bytes;
    const Upstream::Sink sink = [&bytes](std::span<const std::byte> piece) {
      bytes.append(reinterpret_cast<const char*>(piece.data()), piece.size());
      return bytes.size() <= entry_limit;
    };
    const Got got = read(
        Room::actions, key, sink, [&bytes] { bytes.clear(); }, afresh || attempt > 0);
    if (got != Got::found && got != Got::refused) return std::nullopt;
    if (got == Got::found) {
      if (auto entry = decode_action(key, bytes)) return entry;
    }
  }
  damaged(Room::actions, key);
  return std::nullopt;
}

std::optional<ActionEntry> SharedResults::find(const Digest& key) { return read_entry(key); }

std::optional<ActionEntry> SharedResults::await(const Digest& key) {
  Patience patience(use_.patience);
  while (patience.wait()) {
    if (auto entry = read_entry(key, true)) return entry;
  }
  return std::nullopt;
}

bool SharedResults::has(const OutputEntry& output) {
  return !is_resting() && use_.upstream->size(Room::blobs, output.digest) == output.bytes;
}

bool SharedResults::has(const Digest& key) {
  return !is_resting() && use_.upstream->size(Room::actions, key).has_value();
}

SharedResults::Copied SharedResults::copy_to_disk(const Digest& digest, std::optional<std::uint64_t> bytes,
                                                  bool afresh, bool& disk_failed) {
  using Got = Upstream::Got;
  if (!folders_.writing) {
    disk_failed = true;
    return Copied::no;
  }
  Copied copied = Copied::no;
  disk_failed = true;
  bool spoilt = false;  // it went away half read: the draft cannot be begun anew
  const Publisher::Source source = [&](const Publisher::Write& write) {
    Check check(bytes);
    int error = 0;
    bool started = false;
    const Upstream::Sink sink = [&](std::span<const std::byte> piece) {
      started = true;
      return check.add(piece) && (error = write(piece)) >= 0;
    };
    const Got got = read(
        Room::blobs, digest, sink, [&] { spoilt = spoilt || started; }, afresh);
    if (error < 0) return error;
    disk_failed = false;
    if (spoilt || (got != Got::found && got != Got::refused)) return -ECANCELED;
    copied = got == Got::found && check.is(digest) ? Copied::yes : Copied::damaged;
    return copied == Copied::yes ? 0 : -ECANCELED;
  };
  Published published = Published::no;
  for (int attempt = 0; attempt == 0 || (spoilt && attempt < 3); ++attempt) {
    spoilt = false;
    published = publisher_.publish_from(source, folders_.cas, "cas", digest.hex(), {false, false, {}});
  }
  if (copied == Copied::yes && published == Published::no) {
    disk_failed = true;
    return Copied::no;
  }
  return copied;
}

SharedResults::Copied SharedResults::copy_to_memory(const OutputEntry& output, ArtifactPtr& artifact) {
  const auto bytes = std::make_shared<std::vector<std::uint64_t>>((output.bytes + 7) / 8);  // aligned
  auto* const to = reinterpret_cast<std::byte*>(bytes->data());
  std::uint64_t have = 0;
  const Upstream::Sink sink = [&](std::span<const std::byte> piece) {
    if (piece.size() > output.bytes - have) return false;
    std::memcpy(to + have, piece.data(), piece.size());
    have += piece.size();
    return true;
  };
  const Upstream::Got got = read(
      Room::blobs, output.digest, sink, [&have] { have = 0; }, false);
  if (got != Upstream::Got::found && got != Upstream::Got::refused) return Copied::no;
  const std::span<const std::byte> file(to, static_cast<std::size_t>(output.bytes));
  if (got == Upstream::Got::refused || have != output.bytes ||
      sha256({reinterpret_cast<const char*>(file.data()), file.size()}) != output.digest)
    return Copied::damaged;
  try {
    artifact = Artifact::decode(file, bytes);
  } catch (const BadArtifact&) {
    return Copied::damaged;
  }
  if (!describes(output, *artifact)) artifact = nullptr;
  return artifact != nullptr ? Copied::yes : Copied::no;
}

ArtifactPtr SharedResults::load(const OutputEntry& output) {
  Patience patience(use_.patience);
  for (bool afresh = false;; afresh = true) {
    bool disk_failed = false;
    Copied copied = copy_to_disk(output.digest, output.bytes, afresh, disk_failed);
    if (copied == Copied::yes) return blobs_.load(output);
    ArtifactPtr artifact;
    if (disk_failed) copied = copy_to_memory(output, artifact);
    if (artifact != nullptr) return artifact;
    if (copied == Copied::damaged) {
      // Read once more before it is called so: what was wrong may have been the way here.
      copied = copy_to_memory(output, artifact);
      if (artifact != nullptr) return artifact;
      if (copied == Copied::damaged) {
        damaged(Room::blobs, output.digest);
        return nullptr;
      }
    }
    if (!patience.wait()) return nullptr;
  }
}

bool SharedResults::fetch(const Digest& digest) {
  bool disk_failed = false;
  const Copied copied = copy_to_disk(digest, std::nullopt, false, disk_failed);
  if (copied == Copied::damaged) damaged(Room::blobs, digest);
  return copied == Copied::yes;
}

/// True when it is there now.
bool SharedResults::write(Room room, const Digest& name,
                          const std::vector<std::span<const std::byte>>& pieces,
                          const Upstream::PutOptions& options, bool& there) {
  using Put = Upstream::Put;
  Upstream::Written written{Put::unreachable, "it did not answer before"};
  Upstream::PutOptions how = options;
  {
    const std::lock_guard lock(mutex_);
    how.replace = damaged_.erase(name) != 0;
  }
  if (!is_resting()) written = use_.upstream->put(room, name, pieces, how);
  there = written.put == Put::there;
  if (written.put == Put::written || written.put == Put::there) return true;
  if (written.put == Put::given_up) return false;
  if (use_.transport) {
    throw Error(ExitCode::store,
                "the result cannot be published: upstream " + use_.upstream->place() + ": cannot write " +
                    shown(room, name) + ": " + written.why,
                "other jobs would look for it there: make room or make it writable, then submit again");
  }
  if (written.put == Put::unreachable) {
    if (!is_resting()) rest(written.why);
  } else {
    note_failure("write", "cannot write " + shown(room, name) + ": " + written.why +
                              "; results made here are not shared");
  }
  return false;
}

bool SharedResults::is_whole(const Digest& digest, std::uint64_t bytes) {
  std::optional<Check> check(bytes);
  const Upstream::Sink sink = [&check](std::span<const std::byte> piece) { return check->add(piece); };
  const Upstream::Got got = read(
      Room::blobs, digest, sink, [&] { check.emplace(bytes); }, false);
  // What cannot be read now is not known to be damaged.
  return got != Upstream::Got::refused && (got != Upstream::Got::found || check->is(digest));
}

bool SharedResults::put(const Artifact& artifact, bool sync, const std::function<bool()>& give_up) {
  if (use_.read_only) return false;
  const Digest& digest = artifact.digest();
  if (!is_resting()) {
    // There already although its entry was not: rare, and then it may be what is wrong.
    if (use_.upstream->size(Room::blobs, digest)) {
      if (is_whole(digest, artifact.file_size())) return true;
      damaged(Room::blobs, digest);
    }
  }
  bool there = false;
  const bool published = write(Room::blobs, digest, artifact.pieces(), {sync, false, give_up}, there);
  const std::lock_guard lock(mutex_);
  if (published) {
    unpublished_.erase(digest);
  } else {
    unpublished_.insert(digest);
  }
  return published;
}

std::optional<ActionEntry> SharedResults::put(const Digest& key, const ActionEntry& entry, bool sync,
                                              Others others) {
  if (use_.read_only) return std::nullopt;
  {
    const std::lock_guard lock(mutex_);
    for (const OutputEntry& output : entry.outputs) {
      if (unpublished_.count(output.digest) != 0) return std::nullopt;
    }
  }
  const std::string bytes = encode(key, entry);
  if (bytes.size() > entry_limit) return std::nullopt;
  const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(bytes))};
  // Twice: what is there may turn out damaged and be moved aside.
  for (int attempt = 0; attempt < 2; ++attempt) {
    bool there = false;
    if (!write(Room::actions, key, pieces, {sync, false, {}}, there) || !there) return std::nullopt;
    auto kept = read_entry(key);
    if (!kept) continue;
    if (kept->outputs == entry.outputs) return std::nullopt;
    if (others == Others::right) return kept;
    note(shown(Room::actions, key) +
         " names another result than the one that was computed here for equal inputs and parameters: a node "
         "that is not deterministic, or a machine that computes wrongly; the upstream keeps its own");
    return kept;
  }
  return std::nullopt;
}

}  // namespace ballflow
