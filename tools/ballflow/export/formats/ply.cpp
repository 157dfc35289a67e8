#include "export/formats.hpp"

namespace ballflow {
namespace {

void raw_vector(OutputFile& out, geometry::Vec3 p) {
  out.raw(p.x);
  out.raw(p.y);
  out.raw(p.z);
}

void code_property(OutputFile& out, const Codes& codes) {
  if (!codes.name.empty()) out << "property uchar " << codes.name << '\n';
}

/// Many readers know no other count of corners than uchar.
bool counts_fit_a_byte(const PolyData& data) {
  for (std::size_t i = 0; i < data.polygons(); ++i) {
    if (data.polygon(i).size() > 255) return false;
  }
  return true;
}

}  // namespace

void write_ply(const PolyData& data, OutputFile& out) {
  const bool small = counts_fit_a_byte(data);
  out << "ply\nformat binary_little_endian 1.0\ncomment written by ballflow\n";
  out << "element vertex " << data.points.size() << '\n';
  for (const char axis : {'x', 'y', 'z'}) out << "property double " << axis << '\n';
  if (!data.normals.empty()) {
    for (const char axis : {'x', 'y', 'z'}) out << "property double n" << axis << '\n';
  }
  if (data.radii) out << "property double radius\n";
  for (const Column& column : data.point_columns) out << "property double " << column.name << '\n';
  code_property(out, data.point_codes);
  if (!data.point_numbers.name.empty()) out << "property int " << data.point_numbers.name << '\n';
  if (data.polygons() != 0) {
    out << "element face " << data.polygons() << "\nproperty list " << (small ? "uchar" : "int")
        << " int vertex_indices\n";
    code_property(out, data.polygon_codes);
    if (!data.polygon_numbers.name.empty()) out << "property int " << data.polygon_numbers.name << '\n';
    if (!data.polygon_colours.empty()) {
      for (const char* channel : {"red", "green", "blue"}) out << "property uchar " << channel << '\n';
    }
  }
  if (!data.edges.empty()) {
    out << "element edge " << data.edges.size() << "\nproperty int vertex1\nproperty int vertex2\n";
  }
  out << "end_header\n";

  for (std::size_t i = 0; i < data.points.size(); ++i) {
    raw_vector(out, data.points[i]);
    if (!data.normals.empty()) raw_vector(out, data.normals[i]);
    if (data.radii) out.raw((*data.radii)[i]);
    for (const Column& column : data.point_columns) out.raw(column.values[i]);
    if (!data.point_codes.name.empty()) out.raw(data.point_codes.values[i]);
    if (!data.point_numbers.name.empty()) out.raw(data.point_numbers.values[i]);
  }
  for (std::size_t i = 0; i < data.polygons(); ++i) {
    const auto corners = data.polygon(i);
    if (small) {
      out.raw(static_cast<std::uint8_t>(corners.size()));
    } else {
      out.raw(static_cast<std::int32_t>(corners.size()));
    }
    for (const std::int32_t v : corners) out.raw(v);
    if (!data.polygon_codes.name.empty()) out.raw(data.polygon_codes.values[i]);
    if (!data.polygon_numbers.name.empty()) out.raw(data.polygon_numbers.values[i]);
    if (!data.polygon_colours.empty()) {
      for (const std::uint8_t channel : data.polygon_colours[i]) out.raw(channel);
    }
  }
  for (const Edge& edge : data.edges) {
    for (const std::int32_t v : edge) out.raw(v);
  }
}

}  // namespace ballflow
