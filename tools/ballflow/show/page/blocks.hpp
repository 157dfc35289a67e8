// The arrays of a page: packed so that they are small and a browser unpacks them without a library.
//
// A block is an array of float, uint32 or uint8, little-endian. Before it is compressed (zlib), integers
// become differences to the one before, small ones of either sign small (d -> 2 d or -2 d - 1), and the bytes
// of all numbers are ordered by significance: all first bytes, then all second ones. What is left is written
// as base64. tools/viewer/src/blocks.js undoes it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "ballflow/digest.hpp"

namespace ballflow::show {

struct Block {
  enum class Type : std::uint8_t { f32, u32, u8 };
  Type type = Type::f32;
  std::size_t count = 0;
  std::string base64;
};
std::string_view to_string(Block::Type type);

/// Blocks of equal content are kept once: layers share vertices and radii.
class Blocks {
 public:
  std::size_t add(std::span<const float> values);
  std::size_t add(std::span<const std::uint32_t> values);
  std::size_t add(std::span<const std::uint8_t> values);

  const std::vector<Block>& all() const { return blocks_; }
  /// Bytes of base64.
  std::size_t bytes() const { return bytes_; }

  /// Forgets the blocks from number `count` on.
  void shrink(std::size_t count);

 private:
  using Content = std::tuple<Block::Type, std::size_t, std::uint64_t, std::uint64_t>;
  std::size_t add(Block::Type type, std::size_t count, std::span<const std::uint8_t> raw);

  std::vector<Block> blocks_;
  std::vector<Content> contents_;  // as blocks_
  std::map<Content, std::size_t> known_;
  std::size_t bytes_ = 0;
};

}  // namespace ballflow::show
