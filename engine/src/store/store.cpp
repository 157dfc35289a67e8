#include "ballflow/store.hpp"

#include <pwd.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

#include "store/parts.hpp"
#include "store/run_records.hpp"

namespace ballflow {

std::shared_ptr<Store> Store::open(const StoreOptions& options, std::shared_ptr<FileSystem> files) {
  const std::shared_ptr<Store> store(new Store);
  store->parts_ = std::make_unique<StoreParts>(open_folders(options, std::move(files)), options.upstream);
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

const std::string& Store::root() const { return parts_->folders.path; }
const std::string& Store::why() const { return parts_->folders.why; }
bool Store::read_only() const { return !parts_->folders.writing; }
std::string Store::trouble() const { return parts_->publisher.trouble(); }

bool Store::is_transport() const { return parts_->shared.is_transport(); }
std::vector<std::string> Store::upstream_notes() const { return parts_->shared.notes(); }

std::optional<ActionEntry> Store::find_action(const Digest& key) {
  std::optional<ActionEntry> entry = find_anywhere(key);
  if (entry && is_transport() && !hand_on(key, *entry)) return std::nullopt;
  return entry;
}

std::optional<ActionEntry> Store::find_anywhere(const Digest& key) {
  std::optional<ActionEntry> entry = parts_->actions.find(key);
  if (entry || !parts_->shared) return entry;
  entry = parts_->shared.find(key);
  if (entry) parts_->actions.put(key, *entry, false);
  return entry;
}

/// What was found here is of use to other jobs only when it is upstream, with all its blobs.
bool Store::hand_on(const Digest& key, const ActionEntry& entry) {
  SharedResults& shared = parts_->shared;
  for (const OutputEntry& output : entry.outputs) {
    if (shared.has(output)) continue;
    const ArtifactPtr here = parts_->blobs.load(output);
    if (here == nullptr || !shared.put(*here, true, {})) return false;
  }
  if (!shared.has(key)) shared.put(key, entry, true);
  return true;
}

std::optional<ActionEntry> Store::await_action(const Digest& key) {
  std::optional<ActionEntry> entry = find_anywhere(key);
  if (entry || !parts_->shared) return entry;
  entry = parts_->shared.await(key);
  if (entry) parts_->actions.put(key, *entry, false);
  return entry;
}
std::optional<ActionEntry> Store::peek_action(const Digest& key) { return parts_->actions.peek(key); }
ActionPut Store::put_action(const Digest& key, const ActionEntry& entry, bool sync) {
  ActionPut put = parts_->actions.put(key, entry, sync);
  if (shares()) put.upstream_disagreed = parts_->shared.put(key, entry, sync);
  return put;
}

std::optional<ActionEntry> Store::find_state(const Digest& key) { return find_anywhere(key); }
std::optional<ActionEntry> Store::put_state(const Digest& key, const ActionEntry& entry) {
  if (!shares()) {
    parts_->actions.put(key, entry, true);
    return std::nullopt;
  }
  auto kept = parts_->shared.put(key, entry, true, SharedResults::Others::right);
  parts_->actions.put(key, kept ? *kept : entry, true);
  return kept;
}

bool Store::has_blob(const OutputEntry& output) {
  return parts_->blobs.has(output) || (parts_->shared && parts_->shared.has(output));
}
ArtifactPtr Store::load(const OutputEntry& output) {
  if (ArtifactPtr artifact = parts_->blobs.load(output)) return artifact;
  return parts_->shared ? parts_->shared.load(output) : nullptr;
}
bool Store::fetch_blob(const Digest& digest) {
  return parts_->blobs.has(digest) || (parts_->shared && parts_->shared.fetch(digest));
}
bool Store::put_blob(const Artifact& artifact, bool sync, const std::function<bool()>& give_up) {
  const bool here = parts_->blobs.put(artifact, sync, give_up);
  const bool there = shares() && parts_->shared.put(artifact, sync, give_up);
  return here || there;
}

/// A store that is not written is not to be seen elsewhere either, but for jobs, which have nothing else.
bool Store::shares() const { return parts_->shared && (!read_only() || is_transport()); }

Digest Store::file_digest(const std::string& path) { return parts_->file_digests.digest_of(path); }

LockAttempt Store::try_lock(const Digest& key) { return parts_->locks.try_lock(key); }
std::unique_ptr<KeyLock> Store::lock(const Digest& key, const std::function<bool()>& give_up) {
  return parts_->locks.lock(key, give_up);
}

bool Store::put_run(const std::string& id, const std::vector<std::pair<std::string, std::string>>& files) {
  return put_run_record(parts_->folders, parts_->publisher, id, files);
}

void Store::account() { parts_->written.account(); }

Store::Statistics Store::statistics() {
  const StoreFolders& folders = parts_->folders;
  Statistics total;
  for (const StoredFile& blob : files_below(folders, folders.cas)) {
    ++total.blobs;
    total.blob_bytes += blob.bytes;
  }
  for (const StoredFile& action : files_below(folders, folders.ac)) {
    ++total.actions;
    total.action_bytes += action.bytes;
  }
  total.quarantined = names_in(folders, folders.quarantine).size();
  total.runs = names_in(folders, folders.runs).size();
  return total;
}

}  // namespace ballflow
