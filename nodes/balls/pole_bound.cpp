#include "balls/pole_bound.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <limits>
#include <string>

#include "search/box_tree.hpp"

namespace ballflow::geometry {

std::vector<double> pole_bounds(const Balls& balls, const LocalFeatureSize& sizes,
                                std::span<const double> enough, const PoleBoundOptions& options,
                                Monitor& monitor) {
  if (!(options.r > 0 && options.r <= 0.08)) {
    throw InputError("r is " + std::to_string(options.r),
                     "the bound is proved for 0 < r <= 0.08: use 0.08 unless the sample is denser");
  }
  const double lost =
      options.constant == PoleBoundConstant::safe ? 2 * LocalFeatureSize::at_most : LocalFeatureSize::at_most;
  const double c = LocalFeatureSize::discrete_at_least - lost * options.r / (1 - options.r);
  std::vector<double> offsets, slacks;
  for (std::size_t s = 0; s < sizes.points.size(); ++s) {
    offsets.push_back(c * sizes.pole_distances[s]);
    slacks.push_back(-offsets.back());
  }
  monitor.step(0.1);
  BoxTree tree(sizes.points.span());
  tree.set_slacks(slacks);
  monitor.step(0.3);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> bounds(balls.size(), infinity);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, balls.size(), 256), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vec3 p = balls.centers[i];
      const auto value = [&](std::size_t s) { return distance(p, sizes.points[s]) + offsets[s]; };
      const double bound = (1 - 0x1p-40) * tree.smallest(p, (1 + 0x1p-39) * enough[i], -infinity, value);
      if (bound < enough[i]) bounds[i] = bound;
    }
  });
  monitor.step(1);
  return bounds;
}

}  // namespace ballflow::geometry
