// What a parser of a file format produces, before anything is welded or dropped, and the parsers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A face of more than three corners: a fan of corners - 2 triangles around its first corner.
struct RawPolygon {
  std::int32_t first_triangle = 0;
  std::int32_t corners = 0;
};

struct RawModel {
  std::vector<Vec3> vertices;        // finite
  std::vector<Vec3> normals;         // one per vertex, of any length and not checked, or none
  std::vector<double> radii;         // of PLY: one per vertex, not checked, or none
  std::vector<Triangle> triangles;   // polygons as fans; indices in range, repeated ones allowed
  std::vector<RawPolygon> polygons;  // which of them are fans, ascending
  std::int64_t faces = 0;            // polygons the file lists
  std::int64_t small_faces = 0;      // polygons of fewer than three corners, dropped
  bool own_corners = false;          // of every triangle, as in STL: that corners are equal is no news
  std::vector<std::string> warnings;
};

/// Throws InputError when `count` elements of at least `bytes_each` bytes do not fit into `bytes_left`:
/// called before memory is reserved for what a header promises.
void require_room(std::int64_t count, std::size_t bytes_each, std::size_t bytes_left, const char* elements);

/// Throws InputError when the model grows beyond 32-bit indices.
void add_vertex(RawModel& model, const Vec3& p);
/// Adds a polygon as a fan of triangles around its first corner; triangles_of makes better ones of it when
/// all vertices are known.
void add_polygon(RawModel& model, std::span<const std::int32_t> corners);

/// Throws "face 5: vertex index 99 is out of range (8 vertices)". `kind` is "vertex" or "normal".
[[noreturn]] void refuse_index(const char* element, std::int64_t number, const char* kind,
                               const std::string& index, std::size_t count, const std::string& place);

/// How many elements a parser handles between two looks at the monitor.
constexpr std::int64_t elements_per_step = 1 << 15;

// Each parser takes the unpacked content of a file and throws InputError naming the element and, in text
// formats, the line. Memory stays proportional to the size of the content whatever its header claims.
RawModel parse_off(std::string_view content, Monitor& monitor);
RawModel parse_obj(std::string_view content, Monitor& monitor);
RawModel parse_ply(std::string_view content, Monitor& monitor);
RawModel parse_stl(std::string_view content, Monitor& monitor);
RawModel parse_xyz(std::string_view content, Monitor& monitor);

}  // namespace ballflow::geometry
