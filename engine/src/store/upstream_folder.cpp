#include "store/upstream_folder.hpp"

#include <algorithm>
#include <array>

#include "ballflow/error.hpp"
#include "base/draft.hpp"

namespace ballflow {
namespace {

constexpr std::size_t at_once = 1 << 20;

const char* name_of(Upstream::Room room) { return room == Upstream::Room::actions ? "ac" : "cas"; }

bool cannot_link(int error) {
  return error == -EPERM || error == -ENOSYS || error == -EOPNOTSUPP || error == -EMLINK || error == -EINVAL;
}

}  // namespace

UpstreamFolder::UpstreamFolder(std::string place, std::shared_ptr<FileSystem> files)
    : place_(std::move(place)), files_(std::move(files)) {
  root_ = {*files_, files_->open(FileSystem::working_folder, place_, O_RDONLY | O_DIRECTORY)};
  if (root_.get() == -ENOENT) {
    throw Error(ExitCode::store, "there is no upstream folder " + place_,
                "make it, for a group with \"mkdir -m 2770 " + place_ + "\", or mount it");
  }
  struct stat status {};
  const int error = root_.is_open() ? files_->status(root_.get(), status) : root_.get();
  if (error < 0)
    throw Error(ExitCode::store, "cannot open the upstream folder " + place_ + ": " + system_message(error));
  if ((status.st_mode & S_IWOTH) != 0) {
    throw Error(ExitCode::store, "refused upstream folder " + place_ + ": everybody may write to it",
                "its entries are believed; close it to others with \"chmod o-w " + place_ + "\"");
  }
  mode_ = status.st_mode & 07777;
}

/// With the mode of the root, whatever the umask: the others of a group have to be able to write to it.
OpenFile UpstreamFolder::subfolder(int parent, const std::string& name, bool create) const {
  OpenFile folder(*files_, files_->open(parent, name, folder_flags));
  if (folder.get() != -ENOENT || !create) return folder;
  const int made = files_->make_folder(parent, name, mode_ & 0777);
  if (made < 0 && made != -EEXIST) return {*files_, made};
  folder = {*files_, files_->open(parent, name, folder_flags)};
  if (made == 0 && folder.is_open()) files_->set_mode(folder.get(), mode_);
  return folder;
}

OpenFile UpstreamFolder::folder(Room room, const std::string& hex, bool create) const {
  const OpenFile top = subfolder(root_.get(), name_of(room), create);
  if (!top.is_open()) return {*files_, top.get()};
  return subfolder(top.get(), shard_of(hex), create);
}

Upstream::Read UpstreamFolder::get(Room room, const Digest& name, const Sink& sink, bool afresh) {
  const std::string hex = name.hex();
  const auto wrong = [](int error) -> Read {
    if (error == -ENOENT) return {Got::absent, {}};
    if (error == -ESTALE) return {Got::stale, system_message(error)};
    return {Got::failed, system_message(error)};
  };
  const OpenFile shard = folder(room, hex, false);
  if (!shard.is_open()) return wrong(shard.get());
  if (afresh) {
    std::vector<std::string> ignored;  // reading the folder renews what the machine remembers of it
    files_->list(shard.get(), ignored);
  }
  const OpenFile file(*files_, files_->open(shard.get(), rest_of(hex), file_flags));
  if (!file.is_open()) return wrong(file.get());
  struct stat status {};
  if (const int error = files_->status(file.get(), status); error < 0) return wrong(error);
  if (!S_ISREG(status.st_mode)) return {Got::failed, "it is no regular file"};
  std::vector<std::byte> buffer(
      std::clamp<std::size_t>(static_cast<std::size_t>(status.st_size) + 1, 512, at_once));
  for (;;) {
    const ssize_t got = files_->read(file.get(), buffer.data(), buffer.size());
    if (got < 0) return wrong(static_cast<int>(got));
    if (got == 0) return {Got::found, {}};
    if (!sink({buffer.data(), static_cast<std::size_t>(got)})) return {Got::refused, {}};
  }
}

std::optional<std::uint64_t> UpstreamFolder::size(Room room, const Digest& name) {
  const std::string hex = name.hex();
  const OpenFile shard = folder(room, hex, false);
  struct stat status {};
  if (!shard.is_open() || files_->status(shard.get(), rest_of(hex), status) != 0 || !S_ISREG(status.st_mode))
    return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

int UpstreamFolder::write_draft(const OpenFile& shard, const std::string& draft,
                                const std::vector<std::span<const std::byte>>& pieces,
                                const PutOptions& options) const {
  OpenFile file(*files_, files_->open(shard.get(), draft, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0600));
  if (!file.is_open()) return file.get();
  for (std::span<const std::byte> piece : pieces) {
    while (!piece.empty()) {
      if (options.give_up && options.give_up()) return -ECANCELED;
      const ssize_t written = files_->write(file.get(), piece.data(), std::min(piece.size(), 8 * at_once));
      if (written <= 0) return written < 0 ? static_cast<int>(written) : -EIO;
      piece = piece.subspan(static_cast<std::size_t>(written));
    }
  }
  // Nobody edits it by accident; whoever may look into the folder may read it.
  if (const int error = files_->set_mode(file.get(), mode_ & 0444); error < 0) return error;
  if (options.sync) {
    if (const int error = files_->sync(file.get()); error < 0) return error;
  }
  return file.close();  // NFS writes now, and says here that it could not
}

/// The first publisher wins. 0, -EEXIST or another error.
int UpstreamFolder::publish(const OpenFile& shard, const std::string& draft, const std::string& name) const {
  int result = files_->link(shard.get(), draft, shard.get(), name);
  if (result == -EEXIST) {
    // The answer to a request that was sent twice: the name is ours when the draft has two.
    struct stat mine {
    }, there{};
    if (files_->status(shard.get(), draft, mine) == 0 && files_->status(shard.get(), name, there) == 0 &&
        mine.st_dev == there.st_dev && mine.st_ino == there.st_ino)
      result = 0;
  }
  if (!cannot_link(result)) {
    files_->remove(shard.get(), draft);
    return result;
  }
  result = files_->rename(shard.get(), draft, shard.get(), name, false);
  if (result == -EINVAL || result == -ENOSYS || result == -EOPNOTSUPP) {
    // Neither can be promised: look, and leave a gap in which another may come first and be replaced by the
    // same.
    struct stat there {};
    result = files_->status(shard.get(), name, there) == 0
                 ? -EEXIST
                 : files_->rename(shard.get(), draft, shard.get(), name, true);
  }
  if (result == -ENOENT) {
    struct stat there {};  // again a request that was sent twice: the draft is gone because it has moved
    if (files_->status(shard.get(), name, there) == 0) return 0;
  }
  if (result < 0) files_->remove(shard.get(), draft);
  return result;
}

Upstream::Written UpstreamFolder::put(Room room, const Digest& name,
                                      const std::vector<std::span<const std::byte>>& pieces,
                                      const PutOptions& options) {
  const std::string hex = name.hex(), rest = rest_of(hex);
  int error = 0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const OpenFile shard = folder(room, hex, true);
    if ((error = shard.get()) >= 0) {
      struct stat status {};
      if (files_->status(shard.get(), rest, status) == 0) return {Put::there, {}};
      const std::string draft = temporary_name(*files_, rest);
      error = write_draft(shard, draft, pieces, options);
      if (error < 0) {
        files_->remove(shard.get(), draft);
      } else {
        error = publish(shard, draft, rest);
      }
    }
    if (error != -ESTALE && error != -ENOENT) break;  // else the folder went away meanwhile
  }
  if (error == -EEXIST) return {Put::there, {}};
  if (error == -ECANCELED) return {Put::given_up, {}};
  if (error < 0) return {Put::failed, system_message(error)};
  return {Put::written, {}};
}

bool UpstreamFolder::set_aside(Room room, const Digest& name) {
  const std::string hex = name.hex(), rest = rest_of(hex);
  const OpenFile shard = folder(room, hex, false);
  return shard.is_open() &&
         files_->rename(shard.get(), rest, shard.get(), rest + ".damaged-" + random_hex(), true) == 0;
}

}  // namespace ballflow
