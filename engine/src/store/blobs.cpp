#include "store/blobs.hpp"

namespace ballflow {
namespace {

OutputEntry entry_of(const Artifact& artifact) {
  return {{},
          artifact.type(),
          artifact.version(),
          artifact.digest(),
          artifact.file_size(),
          artifact.checksum(),
          artifact.summary()};
}

}  // namespace

bool describes(const OutputEntry& output, const Artifact& artifact) {
  return output.bytes == artifact.file_size() && output.checksum == artifact.checksum() &&
         output.type == artifact.type() && output.type_version == artifact.version() &&
         output.summary == artifact.summary();
}

bool Blobs::has(const OutputEntry& output) const { return size(output.digest) == output.bytes; }

std::optional<std::uint64_t> Blobs::size(const Digest& digest) const {
  const std::string hex = digest.hex();
  const OpenFile shard = open_shard(folders_, folders_.cas, hex);
  struct stat status {};
  if (!shard.is_open() || folders_.files->status(shard.get(), rest_of(hex), status) != 0 ||
      !S_ISREG(status.st_mode) || !distrust(status).empty())
    return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

bool Blobs::put(const Artifact& artifact, bool sync, const std::function<bool()>& give_up) {
  if (!folders_.writing) return false;
  const Fetched there = fetch(entry_of(artifact));
  if (there.artifact != nullptr) return true;
  return publisher_.publish(folders_.cas, "cas", artifact.digest().hex(), artifact.pieces(),
                            {sync, there.damaged, give_up}) != Published::no;
}

Blobs::Fetched Blobs::fetch(const OutputEntry& output) {
  const std::string hex = output.digest.hex();
  const OpenFile shard = open_shard(folders_, folders_.cas, hex);
  if (!shard.is_open()) return {};
  FileSystem& files = *folders_.files;
  const OpenFile file(files, files.open(shard.get(), rest_of(hex), file_flags));
  bool damaged = file.get() == -ELOOP;  // a symbolic link
  if (!file.is_open() && !damaged) return {};
  struct stat status {};
  if (!damaged && files.status(file.get(), status) < 0) return {};
  damaged = damaged || !S_ISREG(status.st_mode) || !distrust(status).empty();
  if (!damaged) {
    const std::string shown = "cas/" + shard_of(hex) + '/' + rest_of(hex);
    try {
      // The checksum in `output` vouches for the digest; only when it does not, the file is hashed.
      const ArtifactPtr artifact = Artifact::map(file.get(), shown, output.digest);
      if (describes(output, *artifact)) {
        touch(folders_, file, status);
        return {artifact, false};
      }
      damaged = Artifact::map(file.get(), shown)->digest() != output.digest;
    } catch (const BadArtifact&) {
      damaged = true;
    } catch (const Error&) {  // no memory or no descriptors left: says nothing about the blob
    }
  }
  if (damaged) to_quarantine(folders_, shard, hex);
  return {nullptr, damaged};
}

}  // namespace ballflow
