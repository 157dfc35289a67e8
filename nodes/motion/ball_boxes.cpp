#include "motion/ball_boxes.hpp"

#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstddef>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "base/space_order.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t leaf_size = 8;

/// How many nodes a tree of so many balls has.
std::size_t nodes_for(std::size_t balls) {
  if (balls <= leaf_size) return 1;
  const std::size_t half = balls / 2;
  if (2 * half == balls) return 1 + 2 * nodes_for(half);
  return 1 + nodes_for(half) + nodes_for(balls - half);
}

struct Place {
  std::uint64_t code;
  std::int32_t index;
  friend bool operator<(const Place& a, const Place& b) {
    return a.code != b.code ? a.code < b.code : a.index < b.index;
  }
};

class Builder {
 public:
  Builder(const SpaceOrder& order, std::span<BallBoxes::Ball> balls, std::span<BallBoxes::Node> nodes,
          Monitor& monitor)
      : order_(order), balls_(balls), nodes_(nodes), monitor_(monitor) {}

  void build(std::size_t self, std::size_t first, std::size_t last) {
    BallBoxes::Node& node = nodes_[self];
    node.first = static_cast<std::int32_t>(first);
    node.last = static_cast<std::int32_t>(last);
    if (last - first <= leaf_size) {
      fill_leaf(node);
      return;
    }
    if (monitor_.cancelled()) throw Cancelled();
    const std::size_t half = (last - first) / 2, middle = first + half;
    // The order halves space; where it no longer tells balls apart, which a far one can bring about, they do.
    if (order_(balls_[first].center) == order_(balls_[last - 1].center)) part_at(first, middle, last);
    const std::size_t second = self + 1 + nodes_for(half);
    node.second = static_cast<std::int32_t>(second);
    const auto build_first = [&] { build(self + 1, first, middle); };
    const auto build_second = [&] { build(second, middle, last); };
    if (last - first > 8192) {
      tbb::parallel_invoke(build_first, build_second);
    } else {
      build_first();
      build_second();
    }
    const BallBoxes::Node &one = nodes_[self + 1], &other = nodes_[second];
    node.box = one.box;
    node.box.add(other.box.lower);
    node.box.add(other.box.upper);
    node.prime = better(other.prime, one.prime) ? other.prime : one.prime;
    node.largest = ball(node.prime).radius;
    node.smallest = std::min(one.smallest, other.smallest);
    node.lowest = std::min(one.lowest, other.lowest);
  }

 private:
  const BallBoxes::Ball& ball(std::int32_t place) const { return balls_[static_cast<std::size_t>(place)]; }
  bool better(std::int32_t p, std::int32_t q) const {
    const BallBoxes::Ball &a = ball(p), &b = ball(q);
    return a.radius > b.radius || (a.radius == b.radius && a.index < b.index);
  }

  void fill_leaf(BallBoxes::Node& node) const {
    node.prime = node.first;
    node.smallest = ball(node.first).radius;
    node.lowest = ball(node.first).index;
    for (std::int32_t place = node.first; place < node.last; ++place) {
      node.box.add(ball(place).center);
      if (better(place, node.prime)) node.prime = place;
      node.smallest = std::min(node.smallest, ball(place).radius);
      node.lowest = std::min(node.lowest, ball(place).index);
    }
    node.largest = ball(node.prime).radius;
  }

  void part_at(std::size_t first, std::size_t middle, std::size_t last) const {
    Box box;
    for (std::size_t i = first; i < last; ++i) box.add(balls_[i].center);
    const Vec3 extent = box.upper - box.lower;
    double Vec3::*axis = &Vec3::x;
    if (extent.y > extent.x) axis = &Vec3::y;
    if (extent.z > extent.*axis) axis = &Vec3::z;
    const auto at = [this](std::size_t i) { return balls_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(first), at(middle), at(last),
                     [&](const BallBoxes::Ball& a, const BallBoxes::Ball& b) {
                       const double u = a.center.*axis, v = b.center.*axis;
                       return u != v ? u < v : a.index < b.index;
                     });
  }

  const SpaceOrder& order_;
  std::span<BallBoxes::Ball> balls_;
  std::span<BallBoxes::Node> nodes_;
  Monitor& monitor_;
};

}  // namespace

BallBoxes::BallBoxes(const Balls& balls, Monitor& monitor) {
  const std::size_t n = balls.size();
  index_of(n, "balls");
  const SpaceOrder order(geometry::bounding_box(balls.centers.span()));
  std::vector<Place> places(n);
  for_each_block(n, 65536, no_monitor(), 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      places[i] = {order(balls.centers[i]), static_cast<std::int32_t>(i)};
  });
  tbb::parallel_sort(places.begin(), places.end());
  balls_.resize(n);
  for_each_block(n, 65536, monitor, 0, 0, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t place = first; place < last; ++place) {
      const auto i = static_cast<std::size_t>(places[place].index);
      balls_[place] = {balls.centers[i], balls.radii[i], places[place].index};
    }
  });
  nodes_.resize(static_cast<std::size_t>(index_of(nodes_for(n), "nodes of a tree of balls")));
  Builder(order, balls_, nodes_, monitor).build(0, 0, n);
}

}  // namespace ballflow::geometry
