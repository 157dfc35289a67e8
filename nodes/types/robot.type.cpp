#include "types/robot_type.hpp"

namespace ballflow {
namespace {

/// A member of the tree as one of what has a tree.
template <class T, class Member>
Member T::*in(Member geometry::RobotTree::*member) {
  return member;
}

template <class T>
void declare_tree(TypeDecl<T>& d) {
  using Tree = geometry::RobotTree;
  d.array("description", in<T>(&Tree::description)).length("c").doc("the URDF that it was read from, UTF-8");
  d.array("name", in<T>(&Tree::name)).length("a").doc("of the robot, UTF-8");
  d.array("link_names", in<T>(&Tree::link_names)).length("b").doc("a line for each link, UTF-8");
  d.array("joint_names", in<T>(&Tree::joint_names)).length("e").doc("a line for each joint, UTF-8");
  d.array("joint_kinds", in<T>(&Tree::joint_kinds))
      .length("j")
      .doc("0 fixed, 1 revolute, 2 continuous, 3 prismatic, 4 floating, 5 planar");
  d.array("joint_parents", in<T>(&Tree::joint_parents)).length("j").doc("links");
  d.array("joint_children", in<T>(&Tree::joint_children)).length("j").doc("links");
  d.array("joint_origins", in<T>(&Tree::joint_origins))
      .length("j")
      .doc(
          "frame of the child in that of the parent where the joint is at 0: rotation by rows, translation "
          "in metres");
  d.array("joint_axes", in<T>(&Tree::joint_axes)).length("j").doc("unit vectors in the frame of the child");
  d.array("joint_limits", in<T>(&Tree::joint_limits))
      .length("j")
      .doc("radians or metres; 0, 0 where there are none");
  d.array("joint_mimics", in<T>(&Tree::joint_mimics)).length("j").doc("the joint that it follows, or -1");
  d.array("joint_mimic_lines", in<T>(&Tree::joint_mimic_lines)).length("j").doc("factor and offset of that");
}

}  // namespace

void TypeOf<geometry::Robot>::declare(TypeDecl<geometry::Robot>& d) {
  using T = geometry::Robot;
  d.id("Robot", 1).doc("The links of a robot with their surfaces, and the joints between them.");
  declare_tree(d);
  d.array("vertex_ends", &T::vertex_ends).length("l").doc("where the vertices of each link end");
  d.array("triangle_ends", &T::triangle_ends).length("l").doc("where the triangles of each link end");
  d.array("vertices", &T::vertices).length("v").doc("in the frame of their link, metres");
  d.array("triangles", &T::triangles).length("t").doc("vertices by their place in the link");
  d.summary("name", "of the robot").summary("links", "how many").summary("joints", "how many");
  d.summary("moving_joints", "joints that are not fixed");
  d.summary("links_with_surface", "links that have triangles").summary("triangles", "of all links");
  d.summarize([](const T& v) {
    std::int64_t moving = 0, shaped = 0;
    for (const std::uint8_t kind : v.joint_kinds) moving += kind != 0 ? 1 : 0;
    for (std::size_t i = 0; i < v.links(); ++i) shaped += geometry::mesh_of(v, i).triangles.empty() ? 0 : 1;
    return Summary{{"name", std::string(geometry::view(v.name))},
                   {"links", static_cast<std::int64_t>(v.links())},
                   {"joints", static_cast<std::int64_t>(v.joint_kinds.size())},
                   {"moving_joints", moving},
                   {"links_with_surface", shaped},
                   {"triangles", static_cast<std::int64_t>(v.triangles.size())}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

void TypeOf<geometry::RobotSpheres>::declare(TypeDecl<geometry::RobotSpheres>& d) {
  using T = geometry::RobotSpheres;
  d.id("RobotSpheres", 2)
      .doc("Balls for the links of a robot, and which links need not be tested against each other.");
  declare_tree(d);
  d.array("ball_ends", &T::ball_ends).length("l").doc("where the balls of each link end");
  d.array("centers", &T::centers).length("n").doc("in the frame of their link, metres");
  d.array("radii", &T::radii).length("n").doc("metres");
  d.array("pair_links", &T::pair_links).length("p").doc("links that need no test against each other");
  d.array("pair_reasons", &T::pair_reasons)
      .length("p")
      .doc("0 adjacent, 1 meeting in the default pose, 2 in every pose tried, 3 in none");
  d.scalar("poses", &T::poses).doc("poses that were tried; 0: pairs were not looked for");
  d.array("open_ends", &T::open_ends)
      .length("k")
      .doc("where the points of each link end that are not covered");
  d.array("open_points", &T::open_points)
      .length("o")
      .doc("points of links that no ball covers, in their frames, metres; of surfaces and of voids inside");
  d.summary("name", "of the robot").summary("links", "how many");
  d.summary("links_with_balls", "how many have any").summary("balls", "of all links");
  d.summary("most_balls", "of one link").summary("untested_pairs", "pairs of links that need no test");
  d.summary("pairs_always", "of these, pairs that met in every pose tried, and are not adjacent");
  d.summary("pairs_never", "pairs that met in no pose tried").summary("poses", "that were tried");
  d.summary("open_points", "points of links that no ball covers; null where nothing was proven or tried");
  d.summarize([](const T& v) {
    std::int64_t with = 0, most = 0, always = 0, never = 0;
    for (std::size_t i = 0; i < v.links(); ++i) {
      const auto count = static_cast<std::int64_t>(geometry::balls_of(v, i).size());
      with += count > 0 ? 1 : 0;
      most = std::max(most, count);
    }
    for (const std::uint8_t reason : v.pair_reasons) {
      always += reason == static_cast<std::uint8_t>(geometry::PairReason::always) ? 1 : 0;
      never += reason == static_cast<std::uint8_t>(geometry::PairReason::never) ? 1 : 0;
    }
    return Summary{
        {"name", std::string(geometry::view(v.name))},
        {"links", static_cast<std::int64_t>(v.links())},
        {"links_with_balls", with},
        {"balls", static_cast<std::int64_t>(v.radii.size())},
        {"most_balls", most},
        {"untested_pairs", static_cast<std::int64_t>(v.pair_links.size())},
        {"pairs_always", always},
        {"pairs_never", never},
        {"poses", v.poses},
        {"open_points", v.open_ends.empty() ? SummaryValue(nullptr)
                                            : SummaryValue(static_cast<std::int64_t>(v.open_points.size()))}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
