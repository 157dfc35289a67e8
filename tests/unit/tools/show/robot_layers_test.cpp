#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "ballflow/error.hpp"
#include "sealed.hpp"
#include "show/motion.hpp"
#include "show/page/layer_json.hpp"
#include "show/palette.hpp"
#include "show/scene.hpp"
#include "types/robot_type.hpp"

namespace ballflow::show {
namespace {

using namespace geometry;

constexpr Pose at(double x, double y, double z) { return {1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z}; }

/// "tray" slides out of "arm", which turns on "base"; "door" follows the tray and turns on the base; "lid"
/// hangs on by a joint that has no room. The root comes last, as descriptions may have it.
RobotTree cupboard() {
  RobotTree tree;
  tree.name = text_of("cupboard");
  tree.link_names = names_text({"tray", "arm", "door", "lid", "base"});
  tree.joint_names = names_text({"out", "turn", "open", "stuck"});
  tree.joint_kinds = {3, 1, 2, 1};
  tree.joint_parents = {1, 4, 4, 4};
  tree.joint_children = {0, 1, 2, 3};
  tree.joint_origins = {at(2, 0, 0), at(0, 0, 1), at(5, 0, 0), at(0, 5, 0)};
  tree.joint_axes = {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 0, 1}};
  tree.joint_limits = {{0.25, 1}, {-2, 2}, {0, 0}, {0.5, 0.5}};
  tree.joint_mimics = {-1, -1, 0, -1};
  tree.joint_mimic_lines = {{1, 0}, {1, 0}, {3, 0.5}, {1, 0}};
  return tree;
}

Robot with_triangles() {
  Robot robot;
  static_cast<RobotTree&>(robot) = cupboard();
  robot.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}};
  robot.triangles = {{0, 1, 2}, {0, 1, 2}};
  robot.vertex_ends = {3, 3, 3, 3, 6};  // of the tray and of the base
  robot.triangle_ends = {1, 1, 1, 1, 2};
  return robot;
}

RobotSpheres with_spheres() {
  RobotSpheres spheres;
  static_cast<RobotTree&>(spheres) = cupboard();
  spheres.centers = {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  spheres.radii = {0.5, 0.25, 1};
  spheres.ball_ends = {2, 2, 2, 2, 3};
  return spheres;
}

TEST(robot_layers, links_are_where_joints_nearest_to_zero_put_them) {
  const auto layers = layers_of(*test::sealed(with_triangles()));
  ASSERT_EQ(layers.size(), 1u);
  const Layer& links = layers[0];
  EXPECT_EQ(broken_invariant(links), "");
  EXPECT_EQ(links.name, "links");
  EXPECT_EQ(links.shape, Shape::triangles);
  // The tray is out by 0.25, the least it can be.
  EXPECT_EQ(links.vertices[0], (Vec3{2.25, 0, 1}));
  EXPECT_EQ(links.vertices[1], (Vec3{3.25, 0, 1}));
  EXPECT_EQ(links.vertices[4], (Vec3{0, 0, 1}));
  EXPECT_EQ(links.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}}));
  const Attribute* const link = links.find(links.colour_by);
  EXPECT_EQ(link->categories, (std::vector<std::string>{"tray", "arm", "door", "lid", "base"}));
  EXPECT_EQ(link->values, (std::vector<double>{0, 0, 0, 4, 4, 4}));
}

TEST(robot_layers, spheres_have_the_colours_of_their_links_and_the_same_chain) {
  const ArtifactPtr artifact = test::sealed(with_spheres());
  const auto layers = layers_of(*artifact);
  ASSERT_EQ(layers.size(), 1u);
  const Layer& balls = layers[0];
  EXPECT_EQ(broken_invariant(balls), "");
  EXPECT_EQ(balls.name, "spheres");
  EXPECT_EQ(balls.vertices[1], (Vec3{3.25, 0, 1}));
  EXPECT_EQ(balls.vertices[2], (Vec3{0, 0, 0}));
  EXPECT_EQ(balls.radii, (Array<double>{0.5, 0.25, 1}));
  EXPECT_EQ(balls.find(balls.colour_by)->values, (std::vector<double>{0, 0, 4}));
  EXPECT_EQ(balls.find("radius")->unit, "m");
  const auto links = layers_of(*test::sealed(with_triangles()));
  EXPECT_EQ(chain_json(*balls.chain), chain_json(*links[0].chain));
}

TEST(robot_layers, points_that_spheres_leave_out_are_red_and_move_with_their_links) {
  RobotSpheres spheres = with_spheres();
  spheres.open_points = {{0, 0, 0}, {0, 0, 3}};
  spheres.open_ends = {1, 1, 1, 1, 2};  // of the tray and of the base
  const ArtifactPtr artifact = test::sealed(spheres);
  const auto layers = layers_of(*artifact);
  ASSERT_EQ(layers.size(), 2u);
  const Layer& open = layers[1];
  EXPECT_EQ(broken_invariant(open), "");
  EXPECT_EQ(open.name, "not covered");
  EXPECT_EQ(open.shape, Shape::points);
  EXPECT_EQ(open.vertices[0], (Vec3{2.25, 0, 1}));
  EXPECT_EQ(open.vertices[1], (Vec3{0, 0, 3}));
  EXPECT_EQ(open.frames[0], layers[0].frames[0]);
  EXPECT_EQ(open.frames[1], layers[0].frames[2]);
  EXPECT_EQ(open.colour_by, "");
  const Colour colour = plain(open);
  EXPECT_GT(colour.red, 200);
  EXPECT_LT(colour.green + colour.blue, 60);
}

TEST(robot_layers, a_chain_has_a_joint_for_what_moves_by_itself) {
  const Chain chain = chain_of(cupboard());
  EXPECT_EQ(broken_invariant(chain), "");
  EXPECT_EQ(chain.name, "cupboard");
  ASSERT_EQ(chain.joints.size(), 2u);  // the door follows, the lid has no room
  EXPECT_EQ(chain.joints[0].name, "out");
  EXPECT_EQ(chain.joints[0].unit, "m");
  EXPECT_EQ(chain.joints[0].lower, 0.25);
  EXPECT_EQ(chain.joints[0].value, 0.25);
  EXPECT_EQ(chain.joints[1].name, "turn");
  EXPECT_EQ(chain.joints[1].unit, "rad");
  EXPECT_EQ(chain.joints[1].upper, 2);
  std::map<std::string, Chain::Frame> frames;
  for (const Chain::Frame& frame : chain.frames) frames[frame.name] = frame;
  ASSERT_EQ(chain.frames[0].name, "base");
  EXPECT_EQ(frames["base"].parent, -1);
  EXPECT_EQ(frames["arm"].parent, 0);
  EXPECT_EQ(chain.frames[static_cast<std::size_t>(frames["tray"].parent)].name, "arm");
  EXPECT_EQ(frames["tray"].motion, Chain::Motion::slide);
  EXPECT_EQ(frames["door"].joint, 0);
  EXPECT_EQ(frames["door"].factor, 3);
  EXPECT_EQ(frames["door"].offset, 0.5);
  EXPECT_EQ(frames["lid"].joint, -1);
  EXPECT_EQ(frames["lid"].offset, 0.5);  // at its limit for good
}

TEST(robot_layers, joints_without_limits_turn_all_around) {
  RobotTree tree = cupboard();
  tree.joint_mimics = {-1, -1, -1, -1};
  const Chain chain = chain_of(tree);
  ASSERT_EQ(chain.joints.size(), 3u);
  EXPECT_EQ(chain.joints[2].name, "open");
  EXPECT_NEAR(chain.joints[2].lower, -3.14159265, 1e-8);
  EXPECT_NEAR(chain.joints[2].upper, 3.14159265, 1e-8);
  EXPECT_EQ(chain.joints[2].value, 0);
}

TEST(robot_layers, layers_of_one_robot_share_a_chain_in_pages) {
  Blocks blocks;
  Json chains = Json::array();
  const ArtifactPtr balls = test::sealed(with_spheres()), links = test::sealed(with_triangles());
  EXPECT_EQ(layer_json(layers_of(*balls)[0], blocks, chains).at("chain"), 0);
  EXPECT_EQ(layer_json(layers_of(*links)[0], blocks, chains).at("chain"), 0);
  RobotSpheres other = with_spheres();
  other.joint_limits = {{0.25, 2}, {-2, 2}, {0, 0}, {0.5, 0.5}};
  const ArtifactPtr further = test::sealed(other);
  const Json json = layer_json(layers_of(*further)[0], blocks, chains);
  EXPECT_EQ(json.at("chain"), 1);
  EXPECT_EQ(chains.size(), 2u);
  EXPECT_EQ(blocks.all()[json.at("frames").get<std::size_t>()].count, 3u);
  Balls still;
  still.centers = {{0, 0, 0}};
  still.radii = {1};
  const ArtifactPtr loose = test::sealed(still);
  EXPECT_FALSE(layer_json(layers_of(*loose)[0], blocks, chains).contains("chain"));
}

TEST(robot_layers, a_vertex_without_a_frame_is_noticed) {
  Layer layer = layers_of(*test::sealed(with_spheres()))[0];
  layer.frames.pop_back();
  EXPECT_NE(broken_invariant(layer), "");
  layer.frames.push_back(99);
  EXPECT_NE(broken_invariant(layer), "");
  layer.frames.back() = 0;
  EXPECT_EQ(broken_invariant(layer), "");
  layer.chain = nullptr;
  EXPECT_NE(broken_invariant(layer), "");
}

TEST(robot_layers, a_joint_takes_what_hangs_on_it_along) {
  const Robot robot = with_triangles();
  const auto layers = layers_of(*test::sealed(robot));
  const std::vector<std::string> joints = names_of(robot.joint_names);
  for (const std::string name : {"out", "turn"}) {
    const Chain::Joint joint = joint_named(layers, name);
    for (const double value : {joint.lower, 0.3, joint.upper}) {
      std::vector<double> values = default_values(robot);
      values[static_cast<std::size_t>(std::find(joints.begin(), joints.end(), name) - joints.begin())] =
          value;
      const std::vector<Pose> poses = link_poses(robot, values);
      const Layer posed = with_joint(layers, name, value)[0];
      std::size_t vertex = 0;
      for (const std::size_t link : {0u, 4u}) {
        for (int k = 0; k < 3; ++k, ++vertex)
          EXPECT_LT(distance(posed.vertices[vertex], moved(poses[link], robot.vertices[vertex])), 1e-12);
      }
    }
  }
  EXPECT_THROW(joint_named(layers, "open"), Error) << "it follows another one";
  EXPECT_THROW(joint_named({}, "turn"), Error);
}

}  // namespace
}  // namespace ballflow::show
