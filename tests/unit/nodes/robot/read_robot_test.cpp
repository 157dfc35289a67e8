// Robots with their meshes: where those are found, and what becomes of them.
#include "robot/read_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "robot/mesh_files.hpp"
#include "robot/robot_spheres.hpp"
#include "robot/solids.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

class Warnings final : public Monitor {
 public:
  void warn(const std::string& text) override { all.push_back(text); }
  std::vector<std::string> all;
};

const char* const tetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
const char* const quad_obj =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const char* const collada = R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
 <asset><unit name="millimeter" meter="0.001"/><up_axis>Y_UP</up_axis></asset>
 <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array id="pa" count="12">0 0 0 1000 0 0 0 1000 0 0 0 1000</float_array>
   <technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 0 3 2</p></triangles>
 </mesh></geometry></library_geometries>
 <library_visual_scenes><visual_scene id="s"><node id="n"><translate>0 0 500</translate><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
 <scene><instance_visual_scene url="#s"/></scene>
</COLLADA>)";

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])],
               b = mesh.vertices[static_cast<std::size_t>(t[1])],
               c = mesh.vertices[static_cast<std::size_t>(t[2])];
    sum += dot(a, cross(b, c)) / 6;
  }
  return sum;
}

struct ReadRobot : testing::Test {
  std::string urdf(const std::string& collisions) {
    test::write_file(folder.file("robot/r.urdf"),
                     "<robot name=\"r\">\n<link name=\"a\">" + collisions + "</link>\n</robot>");
    return folder.file("robot/r.urdf");
  }
  static std::string mesh(const std::string& file, const std::string& more = "") {
    return "<collision><geometry><mesh filename=\"" + file + "\" " + more + "/></geometry></collision>";
  }
  Robot read(const std::string& collisions, const std::string& packages = "") {
    return read_robot({urdf(collisions), packages, RobotGeometry::collision}, warnings);
  }
  std::string refusal(const std::string& collisions) {
    try {
      read(collisions);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  test::TempFolder folder;
  Warnings warnings;
};

TEST_F(ReadRobot, meshes_of_every_format_are_the_same_solid) {
  test::write_file(folder.file("robot/t.off"), tetrahedron);
  test::write_file(folder.file("robot/t.dae"), collada);
  test::write_file(folder.file("robot/cube.obj"), quad_obj);
  EXPECT_NEAR(volume(mesh_of(read(mesh("t.off")), 0)), 1.0 / 6, 1e-15);
  const TriangleMesh dae = mesh_of(read(mesh("t.dae")), 0);
  EXPECT_NEAR(volume(dae), 1.0 / 6, 1e-6);  // single precision
  double lowest = 1;
  for (const Vec3& v : dae.vertices) lowest = std::min(lowest, v.z);
  EXPECT_NEAR(lowest, 0.5, 1e-6) << "the unit is applied, the nodes of the scene too, the up axis is not";
  EXPECT_NEAR(volume(mesh_of(read(mesh("cube.obj")), 0)), 1, 1e-12);
  EXPECT_TRUE(warnings.all.empty());
}

TEST_F(ReadRobot, scale_and_origin_move_and_mirror) {
  test::write_file(folder.file("robot/t.off"), tetrahedron);
  const Robot robot = read(
      "<collision><origin xyz=\"0 0 5\" rpy=\"3.14159265358979 0 0\"/><geometry><mesh filename=\"t.off\" "
      "scale=\"2 2 "
      "-2\"/></geometry></collision>");
  EXPECT_NEAR(volume(mesh_of(robot, 0)), 8.0 / 6, 1e-12) << "a mirrored solid is turned outwards";
  for (const Vec3& v : robot.vertices) EXPECT_GE(v.z, 5 - 1e-9);
}

TEST_F(ReadRobot, meshes_are_found_by_package_folder_and_name) {
  test::write_file(folder.file("ws/arm_description/meshes/t.off"), tetrahedron);
  test::write_file(folder.file("ws/arm_description/urdf/empty"), "");
  const MeshPlaces inside{folder.file("ws/arm_description/urdf"), {}};
  const std::string there = folder.file("ws/arm_description/meshes/t.off");
  EXPECT_EQ(find_mesh("package://arm_description/meshes/t.off", inside).path, there);
  EXPECT_TRUE(find_mesh("package://arm_description/meshes/t.off", inside).as_named);
  EXPECT_EQ(find_mesh("../meshes/t.off", inside).path,
            folder.file("ws/arm_description/urdf/../meshes/t.off"));
  EXPECT_EQ(find_mesh("file://" + there, {}).path, there);
  EXPECT_EQ(find_mesh(there, {}).path, there);
  EXPECT_EQ(find_mesh("package://arm_description/meshes/t.off", {"elsewhere", {folder.file("ws")}}).path,
            there);
  EXPECT_EQ(
      find_mesh("package://arm_description/meshes/t.off", {"elsewhere", {folder.file("ws/arm_description/")}})
          .path,
      folder.file("ws/arm_description/meshes/t.off"));
  // By its name below the folder, and with another ending.
  const MeshPlaces above{folder.file("ws"), {}};
  EXPECT_EQ(find_mesh("package://other/x/t.off", above).path, there);
  EXPECT_FALSE(find_mesh("package://other/x/t.off", above).as_named);
  EXPECT_EQ(find_mesh("x/t.dae", above).path, there);
  EXPECT_EQ(find_mesh("u.off", above).path, "");
  // Of several the one nearest to the top.
  test::write_file(folder.file("ws/a/t.off"), tetrahedron);
  EXPECT_EQ(find_mesh("package://other/x/t.off", above).path, folder.file("ws/a/t.off"));
}

TEST_F(ReadRobot, a_mesh_elsewhere_is_told_and_one_nowhere_refused) {
  test::write_file(folder.file("robot/deep/t.off"), tetrahedron);
  read(mesh("package://p/t.off"));
  ASSERT_EQ(warnings.all.size(), 1U);
  EXPECT_NE(warnings.all[0].find("r.urdf:2: link \"a\": package://p/t.off is not there"), std::string::npos);
  EXPECT_NE(
      refusal(mesh("package://p/u.off")).find("r.urdf:2: link \"a\": there is no mesh \"package://p/u.off\""),
      std::string::npos);
  EXPECT_EQ(mesh_files_of(
                {urdf(mesh("package://p/u.off") + mesh("package://p/t.off")), "", RobotGeometry::collision}),
            (std::vector<std::pair<std::string, std::string>>{
                {"package://p/t.off", folder.file("robot/deep/t.off")}, {"package://p/u.off", ""}}));
}

TEST_F(ReadRobot, damaged_meshes_are_named_with_their_link) {
  test::write_file(folder.file("robot/e.stl"), "");
  EXPECT_NE(refusal(mesh("e.stl")).find("link \"a\": "), std::string::npos);
  test::write_file(folder.file("robot/n.off"), "OFF\n3 1 0\n0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_NE(refusal(mesh("n.off")).find("vertex 0"), std::string::npos);
  test::write_file(folder.file("robot/p.xyz"), "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  EXPECT_NE(refusal(mesh("p.xyz")).find("no triangles"), std::string::npos);
  test::write_file(folder.file("robot/x.dae"), "<COLLADA>");
  EXPECT_NE(refusal(mesh("x.dae")).find("as a Collada file"), std::string::npos);
  test::write_file(folder.file("robot/far.off"), "OFF\n3 1 0\n0 0 1e200\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_NE(refusal(mesh("far.off", "scale=\"1 1 1e200\"")).find("not finite after scale and origin"),
            std::string::npos);
}

TEST_F(ReadRobot, one_flat_triangle_is_a_surface) {
  test::write_file(folder.file("robot/flat.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_EQ(mesh_of(read(mesh("flat.off")), 0).triangles.size(), 1U);
}

TEST_F(ReadRobot, shapes_without_a_size_are_left_out) {
  const Robot robot = read(
      "<collision><geometry><box size=\"0 1 1\"/></geometry></collision>"
      "<collision><geometry><sphere radius=\"0\"/></geometry></collision>");
  EXPECT_TRUE(mesh_of(robot, 0).triangles.empty());
  EXPECT_EQ(warnings.all.size(), 2U);
  EXPECT_TRUE(links_with_surface(robot).empty());
}

/// The largest ball around the origin in a convex mesh around it.
double inside_radius(const SolidMesh& mesh) {
  double least = 1e300;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 n = cross(mesh.vertices[static_cast<std::size_t>(t[1])] - a,
                         mesh.vertices[static_cast<std::size_t>(t[2])] - a);
    EXPECT_GT(dot(n, a), 0) << "turned outwards";
    least = std::min(least, dot(n, a) / length(n));
  }
  return least;
}

TEST(solids, round_shapes_are_inside_their_meshes_and_not_far) {
  for (const double r : {1e-4, 0.07, 30.0}) {
    const SolidMesh ball = ball_mesh_around(r);
    EXPECT_GE(inside_radius(ball), r);
    for (const Vec3& v : ball.vertices) EXPECT_LE(length(v), r * (1 + roundness));
    const SolidMesh cylinder = cylinder_mesh(r, 3 * r);
    for (const Triangle& t : cylinder.triangles) {
      const Vec3 a = cylinder.vertices[static_cast<std::size_t>(t[0])];
      const Vec3 n = cross(cylinder.vertices[static_cast<std::size_t>(t[1])] - a,
                           cylinder.vertices[static_cast<std::size_t>(t[2])] - a);
      const bool cap = std::abs(n.z) > 0.5 * length(n);
      EXPECT_GE(dot(n, a) / length(n), cap ? 1.5 * r : r);
    }
    for (const Vec3& v : cylinder.vertices) {
      EXPECT_LE(std::hypot(v.x, v.y), r * (1 + roundness));
      EXPECT_LE(std::abs(v.z), 1.5 * r * (1 + 1e-11));
    }
  }
}

TEST(robot, sample_is_a_tree_with_surfaces) {
  const Robot robot = read_robot({"robot:arm", "", RobotGeometry::collision});
  EXPECT_EQ(broken_invariant(robot), "");
  EXPECT_EQ(links_with_surface(robot), (std::vector<std::string>{"base", "upper_arm", "forearm", "hand",
                                                                 "left_finger", "right_finger"}));
  EXPECT_THROW(read_robot({"robot:leg", "", RobotGeometry::collision}), InputError);
  EXPECT_THROW(link_named(robot, "leg"), InputError);
}

TEST(robot, poses_follow_the_joints) {
  const Robot robot = read_robot({"robot:arm", "", RobotGeometry::collision});
  std::vector<double> values(6, 0);
  const auto place = [&](const char* link) {
    return moved(link_poses(robot, values)[link_named(robot, link)], {0, 0, 0});
  };
  EXPECT_NEAR(distance(place("hand"), {0.27, 0.07, 0.48}), 0, 1e-12);
  values[0] = 3.14159265358979323846 / 2;  // turn
  EXPECT_NEAR(distance(place("hand"), {-0.07, 0.27, 0.48}), 0, 1e-12);
  values = {0, -3.14159265358979323846 / 2, 0, 0.02, 7, 0};  // elbow up, fingers open; the right one follows
  EXPECT_NEAR(distance(place("hand"), {0, 0.07, 0.75}), 0, 1e-12);
  EXPECT_NEAR(distance(place("left_finger"), {0, 0.09, 0.81}), 0, 1e-12);
  EXPECT_NEAR(distance(place("right_finger"), {0, 0.05, 0.81}), 0, 1e-12);
}

}  // namespace
}  // namespace ballflow::geometry
