#include "io/read_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "base/first_equal.hpp"
#include "exact/affine_span.hpp"
#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/model_faces.hpp"
#include "io/raw_model.hpp"
#include "io/strays.hpp"
#include "io/text_cursor.hpp"
#include "io/weld.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;
constexpr Index none = -1;

std::string counted(std::int64_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// The normals of the kept vertices as unit vectors; empty when one of them has none.
std::vector<Vec3> unit_normals(const RawModel& model, const std::vector<Index>& kept, Monitor& monitor) {
  std::vector<Vec3> normals;
  if (model.normals.empty()) return normals;
  normals.reserve(kept.size());
  for (const Index v : kept) {
    const Vec3& normal = model.normals[static_cast<std::size_t>(v)];
    // Scaled first, so that the square neither overflows nor vanishes.
    const double largest = std::max({std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)});
    if (!is_finite(normal) || largest < std::numeric_limits<double>::min()) {
      monitor.warn("vertex " + std::to_string(v) +
                   " has no usable normal: the normals of the file are left out");
      return {};
    }
    const Vec3 scaled{normal.x / largest, normal.y / largest, normal.z / largest};
    normals.push_back((1 / length(scaled)) * scaled);
  }
  return normals;
}

std::string short_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

/// For each vertex the one that stands for it.
std::vector<Index> welded(const RawModel& model, const Tolerance& tolerance, MeshFile& result,
                          Monitor& monitor) {
  std::vector<Index> first = first_equal_point(model.vertices);
  for (std::size_t v = 0; v < first.size(); ++v) result.welded_vertices += first[v] != static_cast<Index>(v);
  if (tolerance.value == 0) return first;
  const double length = tolerance.length(bounding_box(model.vertices).longest_edge());
  if (!(length > 0)) return first;
  const std::vector<Index> near = weld(model.vertices, first, length, monitor);
  for (std::size_t v = 0; v < first.size(); ++v) {
    result.near_vertices += first[v] == static_cast<Index>(v) && near[v] != first[v];
  }
  if (result.near_vertices != 0) {
    monitor.warn(
        counted(result.near_vertices, "vertex is welded to another one", "vertices are welded to others") +
        " at most " + short_text(length) + " away");
  }
  return near;
}

/// Leaves out what the policy says, or says what could be left out.
void tell_strays(std::vector<Index>& kept, std::vector<Vec3>& vertices, std::vector<Triangle>& triangles,
                 StrayPolicy policy, MeshFile& result, Monitor& monitor) {
  const Strays strays = find_strays(vertices, triangles, monitor);
  if (strays.points.empty()) return;
  const Vec3& p = vertices[static_cast<std::size_t>(strays.points[0])];
  const auto count = static_cast<std::int64_t>(strays.points.size());
  std::string text = counted(count, "point, (", "points, the first at (");
  text.append(short_text(p.x)).append(", ").append(short_text(p.y)).append(", ").append(short_text(p.z));
  text.append(count == 1 ? "), is " : "), are ").append(short_text(strays.nearest));
  text.append(count == 1 ? "" : " and more")
      .append(" away from the middle of the others, whose box has a diagonal of ");
  text.append(short_text(strays.diagonal));
  if (policy == StrayPolicy::keep) {
    monitor.warn(text + ": \"strays\" of Sample, set to drop, leaves out what is not part of the shape");
    return;
  }
  monitor.warn(text + ": left out");
  result.stray_vertices = count;
  std::vector<bool> goes(vertices.size());
  for (const Index v : strays.points) goes[static_cast<std::size_t>(v)] = true;
  // No triangle joins a stray with another point.
  std::erase_if(triangles, [&](const Triangle& t) { return goes[static_cast<std::size_t>(t[0])]; });
  std::vector<Index> new_id(vertices.size(), none);
  std::size_t next = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    if (goes[v]) continue;
    new_id[v] = static_cast<Index>(next);
    kept[next] = kept[v];
    vertices[next++] = vertices[v];
  }
  kept.resize(next);
  vertices.resize(next);
  for (Triangle& t : triangles) {
    for (Index& v : t) v = new_id[static_cast<std::size_t>(v)];
  }
}

void tell_gaps(const TriangleMesh& mesh, Monitor& monitor) {
  const auto gaps = small_gaps(mesh, monitor);
  if (!gaps) return;
  std::string text =
      "the mesh is open at " + counted(gaps->open_edges, "edge", "edges") + ", with gaps as small as ";
  text.append(short_text(gaps->widest))
      .append(": \"weld\" of Sample, set to ")
      .append(short_text(gaps->tolerance));
  monitor.warn(text + (gaps->left == 0 ? ", closes them" : ", closes all but " + std::to_string(gaps->left)));
}

MeshFile clean(RawModel model, const ReadOptions& options, Monitor& monitor) {
  MeshFile result;
  for (const std::string& warning : model.warnings) monitor.warn(warning);
  if (!model.radii.empty() && model.faces == 0) {
    monitor.warn(
        "the vertices have radii, so they are balls, of which only the centres are read here: LoadBalls "
        "(graph balls.json) reads balls");
  }

  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    Vec3& p = model.vertices[v];
    if (options.scale != 1) p = options.scale * p;
    if (!is_finite(p)) require_finite(p, "scaled vertex", static_cast<std::int64_t>(v));
    p = p + Vec3{0, 0, 0};  // -0 to 0: equal points have equal bytes
  }
  const std::vector<Index> first = welded(model, options.weld, result, monitor);
  monitor.step(0.9);

  FaceCounts faces;
  std::vector<Triangle> triangles = triangles_of(model, first, faces, monitor);
  drop_repeated(triangles, model.vertices.size(), faces);
  result.degenerate_faces = model.small_faces + faces.degenerate;
  result.repeated_faces = faces.repeated;
  result.cancelled_faces = faces.cancelled;
  result.concave_faces = faces.concave;
  result.crossing_faces = faces.crossing;
  monitor.step(0.95);

  std::vector<bool> used(model.vertices.size(), triangles.empty());
  for (const Triangle& t : triangles) {
    for (const Index v : t) used[static_cast<std::size_t>(v)] = true;
  }
  std::vector<Index> kept, new_id(model.vertices.size(), none);
  std::vector<Vec3> vertices;
  for (std::size_t v = 0; v < model.vertices.size(); ++v) {
    if (first[v] != static_cast<Index>(v)) continue;
    if (!used[v]) {
      ++result.unused_vertices;
      continue;
    }
    new_id[v] = static_cast<Index>(kept.size());
    kept.push_back(static_cast<Index>(v));
    vertices.push_back(model.vertices[v]);
  }
  for (Triangle& t : triangles) {
    for (Index& v : t) v = new_id[static_cast<std::size_t>(v)];
  }

  if (result.welded_vertices != 0 && !model.own_corners) {
    monitor.warn(counted(result.welded_vertices, "vertex equals an earlier one and is welded to it",
                         "vertices equal earlier ones and are welded to them"));
  }
  if (result.degenerate_faces != 0) {
    monitor.warn(counted(result.degenerate_faces, "degenerate face is", "degenerate faces are") + " dropped");
  }
  if (result.repeated_faces != 0) {
    monitor.warn(counted(result.repeated_faces, "repeated face is", "repeated faces are") + " dropped");
  }
  if (result.cancelled_faces != 0) {
    monitor.warn(std::to_string(result.cancelled_faces) +
                 " faces coincide with others and close nothing: such walls and flaps are left out");
  }
  if (result.concave_faces != 0) {
    monitor.warn(counted(result.concave_faces, "concave polygon is triangulated inside itself",
                         "concave polygons are triangulated inside themselves") +
                 (faces.bent != 0 ? "; " + counted(faces.bent, "is", "are") + " not flat" : ""));
  }
  if (result.crossing_faces != 0) {
    monitor.warn(
        counted(result.crossing_faces, "polygon crosses itself or has", "polygons cross themselves or have") +
        " no area: its surface is a fan of triangles around its first corner");
  }
  if (result.unused_vertices != 0) {
    monitor.warn(counted(result.unused_vertices, "vertex belongs to no face and is no sample",
                         "vertices belong to no face and are not samples"));
  }
  if (model.faces != 0 && triangles.empty()) {
    monitor.warn("all " + counted(model.faces, "face is", "faces are") +
                 " degenerate: the model is read as points");
  }

  tell_strays(kept, vertices, triangles, options.strays, result, monitor);
  require_space_filling(vertices);
  result.points.normals = unit_normals(model, kept, monitor);
  result.points.points = std::move(vertices);
  if (!triangles.empty()) {
    result.mesh.vertices = result.points.points;
    result.mesh.triangles = std::move(triangles);
    tell_gaps(result.mesh, monitor);
  }
  return result;
}

}  // namespace

MeshFile parse_mesh(std::string_view content, MeshFormat format, const ReadOptions& options,
                    Monitor& monitor) {
  static constexpr std::array parsers = {parse_off, parse_obj, parse_ply, parse_stl, parse_xyz};
  return clean(parsers[static_cast<std::size_t>(format)](content, monitor), options, monitor);
}

MeshFile read_mesh_file(const std::string& path, const ReadOptions& options, Monitor& monitor) {
  const FileContent content = read_file_content(path, options.max_unpacked_bytes);
  return parse_mesh(content.view(), format_of(path, content.view(), monitor), options, monitor);
}

}  // namespace ballflow::geometry
