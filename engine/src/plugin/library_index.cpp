#include "plugin/library_index.hpp"

#include <link.h>

#include <cstdlib>
#include <filesystem>
#include <utility>

#include "ballflow/plugin.h"
#include "base/draft.hpp"
#include "base/record.hpp"

namespace ballflow {
namespace {

constexpr std::string_view magic = "bflibrary";
constexpr std::uint32_t format = 2;
constexpr const char* file_name = "libraries";
constexpr std::uint64_t size_limit = 64u << 20;  // bytes; a library declares some ten thousand
constexpr mode_t file_mode = 0444;

bool trusted(FileSystem& files, const OpenFile& file, struct stat& status) {
  return file.is_open() && files.status(file.get(), status) >= 0 && distrust(status).empty();
}

std::optional<FileState> state_of(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileState(status);
}

std::string search_path() {
  const char* const folders = std::getenv("LD_LIBRARY_PATH");
  return folders == nullptr ? "" : folders;
}

/// Reads what encode() wrote.
LibraryOutline decode_outline(RecordReader& reader) {
  constexpr std::size_t smallest_type = 3 * 4, smallest_node = 3 * 4 + 1, smallest_port = 3 * 4;
  LibraryOutline outline;
  std::uint8_t has_digest = 0;
  reader.number(has_digest);
  Digest digest;
  reader.digest(digest);
  if (has_digest != 0) outline.digest = digest;
  reader.text(outline.name);
  reader.text(outline.version);
  outline.types.resize(reader.count(smallest_type));
  for (TypeOutline& type : outline.types) {
    reader.text(type.id);
    reader.number(type.version);
    reader.text(type.declaration);
  }
  outline.nodes.resize(reader.count(smallest_node));
  for (NodeOutline& node : outline.nodes) {
    reader.text(node.id);
    std::uint8_t lists_files = 0;
    reader.number(lists_files);
    node.lists_files = lists_files != 0;
    reader.text(node.declaration);
    node.ports.resize(reader.count(smallest_port));
    for (PortOutline& port : node.ports) {
      reader.text(port.name);
      reader.text(port.type);
      reader.number(port.type_version);
    }
  }
  return outline;
}

void encode(const LibraryOutline& outline, RecordWriter& writer) {
  writer.number(static_cast<std::uint8_t>(outline.digest ? 1 : 0));
  writer.digest(outline.digest.value_or(Digest()));
  writer.text(outline.name);
  writer.text(outline.version);
  writer.number(static_cast<std::uint32_t>(outline.types.size()));
  for (const TypeOutline& type : outline.types) {
    writer.text(type.id);
    writer.number(std::int32_t{type.version});
    writer.text(type.declaration);
  }
  writer.number(static_cast<std::uint32_t>(outline.nodes.size()));
  for (const NodeOutline& node : outline.nodes) {
    writer.text(node.id);
    writer.number(static_cast<std::uint8_t>(node.lists_files ? 1 : 0));
    writer.text(node.declaration);
    writer.number(static_cast<std::uint32_t>(node.ports.size()));
    for (const PortOutline& port : node.ports) {
      writer.text(port.name);
      writer.text(port.type);
      writer.number(std::int32_t{port.type_version});
    }
  }
}

}  // namespace

LibraryIndex::LibraryIndex(const std::string& root, std::shared_ptr<FileSystem> files)
    : files_(files != nullptr ? std::move(files) : std::make_shared<FileSystem>()) {
  if (root.empty()) return;
  std::error_code ignored;
  const std::string path = std::filesystem::absolute(root, ignored).string();
  root_ = OpenFile(*files_, files_->open(FileSystem::working_folder, path, O_RDONLY | O_DIRECTORY));
  struct stat status {};
  if (!trusted(*files_, root_, status)) {
    root_ = OpenFile();
    return;
  }
  if (const std::optional<std::string> bytes = read()) decode(*bytes);
}

std::optional<std::string> LibraryIndex::read() const {
  const OpenFile file(*files_, files_->open(root_.get(), file_name, file_flags));
  struct stat status {};
  if (!trusted(*files_, file, status) || !S_ISREG(status.st_mode)) return std::nullopt;
  if (static_cast<std::uint64_t>(status.st_size) > size_limit) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  for (std::size_t have = 0; have < bytes.size();) {
    const ssize_t got = files_->read(file.get(), bytes.data() + have, bytes.size() - have);
    if (got <= 0) return std::nullopt;
    have += static_cast<std::size_t>(got);
  }
  return bytes;
}

void LibraryIndex::decode(std::string_view bytes) {
  constexpr std::size_t smallest_object = 4 + 5 * 8, smallest_library = smallest_object + 1 + 32 + 4 * 4;
  RecordReader reader(bytes);
  if (!reader.unseal() || reader.raw(magic.size()) != magic) return;
  std::uint32_t its_format = 0, abi = 0;
  reader.number(its_format);
  reader.number(abi);
  if (its_format != format || abi != BALLFLOW_ABI_VERSION) return;
  std::string folders;
  reader.text(folders);
  bool same = folders == search_path();
  std::map<std::string, FileState> objects;
  for (std::uint32_t left = reader.count(smallest_object); left > 0 && reader.ok(); --left) {
    std::string path;
    reader.text(path);
    const FileState state = decode_state(reader);
    same = same && state_of(path) == state;
    objects.insert_or_assign(std::move(path), state);
  }
  std::map<std::string, Known> libraries;
  for (std::uint32_t left = reader.count(smallest_library); left > 0 && reader.ok(); --left) {
    std::string path;
    Known known;
    reader.text(path);
    known.state = decode_state(reader);
    known.outline = std::make_shared<const LibraryOutline>(decode_outline(reader));
    libraries.insert_or_assign(std::move(path), std::move(known));
  }
  if (!reader.at_end() || !same) return;
  libraries_ = std::move(libraries);
  shared_objects_ = std::move(objects);
}

void LibraryIndex::note_shared_objects() {
  const auto note = [](dl_phdr_info* object, std::size_t, void* self) {
    const std::string path = object->dlpi_name;  // nothing for the program itself
    if (path.find('/') == std::string::npos) return 0;
    if (const auto state = state_of(path))
      static_cast<LibraryIndex*>(self)->shared_objects_.insert_or_assign(path, *state);
    return 0;
  };
  dl_iterate_phdr(note, this);
  for (const auto& [path, known] : libraries_) shared_objects_.erase(path);
}

std::string LibraryIndex::encoded() const {
  RecordWriter writer;
  writer.raw(magic);
  writer.number(format);
  writer.number(std::uint32_t{BALLFLOW_ABI_VERSION});
  writer.text(search_path());
  writer.number(static_cast<std::uint32_t>(shared_objects_.size()));
  for (const auto& [path, state] : shared_objects_) {
    writer.text(path);
    encode(state, writer);
  }
  writer.number(static_cast<std::uint32_t>(libraries_.size()));
  for (const auto& [path, known] : libraries_) {
    writer.text(path);
    encode(known.state, writer);
    encode(*known.outline, writer);
  }
  return std::move(writer).sealed();
}

std::shared_ptr<const LibraryOutline> LibraryIndex::find(const std::string& path,
                                                         const FileState& state) const {
  const auto found = libraries_.find(path);
  return found != libraries_.end() && found->second.state == state ? found->second.outline : nullptr;
}

void LibraryIndex::add(const std::string& path, const FileState& state,
                       std::shared_ptr<const LibraryOutline> outline) {
  if (!root_.is_open() || !state.settled(files_->now())) return;
  libraries_.insert_or_assign(path, Known{state, std::move(outline)});
  changed_ = true;
}

void LibraryIndex::save() {
  if (!changed_) return;
  changed_ = false;
  std::erase_if(libraries_, [&](const auto& item) {
    struct stat status {};
    return files_->status(FileSystem::working_folder, item.first, status) < 0 ||
           FileState(status) != item.second.state;
  });
  note_shared_objects();
  const std::string bytes = encoded();
  Draft draft(*files_, root_.get(), temporary_name(*files_, file_name), file_mode);
  if (draft.made() == 0 && draft.write(std::as_bytes(std::span(bytes))) == 0)
    draft.publish(root_.get(), file_name, true);
}

}  // namespace ballflow
