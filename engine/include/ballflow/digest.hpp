// SHA-256 digests: the names of artifacts and of actions. XXH3-128 checksums: the fast check of what was
// read. All hashing of the engine is here.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace ballflow {

struct Digest {
  std::array<std::uint8_t, 32> bytes{};

  friend bool operator==(const Digest&, const Digest&) = default;
  friend auto operator<=>(const Digest&, const Digest&) = default;

  /// 64 lower-case hexadecimal digits.
  std::string hex() const;
  /// Accepts exactly what hex() writes.
  static std::optional<Digest> from_hex(std::string_view text);
};

/// Incremental SHA-256.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  Hasher(const Hasher&) = delete;
  Hasher& operator=(const Hasher&) = delete;

  void add(const void* data, std::size_t size);
  void add(std::string_view text) { add(text.data(), text.size()); }
  /// Ends the computation; call it once, last.
  Digest finish();

 private:
  void* context_;
};

Digest sha256(std::string_view bytes);

/// XXH3-128. It finds accidental damage at memory speed; it does not withstand an attacker.
struct Checksum {
  std::uint64_t low = 0, high = 0;
  friend bool operator==(const Checksum&, const Checksum&) = default;
};

/// Incremental XXH3-128.
class Checksummer {
 public:
  Checksummer();
  ~Checksummer();
  Checksummer(const Checksummer&) = delete;
  Checksummer& operator=(const Checksummer&) = delete;

  void add(const void* data, std::size_t size);
  Checksum finish() const;

 private:
  void* context_;
};

Checksum checksum_of(const void* data, std::size_t size);

/// The sums of pieces one after the other, in one pass; a null pointer is a sum that nobody wants. `give_up`
/// is polled every few milliseconds; false when it said so.
bool sum_up(std::span<const std::span<const std::byte>> pieces, Digest* digest, Checksum* checksum,
            const std::function<bool()>& give_up = {});

class FileSystem;

/// SHA-256 of an open file from where it stands to its end. Stops when there are more than `at_most` bytes (a
/// file may grow faster than it is read). The number of bytes that were read, or a negative errno value.
std::int64_t sha256_of_file(FileSystem& files, int file, std::uint64_t at_most, Digest& digest);

}  // namespace ballflow

template <>
struct std::hash<ballflow::Digest> {
  std::size_t operator()(const ballflow::Digest& d) const noexcept {
    std::size_t h;
    std::memcpy(&h, d.bytes.data(), sizeof h);
    return h;
  }
};
