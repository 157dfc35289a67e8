#include "store/store_format.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>
#include <utility>

#include "store/folders.hpp"

namespace ballflow {
namespace {

constexpr std::string_view action_magic = "bfaction", memo_magic = "bfdigest";
constexpr std::uint32_t action_format = 1, memo_format = 1;
constexpr std::size_t checksum_size = 16;
constexpr std::int64_t settled_after = 2'000'000'000;  // ns; no file system stamps coarser than 2 s (FAT)

class Writer {
 public:
  template <class Integer>
  void number(Integer value) {
    const auto bits = static_cast<std::make_unsigned_t<Integer>>(value);
    for (std::size_t i = 0; i < sizeof bits; ++i) bytes_ += static_cast<char>(bits >> (8 * i) & 0xff);
  }
  void number(double value) { number(std::bit_cast<std::uint64_t>(value)); }
  void raw(std::string_view bytes) { bytes_ += bytes; }
  void text(std::string_view bytes) {
    number(static_cast<std::uint32_t>(bytes.size()));
    raw(bytes);
  }
  void digest(const Digest& digest) {
    raw({reinterpret_cast<const char*>(digest.bytes.data()), digest.bytes.size()});
  }
  std::string sealed() && {
    const Checksum checksum = checksum_of(bytes_.data(), bytes_.size());
    number(checksum.low);
    number(checksum.high);
    return std::move(bytes_);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what Writer wrote. After a step beyond the end ok() is false and all results are empty.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  /// Checks and cuts off the checksum.
  bool unseal() {
    if (bytes_.size() < checksum_size) return ok_ = false;
    const std::string_view content = bytes_.substr(0, bytes_.size() - checksum_size);
    Reader end(bytes_.substr(content.size()));
    Checksum stored;
    end.number(stored.low);
    end.number(stored.high);
    bytes_ = content;
    return ok_ = stored == checksum_of(content.data(), content.size());
  }
  std::string_view raw(std::size_t size) {
    ok_ = ok_ && size <= bytes_.size();
    if (!ok_) return {};
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  template <class Integer>
  void number(Integer& value) {
    std::make_unsigned_t<Integer> bits = 0;
    std::size_t i = 0;
    for (const char byte : raw(sizeof bits)) {
      bits |= static_cast<decltype(bits)>(static_cast<decltype(bits)>(static_cast<unsigned char>(byte))
                                          << (8 * i++));
    }
    value = static_cast<Integer>(bits);
  }
  void number(double& value) {
    std::uint64_t bits = 0;
    number(bits);
    value = std::bit_cast<double>(bits);
  }
  void text(std::string& value) {
    std::uint32_t size = 0;
    number(size);
    value = raw(size);
  }
  void digest(Digest& digest) {
    const std::string_view bytes = raw(digest.bytes.size());
    if (ok_) std::memcpy(digest.bytes.data(), bytes.data(), bytes.size());
  }
  /// A number of items, each of at least `smallest` bytes.
  std::uint32_t count(std::size_t smallest) {
    std::uint32_t value = 0;
    number(value);
    ok_ = ok_ && value <= bytes_.size() / smallest;
    return ok_ ? value : 0;
  }
  bool ok() const { return ok_; }
  bool at_end() const { return ok_ && bytes_.empty(); }

 private:
  std::string_view bytes_;
  bool ok_ = true;
};
}  // namespace

std::string encode(const Digest& key, const ActionEntry& entry) {
  Writer writer;
  writer.raw(action_magic);
  writer.number(action_format);
  writer.digest(key);
  writer.number(entry.seconds);
  writer.number(entry.cpu_seconds);
  writer.text(entry.manifest);
  writer.number(static_cast<std::uint32_t>(entry.outputs.size()));
  for (const OutputEntry& output : entry.outputs) {
    writer.text(output.port);
    writer.text(output.type);
    writer.number(std::int32_t{output.type_version});
    writer.digest(output.digest);
    writer.number(output.bytes);
    writer.number(output.checksum.low);
    writer.number(output.checksum.high);
    writer.text(output.summary);
  }
  writer.number(static_cast<std::uint32_t>(entry.warnings.size()));
  for (const std::string& warning : entry.warnings) writer.text(warning);
  return std::move(writer).sealed();
}

std::optional<ActionEntry> decode_action(const Digest& key, std::string_view bytes) {
  constexpr std::size_t smallest_output = 3 * 4 + 4 + 32 + 3 * 8, smallest_text = 4;
  Reader reader(bytes);
  if (!reader.unseal() || reader.raw(action_magic.size()) != action_magic) return std::nullopt;
  std::uint32_t format = 0;
  reader.number(format);
  Digest stored_key;
  reader.digest(stored_key);
  if (format != action_format || stored_key != key) return std::nullopt;
  ActionEntry entry;
  reader.number(entry.seconds);
  reader.number(entry.cpu_seconds);
  reader.text(entry.manifest);
  entry.outputs.resize(reader.count(smallest_output));
  for (OutputEntry& output : entry.outputs) {
    reader.text(output.port);
    reader.text(output.type);
    reader.number(output.type_version);
    reader.digest(output.digest);
    reader.number(output.bytes);
    reader.number(output.checksum.low);
    reader.number(output.checksum.high);
    reader.text(output.summary);
  }
  entry.warnings.resize(reader.count(smallest_text));
  for (std::string& warning : entry.warnings) reader.text(warning);
  if (!reader.at_end()) return std::nullopt;
  return entry;
}
FileState::FileState(const struct stat& status)
    : device(status.st_dev),
      inode(status.st_ino),
      size(static_cast<std::uint64_t>(status.st_size)),
      modified(nanoseconds(status.st_mtim)),
      changed(nanoseconds(status.st_ctim)) {}

bool FileState::settled(std::int64_t now) const { return now - std::max(modified, changed) >= settled_after; }

std::string FileState::memo_name() const {
  Writer writer;
  writer.number(device);
  writer.number(inode);
  return sha256(writer.bytes()).hex();
}

std::string encode(const Memo& memo) {
  Writer writer;
  writer.raw(memo_magic);
  writer.number(memo_format);
  writer.number(memo.state.device);
  writer.number(memo.state.inode);
  writer.number(memo.state.size);
  writer.number(memo.state.modified);
  writer.number(memo.state.changed);
  writer.digest(memo.digest);
  return std::move(writer).sealed();
}

std::optional<Memo> decode_memo(std::string_view bytes) {
  Reader reader(bytes);
  if (!reader.unseal() || reader.raw(memo_magic.size()) != memo_magic) return std::nullopt;
  std::uint32_t format = 0;
  Memo memo;
  FileState& stored = memo.state;
  reader.number(format);
  reader.number(stored.device);
  reader.number(stored.inode);
  reader.number(stored.size);
  reader.number(stored.modified);
  reader.number(stored.changed);
  reader.digest(memo.digest);
  if (!reader.at_end() || format != memo_format) return std::nullopt;
  return memo;
}

}  // namespace ballflow
