#include "ballflow/artifact.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "ballflow/error.hpp"
#include "base/canonical_json.hpp"
#include "plugin/artifact_layout.hpp"

namespace ballflow {
namespace {

std::string system_message(int error) { return std::generic_category().message(error); }

}  // namespace

std::shared_ptr<const Artifact> Artifact::seal(std::string type, int version, std::vector<NamedArray> arrays,
                                               std::string_view summary, std::shared_ptr<const void> owner) {
  const std::shared_ptr<Artifact> artifact(new Artifact);
  artifact->summary_ = canonical_json(summary, ExitCode::plugin);
  if (artifact->summary_.front() != '{') throw Error(ExitCode::plugin, "the summary is not a JSON object");
  artifact->header_ = make_header(type, version, artifact->summary_, arrays, ExitCode::plugin);
  artifact->type_ = std::move(type);
  artifact->version_ = version;
  artifact->file_size_ = artifact->header_.size();
  for (const NamedArray& array : arrays) {
    if (array.data == nullptr && array.bytes() != 0) {
      throw Error(ExitCode::plugin, "array " + array.name + " has a size and no data");
    }
    artifact->file_size_ += array.bytes();
  }
  artifact->arrays_ = std::move(arrays);
  artifact->owner_ = std::move(owner);
  return artifact;
}

std::shared_ptr<const Artifact> Artifact::decode(std::span<const std::byte> file,
                                                 std::shared_ptr<const void> owner) {
  return read(file, std::move(owner));
}

std::shared_ptr<Artifact> Artifact::read(std::span<const std::byte> file, std::shared_ptr<const void> owner) {
  ArtifactLayout layout = read_layout(file);
  const std::shared_ptr<Artifact> artifact(new Artifact);
  artifact->type_ = std::move(layout.type);
  artifact->version_ = layout.version;
  artifact->summary_ = std::move(layout.summary);
  artifact->arrays_ = std::move(layout.arrays);
  artifact->header_ = std::move(layout.header);
  artifact->checksum_ = checksum_of(file.data(), file.size());
  artifact->file_size_ = file.size();
  artifact->owner_ = std::move(owner);
  return artifact;
}

std::shared_ptr<const Artifact> Artifact::map(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw Error(ExitCode::store, "cannot open " + path + ": " + system_message(errno));
  const std::shared_ptr<const void> closer(nullptr, [file](const void*) { ::close(file); });
  return map(file, path);
}

std::shared_ptr<const Artifact> Artifact::map(int file, const std::string& name,
                                              const std::optional<Digest>& known) {
  struct stat status {};
  if (::fstat(file, &status) != 0) {
    throw Error(ExitCode::store, "cannot read " + name + ": " + system_message(errno));
  }
  if (!S_ISREG(status.st_mode)) throw Error(ExitCode::store, name + " is not a regular file");
  const auto size = static_cast<std::size_t>(status.st_size);
  try {
    if (size == 0) return read({}, nullptr);
    // Everything is read at once for the checksum: have the pages mapped in one go.
    void* address = ::mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, file, 0);
    if (address == MAP_FAILED)
      throw Error(ExitCode::store, "cannot map " + name + ": " + system_message(errno));
    const std::shared_ptr<const void> owner(
        address, [size](const void* at) { ::munmap(const_cast<void*>(at), size); });
    const auto artifact = read({static_cast<const std::byte*>(address), size}, owner);
    artifact->digest_ = known;
    return artifact;
  } catch (const BadArtifact& error) {
    throw BadArtifact(name + ": " + error.what());
  }
}

const NamedArray* Artifact::find(std::string_view name) const {
  const auto found = std::find_if(arrays_.begin(), arrays_.end(),
                                  [&](const NamedArray& array) { return array.name == name; });
  return found == arrays_.end() ? nullptr : &*found;
}

const Digest& Artifact::digest() const {
  hash(nullptr);
  return *digest_;
}

bool Artifact::hash(const std::function<bool()>& give_up) const {
  const std::lock_guard lock(sums_mutex_);
  if (digest_) return true;
  Digest digest;
  Checksum checksum;  // who wants the digest soon wants the checksum
  if (!sum_up(pieces(), &digest, checksum_ ? nullptr : &checksum, give_up)) return false;
  if (!checksum_) checksum_ = checksum;
  digest_ = digest;
  return true;
}

Checksum Artifact::checksum() const {
  const std::lock_guard lock(sums_mutex_);
  if (!checksum_) {
    Checksum checksum;
    sum_up(pieces(), nullptr, &checksum);
    checksum_ = checksum;
  }
  return *checksum_;
}

std::vector<std::span<const std::byte>> Artifact::pieces() const {
  std::vector<std::span<const std::byte>> pieces;
  pieces.push_back(std::as_bytes(std::span(header_)));
  for (const NamedArray& array : arrays_) {
    if (array.bytes() != 0) pieces.emplace_back(static_cast<const std::byte*>(array.data), array.bytes());
  }
  return pieces;
}

}  // namespace ballflow
