#include "run/named_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <utility>

#include "ballflow/key.hpp"
#include "ballflow/plugin.h"
#include "base/canonical_json.hpp"

namespace ballflow {
namespace {

/// Null where the node does not read files that others name.
const bf_node* lister_of(const DagNode& node) {
  const NodeDeclaration* decl = node.kind.declared();
  if (decl == nullptr || !decl->lists_files) return nullptr;
  const bf_node* const entry = decl->entry;
  if (entry == nullptr || entry->struct_size < BALLFLOW_SIZE_UP_TO(bf_node, files)) return nullptr;
  return entry->files == nullptr ? nullptr : entry;
}

/// Of the node itself.
std::vector<FileOfNode> list(const bf_node& entry, const DagNode& node) {
  std::vector<FileOfNode> files;
  const std::string params = params_text(node);
  const auto found = [](void* context, bf_bytes name, bf_bytes path) noexcept {
    static_cast<std::vector<FileOfNode>*>(context)->push_back(
        {std::string(name.data, name.size), std::string(path.data, path.size)});
  };
  entry.files(entry.self, {params.data(), params.size()}, &files, found);
  const auto by_name = [](const FileOfNode& a, const FileOfNode& b) { return a.name < b.name; };
  std::stable_sort(files.begin(), files.end(), by_name);
  const auto same = [](const FileOfNode& a, const FileOfNode& b) { return a.name == b.name; };
  files.erase(std::unique(files.begin(), files.end(), same), files.end());
  return files;
}

}  // namespace

std::string params_text(const DagNode& node) {
  std::string text;
  for (const auto& [name, value] : node.params) {
    text += text.empty() ? '{' : ',';
    write_string(name, text);
    text += ':';
    write_value(value, text);
  }
  return text + (text.empty() ? "{}" : "}");
}

std::string file_format(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  std::string format = name.extension().string();
  if (format == ".gz" || format == ".GZ") format = name.stem().extension().string() + format;
  std::transform(format.begin(), format.end(), format.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return format.empty() ? format : format.substr(1);
}

std::vector<FileOfNode> files_named_by(const DagNode& node) {
  std::vector<FileOfNode> files;
  if (const bf_node* entry = lister_of(node)) files = list(*entry, node);
  if (const Loop* loop = node.kind.loop()) {
    for (const DagNode& inner : loop->body.nodes) {
      for (FileOfNode& file : files_named_by(inner)) files.push_back(std::move(file));
    }
  }
  return files;
}

Json named_files_manifest(const DagNode& node, Store& store) {
  const bf_node* entry = lister_of(node);
  if (entry == nullptr) return nullptr;
  Json files = Json::object();
  for (const FileOfNode& file : list(*entry, node)) {
    Json& value = files[file.name];
    if (!file.path.empty())
      value = {{"digest", store.file_digest(file.path).hex()}, {"format", file_format(file.path)}};
  }
  return files;
}

}  // namespace ballflow
