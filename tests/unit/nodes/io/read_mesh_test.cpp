#include "io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <array>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <utility>

#include "mesh_files.hpp"
#include "read_mesh_cases.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using namespace mesh_cases;

TEST(read_mesh, the_same_mesh_comes_out_of_every_format) {
  const TriangleMesh m = test::small_mesh();
  ASSERT_TRUE(mesh_topology(m).closed && mesh_topology(m).oriented);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"a.off", test::as_off(m)},
      {"colours.off", test::as_off(m, false, true)},
      {"both.coff", test::as_off(m, true, true)},
      {"a.obj", test::as_obj(m)},
      {"negative.OBJ", test::as_obj(m, false, true)},
      {"ascii.ply", test::as_ply(m, Ply::ascii)},
      {"little.ply", test::as_ply(m, Ply::little)},
      {"big.ply", test::as_ply(m, Ply::big)},
      {"extras.ply", test::as_ply(m, Ply::ascii, true, true)},
      {"extras_little.ply", test::as_ply(m, Ply::little, true, true)},
      {"extras_big.ply", test::as_ply(m, Ply::big, true, true)},
      {"ascii.stl", test::as_ascii_stl(m)},
      {"binary.stl", test::as_binary_stl(m)},
      {"sly.stl", test::as_binary_stl(m, "solid, it says")},
      {"no_extension", test::as_off(m)},
      {"ply", test::as_ply(m, Ply::little)},
      {"obj.txt", test::as_obj(m)},
      {"stl.dat", test::as_ascii_stl(m)},
  };
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    expect_small_mesh_file(read(name, content));
    expect_small_mesh_file(read(name + ".gz", test::gzipped(content)));
    expect_small_mesh_file(read(name, test::gzipped(content)));  // the content tells, not the name
  }
}

TEST(read_mesh, clouds_give_the_same_points_and_no_mesh) {
  const TriangleMesh m = test::small_mesh();
  std::string commas = test::as_xyz(m);
  std::replace(commas.begin() + 20, commas.end(), ' ', ',');
  for (const auto& [name, content] :
       std::vector<std::pair<std::string, std::string>>{{"a.xyz", test::as_xyz(m)},
                                                        {"a.pts", test::as_xyz(m, false, true)},
                                                        {"a.pwn", test::as_xyz(m, true)},
                                                        {"commas.xyz", commas},
                                                        {"text", test::as_xyz(m)}}) {
    SCOPED_TRACE(name);
    const MeshFile file = read(name, content);
    EXPECT_EQ(file.points.points, m.vertices);
    EXPECT_TRUE(file.mesh.vertices.empty());
    EXPECT_TRUE(file.mesh.triangles.empty());
    EXPECT_EQ(file.points.normals.empty(), name != "a.pwn");
  }
}

TEST(read_mesh, normals_come_with_the_vertices_of_formats_that_have_them) {
  const TriangleMesh m = test::small_mesh();
  expect_made_up_normals(read("a.noff", test::as_off(m, true)));
  expect_made_up_normals(read("a.obj", test::as_obj(m, true)));
  expect_made_up_normals(read("a.ply", test::as_ply(m, Ply::ascii, true)));
  expect_made_up_normals(read("b.ply", test::as_ply(m, Ply::big, true)));
  expect_made_up_normals(read("a.xyz", test::as_xyz(m, true)));
  EXPECT_TRUE(read("a.off", test::as_off(m)).points.normals.empty());
}

TEST(read_mesh, line_ends_of_other_systems_change_nothing) {
  const TriangleMesh m = test::small_mesh();
  for (const std::string& unix_text :
       {test::as_off(m), test::as_obj(m), test::as_ply(m, Ply::ascii), test::as_ascii_stl(m)}) {
    std::string windows;
    for (const char c : unix_text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::string mac = unix_text;
    std::replace(mac.begin(), mac.end(), '\n', '\r');
    expect_small_mesh_file(read("windows", windows));
    expect_small_mesh_file(read("mac", mac));
  }
}

TEST(read_mesh, the_decimal_point_does_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"}) std::setlocale(LC_ALL, locale);
  expect_small_mesh_file(read("a.off", test::as_off(test::small_mesh())));
  std::setlocale(LC_ALL, before.c_str());
}

TEST(read_mesh, off_headers_may_be_on_one_line_or_without_edges_or_keyword) {
  const std::string body = "0 0 0\n1 0 0 # comment\n\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2";
  for (const char* header : {"OFF 4 4 6\n", "OFF\n4 4 6\n", "OFF\n# first\n4 4\n", "OFF 4\n4\n", "4 4 6\n"}) {
    const MeshFile file = read("a.off", header + body);
    EXPECT_EQ(file.mesh.triangles.size(), 4u) << header;
    EXPECT_EQ(mesh_topology(file.mesh).genus, 0) << header;
  }
}

TEST(read_mesh, obj_faces_may_come_before_their_vertices) {
  const MeshFile file =
      read("a.obj", "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
  EXPECT_EQ(mesh_topology(file.mesh).genus, 0);
}

TEST(read_mesh, triangle_strips_turn_every_other_triangle) {
  const MeshFile file =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
           "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
           "0 0 0\n1 0 0\n0 1 0\n0 0 1\n7 0 2 1 3 0 2 -1\n");
  const MeshTopology t = mesh_topology(file.mesh);
  EXPECT_TRUE(t.closed && t.manifold && t.oriented);
}

TEST(read_mesh, equal_vertices_are_welded_to_the_first_and_counted) {
  Listener listener;
  // -0 equals 0.
  const MeshFile file = read("a.xyz", "0 0 0\n1 0 0\n-0.0 0 0\n0 1 0\n1.0 0 0e9\n0 0 1\n", listener);
  EXPECT_EQ(file.points.points, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}));
  EXPECT_EQ(file.welded_vertices, 2);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_EQ(listener.warnings[0].substr(0, 2), "2 ");
}

TEST(read_mesh, equal_corners_of_stl_are_welded_without_a_word) {
  std::string text = "solid\n";
  const std::array<const char*, 4> corners{"0 0 0", "1 0 0", "0 1 0", "0 0 1"};
  for (const auto& face : {std::array{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face)
      text += std::string("vertex ") + corners[static_cast<std::size_t>(corner)] + "\n";
    text += "endloop\nendfacet\n";
  }
  Listener listener;
  const MeshFile file = read("a.stl", text + "endsolid\n", listener);
  EXPECT_EQ(file.welded_vertices, 8);
  EXPECT_EQ(file.points.points.size(), 4u);
  EXPECT_TRUE(listener.warnings.empty());
}

TEST(read_mesh, degenerate_and_repeated_faces_and_unused_vertices_are_dropped_and_counted) {
  Listener listener;
  const MeshFile file = read("a.off",
                             "OFF 7 8 0\n9 9 9\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n8 8 8\n1 0 0\n"
                             "3 1 3 2\n3 1 2 4\n3 2 3 4\n3 1 4 3\n3 2 6 3\n3 3 1 2\n2 1 2\n3 3 4 6\n",
                             listener);
  EXPECT_EQ(file.points.points.size(), 4u);
  EXPECT_EQ(file.welded_vertices, 1);
  EXPECT_EQ(file.unused_vertices, 2);
  EXPECT_EQ(file.degenerate_faces, 2);
  EXPECT_EQ(file.repeated_faces, 2);
  EXPECT_EQ(listener.warnings.size(), 4u);
  EXPECT_EQ(listener.warnings[3], "2 vertices belong to no face and are not samples");
  EXPECT_TRUE(mesh_topology(file.mesh).closed);
}

TEST(read_mesh, normals_are_left_out_when_one_of_them_has_no_direction) {
  Listener listener;
  const MeshFile file =
      read("a.noff", "NOFF 4 0 0\n0 0 0 1 0 0\n1 0 0 0 0 0\n0 1 0 0 0 5\n0 0 1 1 1 1\n", listener);
  EXPECT_TRUE(file.points.normals.empty());
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_EQ(listener.warnings[0].substr(0, 8), "vertex 1");
}

TEST(read_mesh, normals_are_scaled_to_length_one) {
  const MeshFile file =
      read("a.noff", "NOFF 4 0 0\n0 0 0 1e300 0 0\n1 0 0 0 -1e-300 0\n0 1 0 0 0 5\n0 0 1 3 4 0\n");
  const std::vector<Vec3> expected = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0.6, 0.8, 0}};
  ASSERT_EQ(file.points.normals.size(), 4u);
  for (std::size_t v = 0; v < 4; ++v) EXPECT_LT(distance(file.points.normals[v], expected[v]), 1e-15) << v;
}

TEST(read_mesh, colours_beside_points_are_no_normals) {
  Listener listener;
  const MeshFile file = read("a.xyz", "0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 1 0 0\n0 0 1 0 0 1\n", listener);
  EXPECT_TRUE(file.points.normals.empty());
  EXPECT_EQ(listener.warnings.size(), 1u);
}

TEST(read_mesh, numbers_too_small_for_a_double_are_zero_and_too_large_ones_are_refused) {
  const MeshFile file = read("a.xyz", "1e-999 0 0\n+1 0 0\n0 1 0\n0 0 1\n");
  EXPECT_EQ(file.points.points[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(error_of("a.xyz", "1e999 0 0\n1 0 0\n0 1 0\n0 0 1\n"),
            "point 0: x is \"1e999\", not a number (line 1)");
}

TEST(read_mesh, gzip_members_are_joined) {
  const std::string content = test::as_off(test::small_mesh());
  expect_small_mesh_file(
      read("a.off.gz", test::gzipped(content.substr(0, 100)) + test::gzipped(content.substr(100))));
}

TEST(read_mesh, stops_when_cancelled) {
  class Canceller final : public Monitor {
    bool cancelled() override { return true; }
  } canceller;
  EXPECT_THROW(read("a.off", test::as_off(test::small_mesh()), canceller), Cancelled);
}

struct Figures {
  const char* file;
  std::size_t points;
  std::size_t faces;
  bool closed, manifold, oriented;
  std::int64_t genus, components, boundary_loops, boundary_edges, nonmanifold_edges, welded, unused,
      degenerate, repeated;
};

// From an independent program. Points are without the vertices that no face uses.
constexpr Figures figures[] = {
    {"models/fandisk.off.gz", 6475, 12946, true, true, true, 0, 1, 0, 0, 0, 0, 0, 0, 0},
    {"models/abc_00000801.obj.gz", 16877, 33786, true, true, true, 9, 1, 0, 0, 0, 0, 0, 0, 0},
    {"models/occt_TR12J.stl.gz", 13441, 26966, true, true, true, 22, 1, 0, 0, 0, 67457, 0, 0, 0},
    {"models/lumbar_L2_L5_mean.ply.gz", 65478, 130956, true, true, true, 4, 4, 0, 0, 0, 0, 0, 0, 0},
    {"models/knot2.off.gz", 5760, 11520, true, true, true, 2, 2, 0, 0, 0, 0, 0, 0, 0},
    {"models/cheese.off.gz", 8629, 17786, true, true, true, 133, 1, 0, 0, 0, 0, 0, 0, 0},
    {"models/stanford_bunny.obj.gz", 34834, 69451, false, true, true, 0, 1, 5, 223, 0, 0, 1113, 0, 0},
    {"models/happy_buddha_50k.obj.gz", 49948, 99958, false, false, false, -1, 1, 0, 0, 11, 0, 2, 0, 6},
    {"models/stanford_dragon_res4.ply.gz", 5144, 10327, false, false, false, -1, 3, 2, 11, 34, 0, 61, 0, 215},
    {"models/stanford_dragon_res1.ply.gz", 435545, 871306, true, true, true, 55, 1, 0, 0, 0, 2100, 0, 108, 0},
    {"models/broken_cow.obj.gz", 2903, 5804, true, false, true, -1, 1, 0, 0, 0, 0, 0, 0, 0},
    {"models/broken_octagonal_pocket.stl.gz", 1658, 3262, false, false, true, -1, 2, 2, 54, 0, 8128, 0, 0, 0},
    {"models/broken_not_convex.obj.gz", 44, 96, false, false, false, -1, 1, 0, 0, 12, 244, 0, 0, 0},
    {"models/broken_soup.stl.gz", 300, 100, false, true, true, 0, 100, 100, 300, 0, 0, 0, 0, 0},
    {"models/broken_soup_flipped_dup.off.gz", 315, 634, true, true, false, -1, 1, 0, 0, 0, 1588, 2, 0, 22},
    {"models/hand_points.pwn.gz", 52398, 0, false, false, false, -1, 0, 0, 0, 0, 0, 0, 0, 0},
    {"models/bunny_range_scan_000.ply.gz", 40256, 0, false, false, false, -1, 0, 0, 0, 0, 0, 0, 0, 0},
    {"models/powercrust_knot_points.pts.gz", 1281, 0, false, false, false, -1, 0, 0, 0, 0, 0, 0, 0, 0},
};

class RealModel : public testing::TestWithParam<Figures> {};

TEST_P(RealModel, has_the_figures_of_the_manifest) {
  const Figures& expected = GetParam();
  const std::string path = test::data_file(expected.file);
  if (path.empty()) GTEST_SKIP() << "no test data";
  const MeshFile file = read_mesh_file(path);
  EXPECT_EQ(file.points.points.size(), expected.points);
  EXPECT_EQ(file.mesh.triangles.size(), expected.faces);
  EXPECT_EQ(file.welded_vertices, expected.welded);
  EXPECT_EQ(file.unused_vertices, expected.unused);
  EXPECT_EQ(file.degenerate_faces, expected.degenerate);
  EXPECT_EQ(file.repeated_faces, expected.repeated);
  EXPECT_EQ(broken_invariant(file.points), "");
  EXPECT_EQ(broken_invariant(file.mesh), "");
  const MeshTopology t = mesh_topology(file.mesh);
  EXPECT_EQ(t.closed, expected.closed);
  EXPECT_EQ(t.manifold, expected.manifold);
  EXPECT_EQ(t.oriented, expected.oriented);
  EXPECT_EQ(t.genus, expected.genus);
  EXPECT_EQ(t.components, expected.components);
  EXPECT_EQ(t.boundary_loops, expected.boundary_loops);
  EXPECT_EQ(t.boundary_edges, expected.boundary_edges);
  EXPECT_EQ(t.nonmanifold_edges, expected.nonmanifold_edges);
}

INSTANTIATE_TEST_SUITE_P(read_mesh, RealModel, testing::ValuesIn(figures), [](const auto& model) {
  std::string name = std::filesystem::path(model.param.file).filename().string();
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '.' || c == '-'; }, '_');
  return name;
});

}  // namespace
}  // namespace ballflow::geometry
