#include "planar/read_polygon.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "planar/generated_polygon.hpp"
#include "planar_cases.hpp"

namespace ballflow::geometry {
namespace {

using test::Points;
using test::rings_of;

std::vector<Points> parsed(const std::string& content) {
  return rings_of(nest(parse_polygon(content).rings).polygon);
}

std::string refused_words(const std::string& content) {
  try {
    nest(parse_polygon(content).rings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

const std::vector<Points> frame{{{0, 0}, {9, 0}, {9, 9}, {0, 9}}, {{1, 1}, {1, 5}, {5, 5}, {5, 1}}};

TEST(read_polygon, gives_the_same_polygon_from_every_format) {
  EXPECT_EQ(parsed("# a frame\n2\n4\n0 0\n9 0\n9 9\n0 9\n4\n1 1\n1 5\n5 5\n5 1\n"), frame);
  EXPECT_EQ(parsed("POLYGON((0 0,9 0,9 9,0 9,0 0),(1 1,1 5,5 5,5 1,1 1))"), frame);
  EXPECT_EQ(
      parsed("SRID=4326; MultiPolygon Z (((0 0 7, 9 0 7, 9 9 7, 0 9 7), (1 1 7, 1 5 7, 5 5 7, 5 1 7)))"),
      frame);
  EXPECT_EQ(
      parsed(
          "GEOMETRYCOLLECTION(POLYGON EMPTY, POLYGONM((0 0 1,9 0 1,9 9 1,0 9 1),(1 1 1,1 5 1,5 5 1,5 1 1)))"),
      frame);
  EXPECT_EQ(
      parsed(
          R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[1,1],[1,5],[5,5],[5,1],[1,1]]]})"),
      frame);
  EXPECT_EQ(parsed(R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{},"geometry":
      {"type":"GeometryCollection","geometries":[{"type":"Point","coordinates":[0,0]},{"type":"MultiPolygon",
      "coordinates":[[[[0,0,1],[9,0,1],[9,9,1],[0,9,1]],[[1,1],[1,5],[5,5],[5,1]]]]}]}}]})"),
            frame);
  EXPECT_EQ(parsed(R"(<svg><path d="M0 0L9,0 9 9 0 9ZM1 1V5H5V1z"/></svg>)"), frame);
  EXPECT_EQ(parsed(R"(<svg><path d="m0,0l9 0 0,9-9 0zm1 1v4h4v-4"/></svg>)"), frame);
  EXPECT_EQ(parsed(R"(<svg><rect width="9" height="9"/><polygon points="1,1 1,5 5,5 5,1"/></svg>)"), frame);
  EXPECT_EQ(
      parsed(R"x(<svg><g transform="translate(1) scale(2,.5)"><rect x="-.5" width="4.5" height="18"/></g>
      <g transform="matrix(0 1 -1 0 0 0)"><polygon transform="rotate(-90)" points="1 1 1 5 5 5 5 1"/></g></svg>)x"),
      frame);
}

TEST(read_polygon, names_the_place_of_what_it_refuses) {
  const auto has = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  has(refused_words("1\n3\n0 0\n1 0\nx 1\n"), "(line 5)");
  has(refused_words("1\n3\n0 0\n1 0\n"), "missing");
  has(refused_words("1\n3\n0 0\n1 0\n0 1\n7\n"), "after the last ring");
  has(refused_words("POLYGON ((0 0, 1 0,\n 0 a))"), "(line 2)");
  has(refused_words("POLYGON ((0 0, 1 0, 0 1)"), "\")\" is missing");
  has(refused_words("LINESTRING (0 0, 1 0)"), "LINESTRING");
  has(refused_words("POLYGON EMPTY"), "no polygon");
  has(refused_words(R"({"type": "Polygon", "coordinates": [[[0, 0], [1, "a"]]]})"),
      "position 1 of polygon 0");
  has(refused_words(R"({"type": "Polygon", "coordinates": [)"), "cannot be read as JSON");
  has(refused_words(R"({"type": "Topology"})"), "Topology");
  has(refused_words(R"({"type": "Point", "coordinates": [0, 0]})"), "no polygon");
  has(refused_words("<svg>\n<path d=\"M0 0C1 1 2 2 3 3\"/></svg>"), "(line 2)");
  has(refused_words("<svg><circle r=\"1\"/></svg>"), "circle is no polygon");
  has(refused_words("<svg><rect width=\"1\" height=\"1\" rx=\"0.1\"/></svg>"), "round corners");
  has(refused_words("<svg><rect width=\"1mm\" height=\"1\"/></svg>"), "unit");
  has(refused_words("<svg><g transform=\"skewX(3)\"><rect width=\"1\" height=\"1\"/></g></svg>"), "skewX");
  has(refused_words("<svg></svg>"), "no polygon");
  has(refused_words("<svg><path"), "damaged");
  has(refused_words("<kml></kml>"), "kml");
  has(refused_words("%PDF"), "no format");
  has(refused_words(""), "no format");
}

TEST(read_polygon, turns_svg_over_and_scales) {
  const std::string file = testing::TempDir() + "/ballflow_read_polygon.svg";
  std::ofstream(file) << R"(<svg><polygon points="0 0 2 0 2 1"/></svg>)";
  const auto read = [&](YAxis y) { return rings_of(read_polygon({file, "mm", y}).polygon)[0]; };
  EXPECT_EQ(read(YAxis::automatic), (Points{{0, 0}, {0.002, -0.001}, {0.002, 0}}));
  EXPECT_EQ(read(YAxis::down), read(YAxis::automatic));
  EXPECT_EQ(read(YAxis::up), (Points{{0, 0}, {0.002, 0}, {0.002, 0.001}}));
  std::filesystem::remove(file);
}

TEST(read_polygon, makes_every_generated_polygon) {
  for (const PolygonInfo& info : generated_polygons()) {
    SCOPED_TRACE(info.name);
    const NestedRings one = read_polygon({std::string("polygon:") + info.name});
    EXPECT_EQ(broken_invariant(one.polygon), "");
    const NestedRings large =
        read_polygon({std::string("polygon:") + info.name + "?n=" + std::to_string(2 * info.n) + "&R=10"});
    EXPECT_EQ(broken_invariant(large.polygon), "");
    EXPECT_GT(area(large.polygon), area(one.polygon));
  }
  EXPECT_EQ(area(read_polygon({"polygon:square?R=3"}).polygon), 36);
  EXPECT_EQ(read_polygon({"polygon:frames?n=5"}).polygon.components(), 3u);
  EXPECT_THROW(read_polygon({"polygon:circle"}), InputError);
  EXPECT_THROW(read_polygon({"polygon:star?R=x"}), InputError);
  EXPECT_THROW(read_polygon({"polygon:star?q=1"}), InputError);
  EXPECT_THROW(read_polygon({"polygon:star?n=1.5"}), InputError);
  EXPECT_THROW(read_polygon({"polygon:star?r=2"}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
