#include "store/publisher.hpp"

#include <unistd.h>

#include "store/owner.hpp"

namespace ballflow {
namespace {

constexpr mode_t file_mode = 0444, private_mode = 0700;

Publisher::Source from(const std::vector<std::span<const std::byte>>& pieces) {
  return [&pieces](const Publisher::Write& write) {
    for (const std::span<const std::byte> piece : pieces) {
      if (const int error = write(piece); error < 0) return error;
    }
    return 0;
  };
}

}  // namespace

/// tmp/<host>-<boot>-<pid>-<random>/ of this process: made when first needed, locked while it lives.
struct Publisher::Workspace {
  FileSystem& files;
  int parent;
  std::string name;
  OpenFile folder;
  Maker maker = {};

  ~Workspace() {
    if (maker.is_this_process()) files.remove_folder(parent, name);
  }
};

/// A draft, and the folder that it is in.
struct Publisher::File {
  std::shared_ptr<Workspace> place;
  Draft draft;

  File(FileSystem& files, std::shared_ptr<Workspace> in, const std::string& name)
      : place(std::move(in)), draft(files, place->folder.get(), name, file_mode) {}
};

Publisher::Publisher(const StoreFolders& folders, WrittenBytes& written)
    : folders_(folders), written_(written) {
  if (folders.writing) remove_stale_workspaces();
}

Publisher::~Publisher() = default;

Published Publisher::publish(const OpenFile& top, const std::string& top_name, const std::string& hex,
                             const std::vector<std::span<const std::byte>>& pieces,
                             const PublishOptions& options) {
  return publish_from(from(pieces), top, top_name, hex, options);
}

Published Publisher::publish_from(const Source& source, const OpenFile& top, const std::string& top_name,
                                  const std::string& hex, const PublishOptions& options) {
  int error = 0;
  std::uint64_t size = 0;
  const auto no = [&] {
    if (error != -ECANCELED) failed(top_name + '/' + shard_of(hex) + '/' + rest_of(hex), error);
    return Published::no;
  };
  const Source counted = [&](const Write& write) {
    return source([&](std::span<const std::byte> piece) {
      size += piece.size();
      return write(piece);
    });
  };
  const std::unique_ptr<File> file = write(counted, options, error);
  if (file == nullptr) return no();
  const OpenFile shard = open_shard(folders_, top, hex, true);
  if ((error = shard.get()) < 0) return no();
  error = file->draft.publish(shard.get(), rest_of(hex), options.replace);
  if (error == -EEXIST) return Published::there;
  if (error < 0) return no();
  written_.add(size);
  return Published::written;
}

bool Publisher::publish(const OpenFile& folder, const std::string& name, std::string_view text) {
  int error = 0;
  const std::vector<std::span<const std::byte>> pieces{std::as_bytes(std::span(text))};
  const std::unique_ptr<File> file = write(from(pieces), {}, error);
  if (file == nullptr || file->draft.publish(folder.get(), name, true) < 0) return false;
  written_.add(text.size());
  return true;
}

std::unique_ptr<Publisher::File> Publisher::write(const Source& source, const PublishOptions& options,
                                                  int& error) {
  std::unique_ptr<File> file;
  for (int attempt = 0; attempt < 2; ++attempt) {
    const std::shared_ptr<Workspace> place = workspace(error);
    if (place == nullptr) return nullptr;
    file = std::make_unique<File>(*folders_.files, place, std::to_string(next_file_++));
    if ((error = file->draft.made()) != -ENOENT) break;
    const std::lock_guard lock(workspace_mutex_);  // someone removed the folder: make another
    if (workspace_ == place) workspace_.reset();
  }
  if (error < 0) return nullptr;
  error = source([&](std::span<const std::byte> piece) { return file->draft.write(piece, options.give_up); });
  if (error < 0) return nullptr;
  if (options.sync && (error = file->draft.sync()) < 0) return nullptr;
  return file;
}

std::shared_ptr<Publisher::Workspace> Publisher::workspace(int& error) {
  const std::lock_guard lock(workspace_mutex_);
  if (workspace_ != nullptr && workspace_->maker.is_this_process()) return workspace_;
  FileSystem& files = *folders_.files;
  const int tmp = folders_.tmp.get();
  const std::string name = owned_name(files);
  error = files.make_folder(tmp, name, private_mode);
  if (error < 0) return nullptr;
  OpenFile folder(files, files.open(tmp, name, folder_flags));
  if ((error = folder.get()) < 0) {
    files.remove_folder(tmp, name);
    return nullptr;
  }
  // Tells cleaners that this process lives even where they cannot see its id (another container). Network
  // file systems do not lock folders; there the id has to do.
  files.try_lock(folder.get());
  workspace_ = std::shared_ptr<Workspace>(new Workspace{files, tmp, name, std::move(folder)});
  return workspace_;
}

void Publisher::remove_stale_workspaces() {
  FileSystem& files = *folders_.files;
  const int tmp = folders_.tmp.get();
  const std::vector<std::string> names = names_in(folders_, folders_.tmp);
  if (names.empty()) return;
  const std::string here = files.machine();
  for (const std::string& name : names) {
    const auto owner = owner_of(name);
    if (!owner || owner->host != host_of(here)) continue;
    if (owner->machine == here && files.process_alive(owner->process)) continue;
    const OpenFile folder(files, files.open(tmp, name, folder_flags));
    if (!folder.is_open() || files.try_lock(folder.get()) == -EWOULDBLOCK) continue;
    for (const std::string& file : names_in(folders_, folder)) files.remove(folder.get(), file);
    files.remove_folder(tmp, name);
  }
}

void Publisher::failed(const std::string& what, int error) {
  const std::lock_guard lock(trouble_mutex_);
  if (trouble_.empty()) trouble_ = "cannot write " + what + ": " + system_message(error);
}

std::string Publisher::trouble() const {
  const std::lock_guard lock(trouble_mutex_);
  return trouble_;
}

}  // namespace ballflow
