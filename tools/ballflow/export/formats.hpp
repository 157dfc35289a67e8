// The writers of formats/. Each writes what its format has room for; the table in export.hpp says what that
// is. Text holds the shortest decimals that give the doubles back, binary files are little-endian.
#pragma once

#include "ballflow/artifact.hpp"
#include "ballflow/output_file.hpp"
#include "export/poly_data.hpp"
#include "types/disc_outline.hpp"
#include "types/polygon2.hpp"

namespace ballflow {

/// PLY, binary, doubles. Points with normals (nx, ny, nz), radius, columns, code and number; faces with code
/// and colour; edges (vertex1, vertex2).
void write_ply(const PolyData& data, OutputFile& out);

/// Wavefront OBJ: points, polygons, edges as lines.
void write_obj(const PolyData& data, OutputFile& out);

/// OFF: points and polygons.
void write_off(const PolyData& data, OutputFile& out);

/// STL, binary, floats: the polygons as triangles with normals. Throws Error (usage) when a coordinate does
/// not fit a float.
void write_stl(const PolyData& data, OutputFile& out);

/// A point a line: x y z, then its normal where there are any. xyz has blanks between the numbers; csv has
/// commas, a line of names first, and also radii (r), columns, codes and numbers.
void write_xyz(const PolyData& data, OutputFile& out);
void write_csv(const PolyData& data, OutputFile& out);

/// NumPy: an n x 3 array of the points, n x 4 with their radii, and columns after that.
void write_npy(const PolyData& data, OutputFile& out);

/// VTK XML PolyData for ParaView, raw appended data: points, normals, radius, columns, code and number as
/// point data; dots, edges and polygons with their code as cell data.
void write_vtp(const PolyData& data, OutputFile& out);

/// Medial axis transform as Q-MAT, MATFP and MATTopo read it: the numbers of points, edges and triangles,
/// then "v x y z r", "e i j", "f i j k" with indices from 0. Polygons are cut into triangles; every side
/// of a triangle is an edge. Points without radii have 0.
void write_ma(const PolyData& data, OutputFile& out);

/// Balls as Q-MAT writes them: their number, then "x y z r" a line.
void write_sph(const PolyData& data, OutputFile& out);

/// Collision spheres of one link, named "link": in the layout of cuRobo's robot files, and as URDF.
void write_yaml(const PolyData& data, OutputFile& out);
void write_urdf(const PolyData& data, OutputFile& out);

/// Balls as SVG: a circle for each, as seen from above, y upwards.
void write_svg(const PolyData& data, OutputFile& out);

/// Polygons as ReadPolygon reads them: SVG (a path for each component, y upwards by a transform), GeoJSON and
/// WKT (MULTIPOLYGON, the first point of a ring repeated at its end), and the numbers of rings and points.
void write_svg(const geometry::Polygon2& polygon, OutputFile& out);
/// Outlines with their arcs: as elliptical arcs of paths, each at most half a turn; and as a line per arc,
/// which ring, disc, where it begins, how far it goes.
void write_svg(const geometry::DiscOutline& outline, OutputFile& out);
void write_csv(const geometry::DiscOutline& outline, OutputFile& out);
void write_geojson(const geometry::Polygon2& polygon, OutputFile& out);
void write_wkt(const geometry::Polygon2& polygon, OutputFile& out);
void write_poly2d(const geometry::Polygon2& polygon, OutputFile& out);

/// glTF 2.0 binary: the layers of the artifact that the viewer shows at first, in the same colours; floats.
/// Up to 20 000 balls are nodes with one sphere as their mesh (translation is the centre, scale the radius);
/// more are points with the attribute _RADIUS. Ellipsoids are nodes likewise: their rotation is that of the
/// ellipsoid, their scale its half-axes. Throws Error (usage) when a number does not fit a float.
void write_glb(const Artifact& artifact, OutputFile& out);

}  // namespace ballflow
