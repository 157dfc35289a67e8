#include "planar/read_polygon.hpp"

#include <ballflow/sdk.hpp>
#include <string>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/planar_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::ReadPolygonOptions;
using geometry::YAxis;

struct ReadPolygon {
  Out<geometry::Polygon2> polygon;
  ReadPolygonOptions options;

  static void declare(NodeDecl<ReadPolygon>& d) {
    d.id("ReadPolygon", 1)
        .summary("Reads polygons in the plane, with holes and in several parts, or makes them.");
    d.doc(
        "Reads .poly2d (numbers of rings and points, then x y), WKT, GeoJSON and the straight shapes of SVG "
        "(path, polygon, rect, under transforms), each also packed with gzip or zstd; the content decides. "
        "Rings "
        "may run either way: a ring inside an odd number of others is a hole. Repeated points are left out. "
        "Refuses, with the place, rings that cross or touch themselves or each other, decided exactly, rings "
        "of fewer than three points or without area, WKT and GeoJSON whose holes are none, curves, and "
        "coordinates that are not finite. GeoJSON and WKT are taken to be in a plane.");
    d.avoid_when("polygons overlap: make their union first; or coordinates are degrees: project them first.");
    d.cites("kornberger2010", "5.4")
        .cites("shamos1976", "intersection of segments")
        .cites("rfc7946", "3.1.6");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{64} << 20, 0);
    d.output("polygon", &ReadPolygon::polygon)
        .doc("the polygons: outer rings counter-clockwise, holes clockwise");
    d.param("file", &ReadPolygon::options, &ReadPolygonOptions::file)
        .file()
        .scheme("polygon:")
        .required()
        .doc(
            "a file, or polygon:NAME for a generated one: square, regular, star, gear, frames, comb, sqroot, "
            "euro (polygon:star?n=7&R=2&r=0.8)");
    d.param("scale", &ReadPolygon::options, &ReadPolygonOptions::scale)
        .doc(
            "of all coordinates: a factor, or the unit of the lengths in the file, which become metres (um, "
            "mm, "
            "cm, dm, m, km, mil, in, ft, yd)");
    d.choice("y", &ReadPolygon::options, &ReadPolygonOptions::y,
             {{YAxis::automatic, "auto", "down in SVG, up in other formats"},
              {YAxis::up, "up", "as in mathematics and on maps"},
              {YAxis::down, "down", "as on screens: the shape is turned over"}})
        .doc("which way the y axis of the file points; that of the polygon points up");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::NestedRings rings = geometry::read_polygon(options, monitor);
    polygon.summary("repeated_points", rings.repeated_points);
    polygon.summary("turned_rings", rings.turned_rings);
    polygon = std::move(rings.polygon);
  }
};

}  // namespace

const bf_node* read_polygon_entry() { return node_entry<ReadPolygon>(); }

}  // namespace ballflow::nodes
