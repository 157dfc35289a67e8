#include "show/page/blocks.hpp"

#include <zlib.h>

#include <bit>
#include <new>
#include <string_view>

#include "show/page/base64.hpp"

namespace ballflow::show {
namespace {

static_assert(std::endian::native == std::endian::little);

std::size_t size_of(Block::Type type) { return type == Block::Type::u8 ? 1 : 4; }

std::vector<std::uint8_t> by_significance(std::span<const std::uint8_t> raw, std::size_t size) {
  std::vector<std::uint8_t> ordered(raw.size());
  const std::size_t count = raw.size() / size;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t byte = 0; byte < size; ++byte) ordered[byte * count + i] = raw[i * size + byte];
  }
  return ordered;
}

std::vector<std::uint32_t> differences(std::span<const std::uint32_t> values) {
  std::vector<std::uint32_t> result(values.size());
  std::uint32_t before = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::uint32_t d = values[i] - before;
    result[i] = d << 1 ^ (d >> 31 != 0 ? 0xffffffffU : 0);
    before = values[i];
  }
  return result;
}

std::vector<std::uint8_t> deflated(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> packed(size);
  // Fails for lack of memory only: there is room for any result.
  if (compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), 6) != Z_OK) {
    throw std::bad_alloc();
  }
  packed.resize(size);
  return packed;
}

template <class T>
std::span<const std::uint8_t> bytes_of(std::span<const T> values) {
  return {reinterpret_cast<const std::uint8_t*>(values.data()), values.size_bytes()};
}

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::string_view to_string(Block::Type type) {
  switch (type) {
    case Block::Type::f32:
      return "f32";
    case Block::Type::u32:
      return "u32";
    case Block::Type::u8:
      return "u8";
  }
  return "";
}

std::size_t Blocks::add(std::span<const float> values) {
  return add(Block::Type::f32, values.size(), bytes_of(values));
}

std::size_t Blocks::add(std::span<const std::uint32_t> values) {
  const std::vector<std::uint32_t> steps = differences(values);
  return add(Block::Type::u32, values.size(), bytes_of(std::span<const std::uint32_t>(steps)));
}

std::size_t Blocks::add(std::span<const std::uint8_t> values) {
  return add(Block::Type::u8, values.size(), values);
}

std::size_t Blocks::add(Block::Type type, std::size_t count, std::span<const std::uint8_t> raw) {
  const Checksum sum = checksum_of(raw.data(), raw.size());
  const Content content{type, count, sum.low, sum.high};
  const auto [known, is_new] = known_.try_emplace(content, blocks_.size());
  if (!is_new) return known->second;
  blocks_.push_back({type, count, base64(text_of(deflated(by_significance(raw, size_of(type)))))});
  contents_.push_back(content);
  bytes_ += blocks_.back().base64.size();
  return known->second;
}

void Blocks::shrink(std::size_t count) {
  while (blocks_.size() > count) {
    bytes_ -= blocks_.back().base64.size();
    known_.erase(contents_.back());
    contents_.pop_back();
    blocks_.pop_back();
  }
}

}  // namespace ballflow::show
