// Polygons from files and from formulas.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planar/ring_nesting.hpp"

namespace ballflow::geometry {

/// Which way the y axis of a file points.
enum class YAxis : std::uint8_t {
  automatic,  // down in SVG, up in everything else
  up,
  down,
};

struct ReadPolygonOptions {
  // A file, also packed (gzip, zstd), or polygon: and a generated one ("polygon:star?n=7&R=2&r=0.8").
  std::string file;
  std::string scale = "1";  // a factor, or the unit of the file, which becomes metres: see parse_scale
  YAxis y = YAxis::automatic;
};

enum class PolygonFormat : std::uint8_t { poly2d, wkt, geojson, svg };
const char* name_of(PolygonFormat format);

/// The rings of a file in its own coordinates.
struct RawPolygon {
  PolygonFormat format = PolygonFormat::poly2d;
  std::vector<RawRing> rings;
};

/// The content decides the format:
///
/// - poly2d: the number of rings, then of each the number of its points and these, "x y". "#" begins a
///   comment.
/// - WKT: POLYGON, MULTIPOLYGON and GEOMETRYCOLLECTION of these, any number of them, also with SRID= before
///   and Z, M or ZM behind the name, whose third and fourth coordinates are left out with a warning.
/// - GeoJSON: Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection; other geometries are
///   passed over with a warning. Longitudes are x and latitudes y: coordinates are taken to be in a plane.
/// - SVG: path (M L H V Z and their small letters), polygon, rect without round corners, under transforms
///   matrix, translate, scale and rotate; text, images and what is under defs, symbol, clipPath, mask and
///   pattern are passed over. Open subpaths are closed. User units: neither viewBox nor width is looked at.
///
/// WKT and GeoJSON say which rings are outer and which are holes; elsewhere the even-odd rule does.
///
/// Throws InputError, with the line, for other content and what is cut off or damaged, for curves and shapes
/// that are not straight (circle, ellipse, line and polyline among them), and where there is no polygon.
RawPolygon parse_polygon(std::string_view content, Monitor& monitor = no_monitor());

/// The rings of the file, scaled and with y upwards, nested. Throws InputError as these do.
NestedRings read_polygon(const ReadPolygonOptions& options, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
