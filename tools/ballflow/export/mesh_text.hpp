// Pieces that several formats share.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "export/output_file.hpp"
#include "types/vec3.hpp"

namespace ballflow {

/// An element of a binary little-endian PLY file and its properties ("double x").
struct PlyElement {
  std::string_view name;
  std::size_t count;
  std::vector<std::string_view> properties;
};

inline void ply_header(OutputFile& out, const std::vector<PlyElement>& elements) {
  out << "ply\nformat binary_little_endian 1.0\ncomment written by ballflow\n";
  for (const PlyElement& element : elements) {
    out << "element " << element.name << ' ' << element.count << '\n';
    for (const std::string_view property : element.properties) out << "property " << property << '\n';
  }
  out << "end_header\n";
}

inline void raw(OutputFile& out, geometry::Vec3 p) {
  out.raw(p.x);
  out.raw(p.y);
  out.raw(p.z);
}

/// "x y z" with `separator` between the numbers and nothing after them.
inline void text(OutputFile& out, geometry::Vec3 p, char separator = ' ') {
  out << p.x << separator << p.y << separator << p.z;
}

inline void off_header(OutputFile& out, std::span<const geometry::Vec3> vertices, std::size_t faces) {
  out << "OFF\n" << vertices.size() << ' ' << faces << " 0\n";
  for (const geometry::Vec3 v : vertices) {
    text(out, v);
    out << '\n';
  }
}

inline void obj_vertices(OutputFile& out, std::span<const geometry::Vec3> vertices) {
  for (const geometry::Vec3 v : vertices) {
    out << "v ";
    text(out, v);
    out << '\n';
  }
}

/// "f 1 2 3\n", or "l" and "p": OBJ counts from 1.
template <class Indices>
void obj_element(OutputFile& out, char kind, const Indices& indices) {
  out << kind;
  for (const std::int32_t i : indices) out << ' ' << std::int64_t{i} + 1;
  out << '\n';
}

/// "3 0 1 2\n": OFF counts from 0.
template <class Indices>
void off_face(OutputFile& out, const Indices& indices) {
  out << indices.size();
  for (const std::int32_t i : indices) out << ' ' << i;
  out << '\n';
}

}  // namespace ballflow
