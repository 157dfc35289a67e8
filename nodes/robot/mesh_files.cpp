#include "robot/mesh_files.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace ballflow::geometry {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_files = 20'000;

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

std::vector<std::string> environment(const char* name) {
  const char* text = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nobody sets it
  return text == nullptr ? std::vector<std::string>() : folders_in(text);
}

std::string in_package(const std::string& package, const std::string& rest, const MeshPlaces& places) {
  std::vector<fs::path> folders(places.packages.begin(), places.packages.end());
  std::error_code error;
  for (fs::path at = fs::absolute(places.folder.empty() ? "." : places.folder, error).lexically_normal();;
       at = at.parent_path()) {
    folders.push_back(at);
    if (at == at.parent_path()) break;
  }
  for (const std::string& folder : environment("ROS_PACKAGE_PATH")) folders.emplace_back(folder);
  for (const std::string& folder : environment("AMENT_PREFIX_PATH"))
    folders.push_back(fs::path(folder) / "share");
  for (const fs::path& folder : folders) {
    if (is_file(folder / package / rest)) return (folder / package / rest).string();
    const fs::path plain = folder.filename().empty() ? folder.parent_path() : folder;  // "dir/"
    if (plain.filename() == package && is_file(folder / rest)) return (folder / rest).string();
  }
  return {};
}

/// Names that a file may have instead, better ones first.
std::vector<std::string> names_for(const fs::path& file) {
  std::vector<std::string> names;
  const auto add = [&](const std::string& name) {
    for (const char* packed : {"", ".gz", ".zst"}) names.push_back(name + packed);
  };
  add(file.filename().string());
  for (const char* ending : {".stl", ".STL", ".obj", ".OBJ", ".dae", ".DAE", ".ply", ".off"})
    add(file.stem().string() + ending);
  return names;
}

/// The files below some folders, level by level, sorted; hidden folders are left out.
std::vector<fs::path> files_below(const std::vector<std::string>& folders) {
  std::vector<fs::path> level(folders.begin(), folders.end()), files;
  while (!level.empty() && files.size() < most_files) {
    std::vector<fs::path> next;
    for (const fs::path& folder : level) {
      std::vector<fs::path> entries;
      std::error_code error;
      for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        if (!entry->path().filename().string().starts_with(".")) entries.push_back(entry->path());
      }
      std::sort(entries.begin(), entries.end());
      for (const fs::path& entry : entries) {
        std::error_code ignored;
        if (fs::is_directory(fs::symlink_status(entry, ignored))) {
          next.push_back(entry);
        } else if (is_file(entry)) {
          files.push_back(entry);
        }
      }
    }
    if (next.size() > most_files) next.resize(most_files);
    level = std::move(next);
  }
  return files;
}

}  // namespace

std::vector<std::string> folders_in(const std::string& text) {
  std::vector<std::string> folders;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(':', begin), text.size());
    if (end > begin) folders.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return folders;
}

MeshPlace find_mesh(const std::string& name, const MeshPlaces& places) {
  fs::path file = name;
  const std::size_t scheme = name.find("://");
  if (scheme != std::string::npos) {
    const std::string kind = name.substr(0, scheme), rest = name.substr(scheme + 3);
    file = rest;
    const std::size_t slash = rest.find('/');
    if (kind == "file") {
      if (is_file(rest)) return {rest, true};
    } else if (slash != std::string::npos) {
      if (std::string found = in_package(rest.substr(0, slash), rest.substr(slash + 1), places);
          !found.empty())
        return {found, true};
    }
  } else {
    const fs::path path = file.is_absolute() ? file : fs::path(places.folder) / file;
    if (is_file(path)) return {path.string(), true};
  }
  std::vector<std::string> folders = {places.folder.empty() ? "." : places.folder};
  folders.insert(folders.end(), places.packages.begin(), places.packages.end());
  const std::vector<fs::path> files = files_below(folders);
  for (const std::string& wanted : names_for(file)) {
    for (const fs::path& candidate : files) {
      if (candidate.filename() == wanted) return {candidate.string(), false};
    }
  }
  return {{}, false};
}

}  // namespace ballflow::geometry
