#include <cmath>

#include "export/formats.hpp"
#include "export/formats/float32.hpp"

namespace ballflow {
namespace {

using geometry::Vec3;

void raw_floats(OutputFile& out, Vec3 p) {
  for (const double value : {p.x, p.y, p.z}) out.raw(float32(value, "STL"));
}

/// Unit normal, or zero for a triangle without area.
Vec3 normal(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 n = geometry::cross(b - a, c - a);
  const double size = geometry::length(n);
  return size > 0 && std::isfinite(size) ? (1 / size) * n : Vec3{};
}

}  // namespace

void write_stl(const PolyData& data, OutputFile& out) {
  const std::vector<Triangle> triangles = triangles_of(data);
  std::string header = "binary STL written by ballflow";  // must not begin with "solid"
  header.resize(80, ' ');
  out << std::string_view(header);
  out.raw(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    const auto corner = [&](std::size_t k) { return data.points[static_cast<std::size_t>(t[k])]; };
    raw_floats(out, normal(corner(0), corner(1), corner(2)));
    for (std::size_t k = 0; k < 3; ++k) raw_floats(out, corner(k));
    out.raw(std::uint16_t{0});
  }
}

}  // namespace ballflow
