#include "mesh/crossings.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
using Ends = std::pair<std::int32_t, std::int32_t>;

bool cross(std::span<const std::array<double, 2>> points, const Ends& a, const Ends& b) {
  const auto point = [&](std::int32_t i) {
    const auto [x, y] = points[static_cast<std::size_t>(i)];
    return Point(x, y);
  };
  if (a.first != b.first && a.first != b.second && a.second != b.first && a.second != b.second) {
    return CGAL::do_intersect(Kernel::Segment_2(point(a.first), point(a.second)),
                              Kernel::Segment_2(point(b.first), point(b.second)));
  }
  // With a common end they may only lie on each other.
  const std::int32_t common = a.first == b.first || a.first == b.second ? a.first : a.second;
  const Point o = point(common), u = point(a.first == common ? a.second : a.first),
              v = point(b.first == common ? b.second : b.first);
  return CGAL::collinear(o, u, v) && !CGAL::collinear_are_ordered_along_line(u, o, v);
}

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossings(std::span<const std::array<double, 2>> points,
                                                           std::span<const Ends> segments, std::size_t most,
                                                           Monitor& monitor) {
  struct Range {
    std::size_t segment = 0;
    double low = 0, high = 0;  // x
  };
  std::vector<Range> ranges;
  ranges.reserve(segments.size());
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const double a = points[static_cast<std::size_t>(segments[k].first)][0],
                 b = points[static_cast<std::size_t>(segments[k].second)][0];
    ranges.push_back({k, std::min(a, b), std::max(a, b)});
  }
  std::sort(ranges.begin(), ranges.end(), [](const Range& a, const Range& b) {
    return std::pair(a.low, a.segment) < std::pair(b.low, b.segment);
  });
  std::vector<std::pair<std::size_t, std::size_t>> found;
  Lookout look(monitor);
  for (std::size_t s = 0; s < ranges.size(); ++s) {
    for (std::size_t t = s + 1; t < ranges.size() && ranges[t].low <= ranges[s].high; ++t) {
      look(16);
      const std::size_t a = ranges[s].segment, b = ranges[t].segment;
      if (!cross(points, segments[a], segments[b])) continue;
      found.emplace_back(a, b);
      if (found.size() >= most) return found;
    }
  }
  return found;
}

}  // namespace ballflow::geometry
