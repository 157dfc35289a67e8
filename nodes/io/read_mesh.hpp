// Models from files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

struct ReadOptions {
  /// A gzipped file that unpacks to more bytes is refused.
  std::int64_t max_unpacked_bytes = std::int64_t{2} << 30;
};

/// A model without repeated vertices. With faces, points.points and mesh.vertices are the same array; a
/// cloud has an empty mesh. Vertices keep the order of the file.
struct MeshFile {
  TriangleMesh mesh;
  PointSet points;
  // What the file had and this model has not.
  std::int64_t welded_vertices = 0;  // equal to an earlier vertex
  std::int64_t unused_vertices = 0;  // in no face of a file that has faces
  // Triangles with a repeated vertex, polygons of fewer than three corners.
  std::int64_t degenerate_faces = 0;
  std::int64_t repeated_faces = 0;   // triangles with the vertices of one that stays, in any order
  std::int64_t cancelled_faces = 0;  // triangles that coincide with others and close nothing; none stays
  // Polygons that are triangulated inside themselves, because no fan fills them, and polygons that cross
  // themselves or have no area, which are fans all the same.
  std::int64_t concave_faces = 0, crossing_faces = 0;
};

enum class MeshFormat { off, obj, ply, stl, xyz };

/// Reads OFF (also COFF, NOFF, STOFF), OBJ, PLY (ASCII, binary of both byte orders), STL (ASCII, binary) and
/// points as text (XYZ, PTS, PWN), each also gzipped.
///
/// - The extension names the format, the content where there is none (or .txt or .dat).
/// - Numbers are read with the decimal point in every locale and rounded to the nearest double.
/// - Polygons become triangles between their corners: a fan around the first one where that fills the
/// polygon, else the constrained Delaunay triangulation of its inside, seen along an axis. Bent and nested
/// ones too; only what crosses itself however it is seen is a fan all the same.
/// - Of faces with the same corners, whichever way round, one stays, or none where they close nothing: a wall
/// in a solid that is there twice cancels.
/// - Exactly equal vertices are welded, the first one stays; -0 becomes 0. Degenerate and repeated triangles
/// and, where
///   there are faces, vertices in no face are dropped. All are counted, and reported by monitor.warn.
/// - Normals are kept when every vertex that stays has one, scaled to length 1; else they are left out with
///   a warning.
///
/// Throws InputError, naming the element and in text files the line, for a file that is missing, unreadable,
/// empty, cut off or damaged, for a nan or infinite coordinate, for a vertex index out of range, for fewer
/// than four points, and for points in one plane (decided exactly). Memory stays proportional to the size of
/// the unpacked file.
MeshFile read_mesh_file(const std::string& path, const ReadOptions& options = {},
                        Monitor& monitor = no_monitor());

/// The same for content in memory.
MeshFile parse_mesh(std::string_view content, MeshFormat format, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
