// Models from files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "io/formats.hpp"
#include "io/lengths.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// What becomes of points that find_strays names.
enum class StrayPolicy { keep, drop };

struct ReadOptions {
  std::int64_t max_unpacked_bytes = std::int64_t{2} << 30;  // a packed file that unpacks to more is refused
  double scale = 1;                                         // of all coordinates; positive and finite
  Tolerance weld;                                           // see weld(); 0: equal vertices only
  StrayPolicy strays = StrayPolicy::keep;
};

/// A model without repeated vertices. With faces, points.points and mesh.vertices are the same array; a
/// cloud has an empty mesh. Vertices keep the order of the file.
struct MeshFile {
  TriangleMesh mesh;
  PointSet points;
  // What the file had and this model has not.
  std::int64_t welded_vertices = 0;  // equal to an earlier vertex
  std::int64_t near_vertices = 0;    // within the tolerance of an earlier vertex, and not equal
  std::int64_t stray_vertices = 0;   // left out as strays
  std::int64_t unused_vertices = 0;  // in no face of a file that has faces
  // Triangles with a repeated vertex, polygons of fewer than three corners.
  std::int64_t degenerate_faces = 0;
  std::int64_t repeated_faces = 0;   // triangles with the vertices of one that stays, in any order
  std::int64_t cancelled_faces = 0;  // triangles that coincide with others and close nothing; none stays
  // Polygons that are triangulated inside themselves, because no fan fills them, and polygons that cross
  // themselves or have no area, which are fans all the same.
  std::int64_t concave_faces = 0, crossing_faces = 0;
};

/// Reads OFF (also COFF, NOFF, STOFF, 4OFF, and nOFF of dimension 3), OBJ, PLY (ASCII, binary of both byte
/// orders), STL (ASCII, binary) and points as text (XYZ, PTS, PWN, CSV, ASC), each also packed with gzip or
/// zstd, and with a UTF-8 byte order mark.
///
/// - The extension names the format; where the content is certainly of another one (see format_of), it
/// decides with a warning.
/// - Normals and texture coordinates of OBJ that faces name and the file has not are not used, with a
/// warning.
/// - Binary STL files whose header promises no facet, or fewer than the length fits exactly, are read by
/// their length, with a warning.
/// - Lists of points may have a first line of column names, decimal commas (see NumberRows), and several
/// scans one after another.
/// - Numbers are read with the decimal point in every locale and rounded to the nearest double.
/// - Polygons become triangles between their corners: a fan around the first one where that fills the
/// polygon, else the constrained Delaunay triangulation of its inside, seen along an axis. Bent and nested
/// ones too; only what crosses itself however it is seen is a fan all the same.
/// - Of faces with the same corners, whichever way round, one stays, or none where they close nothing: a wall
/// in a solid that is there twice cancels.
/// - Coordinates are multiplied by options.scale first, so all lengths are in the resulting units.
/// - Where the mesh is open and its gaps are small, a warning names the tolerance that closes them; where a
/// few points stretch the bounding box by an order of magnitude or more, one names them.
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
MeshFile parse_mesh(std::string_view content, MeshFormat format, const ReadOptions& options = {},
                    Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
