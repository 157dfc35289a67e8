#include "prior/closest_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "prior/procrustes.hpp"

namespace ballflow::geometry {
namespace {

/// A point of the moved cloud, one of the target, and how far they are apart after the transform.
struct Pair {
  double distance;
  std::size_t moved, target;
  bool operator<(const Pair& other) const {
    if (distance != other.distance) return distance < other.distance;
    return moved != other.moved ? moved < other.moved : target < other.target;
  }
};

void keep_nearest(std::vector<Pair>& pairs, double keep) {
  const auto count = static_cast<std::size_t>(std::ceil(keep * static_cast<double>(pairs.size())));
  if (count >= pairs.size()) return;
  std::nth_element(pairs.begin(), pairs.begin() + static_cast<std::ptrdiff_t>(count), pairs.end());
  pairs.resize(count);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return a.moved != b.moved ? a.moved < b.moved : a.target < b.target;
  });
}

std::vector<Pair> forward_pairs(const ShapePose& pose, const Cloud& moved, const Cloud& target, double keep) {
  std::vector<Pair> pairs;
  pairs.reserve(moved.points.size());
  for (std::size_t i = 0; i < moved.points.size(); ++i) {
    const Cloud::Nearest near = target.nearest(transformed(pose, moved.points[i]));
    pairs.push_back({near.distance, i, near.index});
  }
  keep_nearest(pairs, keep);
  return pairs;
}

std::vector<Pair> backward_pairs(const ShapePose& pose, const Cloud& moved, const Cloud& target,
                                 double keep) {
  std::vector<Pair> pairs;
  pairs.reserve(target.points.size());
  const ShapePose back = inverse(pose);
  for (std::size_t j = 0; j < target.points.size(); ++j) {
    const Cloud::Nearest near = moved.nearest(transformed(back, target.points[j]));
    pairs.push_back({pose.scale * near.distance, near.index, j});
  }
  keep_nearest(pairs, keep);
  return pairs;
}

double root_mean_square(const std::vector<Pair>& pairs) {
  double sum = 0;
  for (const Pair& pair : pairs) sum += pair.distance * pair.distance;
  return pairs.empty() ? 0 : std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace

double residual_of(const ShapePose& pose) {
  return std::sqrt(pose.forward * pose.forward + pose.backward * pose.backward);
}

void measure(ShapePose& pose, const Cloud& moved, const Cloud& target, double keep, bool both_ways) {
  pose.forward = root_mean_square(forward_pairs(pose, moved, target, keep));
  pose.backward = both_ways ? root_mean_square(backward_pairs(pose, moved, target, keep)) : 0;
}

ShapePose iterate_closest_points(const Cloud& moved, const Cloud& target, const ShapePose& start,
                                 const ClosestPointsOptions& options, Monitor& monitor) {
  ShapePose pose = start;
  double last = -1;
  std::vector<Vec3> from, to;
  std::vector<double> weights;
  for (int step = 0; step < options.most_steps; ++step) {
    if (monitor.cancelled()) throw Cancelled();
    std::vector<Pair> pairs = forward_pairs(pose, moved, target, options.keep);
    const std::size_t forward = pairs.size();
    double cost = root_mean_square(pairs);
    cost *= cost;
    if (options.both_ways) {
      const std::vector<Pair> others = backward_pairs(pose, moved, target, options.keep);
      const double other = root_mean_square(others);
      cost += other * other;
      pairs.insert(pairs.end(), others.begin(), others.end());
    }
    if (last >= 0 && std::abs(last - cost) <= options.stop * last) break;
    last = cost;
    from.clear();
    to.clear();
    weights.clear();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      from.push_back(moved.points[pairs[k].moved]);
      to.push_back(target.points[pairs[k].target]);
      weights.push_back(1 / static_cast<double>(k < forward ? forward : pairs.size() - forward));
    }
    pose = labelled_pose(from, to, weights, {options.similarity, start.mirrored != 0});
  }
  measure(pose, moved, target, options.keep, options.both_ways);
  return pose;
}

}  // namespace ballflow::geometry
