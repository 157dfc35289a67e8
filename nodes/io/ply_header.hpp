// The header of a PLY file: which elements follow, and what their properties mean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/text_cursor.hpp"

namespace ballflow::geometry::ply {

enum class Encoding { ascii, little_endian, big_endian };
enum class Scalar { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };
enum class Role { none, x, y, z, nx, ny, nz, radius, diameter, indices };
constexpr std::size_t roles = 10;

std::size_t bytes(Scalar type);
inline bool is_float(Scalar type) { return type == Scalar::f32 || type == Scalar::f64; }

struct Property {
  std::string name;
  bool list = false;
  Scalar count_type = Scalar::u8;  // lists only
  Scalar type = Scalar::f32;
  Role role = Role::none;
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
};

/// Reads the header from the beginning of the text and leaves the cursor at the first byte after it: the line
/// end of the header's first line counts, so that a binary body may begin with any byte.
///
/// Throws InputError, naming the line, for what is no header; for vertices without x, y or z, for more than
/// one property of a role, and for faces that nothing says the corners of: an element "face" without a list
/// vertex_indices or vertex_index of whole numbers, or an element that is nearly called so.
Header parse_header(TextCursor& text);

/// Whether the content begins with a PLY header whose vertices have a radius or diameter, and that has no
/// faces.
bool has_radii(std::string_view content);

}  // namespace ballflow::geometry::ply
