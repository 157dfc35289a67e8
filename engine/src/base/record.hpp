// The bytes of records on the disk: numbers little-endian, text as a u32 length and so many bytes, at the end
// the XXH3-128 (low u64, high u64) of everything before it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "ballflow/digest.hpp"

namespace ballflow {

class RecordWriter {
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

/// Reads what RecordWriter wrote. After a step beyond the end ok() is false and all results are empty.
class RecordReader {
 public:
  explicit RecordReader(std::string_view bytes) : bytes_(bytes) {}

  /// Checks and cuts off the checksum.
  bool unseal() {
    constexpr std::size_t checksum_size = 16;
    if (bytes_.size() < checksum_size) return ok_ = false;
    const std::string_view content = bytes_.substr(0, bytes_.size() - checksum_size);
    RecordReader end(bytes_.substr(content.size()));
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

}  // namespace ballflow
