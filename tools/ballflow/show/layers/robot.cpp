// Robot: the surfaces of all links, where they are when every joint is at 0 or at the limit nearest to it.
// RobotSpheres: their balls, in the same pose, and the points that these leave out. Links and balls are
// coloured by link, in equal colours.
#include <algorithm>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/robot_type.hpp"

namespace ballflow::show {
namespace {

using geometry::Array;
using geometry::Pose;
using geometry::RobotTree;
using geometry::Vec3;

/// Puts what the links have in their own frames into one layer.
class LinkedLayers {
 public:
  explicit LinkedLayers(const RobotTree& tree) : names_(names_of(tree.link_names)), frame_of_(names_.size()) {
    const std::vector<std::size_t> order = from_root(tree);
    for (std::size_t i = 0; i < order.size(); ++i) frame_of_[order[i]] = static_cast<std::uint32_t>(i);
    poses_ = link_poses(tree, default_values(tree));
    chain_ = std::make_shared<const Chain>(chain_of(tree));
  }

  /// The vertices of a layer: those of link i end at ends[i].
  void place(Layer& layer, const Array<Vec3>& vertices, const Array<std::int64_t>& ends) const {
    std::vector<Vec3> placed;
    placed.reserve(vertices.size());
    Attribute link{"link", "", names_, true, {}};
    for (std::size_t i = 0; i < ends.size(); ++i) {
      while (placed.size() < static_cast<std::size_t>(ends[i])) {
        placed.push_back(moved(poses_[i], vertices[placed.size()]));
        layer.frames.push_back(frame_of_[i]);
        link.values.push_back(static_cast<double>(i));
      }
    }
    layer.vertices = std::move(placed);
    layer.attributes.push_back(std::move(link));
    layer.chain = chain_;
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::uint32_t> frame_of_;
  std::vector<Pose> poses_;
  std::shared_ptr<const Chain> chain_;
};

std::vector<Layer> layers_of_robot(const Artifact& artifact) {
  const auto robot = typed<geometry::Robot>(artifact);
  Layer links;
  links.name = "links";
  links.shape = Shape::triangles;
  LinkedLayers(robot).place(links, robot.vertices, robot.vertex_ends);
  links.triangles.reserve(robot.triangles.size());
  for (std::size_t link = 0; link < robot.links(); ++link) {
    const auto begin = static_cast<std::int64_t>(link == 0 ? 0 : robot.vertex_ends[link - 1]);
    for (const auto& [a, b, c] : mesh_of(robot, link).triangles) {
      links.triangles.push_back({static_cast<std::uint32_t>(begin + a), static_cast<std::uint32_t>(begin + b),
                                 static_cast<std::uint32_t>(begin + c)});
    }
  }
  links.colour_by = "link";
  links.smooth = true;
  return {std::move(links)};
}

std::vector<Layer> layers_of_robot_spheres(const Artifact& artifact) {
  const auto spheres = typed<geometry::RobotSpheres>(artifact);
  Layer balls;
  balls.name = "spheres";
  balls.shape = Shape::balls;
  const LinkedLayers links(spheres);
  links.place(balls, spheres.centers, spheres.ball_ends);
  balls.radii = spheres.radii;
  balls.attributes.push_back(radius_attribute(spheres.radii.span()));
  balls.attributes.back().unit = "m";
  balls.colour_by = "link";
  Layer open;
  open.name = "not covered";
  links.place(open, spheres.open_points, spheres.open_ends);
  return {std::move(balls), std::move(open)};
}

}  // namespace

TypeLayers robot_layers() { return {"Robot", layers_of_robot}; }
TypeLayers robot_spheres_layers() { return {"RobotSpheres", layers_of_robot_spheres}; }

}  // namespace ballflow::show
