#include "io/load_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace ballflow::geometry {
namespace {

struct Warnings final : Monitor {
  std::string text;
  void warn(const std::string& warning) override { text += warning + "\n"; }
};

std::string refusal_of(std::string_view content) {
  try {
    parse_balls(content);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

testing::AssertionResult names(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (text.find(word) == std::string::npos) {
      return testing::AssertionFailure() << "\"" << text << "\" lacks \"" << word << "\"";
    }
  }
  return testing::AssertionSuccess();
}

using Edges = Array<std::array<std::int32_t, 2>>;
using Indices = Array<std::int32_t>;

const Array<Vec3> three_centers = {{0, 0, 0}, {1, 0, 0}, {0.1, -1.0 / 3, 1e-300}};
const Array<double> three_radii = {1, 0.5, 0.1};
const std::string three_rows = "0 0 0 1\n1 0 0 0.5\n0.1 -0.3333333333333333 1e-300 .1\n";

void expect_three(const LoadedBalls& loaded) {
  EXPECT_EQ(loaded.balls.centers, three_centers);
  EXPECT_EQ(loaded.balls.radii, three_radii);
  EXPECT_EQ(broken_invariant(loaded.balls), "");
  EXPECT_EQ(broken_invariant(loaded.axis), "");
}

std::string replaced(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

TEST(load_balls, reads_equal_balls_from_every_way_of_listing_them) {
  std::string with_v;
  for (std::size_t at = 0; at < three_rows.size();) {
    const std::size_t end = three_rows.find('\n', at) + 1;
    with_v += "v " + three_rows.substr(at, end - at);
    at = end;
  }
  for (const std::string& text :
       {"3\n" + three_rows,                                           // sph of Q-MAT
        "4 3\n" + three_rows,                                         // sph of MATTopo
        "# a comment\n\n3   # balls\r\n" + three_rows + "\n# end\n",  // between the lines
        "0. 0 0 1" + three_rows.substr(7),                            // rows
        replaced("0.0 0 0 1" + three_rows.substr(7), ' ', ','), "x,y,z,r\n" + replaced(three_rows, ' ', ','),
        "X;Y;Z;radius\n" + replaced(three_rows, ' ', ';'), with_v, "3 0 0\n" + with_v}) {
    SCOPED_TRACE(text);
    expect_three(parse_balls(text));
  }
  expect_three(load_balls({"balls:" + replaced(three_rows, '\n', ';')}));
  EXPECT_EQ(parse_balls("3\n" + three_rows).axis.vertices.size(), 0u);
}

TEST(load_balls, reads_whole_numbers_as_balls_when_there_are_four_in_a_line) {
  const LoadedBalls loaded = parse_balls("1 2 3 4\n5 6 7 8\n");
  EXPECT_EQ(loaded.balls.centers, (Array<Vec3>{{1, 2, 3}, {5, 6, 7}}));
  EXPECT_EQ(loaded.balls.radii, (Array<double>{4, 8}));
}

TEST(load_balls, reads_radii_of_a_binary_ply_file_to_the_last_bit) {
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nproperty double radius\nproperty uchar label\nend_header\n";
  for (std::size_t i = 0; i < 3; ++i) {
    const double values[] = {three_centers[i].x, three_centers[i].y, three_centers[i].z, three_radii[i]};
    text.append(reinterpret_cast<const char*>(values), sizeof values);
    text += '\1';
  }
  expect_three(parse_balls(text));
}

const std::string header_of_ply =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";

TEST(load_balls, refuses_ply_without_radii_and_with_bad_ones) {
  EXPECT_TRUE(names(refusal_of(header_of_ply + "property uchar r\nend_header\n0 0 0 255\n"),
                    {"no property \"radius\"", "Sample"}));
  EXPECT_TRUE(names(refusal_of(header_of_ply + "property float radius\nend_header\n0 0 0 -2\n"),
                    {"vertex 0", "radius is -2"}));
  EXPECT_TRUE(names(refusal_of(header_of_ply + "property float radius\nend_header\n0 0 0 nan\n"),
                    {"vertex 0", "nan"}));
}

/// A tetrahedron's surface less one side, an edge that hangs on it, and a lone vertex.
const std::string fin =
    "6 7 3\nv 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nv 0 0 1 1\nv 2 0 0 0.5\nv 9 9 9 0\n"
    "e 0 1\ne 1 2\ne 2 0\ne 3 0\ne 1 3\ne 3 2\ne 4 1\nf 0 1 2\nf 0 3 1\nf 3 2 1\n";

TEST(load_balls, reads_a_medial_axis_with_edges_that_bound_nothing) {
  Warnings warnings;
  const LoadedBalls loaded = parse_balls(fin, warnings);
  EXPECT_EQ(warnings.text, "");
  EXPECT_EQ(loaded.balls.size(), 6u);
  EXPECT_EQ(loaded.axis.vertices, loaded.balls.centers);
  EXPECT_EQ(loaded.axis.radii, loaded.balls.radii);
  EXPECT_EQ(loaded.axis.edges, (Edges{{4, 1}}));
  EXPECT_EQ(loaded.axis.polygon_vertices, (Indices{0, 1, 2, 0, 3, 1, 3, 2, 1}));
  EXPECT_EQ(loaded.axis.polygon_kinds, (Array<std::uint8_t>{0, 0, 0}));
  EXPECT_EQ(broken_invariant(loaded.axis), "");
  const AxisTopology topology = axis_topology(loaded.axis);
  EXPECT_EQ(topology.components, 2);
  EXPECT_EQ(topology.euler_characteristic, 6 - 7 + 3);
}

TEST(load_balls, leaves_out_what_matfp_marks_as_deleted) {
  Warnings warnings;
  const LoadedBalls loaded = parse_balls(
      "5 5 2\nv 0 0 0 1 2 0\nv 7 7 7 1 0 1\nv 1 0 0 1 2 0\nv 0 1 0 1 2 0\nv 0 0 1 1 3 0\n"
      "e 0 2 0 0\ne 2 3 1 0\ne 3 0 2 0\ne 0 4 0 0\ne 2 4 0 1\nf 0 2 3 0\nf 2 3 4 1\n",
      warnings);
  EXPECT_EQ(warnings.text, "");
  EXPECT_EQ(loaded.balls.centers, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(loaded.axis.edges, (Edges{{0, 3}}));
  EXPECT_EQ(loaded.axis.polygon_vertices, (Indices{0, 1, 2}));
  EXPECT_EQ(broken_invariant(loaded.axis), "");
  EXPECT_EQ(parse_balls("4 2\n0 0 0 1 3 0 1\n1 1 1 1 3 1 1\n").balls.size(), 1u);
}

TEST(load_balls, drops_repeated_and_degenerate_elements_with_a_warning) {
  Warnings warnings;
  const LoadedBalls loaded = parse_balls(
      "4 3 3\nv 0 0 0 1\nv 1 0 0 1\nv 0 1 0 1\nv 5 5 5 1\ne 3 0\ne 0 3\ne 2 2\nf 0 1 2\nf 2 0 1\nf 1 1 3\n",
      warnings);
  EXPECT_TRUE(names(warnings.text, {"2 edges", "2 triangles"}));
  EXPECT_EQ(loaded.axis.edges, (Edges{{3, 0}}));
  EXPECT_EQ(loaded.axis.polygon_vertices, (Indices{0, 1, 2}));
  EXPECT_EQ(broken_invariant(loaded.axis), "");
}

TEST(load_balls, finds_columns_by_their_names) {
  Warnings warnings;
  const LoadedBalls loaded = parse_balls("x,y,z,r,label\n0,0,0,1,2\n3,4,5,6,1\n", warnings);
  EXPECT_EQ(loaded.balls.radii, (Array<double>{1, 6}));
  const LoadedBalls turned = parse_balls("name;Diameter;Z [mm];Y [mm];X [mm]\n7;12;5;4;3\n");
  EXPECT_EQ(turned.balls.centers, (Array<Vec3>{{3, 4, 5}}));
  EXPECT_EQ(turned.balls.radii, (Array<double>{6}));
  EXPECT_TRUE(names(warnings.text, {"of 5 columns those called x, y, z and r"}));
}

TEST(load_balls, names_element_and_line_of_what_is_wrong) {
  // rows
  EXPECT_TRUE(names(refusal_of("0. 0 0 1\n0 0 0 -2\n"), {"ball 1", "\"-2\"", "line 2"}));
  EXPECT_TRUE(names(refusal_of("0. 0 0 1\n0 0 0\n"), {"ball 1", "r is missing", "line 2"}));
  EXPECT_TRUE(names(refusal_of("0. 0 0 1 5\n"), {"ball 0", "\"5\" follows", "line 1"}));
  EXPECT_TRUE(names(refusal_of("0. nan 0 1\n"), {"ball 0", "y is nan", "line 1"}));
  EXPECT_TRUE(names(refusal_of("0. 0 0 inf\n"), {"ball 0", "r is inf", "line 1"}));
  EXPECT_TRUE(names(refusal_of("0. 0 0 1e999\n"), {"ball 0", "not a number", "line 1"}));
  EXPECT_TRUE(
      names(refusal_of("x,y,z,nx,ny,nz\n0,0,0,1,0,0\n"), {"nx", "none is called r or radius", "line 1"}));
  EXPECT_TRUE(names(refusal_of("x,y,z,r\n"), {"no ball"}));
  EXPECT_TRUE(names(refusal_of(""), {"no ball"}));
  EXPECT_TRUE(names(refusal_of("# none\n"), {"no ball"}));
  EXPECT_TRUE(names(refusal_of("//Maya ASCII 2018 scene\n"), {"\"//Maya\"", "line 1", "readable are"}));
  EXPECT_TRUE(names(refusal_of("OFF\n3 1 0\n"), {"\"OFF\"", "readable are"}));
  EXPECT_TRUE(names(refusal_of("0.5 1 2\n"), {"r is missing", "line 1"}));
  EXPECT_TRUE(names(refusal_of("7 9\n1 2 3 4\n"), {"\"7 9\"", "line 1", "1 lines follow", "9 balls"}));
  // sph
  EXPECT_TRUE(names(refusal_of("2\n0 0 0 1\n"), {"promises 2 balls", "ends after at most 1"}));
  EXPECT_TRUE(names(refusal_of("2\n0.125 0.25 0.5 1\n"), {"ends after 1 of 2 balls", "line 3"}));
  EXPECT_TRUE(names(refusal_of("1\n0 0 0 1\n0 0 0 1\n"), {"\"0\" follows", "1 balls", "line 3"}));
  EXPECT_TRUE(names(refusal_of("1\n0 0 0 1 0 2\n"), {"ball 0", "\"2\"", "0 or 1", "line 2"}));
  EXPECT_TRUE(names(refusal_of("1\n0 0 0 1 0 0 0 0\n"), {"ball 0", "one number too many", "line 2"}));
  EXPECT_TRUE(names(refusal_of("9000000000000000000\n0 0 0 1\n"), {"promises 9000000000000000000 balls"}));
  EXPECT_TRUE(names(refusal_of("-1\n0 0 0 1\n"), {"promises -1 balls"}));
  EXPECT_TRUE(names(refusal_of("0\n"), {"no ball"}));
  EXPECT_TRUE(names(refusal_of("4 1\n0 0 0 1 0 1\n"), {"no ball"})) << "the only one is deleted";
  // ma
  EXPECT_TRUE(names(refusal_of("1 0 0\nv 0 0 0 -1\n"), {"vertex 0", "\"-1\"", "line 2"}));
  EXPECT_TRUE(names(refusal_of("1 0 0\nv 0 0 0 1 2.5\n"), {"vertex 0", "\"2.5\"", "line 2"}));
  EXPECT_TRUE(names(refusal_of("2 0 0\nv 0 0 0 1\nv 0 0 0   \n"), {"vertex 1", "r is missing", "line 3"}));
  EXPECT_TRUE(
      names(refusal_of("2 0 0\nv 0 0 0 1\n     \n    "), {"vertex 1", "the file ends", "promises 2"}));
  EXPECT_TRUE(names(refusal_of("2 1 0\nv 0 0 0 1\nv 1 0 0 1\ne 0 2\n"),
                    {"edge 0", "index 2", "2 vertices", "line 4"}));
  EXPECT_TRUE(names(refusal_of("2 1 0\nv 0 0 0 1\nv 1 0 0 1\ne 0 -1\n"), {"edge 0", "index -1", "line 4"}));
  EXPECT_TRUE(
      names(refusal_of("2 1 0\nv 0 0 0 1\nv 1 0 0 1\ne 0    \n"), {"edge 0", "index is missing", "line 4"}));
  EXPECT_TRUE(names(refusal_of("2 1 0\nv 0 0 0 1\nv 1 0 0 1\nf 0 1 1\n"),
                    {"edge 0", "\"f\"", "\"e\" should be", "line 4"}));
  EXPECT_TRUE(names(refusal_of("3 0 1\nv 0 0 0 1\nv 1 0 0 1\nv 2 0 0 1\nf 0 1 2 7\n"),
                    {"face 0", "\"7\"", "0 or 1", "line 5"}));
  EXPECT_TRUE(names(refusal_of("2 1 0\nv 0 0 0 1\nv 1 0 0 1 0 1\ne 0 1\n"),
                    {"edge 0", "vertex 1 is marked as deleted", "line 4"}));
  EXPECT_TRUE(names(refusal_of("1 0 0\nv 0 0 0 1\nv 1 0 0 1\n"), {"\"v\" follows", "line 3"}));
  EXPECT_TRUE(names(refusal_of("1 0 99999999\nv 0 0 0 1\n"), {"promises 99999999 triangles"}));
  EXPECT_TRUE(names(refusal_of("0 0 0\n"), {"no ball"}));
}

TEST(load_balls, reads_decimal_commas_as_decimals_or_not_at_all) {
  const LoadedBalls blanks = parse_balls("1,5 0,25 -3,0 0,5\n2 1,0 0 1\n");
  EXPECT_EQ(blanks.balls.centers, (Array<Vec3>{{1.5, 0.25, -3}, {2, 1, 0}}));
  EXPECT_EQ(blanks.balls.radii, (Array<double>{0.5, 1}));
  EXPECT_EQ(parse_balls("x;y;z;r\n1,5;0;0;0,5\n").balls.centers, (Array<Vec3>{{1.5, 0, 0}}));
  EXPECT_EQ(load_balls({"balls:0,5 0 0 1"}).balls.centers, (Array<Vec3>{{0.5, 0, 0}}));
  EXPECT_TRUE(names(refusal_of("1,5000,0,0000,0,0000,0,5000\n"), {"\"0\" follows the radius", "line 1"}));
}

TEST(load_balls, reads_the_leaves_of_sphere_trees) {
  // Two levels below the root; the second child is a leaf of the first level, the last row is no ball.
  const std::string tree =
      "3 2\n0 0 0 4 1\n-1 0 0 2 1\n2 0 0 1.5 1\n-1.5 0 0 1 1\n-0.5 0 0 1.25 1\n0 0 0 -1 1\n0 0 0 -1 1\n";
  const LoadedBalls loaded = parse_balls(tree);
  EXPECT_EQ(loaded.balls.radii, (Array<double>{1.5, 1, 1.25}));
  EXPECT_EQ(loaded.balls.centers, (Array<Vec3>{{2, 0, 0}, {-1.5, 0, 0}, {-0.5, 0, 0}}));
  EXPECT_TRUE(names(refusal_of(tree.substr(0, tree.size() - 11)), {"\"3 2\"", "6 lines follow", "3 levels"}));
  EXPECT_TRUE(names(refusal_of("3 2\n0 0 0 4 1\n" + std::string("-1 0 0 x 1\n") + tree.substr(29)),
                    {"ball 1", "r is \"x\"", "line 3"}));
  // 4 begins a list of MATTopo, too: the number of lines tells them apart.
  EXPECT_EQ(parse_balls("4 1\n0 0 0 3\n").balls.size(), 1u);
  EXPECT_EQ(parse_balls("4 1\n0 0 0 4 1\n0 0 0 3 1\n0 0 0 2 1\n0 0 0 1 1\n").balls.radii, (Array<double>{1}));
}

TEST(load_balls, halves_diameters) {
  EXPECT_EQ(parse_balls(header_of_ply + "property float diameter\nend_header\n0 0 0 3\n").balls.radii,
            (Array<double>{1.5}));
}

TEST(load_balls, tells_files_of_balls_from_models) {
  EXPECT_TRUE(holds_balls("a.ply", header_of_ply + "property float radius\nend_header\n0 0 0 3\n"));
  EXPECT_TRUE(holds_balls("a", header_of_ply + "property float diameter\nend_header\n0 0 0 3\n"));
  EXPECT_FALSE(holds_balls("a.ply", header_of_ply + "end_header\n0 0 0\n"));
  EXPECT_FALSE(holds_balls("a.ply", header_of_ply + "property float radius\nelement face 1\n"
                                                    "property list uchar int vertex_indices\nend_header\n"));
  EXPECT_FALSE(holds_balls("a.ply", "ply\nbroken\n"));
  EXPECT_TRUE(holds_balls("a.csv", "x,y,z,r\n0,0,0,1\n"));
  EXPECT_FALSE(holds_balls("a.csv", "x,y,z,nx\n0,0,0,1\n"));
  EXPECT_FALSE(holds_balls("a.csv", "x,y,z,r,g,b\n0,0,0,255,0,0\n")) << "a colour";
  EXPECT_TRUE(names(refusal_of("x,y,z,r,g,b\n0,0,0,255,0,0\n"), {"none is called r or radius", "line 1"}));
  EXPECT_TRUE(holds_balls("a.csv", "x,y,z,radius,r,g,b\n0,0,0,1,255,0,0\n"));
  EXPECT_FALSE(holds_balls("a.xyz", "0 0 0 1\n"));
  EXPECT_TRUE(holds_balls("A.MA.gz", "1 0 0\nv 0 0 0 1\n"));
  EXPECT_TRUE(holds_balls("a.sph", "1\n0 0 0 1\n"));
}

TEST(load_balls, names_formats_that_are_not_read) {
  EXPECT_TRUE(names(refusal_of("{\"asset\": {\"version\": \"2.0\"}}"), {"a glTF model", "readable are ma"}));
  EXPECT_TRUE(names(refusal_of("<?xml version=\"1.0\"?>\n<robot name=\"arm\">"), {"URDF or SRDF"}));
}

TEST(load_balls, names_the_ball_of_a_list_in_the_parameter) {
  try {
    load_balls({"balls:0 0 0 1; 0 0 0"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(names(error.what(), {"ball 1", "r is missing"}));
  }
  EXPECT_THROW(load_balls({"balls:"}), InputError);
  EXPECT_THROW(load_balls({"/no/such/file.ma"}), InputError);
}

TEST(load_balls, can_be_cancelled) {
  struct Stop final : Monitor {
    bool cancelled() override { return true; }
  } stop;
  EXPECT_THROW(parse_balls("3\n" + three_rows, stop), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
