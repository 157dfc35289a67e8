// How binary STL files are laid out: 80 bytes of header, the number of facets, 50 bytes a facet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace ballflow::geometry {

constexpr std::size_t stl_header_bytes = 84, stl_facet_bytes = 50;

inline std::uint32_t little_endian_u32(const char* p) {
  const auto byte = [p](int i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(p[i])); };
  return byte(0) | byte(1) << 8 | byte(2) << 16 | byte(3) << 24;
}

struct StlLayout {
  std::int64_t facets = 0;   // that the header promises
  std::int64_t fitting = 0;  // that the length has room for
  std::size_t extra = 0;     // bytes after these
};

/// The layout if the content is a binary STL file; none for content shorter than a header.
inline std::optional<StlLayout> stl_layout(std::string_view content) {
  if (content.size() < stl_header_bytes) return std::nullopt;
  const std::size_t left = content.size() - stl_header_bytes;
  return StlLayout{little_endian_u32(content.data() + 80), static_cast<std::int64_t>(left / stl_facet_bytes),
                   left % stl_facet_bytes};
}

}  // namespace ballflow::geometry
