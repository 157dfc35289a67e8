#include "cover/sample_tree.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "cover/membership.hpp"

namespace ballflow::geometry {
namespace {

// Tuned on samples of 35 000 and 100 000 points: half as much makes too many nodes, twice as much tests too
// many samples.
constexpr std::int32_t leaf_size = 32;
static_assert(leaf_size <= static_cast<std::int32_t>(SampleTree::margin));

constexpr std::size_t max_depth = 64;  // the size halves at every level

}  // namespace

SampleTree::SampleTree(std::span<const Vec3> samples) : ids_(samples.size()) {
  std::iota(ids_.begin(), ids_.end(), 0);
  if (samples.empty()) return;
  nodes_.reserve(4 * samples.size() / static_cast<std::size_t>(leaf_size) + 1);
  build(samples, 0, static_cast<std::int32_t>(samples.size()));
  x_.reserve(samples.size());
  y_.reserve(samples.size());
  z_.reserve(samples.size());
  for (const std::int32_t id : ids_) {
    const Vec3& p = samples[static_cast<std::size_t>(id)];
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
}

void SampleTree::build(std::span<const Vec3> samples, std::int32_t first, std::int32_t last) {
  Box box;
  for (std::int32_t i = first; i < last; ++i) {
    box.add(samples[static_cast<std::size_t>(ids_[static_cast<std::size_t>(i)])]);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box.lower, box.upper, first, last, 0});
  if (last - first <= leaf_size) return;
  const Vec3 extent = box.upper - box.lower;
  double Vec3::*axis = &Vec3::x;
  if (extent.y > extent.*axis) axis = &Vec3::y;
  if (extent.z > extent.*axis) axis = &Vec3::z;
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(
      ids_.begin() + first, ids_.begin() + middle, ids_.begin() + last, [&](std::int32_t a, std::int32_t b) {
        return samples[static_cast<std::size_t>(a)].*axis < samples[static_cast<std::size_t>(b)].*axis;
      });
  build(samples, first, middle);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(samples, middle, last);
}

template <class Whole, class Leaf>
void SampleTree::descend(Vec3 c, double squared_reach, Whole whole, Leaf leaf) const {
  if (nodes_.empty()) return;
  std::array<std::int32_t, max_depth> stack;
  std::size_t depth = 0;
  std::int32_t at = 0;
  for (;;) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    // Differences to the lower and to the upper corner bound those to every sample between them.
    const Vec3 low = node.lower - c, high = c - node.upper;
    const double nearest = squared_norm(std::max({low.x, high.x, 0.0}), std::max({low.y, high.y, 0.0}),
                                        std::max({low.z, high.z, 0.0}));
    if (nearest <= squared_reach) {
      const double farthest =
          squared_norm(std::min(low.x, high.x), std::min(low.y, high.y), std::min(low.z, high.z));
      if (farthest <= squared_reach) {
        whole(node);
      } else if (node.right == 0) {
        leaf(node);
      } else {
        stack[depth++] = node.right;
        ++at;
        continue;
      }
    }
    if (depth == 0) return;
    at = stack[--depth];
  }
}

std::int64_t SampleTree::count(Vec3 c, double squared_reach) const {
  std::int64_t found = 0;
  descend(
      c, squared_reach, [&](const Node& node) { found += node.last - node.first; },
      [&](const Node& node) {
        for (auto i = static_cast<std::size_t>(node.first); i < static_cast<std::size_t>(node.last); ++i) {
          found += squared_norm(c.x - x_[i], c.y - y_[i], c.z - z_[i]) <= squared_reach ? 1 : 0;
        }
      });
  return found;
}

std::int32_t* SampleTree::find(Vec3 c, double squared_reach, std::int32_t* out) const {
  descend(
      c, squared_reach,
      [&](const Node& node) { out = std::copy(ids_.begin() + node.first, ids_.begin() + node.last, out); },
      [&](const Node& node) {
        // Every index is written, and kept by advancing: no branch to mispredict. Hence the margin.
        for (auto i = static_cast<std::size_t>(node.first); i < static_cast<std::size_t>(node.last); ++i) {
          *out = ids_[i];
          out += squared_norm(c.x - x_[i], c.y - y_[i], c.z - z_[i]) <= squared_reach ? 1 : 0;
        }
      });
  return out;
}

}  // namespace ballflow::geometry
