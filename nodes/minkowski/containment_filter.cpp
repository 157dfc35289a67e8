#include "minkowski/containment_filter.hpp"

#include <algorithm>
#include <limits>

namespace ballflow::geometry {
namespace {

constexpr double nothing = -std::numeric_limits<double>::infinity();

}  // namespace

ContainmentFilter::ContainmentFilter(const Box& box, double voxels) : lower_(box.lower) {
  const std::array<double, 3> edges{box.upper.x - box.lower.x, box.upper.y - box.lower.y,
                                    box.upper.z - box.lower.z};
  if (box.longest_edge() > 0) {
    // The finest grid of cubes that is small enough; flat boxes have one layer.
    edge_ = box.longest_edge();
    for (double finer = edge_;; finer *= 0.9375) {
      Index size{};
      double count = 1;
      for (std::size_t k = 0; k < 3; ++k) {
        size[k] = static_cast<std::size_t>(edges[k] / finer) + 1;
        count *= static_cast<double>(size[k]);
      }
      if (count > voxels) break;
      edge_ = finer;
      size_ = size;
    }
  }
  inverse_ = 1 / edge_;
  stride_ = {size_[1] * size_[2], size_[2], 1};
  entries_.assign(size_[0] * stride_[0], Entry{{}, nothing});
}

ContainmentFilter::Index ContainmentFilter::index_of(Vec3 p) const {
  const Vec3 q = inverse_ * (p - lower_);
  const auto index = [this](double x, std::size_t axis) {
    return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(size_[axis] - 1)));
  };
  return {index(q.x, 0), index(q.y, 1), index(q.z, 2)};
}

Vec3 ContainmentFilter::center_of(const Index& index) const {
  const auto middle = [](std::size_t i) { return static_cast<double>(i) + 0.5; };
  return lower_ + edge_ * Vec3{middle(index[0]), middle(index[1]), middle(index[2])};
}

void ContainmentFilter::Entry::improve(const Ball& other, Vec3 voxel_center) {
  if (other.radius <= depth) return;
  const double other_depth = other.radius - distance(other.center, voxel_center);
  if (other_depth > depth) *this = {other, other_depth};
}

void ContainmentFilter::offer(const Ball& ball) {
  const Index at = index_of(ball.center);
  entries_[at[0] * stride_[0] + at[1] * stride_[1] + at[2]].improve(ball, center_of(at));
}

void ContainmentFilter::merge(const ContainmentFilter& later) {
  for (std::size_t i = 0; i < entries_.size(); ++i) entries_[i].improve(later.entries_[i]);
}

void ContainmentFilter::spread(Monitor& monitor) {
  Lookout look(monitor);
  const auto sweep = [&](bool forward) {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      look(8);
      const std::size_t voxel = forward ? i : entries_.size() - 1 - i;
      const Index at{voxel / stride_[0], voxel / stride_[1] % size_[1], voxel % size_[2]};
      const Vec3 center = center_of(at);
      for (std::size_t k = 0; k < 3; ++k) {
        if (forward ? at[k] == 0 : at[k] + 1 == size_[k]) continue;
        const Entry& from = entries_[forward ? voxel - stride_[k] : voxel + stride_[k]];
        if (from.depth != nothing) entries_[voxel].improve(from.ball, center);
      }
    }
  };
  sweep(true);
  sweep(false);
}

bool ContainmentFilter::contains(const Ball& ball) const {
  const auto inside = [&ball](const Entry& entry) {
    // Less by far more than what is rounded here.
    const double room = (entry.ball.radius - ball.radius) - 0x1p-40 * entry.ball.radius;
    return room > 0 && squared_distance(ball.center, entry.ball.center) < room * room;
  };
  const Index at = index_of(ball.center);
  const std::size_t voxel = at[0] * stride_[0] + at[1] * stride_[1] + at[2];
  if (inside(entries_[voxel])) return true;
  for (std::size_t k = 0; k < 3; ++k) {
    if (at[k] > 0 && inside(entries_[voxel - stride_[k]])) return true;
    if (at[k] + 1 < size_[k] && inside(entries_[voxel + stride_[k]])) return true;
  }
  return false;
}

}  // namespace ballflow::geometry
