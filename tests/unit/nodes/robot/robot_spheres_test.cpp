// Balls of robots: from other programs, put together, and which links need no test.
#include "robot/robot_spheres.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "robot/load_robot_spheres.hpp"
#include "robot/read_robot.hpp"
#include "test_data.hpp"
#include "urdf/sample_robot.hpp"

namespace ballflow::geometry {
namespace {

class Warned final : public Monitor {
 public:
  void warn(const std::string& text) override { all += text + "\n"; }
  std::string all;
};

const Robot& arm() {
  static const Robot robot = read_robot({"robot:arm", "", RobotGeometry::collision});
  return robot;
}

std::vector<LinkSpheres> parse(const std::string& text, const std::string& file = "s") {
  std::vector<std::string> warnings;
  return parse_link_spheres(text, file, warnings);
}
std::string refused(const std::string& text) {
  try {
    parse(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
/// "hand: 1 2 3 r 0.5; ..." of everything that was read.
std::string shown(const std::vector<LinkSpheres>& all) {
  std::string text;
  for (const LinkSpheres& link : all) {
    text += link.link + ":";
    for (std::size_t i = 0; i < link.radii.size(); ++i)
      text += " " + shortest_text(link.centers[i].x) + " " + shortest_text(link.centers[i].y) + " " +
              shortest_text(link.centers[i].z) + " r " + shortest_text(link.radii[i]) + ";";
    text += "\n";
  }
  return text;
}

const char* const two = "hand: 1 2 3 r 0.5; -0.001 0 1e-05 r 0.25;\nbase: 0 0 0 r 2;\n";

TEST(link_spheres, the_same_in_every_format) {
  const std::string lists =
      "hand:\n  - {center: [1, 2, 3], radius: 0.5}\n  - center: [-0.001, 0.0, 1.0e-5]\n    radius: "
      "0.25\nbase:\n"
      "  - \"center\": [0, 0, 0]\n    \"radius\": 2.0\n";
  const auto indented = [&](const std::string& by) {
    std::string text = by + lists;
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos && at + 1 < text.size(); ++at)
      text.insert(at + 1, by);
    return text;
  };
  EXPECT_EQ(shown(parse(lists)), two);
  EXPECT_EQ(shown(parse("# spheres of links, by hand\n\n# a, b\n" + lists)), two);
  EXPECT_EQ(shown(parse("collision_spheres:\n" + indented("  "))), two);
  EXPECT_EQ(shown(parse("robot_cfg:\n  kinematics:\n    base_link: base\n    collision_spheres:\n" +
                        indented("      "))),
            two);
  EXPECT_EQ(
      shown(parse("format: xrdf\nformat_version: 1.0\ngeometry:\n  a:\n    spheres:\n" + indented("      "))),
      two);
  EXPECT_EQ(shown(parse(R"({"hand": {"centers": [[1,2,3],[-0.001,0,1e-5]], "radii": [0.5,0.25]},
                            "base": {"centers": [[0,0,0]], "radii": [2]}})")),
            two);
  EXPECT_EQ(shown(parse(R"({"spheres": [{"link":"hand","position":[1,2,3],"radius":0.5},
      {"link":"hand","position":[-0.001,0,1e-5],"radius":0.25},{"link":"base","position":[0,0,0],"radius":2}]})")),
            two);
  EXPECT_EQ(shown(parse("link,x,y,z,radius\nhand,1,2,3,0.5\nhand,-0.001,0,1e-5,0.25\n\nbase,0,0,0,2\n")),
            two);
  EXPECT_EQ(
      shown(parse("radius, link, z, y, x\n0.5,\"hand\",3,2,1\r\n0.25,hand,1e-5,0,-0.001\n2,base,0,0,0")),
      two);
  EXPECT_EQ(
      shown(parse(
          R"(<robot name="r"><link_sphere_approximation link="hand"><sphere center="1 2 3" radius="0.5"/>
      <sphere center="-0.001 0 1e-5" radius="0.25"/></link_sphere_approximation>
      <link_sphere_approximation link="base"><sphere center="0 0 0" radius="2"/></link_sphere_approximation></robot>)")),
      two);
  EXPECT_EQ(shown(parse(R"(<robot name="r"><link name="hand">
      <collision><origin xyz="1 2 3"/><geometry><sphere radius="0.5"/></geometry></collision>
      <collision><origin xyz="-0.001 0 1e-5"/><geometry><sphere radius="0.25"/></geometry></collision></link>
      <link name="base"><collision><geometry><sphere radius="2"/></geometry></collision></link>
      <joint name="j" type="fixed"><parent link="base"/><child link="hand"/></joint></robot>)")),
            two);
}

TEST(link_spheres, what_is_wrong_is_named_with_its_line) {
  EXPECT_NE(refused("").find("has nothing in it"), std::string::npos);
  EXPECT_NE(refused("just text").find("is no list of spheres by link"), std::string::npos);
  EXPECT_NE(refused("a: [1, 2").find("neither YAML nor JSON"), std::string::npos);
  EXPECT_EQ(refused("hand:\n  - {center: [1, 2], radius: 1}\n").substr(0, 4), "s:2 ");
  EXPECT_NE(refused("hand:\n  - {center: [1, 2, .nan], radius: 1}\n").find("no finite number"),
            std::string::npos);
  EXPECT_NE(refused("hand:\n  - {center: [1, 2, 3]}\n").find("radius of a sphere of link \"hand\""),
            std::string::npos);
  EXPECT_NE(refused("collision_spheres: spheres/x.yml\n").find("names another file for its spheres"),
            std::string::npos);
  EXPECT_NE(refused("link,x,y,z\n").find("no column \"r\""), std::string::npos);
  EXPECT_NE(refused("link,x,y,z,r\nhand,1,2,x,4\n").find("s:2: \"z\""), std::string::npos);
  EXPECT_NE(refused("<robot name=\"r\"/>").find("neither links nor sphere approximations"),
            std::string::npos);
  EXPECT_NE(refused("<robot><link_sphere_approximation link=\"a\"><sphere center=\"1 2\" radius=\"1\"/>"
                    "</link_sphere_approximation></robot>")
                .find("has 2 numbers"),
            std::string::npos);
}

TEST(link_spheres, those_without_a_radius_and_of_other_links_are_left_out_with_words) {
  test::TempFolder folder;
  test::write_file(folder.file("s.yml"),
                   "kinematics:\n  collision_sphere_buffer: 0.005\n  collision_spheres:\n    hand:\n    - "
                   "{center: [0, 0, 0], "
                   "radius: 0.1}\n    - {center: [0, 0, 0], radius: -10.0}\n    attached_object:\n    - "
                   "{center: [0, 0, 0], radius: 1}\n");
  Warned warned;
  const RobotSpheres spheres = load_robot_spheres(arm(), {folder.file("s.yml"), 0.01}, warned);
  EXPECT_EQ(broken_invariant(spheres), "");
  EXPECT_EQ(spheres.radii.size(), 1U);
  EXPECT_DOUBLE_EQ(spheres.radii[0], 0.11);
  EXPECT_EQ(balls_of(spheres, link_named(arm(), "hand")).size(), 1U);
  EXPECT_NE(warned.all.find("a buffer of 0.005 m"), std::string::npos);
  EXPECT_NE(warned.all.find("1 spheres of link \"hand\" have a radius of 0 or less"), std::string::npos);
  EXPECT_NE(warned.all.find("no link \"attached_object\""), std::string::npos);
  test::write_file(folder.file("other.csv"), "link,x,y,z,r\nleg,0,0,0,1\n");
  EXPECT_THROW(load_robot_spheres(arm(), {folder.file("other.csv"), 0}), InputError);
}

TEST(link_spheres, a_list_without_a_link_is_for_the_link_of_its_file) {
  test::TempFolder folder;
  const std::string foam = R"({"mean":1,"best":1,"worst":2,"spheres":[{"origin":[0,0,0.5],"radius":0.5}]})";
  test::write_file(folder.file("forearm.json"), foam);
  test::write_file(folder.file("other.json"), foam);
  const RobotSpheres spheres = load_robot_spheres(arm(), {folder.file("forearm.json"), 0});
  EXPECT_EQ(balls_of(spheres, link_named(arm(), "forearm")).size(), 1U);
  EXPECT_THROW(load_robot_spheres(arm(), {folder.file("other.json"), 0}), InputError);
}

TEST(robot_spheres, lists_go_to_links_by_order_or_name) {
  const auto ball = [](double r) { return Balls{{Vec3{0, 0, 0}}, {r}, {}, {}}; };
  RobotSpheresOptions options;
  options.pairs.poses = 0;
  options.links = "hand,base";
  RobotSpheres spheres = robot_spheres(arm(), {ball(1), ball(2)}, {}, options);
  EXPECT_EQ(balls_of(spheres, link_named(arm(), "hand")).radii[0], 1);
  EXPECT_EQ(balls_of(spheres, link_named(arm(), "base")).radii[0], 2);
  options.links = R"(["base","hand"])";
  spheres = robot_spheres(arm(), {ball(1), ball(2)}, {}, options);
  EXPECT_EQ(balls_of(spheres, link_named(arm(), "hand")).radii[0], 2);
  for (const char* wrong : {"hand", "hand,hand", "hand,leg", "[\"hand\"", ""}) {
    options.links = wrong;
    EXPECT_THROW(robot_spheres(arm(), {ball(1), ball(2)}, {}, options), InputError) << wrong;
  }
}

TEST(robot_spheres, points_that_are_left_out_go_with_their_links) {
  const Balls ball{{Vec3{0, 0, 0}}, {1}, {}, {}};
  RobotSpheresOptions options;
  options.pairs.poses = 0;
  options.links = "hand,base";
  Enclosure hand, base;
  hand.open_points = {{1, 2, 3}};
  hand.open_triangles = {4};
  hand.open_why = {0};
  base.void_points = {{4, 5, 6}, {7, 8, 9}};
  base.void_places = {0, 1};  // one outside of the solid, which matters not, one inside
  const RobotSpheres spheres = robot_spheres(arm(), {ball, ball}, {hand, base}, options);
  EXPECT_EQ(broken_invariant(spheres), "");
  ASSERT_EQ(spheres.open_points.size(), 2u);
  EXPECT_EQ(spheres.open_points[0], (Vec3{7, 8, 9})) << "the base is the first link of the robot";
  EXPECT_EQ(spheres.open_points[1], (Vec3{1, 2, 3}));
  EXPECT_EQ(spheres.open_ends[link_named(arm(), "base")], 1);
  EXPECT_EQ(spheres.open_ends[link_named(arm(), "hand")], 2);
  EXPECT_TRUE(robot_spheres(arm(), {ball, ball}, {}, options).open_ends.empty());
  EXPECT_THROW(robot_spheres(arm(), {ball, ball}, {hand}, options), InputError);
}

/// By name and reason.
std::string pairs_of(const RobotSpheres& spheres) {
  const std::vector<std::string> names = names_of(spheres.link_names);
  std::string text;
  for (std::size_t i = 0; i < spheres.pair_links.size(); ++i) {
    text += names[static_cast<std::size_t>(spheres.pair_links[i][0])] + "-" +
            names[static_cast<std::size_t>(spheres.pair_links[i][1])] + " " +
            name_of(static_cast<PairReason>(spheres.pair_reasons[i])) + "\n";
  }
  return text;
}

TEST(self_collision, pairs_are_told_apart_by_poses) {
  const RobotSpheres loaded = load_robot_spheres(arm(), {"spheres:arm", 0});
  std::vector<Balls> balls;
  for (std::size_t link = 0; link < 6; ++link) balls.push_back(balls_of(loaded, link));
  RobotSpheresOptions options;
  const RobotSpheres spheres = robot_spheres(arm(), balls, {}, options);
  EXPECT_EQ(broken_invariant(spheres), "");
  EXPECT_EQ(spheres.poses, 2000);
  const std::string pairs = pairs_of(spheres);
  for (const char* adjacent :
       {"base-upper_arm", "upper_arm-forearm", "forearm-hand", "hand-left_finger", "hand-right_finger"})
    EXPECT_NE(pairs.find(adjacent + std::string(" adjacent\n")), std::string::npos) << pairs;
  EXPECT_NE(pairs.find("left_finger-right_finger default\n"), std::string::npos)
      << "closed at 0, open elsewhere\n"
      << pairs;
  EXPECT_NE(pairs.find("forearm-left_finger never"), std::string::npos) << pairs;
  EXPECT_EQ(pairs.find("upper_arm-hand"), std::string::npos) << "the elbow bends far enough for some poses\n"
                                                             << pairs;
  // The same for any number of threads, and for a second time.
  for (const std::size_t threads : {1, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(pairs_of(robot_spheres(arm(), balls, {}, options)), pairs);
  }
  // Balls as large as the robot meet always.
  for (Balls& one : balls) one = {{Vec3{0, 0, 0}}, {1.0}, {}, {}};
  EXPECT_NE(pairs_of(robot_spheres(arm(), balls, {}, options)).find("base-forearm always\n"),
            std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
