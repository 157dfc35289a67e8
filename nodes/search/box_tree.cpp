#include "search/box_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <limits>
#include <numeric>

#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

/// How many nodes a tree of so many items has.
std::size_t nodes_for(std::size_t items, std::size_t leaf_size) {
  if (items <= leaf_size) return 1;
  const std::size_t half = items / 2;
  if (2 * half == items) return 1 + 2 * nodes_for(half, leaf_size);
  return 1 + nodes_for(half, leaf_size) + nodes_for(items - half, leaf_size);
}

/// `Items` says where items are: items.middle(i), twice the middle of item i, and items.add(i, box).
template <class Items>
class Builder {
 public:
  Builder(const Items& items, std::size_t leaf_size, std::span<BoxTree::Node> nodes,
          std::span<std::int32_t> order, Monitor& monitor)
      : items_(items), leaf_size_(leaf_size), nodes_(nodes), order_(order), monitor_(monitor) {}

  void build(std::size_t self, std::size_t first, std::size_t last) {
    const std::span<std::int32_t> own = order_.subspan(first, last - first);
    BoxTree::Node& node = nodes_[self];
    node = {{}, static_cast<std::int32_t>(first), static_cast<std::int32_t>(last), 0};
    if (own.size() <= leaf_size_) {
      std::sort(own.begin(), own.end());
      for (const std::int32_t i : own) items_.add(i, node.box);
      return;
    }
    if (monitor_.cancelled()) throw Cancelled();
    Box middles;
    for (const std::int32_t i : own) middles.add(items_.middle(i));
    const Vec3 extent = middles.upper - middles.lower;
    double Vec3::*axis = &Vec3::x;
    if (extent.y > extent.x) axis = &Vec3::y;
    if (extent.z > extent.*axis) axis = &Vec3::z;
    const std::size_t half = own.size() / 2;
    std::nth_element(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(half), own.end(),
                     [&](std::int32_t a, std::int32_t b) {
                       const double u = items_.middle(a).*axis, v = items_.middle(b).*axis;
                       return u != v ? u < v : a < b;
                     });
    const std::size_t second = self + 1 + nodes_for(half, leaf_size_);
    node.second = static_cast<std::int32_t>(second);
    const auto build_first = [&] { build(self + 1, first, first + half); };
    const auto build_second = [&] { build(second, first + half, last); };
    if (own.size() > 8192) {
      tbb::parallel_invoke(build_first, build_second);
    } else {
      build_first();
      build_second();
    }
    for (const std::size_t child : {self + 1, second}) {
      node.box.add(nodes_[child].box.lower);
      node.box.add(nodes_[child].box.upper);
    }
  }

 private:
  const Items& items_;
  std::size_t leaf_size_;
  std::span<BoxTree::Node> nodes_;
  std::span<std::int32_t> order_;
  Monitor& monitor_;
};

struct BoxItems {
  std::span<const Box> boxes;
  Vec3 middle(std::int32_t i) const {
    const Box& box = boxes[static_cast<std::size_t>(i)];
    return box.lower + box.upper;
  }
  void add(std::int32_t i, Box& box) const {
    box.add(boxes[static_cast<std::size_t>(i)].lower);
    box.add(boxes[static_cast<std::size_t>(i)].upper);
  }
};

struct PointItems {
  std::span<const Vec3> points;
  Vec3 middle(std::int32_t i) const { return points[static_cast<std::size_t>(i)]; }
  void add(std::int32_t i, Box& box) const { box.add(points[static_cast<std::size_t>(i)]); }
};

template <class Items>
void build(const Items& items, std::size_t count, std::size_t leaf_size, Monitor& monitor,
           std::vector<BoxTree::Node>& nodes, std::vector<std::int32_t>& order) {
  order.resize(static_cast<std::size_t>(index_of(count, "items of a box tree")));
  std::iota(order.begin(), order.end(), 0);
  if (count == 0) return;
  nodes.resize(static_cast<std::size_t>(index_of(nodes_for(count, leaf_size), "nodes of a box tree")));
  Builder(items, leaf_size, nodes, order, monitor).build(0, 0, count);
}

}  // namespace

BoxTree::BoxTree(std::span<const Box> boxes, std::size_t leaf_size, Monitor& monitor) {
  build(BoxItems{boxes}, boxes.size(), leaf_size, monitor, nodes_, order_);
}

BoxTree::BoxTree(std::span<const Vec3> points, std::size_t leaf_size, Monitor& monitor) {
  build(PointItems{points}, points.size(), leaf_size, monitor, nodes_, order_);
}

void BoxTree::set_slacks(std::span<const double> slacks) {
  slacks_.assign(nodes_.size(), -std::numeric_limits<double>::infinity());
  for (std::size_t self = nodes_.size(); self-- > 0;) {
    const Node& node = nodes_[self];
    double& slack = slacks_[self];
    if (node.second != 0) {
      slack = std::max(slacks_[self + 1], slacks_[static_cast<std::size_t>(node.second)]);
      continue;
    }
    for (std::int32_t k = node.first; k < node.last; ++k) slack = std::max(slack, slacks[item(k)]);
  }
}

}  // namespace ballflow::geometry
