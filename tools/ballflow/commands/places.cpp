#include "commands/places.hpp"

#include <unistd.h>

#include <filesystem>

#include "ballflow/key.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* advice = "choose another place for it; nothing was run, and no file was changed";

std::string other_name(const std::string& written, const std::string& known) {
  return written == known ? "" : " (" + known + " is the same file)";
}

}  // namespace

Places::Places() {
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) {
    struct stat status {};
    if (fstat(stream, &status) != 0 || !S_ISREG(status.st_mode)) continue;
    printed_.emplace(status.st_dev, status.st_ino);
  }
}

std::string Places::real_path(const std::string& path) {
  std::error_code error;
  return real(fs::absolute(path, error));
}

std::string Places::real(const fs::path& path) {
  // Links are resolved as far as there are files; what follows will be made of plain folders, of which ".."
  // leads back. A link that leads nowhere is replaced, not followed, when it is written.
  std::error_code error;
  const fs::path name = path.filename(), folder = path.parent_path();
  if (name.empty() || name == "." || name == ".." || folder == path || fs::is_symlink(path, error)) {
    const fs::path whole = fs::weakly_canonical(path, error);
    std::string real = error ? path.lexically_normal().string() : whole.string();
    if (real.size() > 1 && real.back() == '/') real.pop_back();
    return real;
  }
  auto known = real_folders_.find(folder.string());
  if (known == real_folders_.end()) known = real_folders_.emplace(folder.string(), real(folder)).first;
  return (fs::path(known->second) / name).string();
}

Places::Place Places::place_of(const std::string& path) {
  Place place{path, real_path(path), std::nullopt, false};
  struct stat status {};
  if (stat(path.c_str(), &status) != 0 && stat(place.path.c_str(), &status) != 0) return place;
  place.is_special = !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
  place.file = File{status.st_dev, status.st_ino};
  return place;
}

void Places::Uses::add(const Place& place, const std::string& what) {
  if (place.is_special) return;
  by_path.try_emplace(place.path, Use{what, place.given});
  if (place.file) by_file.try_emplace(*place.file, Use{what, place.given});
}

const Places::Use* Places::Uses::find(const Place& place) const {
  if (place.is_special) return nullptr;
  if (place.file) {
    const auto found = by_file.find(*place.file);
    if (found != by_file.end()) return &found->second;
  }
  const auto found = by_path.find(place.path);
  return found == by_path.end() ? nullptr : &found->second;
}

void Places::reads(const std::string& what, const std::string& path) {
  if (!seen_.insert(path).second) return;
  const Place place = place_of(path);
  if (!place.file) return;
  std::string over;
  if (printed_.contains(*place.file)) over = "what the program prints";
  std::string given = path;
  if (const Use* const use = written_.find(place)) over = use->what, given = use->given;
  if (!over.empty()) {
    throw Error(ExitCode::usage,
                over + " would be written over " + what + ", " + path + other_name(path, given), advice);
  }
  read_.add(place, what);
}

void Places::reads(const DagNode& node) {
  for (const ParamDecl& param : node.kind.params()) {
    if (param.kind != ParamKind::file) continue;
    const auto value = node.params.find(param.name);
    if (value == node.params.end() || !value->second.is_string()) continue;
    const auto& path = value->second.get_ref<const std::string&>();
    bool is_file = !path.empty();
    for (const std::string& scheme : param.schemes) is_file = is_file && !path.starts_with(scheme);
    if (is_file) reads("the " + param.name + " of node " + node.path, path);
  }
  for (const FileOfNode& file : files_named_by(node)) {
    if (!file.path.empty()) reads(file.name + ", which a file of node " + node.path + " names", file.path);
  }
  if (const Loop* const loop = node.kind.loop()) {
    for (const DagNode& inner : loop->body.nodes) reads(inner);
  }
}

void Places::reads(const Dag& dag) {
  for (const std::string& file : dag.files) reads(file == dag.file ? "the graph" : "a subgraph", file);
  for (const DagNode& node : dag.nodes) reads(node);
}

void Places::has_cache(const std::string& root) {
  if (!root.empty()) cache_ = place_of(root);
}

bool Places::in_cache(const Place& place) {
  if (!cache_) return false;
  // From the place upwards, as far as it takes to meet the cache or a folder that is known.
  std::vector<std::string> above;
  bool inside = false;
  for (fs::path at = place.path;; at = at.parent_path()) {
    if (const auto known = folders_in_cache_.find(at.string()); known != folders_in_cache_.end()) {
      inside = known->second;
      break;
    }
    above.push_back(at.string());
    struct stat status {};
    inside = at.string() == cache_->path || (cache_->file && stat(at.c_str(), &status) == 0 &&
                                             File{status.st_dev, status.st_ino} == *cache_->file);
    if (inside || at == at.parent_path()) break;
  }
  for (const std::string& folder : above) folders_in_cache_[folder] = inside;
  return inside;
}

void Places::writes(const std::string& what, const std::string& path) {
  if (path.empty()) return;
  const Place place = place_of(path);
  if (place.is_special) return;
  if (const Use* const use = read_.find(place)) {
    throw Error(
        ExitCode::usage,
        what + ": " + path + " is " + use->what + ", which would be lost" + other_name(path, use->given),
        advice);
  }
  if (in_cache(place)) {
    throw Error(ExitCode::usage, what + ": " + path + " is in the cache, " + cache_->given, advice);
  }
  if (const Use* const use = written_.find(place)) {
    throw Error(ExitCode::usage, what + ": " + use->what + " would be written to the same file, " + path,
                advice);
  }
  written_.add(place, what);
}

}  // namespace ballflow::cli
