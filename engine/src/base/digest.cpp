#include "ballflow/digest.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

#include "ballflow/file_system.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace ballflow {
namespace {

// Looked up once: the implicit fetch of EVP_sha256() costs more than hashing a short manifest.
const EVP_MD* algorithm() {
  static const EVP_MD* const fetched = EVP_MD_fetch(nullptr, "SHA256", nullptr);
  if (fetched == nullptr) throw std::runtime_error("libcrypto offers no SHA-256");
  return fetched;
}

struct FreeState {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};

/// A state that this thread used before: making one costs as much as hashing a short text.
std::unique_ptr<EVP_MD_CTX, FreeState>& spare() {
  thread_local std::unique_ptr<EVP_MD_CTX, FreeState> state;
  return state;
}

int nibble(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

EVP_MD_CTX* state(void* context) { return static_cast<EVP_MD_CTX*>(context); }
XXH3_state_t* checksum_state(void* context) { return static_cast<XXH3_state_t*>(context); }

}  // namespace

std::string Digest::hex() const {
  static constexpr char digits[] = "0123456789abcdef";
  std::string text(2 * bytes.size(), '0');
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    text[2 * i] = digits[bytes[i] >> 4];
    text[2 * i + 1] = digits[bytes[i] & 15];
  }
  return text;
}

std::optional<Digest> Digest::from_hex(std::string_view text) {
  Digest digest;
  if (text.size() != 2 * digest.bytes.size()) return std::nullopt;
  for (std::size_t i = 0; i < digest.bytes.size(); ++i) {
    const int high = nibble(text[2 * i]), low = nibble(text[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    digest.bytes[i] = static_cast<std::uint8_t>(high << 4 | low);
  }
  return digest;
}

Hasher::Hasher() : context_(spare() ? spare().release() : EVP_MD_CTX_new()) {
  if (context_ == nullptr) throw std::bad_alloc();
  if (EVP_DigestInit_ex2(state(context_), algorithm(), nullptr) != 1) {
    EVP_MD_CTX_free(state(context_));
    throw std::runtime_error("libcrypto cannot start a SHA-256 computation");
  }
}

Hasher::~Hasher() { spare().reset(state(context_)); }

void Hasher::add(const void* data, std::size_t size) {
  if (size != 0 && EVP_DigestUpdate(state(context_), data, size) != 1) {
    throw std::runtime_error("libcrypto failed in a SHA-256 computation");
  }
}

Digest Hasher::finish() {
  Digest digest;
  if (EVP_DigestFinal_ex(state(context_), digest.bytes.data(), nullptr) != 1) {
    throw std::runtime_error("libcrypto failed to end a SHA-256 computation");
  }
  return digest;
}

Digest sha256(std::string_view bytes) {
  Hasher hasher;
  hasher.add(bytes);
  return hasher.finish();
}

Checksummer::Checksummer() : context_(XXH3_createState()) {
  if (context_ == nullptr) throw std::bad_alloc();
  XXH3_128bits_reset(checksum_state(context_));
}

Checksummer::~Checksummer() { XXH3_freeState(checksum_state(context_)); }

void Checksummer::add(const void* data, std::size_t size) {
  if (size != 0) XXH3_128bits_update(checksum_state(context_), data, size);
}

Checksum Checksummer::finish() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(checksum_state(context_));
  return {hash.low64, hash.high64};
}

Checksum checksum_of(const void* data, std::size_t size) {
  const XXH128_hash_t hash = XXH3_128bits(data, size);
  return {hash.low64, hash.high64};
}

bool sum_up(std::span<const std::span<const std::byte>> pieces, Digest* digest, Checksum* checksum,
            const std::function<bool()>& give_up) {
  // Both sums of a chunk while it is in the processor's cache.
  constexpr std::size_t chunk = 128 << 10, chunks_between_looks = 64;
  std::optional<Hasher> sha;
  std::optional<Checksummer> xxh;
  if (digest != nullptr) sha.emplace();
  if (checksum != nullptr) xxh.emplace();
  std::size_t chunks = 0;
  for (const std::span<const std::byte> piece : pieces) {
    for (std::size_t at = 0; at < piece.size(); at += chunk) {
      if (++chunks % chunks_between_looks == 0 && give_up && give_up()) return false;
      const std::size_t size = std::min(chunk, piece.size() - at);
      if (xxh) xxh->add(piece.data() + at, size);
      if (sha) sha->add(piece.data() + at, size);
    }
  }
  if (xxh) *checksum = xxh->finish();
  if (sha) *digest = sha->finish();
  return true;
}

std::int64_t sha256_of_file(FileSystem& files, int file, std::uint64_t at_most, Digest& digest) {
  Hasher hasher;
  std::vector<char> buffer(1 << 18);
  std::uint64_t size = 0;
  while (size <= at_most) {
    const ssize_t got = files.read(file, buffer.data(), buffer.size());
    if (got < 0) return got;
    if (got == 0) break;
    hasher.add(buffer.data(), static_cast<std::size_t>(got));
    size += static_cast<std::uint64_t>(got);
  }
  digest = hasher.finish();
  return static_cast<std::int64_t>(size);
}

}  // namespace ballflow
