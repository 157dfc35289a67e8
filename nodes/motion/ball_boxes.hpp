// A tree of balls, by boxes around their centers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "base/vec3.hpp"
#include "types/balls.hpp"

namespace ballflow::geometry {

class BallBoxes {
 public:
  struct Ball {
    Vec3 center;
    double radius;
    std::int32_t index;  // among the balls that the tree was made of
  };
  struct Node {
    Box box;                           // of the centers
    double largest = 0, smallest = 0;  // radii
    std::int32_t first = 0, last = 0;  // its balls, places in balls()
    std::int32_t second = 0;           // the second child, 0 for a leaf; the first one follows its parent
    std::int32_t lowest = 0;           // of the indices
    std::int32_t prime = 0;  // place of the largest ball, of equally large ones that of lowest index

    bool leaf() const { return second == 0; }
    /// All centers are in one place: only the prime ball can be next to anything.
    bool concentric() const { return box.lower == box.upper; }
    double size() const { return squared_distance(box.lower, box.upper); }
  };

  /// Fewer than 2^31 balls, at least one.
  BallBoxes(const Balls& balls, Monitor& monitor);

  const Node& node(std::int32_t i) const { return nodes_[static_cast<std::size_t>(i)]; }
  std::span<const Ball> balls() const { return balls_; }
  const Ball& ball(std::int32_t place) const { return balls_[static_cast<std::size_t>(place)]; }
  std::span<const Ball> balls_of(const Node& node) const {
    return std::span(balls_).subspan(static_cast<std::size_t>(node.first),
                                     static_cast<std::size_t>(node.last - node.first));
  }

 private:
  std::vector<Node> nodes_;  // in preorder
  std::vector<Ball> balls_;
};

}  // namespace ballflow::geometry
