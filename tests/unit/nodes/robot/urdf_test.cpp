// Descriptions of robots: what is read, and what strangers' files are told.
#include "urdf/urdf.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/monitor.hpp"
#include "urdf/sample_robot.hpp"

#ifdef BALLFLOW_HAS_URDFDOM
#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>
#endif

namespace ballflow::geometry {
namespace {

std::string link(const std::string& name, const std::string& inside = "") {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}
std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& rest = "", const std::string& type = "fixed") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + rest + "</joint>\n";
}
std::string robot(const std::string& inside) { return "<robot name=\"r\">\n" + inside + "</robot>\n"; }
std::string shape(const std::string& geometry, const std::string& origin = "") {
  return "<collision>" + origin + "<geometry>" + geometry + "</geometry></collision>";
}

/// Cause and hint; empty when it is read.
std::string refusal(const std::string& text, const std::string& file = "r.urdf") {
  try {
    parse_urdf(text, file);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(urdf, links_joints_and_shapes_are_as_written) {
  const Urdf urdf =
      parse_urdf(robot(link("a", shape("<mesh filename=\"package://p/m.stl\" scale=\"0.001 -0.001 2\"/>") +
                                     shape("<box size=\"1 2 3\"/>",
                                           "<origin xyz=\"1 2 3\" rpy=\"0 0 1.5707963267948966\"/>") +
                                     "<visual><geometry><sphere radius=\"0.5\"/></geometry></visual>") +
                       link("b", shape("<cylinder radius=\".5\" length=\"2e0\"/>")) +
                       joint("j", "a", "b",
                             "<origin xyz=\"0 0 1\"/><axis xyz=\"0 3 4\"/><limit lower=\"-1\" upper=\"2\"/>"
                             "<mimic joint=\"j\" multiplier=\"-2\" offset=\"0.5\"/>",
                             "revolute")),
                 "r.urdf");
  ASSERT_EQ(urdf.links.size(), 2U);
  EXPECT_EQ(urdf.name, "r");
  ASSERT_EQ(urdf.links[0].collisions.size(), 2U);
  EXPECT_EQ(urdf.links[0].collisions[0].file, "package://p/m.stl");
  EXPECT_EQ(urdf.links[0].collisions[0].scale, (Vec3{0.001, -0.001, 2}));
  EXPECT_EQ(urdf.links[0].collisions[0].line, 2);
  const Vec3 corner = moved(urdf.links[0].collisions[1].origin, {1, 0, 0});
  EXPECT_NEAR(distance(corner, {1, 3, 3}), 0, 1e-12);
  EXPECT_EQ(urdf.links[0].visuals.size(), 1U);
  EXPECT_EQ(urdf.links[1].collisions[0].size, (Vec3{0.5, 2, 0}));
  EXPECT_EQ(urdf.joints[0].kind, JointKind::revolute);
  EXPECT_NEAR(distance(urdf.joints[0].axis, {0, 0.6, 0.8}), 0, 1e-15);
  EXPECT_EQ(urdf.joints[0].upper, 2);
  EXPECT_EQ(urdf.joints[0].mimic_factor, -2);
  EXPECT_EQ(links_with_shapes(urdf, true), (std::vector<std::string>{"a"}));
  EXPECT_EQ(links_with_shapes(urdf, false), (std::vector<std::string>{"a", "b"}));
}

TEST(urdf, what_is_no_urdf_is_named) {
  EXPECT_EQ(refusal(""),
            "r.urdf: this is no XML: XML_ERROR_EMPTY_DOCUMENT\na URDF is an XML file with a <robot> in it");
  EXPECT_TRUE(refusal("<robot><link name=\"a\"></robot>")
                  .starts_with("r.urdf:1: this is no XML: XML_ERROR_MISMATCHED"));
  EXPECT_TRUE(refusal("<sdf version=\"1.7\"/>").starts_with("r.urdf:1: this is an SDF file"));
  EXPECT_TRUE(refusal("<mujoco/>").starts_with("r.urdf:1: this is an MJCF file"));
  EXPECT_TRUE(refusal("<COLLADA/>").starts_with("r.urdf:1: the root element is <COLLADA>, not <robot>"));
  EXPECT_TRUE(refusal(robot("")).starts_with("r.urdf:1: the robot has no <link>"));
}

TEST(urdf, xacro_is_refused_with_the_command_that_expands_it) {
  const std::string text = "<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"r\">\n" + link("a") +
                           "<xacro:include filename=\"x\"/></robot>";
  EXPECT_EQ(
      refusal(text, "dir/r.urdf.xacro"),
      "dir/r.urdf.xacro:3: this is a xacro file, which has to be expanded first\nxacro dir/r.urdf.xacro > "
      "dir/r.urdf");
  EXPECT_NE(refusal(robot(link("${prefix}a"))).find("xacro r.urdf > robot.urdf"), std::string::npos);
  EXPECT_NE(refusal(robot(link("$(arg a)"))).find("xacro r.urdf > robot.urdf"), std::string::npos);
  // An expanded file keeps the attribute, and comments with what was there.
  EXPECT_EQ(refusal("<robot xmlns:xacro=\"http://www.ros.org/wiki/xacro\" name=\"r\">" + link("a") +
                    "<!-- <xacro:box size=\"${w} $(arg h)\"/> --></robot>"),
            "");
}

TEST(urdf, links_that_are_no_tree_are_named_with_their_lines) {
  EXPECT_EQ(refusal(robot(link("a") + link("a"))),
            "r.urdf:3: link \"a\" is there twice, first in line 2\nrename or remove one of them");
  EXPECT_TRUE(
      refusal(robot(link("a") + link("b"))).starts_with("r.urdf:3: the robot has 2 roots, \"a\" and \"b\""));
  EXPECT_TRUE(refusal(robot(link("a") + link("b") + joint("j", "a", "b") + joint("k", "b", "a")))
                  .starts_with("r.urdf:4: the joints run in a circle"));
  EXPECT_TRUE(refusal(robot(link("a") + link("b") + link("c") + joint("j", "b", "c") + joint("k", "c", "b")))
                  .starts_with("r.urdf:6: the joints run in a circle through link \"b\""));
  EXPECT_TRUE(refusal(robot(link("a") + link("b") + link("c") + joint("j", "a", "c") + joint("k", "b", "c")))
                  .starts_with("r.urdf:6: link \"c\" is the child of two joints, \"j\" and \"k\""));
  EXPECT_TRUE(refusal(robot(link("a") + joint("j", "a", "b")))
                  .starts_with("r.urdf:3: joint \"j\" joins the link \"b\", which is not there"));
  EXPECT_TRUE(refusal(robot(link("a") + link("b") + joint("j", "a", "b", "<mimic joint=\"x\"/>")))
                  .find("follows the joint \"x\"") != std::string::npos);
  EXPECT_EQ(refusal(robot(link("only"))), "");
}

TEST(urdf, values_that_are_none_are_named_with_their_lines) {
  const auto with = [](const std::string& inside) { return refusal(robot(link("a", inside))); };
  EXPECT_EQ(with(shape("<box size=\"1 nan 1\"/>")),
            "r.urdf:2: link \"a\", collision 1: \"size\" has \"nan\", which is no finite number\nwrite "
            "numbers with a "
            "decimal point");
  EXPECT_NE(with(shape("<box size=\"1 1\"/>")).find("\"size\" needs 3 numbers, has 2"), std::string::npos);
  EXPECT_NE(with(shape("<box size=\"1 -1 1\"/>")).find("negative edge"), std::string::npos);
  EXPECT_NE(with(shape("<sphere radius=\"1e999\"/>")).find("no finite number"), std::string::npos);
  EXPECT_NE(with(shape("<sphere radius=\"-1\"/>")).find("negative"), std::string::npos);
  EXPECT_NE(with(shape("<sphere/>")).find("has no \"radius\""), std::string::npos);
  EXPECT_NE(with(shape("<mesh filename=\"\"/>")).find("has no \"filename\""), std::string::npos);
  EXPECT_NE(with(shape("<mesh filename=\"m.stl\" scale=\"1 0 1\"/>")).find("a scale of 0"),
            std::string::npos);
  EXPECT_NE(with(shape("<torus/>")).find("is a <torus>, which is not read"), std::string::npos);
  EXPECT_NE(with("<collision/>").find("has no geometry"), std::string::npos);
  const auto of_joint = [](const std::string& rest, const std::string& type) {
    return refusal(robot(link("a") + link("b") + joint("j", "a", "b", rest, type)));
  };
  EXPECT_NE(of_joint("<axis xyz=\"0 0 0\"/>", "revolute").find("an axis of length 0"), std::string::npos);
  EXPECT_NE(of_joint("", "hinge").find("has the type \"hinge\""), std::string::npos);
  EXPECT_EQ(of_joint("<axis xyz=\"0 0 0\"/>", "fixed"), "");
  EXPECT_EQ(parse_urdf(robot(link("a") + link("b") + joint("j", "a", "b", "", "revolute")), "r.urdf")
                .warnings.size(),
            1U);
}

TEST(urdf, text_cut_off_anywhere_is_refused_or_read) {
  const std::string text = sample_robot("robot:arm");
  std::size_t read = 0;
  for (std::size_t size = 0; size < text.size(); size += 7)
    read += refusal(text.substr(0, size)).empty() ? 1 : 0;
  EXPECT_EQ(read, 0U);
  const std::string deep = "<robot>" + [] {
    std::string nested;
    for (int i = 0; i < 100'000; ++i) nested += "<a>";
    return nested;
  }();
  EXPECT_NE(refusal(deep).find("this is no XML"), std::string::npos);
}

#ifdef BALLFLOW_HAS_URDFDOM
TEST(urdf, urdfdom_reads_the_same) {
  const std::string text =
      robot(link("a", shape("<box size=\"1 2 3\"/>", "<origin xyz=\"1 -2 3\" rpy=\"0.3 -0.7 2.1\"/>")) +
            link("b") + link("c", shape("<mesh filename=\"package://p/m.stl\" scale=\"2 3 4\"/>")) +
            joint("j", "a", "b",
                  "<origin xyz=\"0.1 0.2 0.3\" rpy=\"1.1 0.2 -0.4\"/><axis xyz=\"0 1 0\"/><limit "
                  "lower=\"-1\" upper=\"2\" "
                  "effort=\"1\" velocity=\"1\"/>",
                  "revolute") +
            joint("k", "b", "c",
                  "<axis xyz=\"0 0 1\"/><limit lower=\"0\" upper=\"0.5\" effort=\"1\" velocity=\"1\"/>",
                  "prismatic"));
  for (const std::string& one : {text, sample_robot("robot:arm")}) {
    const Urdf mine = parse_urdf(one, "r.urdf");
    const urdf::ModelInterfaceSharedPtr theirs = urdf::parseURDF(one);
    ASSERT_NE(theirs, nullptr);
    EXPECT_EQ(theirs->links_.size(), mine.links.size());
    EXPECT_EQ(theirs->joints_.size(), mine.joints.size());
    const auto expect_pose = [](const Pose& pose, const urdf::Pose& other) {
      for (const Vec3 v : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, 0}}) {
        const urdf::Vector3 turned = other.rotation * urdf::Vector3(v.x, v.y, v.z);
        const Vec3 there = {turned.x + other.position.x, turned.y + other.position.y,
                            turned.z + other.position.z};
        EXPECT_NEAR(distance(moved(pose, v), there), 0, 1e-12);
      }
    };
    for (const UrdfJoint& joint : mine.joints) {
      const auto other = theirs->getJoint(joint.name);
      ASSERT_NE(other, nullptr);
      EXPECT_EQ(other->parent_link_name, joint.parent);
      EXPECT_EQ(other->child_link_name, joint.child);
      expect_pose(joint.origin, other->parent_to_joint_origin_transform);
      if (other->limits != nullptr) {
        EXPECT_EQ(other->limits->lower, joint.lower);
        EXPECT_EQ(other->limits->upper, joint.upper);
      }
    }
    for (const UrdfLink& link : mine.links) {
      const auto other = theirs->getLink(link.name);
      ASSERT_NE(other, nullptr);
      ASSERT_EQ(other->collision_array.size(), link.collisions.size());
      for (std::size_t i = 0; i < link.collisions.size(); ++i)
        expect_pose(link.collisions[i].origin, other->collision_array[i]->origin);
    }
  }
}
#else
TEST(urdf, urdfdom_reads_the_same) { GTEST_SKIP() << "SKIPPED: urdfdom is not installed"; }
#endif

}  // namespace
}  // namespace ballflow::geometry
