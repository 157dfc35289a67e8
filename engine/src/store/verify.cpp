#include <algorithm>
#include <map>
#include <unordered_map>
#include <unordered_set>

#include "ballflow/error.hpp"
#include "ballflow/gc.hpp"
#include "store/parts.hpp"

namespace ballflow {
namespace {

/// Everything in the subfolders of cas/, ac/ or files/ with a name that the store gives, whatever it is.
template <class Visit>
void for_each_below(const StoreFolders& folders, const OpenFile& top, Visit visit) {
  for (const std::string& shard : names_in(folders, top)) {
    const OpenFile folder(*folders.files, folders.files->open(top.get(), shard, folder_flags));
    if (shard.size() != 2 || !folder.is_open()) continue;
    for (const std::string& name : names_in(folders, folder)) {
      if (const auto digest = Digest::from_hex(shard + name)) visit(folder, *digest);
    }
  }
}

class Verifier {
 public:
  Verifier(StoreParts& store, bool full) : store_(store), folders_(store.folders), full_(full) {}

  Verified run() {
    for_each_below(folders_, folders_.ac,
                   [this](const OpenFile& shard, const Digest& key) { check_action(shard, key); });
    for_each_below(folders_, folders_.cas,
                   [this](const OpenFile& shard, const Digest& name) { check_artifact(shard, name); });
    for_each_below(folders_, folders_.memos, [this](const OpenFile& shard, const Digest& name) {
      ++result_.memos;
      if (!store_.file_digests.intact(name) && exists(shard, name))
        report("files", shard, name, "is damaged");
    });
    for (const auto& [key, outputs] : actions_) {
      const auto there = [this](const OutputEntry& output) { return good_.count(output.digest) != 0; };
      if (std::none_of(outputs.begin(), outputs.end(), there)) ++result_.without_artifacts;
    }
    return std::move(result_);
  }

 private:
  bool exists(const OpenFile& shard, const Digest& name) const {  // it may have been collected meanwhile
    struct stat status {};
    return folders_.files->status(shard.get(), rest_of(name.hex()), status) == 0;
  }

  void report(const std::string& folder, const OpenFile& shard, const Digest& name, const std::string& what) {
    const std::string hex = name.hex();
    const bool moved = to_quarantine(folders_, shard, hex);
    result_.bad.push_back({folder + '/' + shard_of(hex) + '/' + rest_of(hex), what, moved});
  }

  void check_action(const OpenFile& shard, const Digest& key) {
    const auto entry = store_.actions.peek(key);
    if (!entry) {
      if (exists(shard, key)) report("ac", shard, key, "is damaged, or no action entry for this key");
      return;
    }
    ++result_.actions;
    actions_[key] = entry->outputs;
    for (const OutputEntry& output : entry->outputs) producers_[output.digest].push_back(key);
  }

  void check_artifact(const OpenFile& shard, const Digest& name) {
    const std::string hex = name.hex();
    struct stat status {};
    const OpenFile file(*folders_.files, folders_.files->open(shard.get(), rest_of(hex), file_flags));
    if (file.get() == -ELOOP) return report("cas", shard, name, "is a symbolic link");
    if (file.get() == -EACCES) return report("cas", shard, name, "cannot be read");
    if (!file.is_open()) return;  // collected meanwhile, or no descriptors left
    if (folders_.files->status(file.get(), status) < 0 || !S_ISREG(status.st_mode)) {
      return report("cas", shard, name, "is not a regular file");
    }
    if (const std::string reason = distrust(status); !reason.empty())
      return report("cas", shard, name, reason);
    ++result_.artifacts;
    result_.bytes += static_cast<std::uint64_t>(status.st_size);
    try {
      const ArtifactPtr artifact = Artifact::map(file.get(), "the file");
      const auto producers = producers_.find(name);
      const bool known = producers != producers_.end();
      const bool differs =
          known && std::any_of(producers->second.begin(), producers->second.end(),
                               [&](const Digest& key) { return !agrees(key, name, *artifact); });
      if ((full_ || !known || differs) && artifact->digest() != name) {
        return report("cas", shard, name, "has content that does not belong to its name");
      }
      good_.insert(name);
      if (differs) report_liars(name, *artifact);
    } catch (const BadArtifact& error) {
      report("cas", shard, name, error.what());
    } catch (const Error&) {  // no memory or no descriptors left: says nothing about the artifact
    }
  }

  bool agrees(const Digest& key, const Digest& name, const Artifact& artifact) const {
    const auto& outputs = actions_.at(key);
    return std::all_of(outputs.begin(), outputs.end(), [&](const OutputEntry& output) {
      return output.digest != name || describes(output, artifact);
    });
  }

  /// The artifact is what its name says, so an entry that describes it otherwise is wrong.
  void report_liars(const Digest& name, const Artifact& artifact) {
    for (const Digest& key : producers_.at(name)) {
      if (agrees(key, name, artifact)) continue;
      const OpenFile shard(*folders_.files,
                           folders_.files->open(folders_.ac.get(), shard_of(key.hex()), folder_flags));
      if (shard.is_open()) report("ac", shard, key, "describes another artifact than the one it names");
    }
  }

  StoreParts& store_;
  const StoreFolders& folders_;
  const bool full_;
  Verified result_;
  std::map<Digest, std::vector<OutputEntry>> actions_;
  std::unordered_map<Digest, std::vector<Digest>> producers_;  // keys of the actions that name an artifact
  std::unordered_set<Digest> good_;
};

}  // namespace

Verified verify(Store& store, bool full) { return Verifier(store.parts(), full).run(); }

}  // namespace ballflow
