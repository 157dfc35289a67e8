#include "document/graph_files.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "ballflow/text.hpp"
#include "base/quote.hpp"
#include "document/graph_json.hpp"

namespace ballflow {

namespace fs = std::filesystem;

namespace {

/// Which graph files there are where one was looked for.
std::string neighbours(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(path.parent_path().empty() ? fs::path(".") : path.parent_path(), error),
       end;
       !error && entry != end && names.size() < 1000; entry.increment(error)) {
    if (entry->path().extension() == ".json") names.push_back(entry->path().filename().string());
  }
  const std::string folder = path.parent_path().empty() ? "." : printable(path.parent_path().string());
  if (error) return "there is no folder " + in_quotes(folder);
  if (names.empty()) return "folder " + in_quotes(folder) + " has no *.json files";
  std::sort(names.begin(), names.end());
  const std::string near = did_you_mean(path.filename().string(), names);
  return near + (near.empty() ? "" : " ") + "folder " + in_quotes(folder) + " has " + listed(names);
}

}  // namespace

const std::string& GraphFiles::canonical(const std::string& path) {
  const auto [memo, fresh] = canonical_.try_emplace(path);
  if (fresh) {
    std::error_code error;
    const fs::path result = fs::weakly_canonical(path, error);
    memo->second = error ? path : result.string();
  }
  return memo->second;
}

void GraphFiles::enter(const GraphFile& file) {
  chain_.push_back({canonical(file.source.file()), file.source.file()});
}

const GraphFile* GraphFiles::find(const GraphFile& includer, Offset offset, const std::string& name,
                                  Findings& findings) {
  const fs::path path = (fs::path(includer.source.file()).parent_path() / name).lexically_normal();
  const std::string& key = canonical(path.string());
  std::string cycle;
  bool found_self = false;
  for (const ChainLink& link : chain_) {
    found_self = found_self || link.key == key;
    if (found_self) cycle += link.name + " -> ";
  }
  if (found_self) {
    findings.error(includer, offset, "the graph includes itself: " + printable(cycle + path.string()),
                   "subgraphs cannot be recursive");
    return nullptr;
  }
  if (chain_.size() >= max_subgraph_depth) {
    findings.error(includer, offset,
                   "subgraphs are nested deeper than " + std::to_string(max_subgraph_depth) + " levels");
    return nullptr;
  }
  if (const auto known = by_path_.find(key); known != by_path_.end()) return known->second.get();
  std::error_code error;
  if (name.find('\0') != std::string::npos || !fs::is_regular_file(path, error)) {
    findings.error(includer, offset, "no subgraph file " + in_quotes(path.string()), neighbours(path));
    return nullptr;
  }
  std::string text;
  try {
    text = read_text_file(path.string());
  } catch (const Error& problem) {
    findings.error(includer, offset, problem.what(), problem.hint());
    return nullptr;
  }
  names_.push_back(path.string());
  std::unique_ptr<GraphFile> file =
      read_graph_file(json_text::Source(path.string(), std::move(text)), findings_);
  if (file != nullptr && (file->sweep || !file->maps.empty())) {
    const Offset section = file->sweep ? file->sweep->offset : file->maps.front().offset;
    findings_.warning(*file, section, "the sweep of a subgraph is not run",
                      "only the top graph's counts; sweep over its parameters there");
  }
  return (by_path_[key] = std::move(file)).get();
}

std::string read_text_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  if (!in || fs::is_directory(path, error)) {
    const std::string why = fs::exists(path, error)
                                ? (fs::is_directory(path, error) ? "it is a folder" : "access denied")
                                : "there is no such file";
    throw Error(ExitCode::usage, "cannot read " + in_quotes(path) + ": " + why);
  }
  std::string text;
  constexpr std::size_t block = std::size_t{1} << 16;
  while (in && text.size() <= json_text::max_size) {
    const std::size_t size = text.size();
    text.resize(size + block);
    in.read(text.data() + size, static_cast<std::streamsize>(block));
    text.resize(size + static_cast<std::size_t>(in.gcount()));
  }
  // Editors write a byte order mark before UTF-8, or text of two bytes a character.
  if (text.starts_with("\xef\xbb\xbf")) text.erase(0, 3);
  const std::string_view start = std::string_view(text).substr(0, 2);
  if (start == "\xff\xfe" || start == "\xfe\xff" ||
      (start.size() == 2 && (start[0] == '\0') != (start[1] == '\0'))) {
    throw Error(ExitCode::usage, "cannot read " + in_quotes(path) + ": its text is in UTF-16",
                "save it as UTF-8");
  }
  return text;
}

}  // namespace ballflow
