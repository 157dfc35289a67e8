#include "search/local_feature_size.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "search/neighbor_distances.hpp"

namespace ballflow::geometry {

PoleDistance::PoleDistance(const PoleSet& poles, Monitor& monitor) {
  // The two poles of Amenta and Bern: third poles depend on labels, and there are none before LabelPoles.
  std::vector<std::uint8_t> pole(poles.size());
  for (const auto& own : poles.sample_poles) {
    for (std::size_t k = 0; k < 2; ++k) {
      if (own[k] >= 0) pole[static_cast<std::size_t>(own[k])] = 1;
    }
  }
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (pole[i] != 0) poles_.push_back(poles.centers[i]);
  }
  if (poles_.empty() && !poles.sample_poles.empty()) {
    throw InputError("no sample has a pole", "the poles are damaged: compute them again");
  }
  tree_ = BoxTree(poles_, BoxTree::default_leaf_size, monitor);
}

PoleDistance::PoleDistance(std::vector<Vec3> poles, Monitor& monitor)
    : poles_(std::move(poles)), tree_(poles_, BoxTree::default_leaf_size, monitor) {}

double PoleDistance::operator()(Vec3 p) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return tree_.smallest(p, infinity, -infinity, [&](std::size_t i) { return distance(p, poles_[i]); });
}

LocalFeatureSize local_feature_size(const PointSet& sample, const PoleSet& poles, Monitor& monitor) {
  const std::size_t n = sample.points.size();
  if (poles.sample_poles.size() != n) {
    throw InputError("the poles are those of " + std::to_string(poles.sample_poles.size()) +
                         " samples, but there are " + std::to_string(n),
                     "connect the points that the poles were computed from");
  }
  LocalFeatureSize size = local_feature_size(sample, PoleDistance(poles, monitor), monitor);
  size.fewer_poles = 0;
  return size;
}

LocalFeatureSize local_feature_size(const PointSet& sample, const PoleDistance& to_pole, Monitor& monitor) {
  const std::size_t n = sample.points.size();
  monitor.step(0.3);
  std::vector<double> distances(n);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 1024), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t s = range.begin(); s != range.end(); ++s) {
      distances[s] = to_pole(sample.points[s]);
    }
  });
  for (std::size_t s = 0; s < n; ++s) {
    if (distances[s] > 0 && std::isfinite(distances[s])) continue;
    if (!std::isfinite(distances[s]))
      throw InputError("there is no pole", "connect polar balls, at least one");
    throw InputError("a pole lies at sample " + std::to_string(s),
                     "scale the model up: its features are beyond the resolution of doubles");
  }
  std::vector<double> third = neighbor_distances(sample.points, 3, monitor);
  monitor.step(1);
  LocalFeatureSize size{sample.points, std::move(distances), std::move(third)};
  size.fewer_poles = 1;
  return size;
}

}  // namespace ballflow::geometry
