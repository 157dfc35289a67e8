#include "store/contents.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "ballflow/json.hpp"
#include "store/parts.hpp"

namespace ballflow {
namespace {

std::string node_of(const std::string& manifest) {
  const Json json = Json::parse(manifest, nullptr, false);
  const auto node = json.is_object() ? json.find("node") : json.end();
  return node != json.end() && node->is_string() ? node->get<std::string>() : std::string();
}

double score(double seconds, std::uint64_t bytes, std::int64_t age) {
  const double age_seconds = static_cast<double>(std::max(age, second)) / static_cast<double>(second);
  return std::max(seconds, 0.0) / (static_cast<double>(std::max(bytes, std::uint64_t{1})) * age_seconds);
}

}  // namespace

void weigh(CacheContents& contents, std::int64_t now,
           const std::function<bool(const CachedAction&)>& counts) {
  std::unordered_map<Digest, CachedArtifact*> by_digest;
  for (CachedArtifact& artifact : contents.artifacts) {
    artifact.score = 0;
    by_digest[artifact.digest] = &artifact;
  }
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
      artifact.score = std::max(artifact.score, score(action.seconds, bytes, now - artifact.last_use));
    }
  }
  std::sort(contents.artifacts.begin(), contents.artifacts.end(),
            [](const CachedArtifact& a, const CachedArtifact& b) {
              if (a.score != b.score) return a.score < b.score;
              if (a.last_use != b.last_use) return a.last_use < b.last_use;
              return a.digest < b.digest;
            });
}

CacheContents read_contents(Store& store, std::int64_t now) {
  const StoreFolders& folders = store.parts().folders;
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

}  // namespace ballflow
