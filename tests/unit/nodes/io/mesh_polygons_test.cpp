// Polygons of mesh files, and faces that coincide.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "read_mesh_cases.hpp"

namespace ballflow::geometry {
namespace {

using namespace mesh_cases;

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

}  // namespace
}  // namespace ballflow::geometry
