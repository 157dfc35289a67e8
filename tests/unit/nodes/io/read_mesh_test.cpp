#include "io/read_mesh.hpp"

#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <filesystem>
#include <utility>

#include "mesh_files.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using test::Ply;

/// Keeps warnings.
class Listener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

MeshFile read(const std::string& name, const std::string& content, Monitor& monitor = no_monitor(),
              const ReadOptions& options = {}) {
  const test::TempFolder folder;
  test::write_file(folder.file(name), content);
  return read_mesh_file(folder.file(name), options, monitor);
}

/// The cause of the error that reading gives; empty when there is none.
std::string error_of(const std::string& name, const std::string& content) {
  try {
    read(name, content);
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find('\n'), std::string::npos) << "no hint: " << text;
    return text.substr(0, text.find('\n'));
  }
  return {};
}

void expect_small_mesh(const MeshFile& file) {
  const TriangleMesh expected = test::small_mesh();
  EXPECT_EQ(file.points.points, expected.vertices);
  EXPECT_EQ(file.mesh.vertices, expected.vertices);
  EXPECT_EQ(file.mesh.triangles, expected.triangles);
}

void expect_normals(const MeshFile& file) {
  ASSERT_EQ(file.points.normals.size(), file.points.points.size());
  for (std::size_t v = 0; v < file.points.normals.size(); ++v) {
    EXPECT_LT(distance(file.points.normals[v], test::made_up_normal(v)), 1e-15) << v;
  }
}

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
    expect_small_mesh(read(name, content));
    expect_small_mesh(read(name + ".gz", test::gzipped(content)));
    expect_small_mesh(read(name, test::gzipped(content)));  // the content tells, not the name
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
  expect_normals(read("a.noff", test::as_off(m, true)));
  expect_normals(read("a.obj", test::as_obj(m, true)));
  expect_normals(read("a.ply", test::as_ply(m, Ply::ascii, true)));
  expect_normals(read("b.ply", test::as_ply(m, Ply::big, true)));
  expect_normals(read("a.xyz", test::as_xyz(m, true)));
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
    expect_small_mesh(read("windows", windows));
    expect_small_mesh(read("mac", mac));
  }
}

TEST(read_mesh, the_decimal_point_does_not_depend_on_the_locale) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE"}) std::setlocale(LC_ALL, locale);
  expect_small_mesh(read("a.off", test::as_off(test::small_mesh())));
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

TEST(read_mesh, polygons_become_fans) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\n";
  const MeshFile file =
      read("a.obj", vertices + "f 4 3 2 1\nf 1 2 5\nf 2/7 3/8 5/9\nf 3 4 \\\n 5\nf 4 1 5\nl 1 2\n");
  EXPECT_EQ(file.mesh.triangles,
            (Array<Triangle>{{3, 2, 1}, {3, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}}));
  EXPECT_TRUE(mesh_topology(file.mesh).closed);
}

/// Six times the volume, by the exact formula where coordinates are small whole numbers.
double six_volumes(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += dot(corner(0), cross(corner(1), corner(2)));
  }
  return sum;
}

/// A prism of height 1 over an L of area 7; the caps begin at a corner that does not see all of it.
struct Prism {
  std::vector<Vec3> vertices;
  std::vector<std::vector<int>> faces = {{7, 8, 9, 10, 11, 6}, {1, 0, 5, 4, 3, 2}, {0, 1, 7, 6},
                                         {1, 2, 8, 7},         {2, 3, 9, 8},       {3, 4, 10, 9},
                                         {4, 5, 11, 10},       {5, 0, 6, 11}};
  Prism() {
    for (const double z : {0.0, 1.0}) {
      for (const Vec3 p : {Vec3{0, 0, z}, {4, 0, z}, {4, 1, z}, {1, 1, z}, {1, 4, z}, {0, 4, z}})
        vertices.push_back(p);
    }
  }
  std::string as_obj() const {
    std::string content;
    for (const auto& face : faces) {
      content += "f";
      for (const int v : face) content += " " + std::to_string(v + 1);
      content += "\n";
    }
    for (const Vec3& p : vertices) content += "v " + test::text(p) + "\n";
    return content;
  }
  std::string as_off() const {
    std::string content =
        "OFF\n" + std::to_string(vertices.size()) + " " + std::to_string(faces.size()) + " 0\n";
    for (const Vec3& p : vertices) content += test::text(p) + "\n";
    return content + lists();
  }
  /// The faces before the vertices.
  std::string as_ply() const {
    std::string content = "ply\nformat ascii 1.0\nelement face " + std::to_string(faces.size()) +
                          "\nproperty list uchar int vertex_indices\nelement vertex " +
                          std::to_string(vertices.size()) +
                          "\nproperty double x\nproperty double y\nproperty double z\nend_header\n" + lists();
    for (const Vec3& p : vertices) content += test::text(p) + "\n";
    return content;
  }

 private:
  std::string lists() const {
    std::string content;
    for (const auto& face : faces) {
      content += std::to_string(face.size());
      for (const int v : face) content += " " + std::to_string(v);
      content += "\n";
    }
    return content;
  }
};

TEST(read_mesh, concave_polygons_are_triangulated_inside_themselves_in_every_format) {
  const Prism prism;
  for (const auto& [name, content] : {std::pair<std::string, std::string>{"a.obj", prism.as_obj()},
                                      {"a.off", prism.as_off()},
                                      {"a.ply", prism.as_ply()}}) {
    SCOPED_TRACE(name);
    Listener listener;
    const MeshFile file = read(name, content, listener);
    const MeshTopology t = mesh_topology(file.mesh);
    EXPECT_TRUE(t.closed && t.manifold && t.oriented);
    EXPECT_EQ(t.genus, 0);
    EXPECT_EQ(six_volumes(file.mesh), 6 * 7);
    EXPECT_EQ(file.mesh.triangles.size(), 2u * 4 + 6 * 2);
    EXPECT_EQ(file.concave_faces, 2);
    EXPECT_EQ(listener.warnings,
              std::vector<std::string>{"2 concave polygons are triangulated inside themselves"});
    // Nothing of a cap is outside the L: the areas of its triangles are that of the L.
    double area = 0;
    for (const Triangle& triangle : file.mesh.triangles) {
      const auto corner = [&](std::size_t k) {
        return file.mesh.vertices[static_cast<std::size_t>(triangle[k])];
      };
      area += std::abs(cross(corner(1) - corner(0), corner(2) - corner(0)).z) / 2;
    }
    EXPECT_EQ(area, 2 * 7);
  }
}

TEST(read_mesh, polygons_that_cross_themselves_are_counted) {
  Listener listener;
  const MeshFile file =
      read("a.off", "OFF 5 4 0\n0 0 0\n2 2 0\n2 0 0\n0 2 0\n1 1 1\n4 0 1 2 3\n3 0 1 4\n3 1 2 4\n3 2 3 4\n",
           listener);
  EXPECT_EQ(file.crossing_faces, 1);
  EXPECT_EQ(file.concave_faces, 0);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_EQ(listener.warnings[0].substr(0, 26), "1 polygon crosses itself o");
}

TEST(read_mesh, repeated_corners_of_polygons_are_passed_over) {
  // A square pyramid whose base names a vertex twice, and another one that is welded to its neighbour.
  const MeshFile file = read("a.obj",
                             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nv 0 1 0\n"
                             "f 6 4 3 3 2 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  EXPECT_EQ(file.degenerate_faces, 2);
  EXPECT_TRUE(mesh_topology(file.mesh).closed);
  EXPECT_EQ(six_volumes(file.mesh), 2);
}

/// Two cubes beside each other, of triangles, and their common wall `sheets` times.
std::string two_rooms(int sheets, bool turned, bool quads) {
  std::string content;
  for (int x = 0; x < 3; ++x) {
    for (int k = 0; k < 4; ++k)
      content += "v " + std::to_string(x) + " " + std::to_string(k % 2) + " " + std::to_string(k / 2) + "\n";
  }
  const auto face = [&](int a, int b, int c, int d) {
    const auto id = [](int v) { return " " + std::to_string(v + 1); };
    if (quads) {
      content += "f" + id(a) + id(b) + id(c) + id(d) + "\n";
    } else {
      content += "f" + id(a) + id(b) + id(c) + "\nf" + id(a) + id(c) + id(d) + "\n";
    }
  };
  for (const int x : {0, 4}) {
    face(x + 0, x + 4, x + 5, x + 1);
    face(x + 2, x + 3, x + 7, x + 6);
    face(x + 0, x + 2, x + 6, x + 4);
    face(x + 1, x + 5, x + 7, x + 3);
  }
  face(0, 1, 3, 2);
  face(8, 10, 11, 9);
  for (int k = 0; k < sheets; ++k) {
    if (quads && k % 2 == 1) {  // the same face, listed from another corner on
      turned ? face(6, 7, 5, 4) : face(5, 7, 6, 4);
    } else {
      turned&& k % 2 == 1 ? face(4, 6, 7, 5) : face(4, 5, 7, 6);
    }
  }
  return content;
}

TEST(read_mesh, coincident_walls_in_a_solid_cancel) {
  for (const bool quads : {false, true}) {
    for (const bool turned : {false, true}) {
      SCOPED_TRACE(testing::Message() << (quads ? "quads" : "triangles") << (turned ? " turned" : ""));
      Listener listener;
      const MeshFile file = read("a.obj", two_rooms(2, turned, quads), listener);
      EXPECT_EQ(file.cancelled_faces, 4);
      EXPECT_EQ(file.repeated_faces, 0);
      const MeshTopology t = mesh_topology(file.mesh);
      EXPECT_TRUE(t.closed && t.manifold);
      EXPECT_EQ(file.mesh.triangles.size(), 20u);
      ASSERT_EQ(listener.warnings.size(), 1u);
      EXPECT_EQ(listener.warnings[0].substr(0, 30), "4 faces coincide with others a");
    }
  }
  // One sheet is what the file says, and of three one stays.
  EXPECT_EQ(read("a.obj", two_rooms(1, false, false)).mesh.triangles.size(), 22u);
  EXPECT_EQ(read("a.obj", two_rooms(3, true, false)).mesh.triangles.size(), 22u);
  EXPECT_EQ(read("a.obj", two_rooms(3, true, false)).repeated_faces, 4);
}

TEST(read_mesh, coincident_faces_that_close_a_hole_leave_one) {
  // A tetrahedron: each face is there again, turned over, then three of them, then all.
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  const std::vector<std::string> faces = {"f 1 3 2\n", "f 1 2 4\n", "f 2 3 4\n", "f 1 4 3\n"},
                                 turned = {"f 1 2 3\n", "f 4 2 1\n", "f 4 3 2\n", "f 3 4 1\n"};
  for (unsigned which = 0; which < 16; ++which) {
    std::string content = vertices + faces[0] + faces[1] + faces[2] + faces[3];
    for (std::size_t k = 0; k < 4; ++k) content += (which >> k & 1) != 0 ? turned[k] : "";
    const MeshFile file = read("a.obj", content);
    EXPECT_TRUE(mesh_topology(file.mesh).closed) << which;
    EXPECT_EQ(file.cancelled_faces, 0) << which;
    EXPECT_EQ(file.mesh.triangles.size(), 4u) << which;
  }
}

TEST(read_mesh, a_sheet_of_two_sides_stays_and_a_flap_on_a_solid_goes) {
  // A bent sheet of two triangles, each twice.
  const MeshFile sheet =
      read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 3 2 4\nf 1 3 2\nf 3 4 2\n");
  EXPECT_EQ(sheet.mesh.triangles, (Array<Triangle>{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(sheet.repeated_faces, 2);
  // A corner of an open mesh, twice.
  const MeshFile corner = read("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 3 2 4\nf 3 4 2\n");
  EXPECT_EQ(corner.mesh.triangles.size(), 2u);
  // A flap on an edge of a tetrahedron.
  const MeshFile flap = read("a.obj",
                             "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 2 2 -1\nf 1 3 2\nf 1 2 4\nf 2 3 4\n"
                             "f 1 4 3\nf 2 3 5\nf 3 2 5\n");
  EXPECT_EQ(flap.cancelled_faces, 2);
  EXPECT_EQ(flap.unused_vertices, 1);
  EXPECT_TRUE(mesh_topology(flap.mesh).closed);
}

TEST(read_mesh, reported_polygons_and_walls_give_the_solids_they_mean) {
  const auto model = [](const char* name) {
    const std::string path = test::data_file(std::string("reports/") + name);
    return path.empty() ? MeshFile() : read_mesh_file(path);
  };
  const MeshFile ngon = model("polygons/e_ngon.obj.gz"), triangles = model("polygons/triangles.obj.gz"),
                 ell = model("polygons/concave.obj"), walls = model("inside/wall_same.off.gz"),
                 bare = model("inside/nowall.off.gz");
  if (ngon.mesh.triangles.empty()) GTEST_SKIP() << "no test data";
  for (const MeshFile* file : {&ngon, &triangles, &ell, &walls, &bare}) {
    EXPECT_TRUE(mesh_topology(file->mesh).closed);
    EXPECT_TRUE(mesh_topology(file->mesh).oriented);
  }
  EXPECT_EQ(six_volumes(triangles.mesh), 6 * 7);
  EXPECT_EQ(six_volumes(ell.mesh), 6 * 7);
  EXPECT_EQ(six_volumes(ngon.mesh), 6 * 16) << "an E";
  EXPECT_EQ(ell.concave_faces, 2);
  EXPECT_EQ(ngon.concave_faces, 2);
  EXPECT_GT(walls.cancelled_faces, 0);
  EXPECT_EQ(walls.mesh.triangles.size(), bare.mesh.triangles.size());
  EXPECT_DOUBLE_EQ(six_volumes(walls.mesh), six_volumes(bare.mesh));
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

TEST(read_mesh_error, names_the_vertex_and_the_coordinate) {
  EXPECT_EQ(error_of("a.off", "OFF\n4 0 0\n0 0 0\n1 nan 0\n0 1 0\n0 0 1\n"), "vertex 1: y is nan (line 4)");
  EXPECT_EQ(error_of("a.off", "OFF\n4 0 0\n0 0 0\n1 0 -inf\n0 1 0\n0 0 1\n"), "vertex 1: z is -inf (line 4)");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 0 x 0\n"), "vertex 1: y is \"x\", not a number (line 2)");
  EXPECT_EQ(error_of("a.obj", "v 0 0 0\nv 0 0\n"), "vertex 1: z is missing (line 2)");
  EXPECT_EQ(error_of("a.xyz", "0 0 0\n0 1,5 0\n0 y 0"), "point 2: y is \"y\", not a number (line 3)");
  EXPECT_EQ(error_of("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 nan 0\n"),
            "facet 0: y is nan (line 5)");
  TriangleMesh m = test::small_mesh();
  std::vector<Vec3> vertices(m.vertices.begin(), m.vertices.end());
  vertices[17].y = std::numeric_limits<double>::quiet_NaN();
  m.vertices = vertices;
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::ascii)), "vertex 17: y is nan (line 28)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::big)), "vertex 17: y is nan");
  EXPECT_NE(error_of("a.stl", test::as_binary_stl(m)).find(": y is nan"), std::string::npos);
}

TEST(read_mesh_error, names_the_face_with_a_vertex_index_out_of_range) {
  TriangleMesh m = test::small_mesh();
  std::vector<Triangle> triangles(m.triangles.begin(), m.triangles.end());
  triangles[5][1] = 99;
  m.triangles = triangles;
  EXPECT_EQ(error_of("a.off", test::as_off(m)),
            "face 5: vertex index 99 is out of range (20 vertices) (line 30)");
  EXPECT_EQ(error_of("a.obj", test::as_obj(m)),
            "face 5: vertex index 100 is out of range (20 vertices) (line 29)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::ascii)),
            "face 5: vertex index 99 is out of range (20 vertices) (line 36)");
  EXPECT_EQ(error_of("a.ply", test::as_ply(m, Ply::little)),
            "face 5: vertex index 99 is out of range (20 vertices)");
  EXPECT_NE(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n").find("face 0: vertex index 0 "),
            std::string::npos);
  EXPECT_NE(error_of("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n").find("face 0: vertex index -4 "),
            std::string::npos);
}

TEST(read_mesh_error, comes_for_every_truncation_of_a_file_with_a_size) {
  const TriangleMesh m = test::small_mesh();
  struct Case {
    std::string whole;
    MeshFormat format;
    std::size_t tail;  // a text without its last characters may be whole, or end in a shorter number
  };
  // XYZ and OBJ files may end anywhere.
  for (const Case& c :
       {Case{test::as_ply(m, Ply::little), MeshFormat::ply, 0},
        Case{test::as_ply(m, Ply::big), MeshFormat::ply, 0}, Case{test::as_binary_stl(m), MeshFormat::stl, 0},
        Case{test::as_off(m), MeshFormat::off, 3}, Case{test::as_ply(m, Ply::ascii), MeshFormat::ply, 4},
        Case{test::as_ascii_stl(m), MeshFormat::stl, 16}}) {
    for (std::size_t size = 0; size + c.tail < c.whole.size(); ++size) {
      EXPECT_THROW(parse_mesh(c.whole.substr(0, size), c.format), InputError)
          << size << " of " << c.whole.size();
    }
  }
  const std::string packed = test::gzipped(test::as_off(m));
  for (std::size_t size = 1; size < packed.size(); size += 17) {
    EXPECT_THROW(read("a.off.gz", packed.substr(0, size)), InputError) << size << " of " << packed.size();
  }
}

TEST(read_mesh_error, comes_before_memory_for_what_a_header_claims) {
  EXPECT_NE(error_of("a.off", "OFF 1000000000000 4 0\n0 0 0\n").find("promises 1000000000000 vertices"),
            std::string::npos);
  EXPECT_NE(error_of("a.off", "OFF 1 1000000000000 0\n0 0 0\n").find("promises 1000000000000 faces"),
            std::string::npos);
  EXPECT_NE(error_of("a.off", "OFF 3 1 0\n0 0 0\n0 0 1\n0 1 0\n1000000000000 0 1 2\n"), "");
  EXPECT_NE(error_of("a.pts", "1000000000000\n0 0 0\n").find("promises 1000000000000 points"),
            std::string::npos);
  for (const char* format : {"ascii", "binary_little_endian"}) {
    const std::string header = std::string("ply\nformat ") + format + " 1.0\nelement vertex ";
    const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_NE(error_of("a.ply", header + "1000000000000" + xyz + "end_header\n0 0 0\n")
                  .find("promises 1000000000000"),
              std::string::npos);
    EXPECT_NE(
        error_of("a.ply", header + "9223372036854775807" + xyz + "end_header\n0 0 0\n").find("promises"),
        std::string::npos);
    EXPECT_NE(error_of("a.ply", header + "1000000000000\nend_header\n"), "");  // no property: nothing to read
    EXPECT_NE(error_of("a.ply", header + "0" + xyz +
                                    "element face 1\nproperty list int int "
                                    "vertex_indices\nend_header\n\x7f\xff\xff\x7f 2000000000"),
              "");
  }
}

TEST(read_mesh_error, says_what_is_wrong_with_the_file_itself) {
  const test::TempFolder folder;
  const auto error = [](const std::string& path, const ReadOptions& options = {}) -> std::string {
    try {
      read_mesh_file(path, options);
    } catch (const InputError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(error(folder.file("none.off")).find("does not exist"), std::string::npos);
  EXPECT_NE(error(folder.path()).find("is a folder"), std::string::npos);
  EXPECT_NE(error("/dev/null").find("is not a regular file"), std::string::npos);
  test::write_file(folder.file("empty.off"), "");
  EXPECT_NE(error(folder.file("empty.off")).find("is empty"), std::string::npos);
  test::write_file(folder.file("empty.off.gz"), test::gzipped(""));
  EXPECT_NE(error(folder.file("empty.off.gz")).find("is empty"), std::string::npos);
  test::write_file(folder.file("a.step"), "x");
  EXPECT_NE(
      error(folder.file("a.step")).find("unknown extension \".step\"\nreadable are .off .obj .ply .stl"),
      std::string::npos);

  const std::string packed = test::gzipped(test::as_off(test::small_mesh()));
  std::string damaged = packed;
  damaged[packed.size() - 6] ^= 1;  // the checksum
  test::write_file(folder.file("crc.off.gz"), damaged);
  EXPECT_NE(error(folder.file("crc.off.gz")).find("is damaged"), std::string::npos);
  test::write_file(folder.file("more.off.gz"), packed + "more");
  EXPECT_NE(error(folder.file("more.off.gz")).find("is damaged"), std::string::npos);
  test::write_file(folder.file("padded.off.gz"), packed + std::string(512, '\0'));
  EXPECT_EQ(error(folder.file("padded.off.gz")), "");
}

TEST(read_mesh_error, comes_for_a_gzip_bomb) {
  const std::string bomb = test::gzipped(std::string(std::size_t{50} << 20, '\n'));
  ReadOptions options;
  options.max_unpacked_bytes = 10 << 20;
  try {
    read("bomb.xyz.gz", bomb, no_monitor(), options);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("unpacks to more than 10485760 bytes"), std::string::npos);
  }
}

TEST(read_mesh, gzip_members_are_joined) {
  const std::string content = test::as_off(test::small_mesh());
  expect_small_mesh(
      read("a.off.gz", test::gzipped(content.substr(0, 100)) + test::gzipped(content.substr(100))));
}

TEST(read_mesh_error, comes_for_points_that_do_not_fill_space) {
  EXPECT_NE(error_of("a.xyz", "0 0 0\n1 0 0\n0 1 0\n").find("only 3 distinct points"), std::string::npos);
  EXPECT_NE(error_of("a.xyz", "1 1 1\n1 1 1\n1 1 1\n1 1 1\n1 1 1\n").find("only 1 point"), std::string::npos);
  EXPECT_NE(error_of("a.xyz", "0 0 0\n1 2 3\n2 4 6\n3 6 9\n-1 -2 -3\n").find("on one line"),
            std::string::npos);
  // In a plane no coordinate of which is constant.
  EXPECT_NE(error_of("a.xyz", "1 0 0\n0 1 0\n0 0 1\n2 -1 0\n0.5 0.25 0.25\n-3 3 1\n").find("in one plane"),
            std::string::npos);
  // One unit in the last place off the plane.
  EXPECT_EQ(error_of("a.xyz", "1 0 0\n0 1 0\n0 0 1\n2 -1 0\n0.5 0.25 0.25000000000000006\n"), "");
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

TEST(read_mesh_error, refuses_the_damaged_models_by_element) {
  const std::vector<std::pair<std::string, std::string>> expected = {
      {"models/broken_truncated.ply.gz",
       "the header promises 12 vertex elements, but the file ends after at most 6"},
      {"models/broken_bad_index.off.gz", "face 0: vertex index 100 is out of range (12 vertices) (line 15)"},
      {"models/broken_nan.off.gz", "vertex 10: x is nan (line 13)"}};
  for (const auto& [name, cause] : expected) {
    const std::string path = test::data_file(name);
    if (path.empty()) GTEST_SKIP() << "no test data";
    try {
      read_mesh_file(path);
      ADD_FAILURE() << name << " was read";
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).substr(0, cause.size()), cause);
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
