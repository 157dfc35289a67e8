#include "planar/compare_outlines.hpp"

#include <CGAL/Boolean_set_operations_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_with_holes_2.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planar/ring_nesting.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Ring = CGAL::Polygon_2<Kernel>;
using Part = CGAL::Polygon_with_holes_2<Kernel>;
using Set = CGAL::Polygon_set_2<Kernel>;

void require_whole(const Polygon2& polygon, const char* name) {
  if (const std::string broken = broken_invariant(polygon); !broken.empty())
    throw InputError(std::string("input ") + name + ": " + broken, "make it again");
}

/// False, with a warning, where rings cross or touch.
bool is_simple(const Polygon2& polygon, const char* name, Monitor& monitor) {
  std::vector<RawRing> rings;
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    for (std::int64_t r = polygon.component_offsets[k]; r < polygon.component_offsets[k + 1]; ++r) {
      const auto points = polygon.ring(static_cast<std::size_t>(r));
      rings.push_back({{points.begin(), points.end()},
                       r == polygon.component_offsets[k] ? RingRole::outer : RingRole::hole,
                       std::string("input ") + name + ", ring " + std::to_string(r)});
    }
  }
  if (rings.empty()) return true;
  try {
    nest(std::move(rings), monitor);
  } catch (const InputError& error) {
    const std::string text = error.what();
    monitor.warn("areas are not known: " + text.substr(0, text.find('\n')));
    return false;
  }
  return true;
}

Set set_of(const Polygon2& polygon) {
  const auto ring = [&polygon](std::int64_t r) {
    Ring result;
    for (const Vec2 p : polygon.ring(static_cast<std::size_t>(r)))
      result.push_back(Kernel::Point_2(p.x, p.y));
    return result;
  };
  std::vector<Part> parts;
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    const std::int64_t first = polygon.component_offsets[k], last = polygon.component_offsets[k + 1];
    std::vector<Ring> holes;
    for (std::int64_t r = first + 1; r < last; ++r) holes.push_back(ring(r));
    parts.emplace_back(ring(first), holes.begin(), holes.end());
  }
  // What lies in a hole has no point in common with the part around it, so all can be joined at once.
  Set set;
  set.join(parts.begin(), parts.end());
  return set;
}

Kernel::FT area_of(const Set& set) {
  std::vector<Part> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  Kernel::FT sum = 0;
  for (const Part& part : parts) {
    sum += part.outer_boundary().area();
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) sum += hole->area();
  }
  return sum;
}

double rounded(const Kernel::FT& area) {
  CGAL::exact(area);  // so that it is rounded in the same way whatever intervals there were
  return CGAL::to_double(area);
}

struct Edges {
  std::vector<Vec2> from, to;

  explicit Edges(const Polygon2& polygon) {
    for (std::size_t r = 0; r < polygon.rings(); ++r) {
      const auto ring = polygon.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        from.push_back(ring[i]);
        to.push_back(ring[(i + 1) % ring.size()]);
      }
    }
  }
};

double distance_to_edge(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return distance(p, a + t * d);
}

struct Range {
  double at_least = 0, at_most = 0;
};

/// From the boundary of one to that of the other.
Range farthest(const Edges& one, const Edges& other, double spacing, Monitor& monitor) {
  std::vector<Box> boxes(other.from.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes[i].add(in_space(other.from[i]));
    boxes[i].add(in_space(other.to[i]));
  }
  const BoxTree tree(boxes, BoxTree::default_leaf_size, monitor);
  // The distance to a box and that to the edge in it are rounded differently: a little slack keeps the order.
  const Box all = [&] {
    Box box;
    for (const Box& b : boxes) {
      box.add(b.lower);
      box.add(b.upper);
    }
    return box;
  }();
  const double slack = 0x1p-44 * (all.longest_edge() + length(all.lower) + length(all.upper));
  BoxTree with_slack = tree;
  with_slack.set_slacks(std::vector<double>(boxes.size(), slack));
  Range range;
  Lookout look(monitor);
  const auto distance_at = [&](Vec2 p) {
    look(1024);
    return with_slack.smallest(in_space(p), INFINITY, 0.0, [&](std::int32_t i) {
      return distance_to_edge(p, other.from[static_cast<std::size_t>(i)],
                              other.to[static_cast<std::size_t>(i)]);
    });
  };
  for (std::size_t i = 0; i < one.from.size(); ++i) {
    const double whole = distance(one.from[i], one.to[i]), pieces = std::max(1.0, std::ceil(whole / spacing)),
                 piece = whole / pieces;
    double before = distance_at(one.from[i]);
    for (double k = 1; k <= pieces; ++k) {
      const double next = distance_at(one.from[i] + (k / pieces) * (one.to[i] - one.from[i]));
      range.at_least = std::max({range.at_least, before, next});
      // Between two samples the distance is below both lines of slope 1: they meet at the mean plus half.
      range.at_most = std::max(range.at_most, (before + next + piece) / 2);
      before = next;
    }
  }
  range.at_most = std::max(range.at_most, range.at_least) + slack;
  return range;
}

}  // namespace

OutlineComparison compare_outlines(const Polygon2& a, const Polygon2& b,
                                   const CompareOutlinesOptions& options, Monitor& monitor) {
  // Written so that nan fails.
  if (!(options.spacing >= 1e-5 && options.spacing <= 100))
    throw InputError("spacing is " + std::to_string(options.spacing) + " %", "take one from 0.00001 to 100");
  require_whole(a, "a");
  require_whole(b, "b");
  if ((a.components() == 0) != (b.components() == 0)) {
    throw InputError(
        std::string("input ") + (a.components() == 0 ? "a" : "b") + " is empty and the other is not",
        "there is no distance to nothing");
  }
  OutlineComparison result;
  if (a.components() == 0) return result;
  const double spacing = options.spacing / 100 * bounding_box(a).longest_edge();
  if (!((perimeter(a) + perimeter(b)) / spacing <= 0x1p26))
    throw InputError("the spacing asks for more than 2^26 samples", "take a larger one");
  monitor.step(0);
  if (is_simple(a, "a", monitor) && is_simple(b, "b", monitor)) {
    Set both = set_of(a);
    const Set set_b = set_of(b);
    const Kernel::FT area_a = area_of(both), area_b = area_of(set_b);
    monitor.step(0.3);
    both.intersection(set_b);
    monitor.step(0.8);
    const Kernel::FT shared = area_of(both);
    result.area_a = rounded(area_a);
    result.area_b = rounded(area_b);
    result.only_a = rounded(area_a - shared);
    result.only_b = rounded(area_b - shared);
  } else {
    result.area_a = result.area_b = result.only_a = result.only_b = -1;
  }
  const Edges edges_a(a), edges_b(b);
  const Range there = farthest(edges_a, edges_b, spacing, monitor),
              back = farthest(edges_b, edges_a, spacing, monitor);
  result.a_to_b_at_least = there.at_least;
  result.a_to_b_at_most = there.at_most;
  result.b_to_a_at_least = back.at_least;
  result.b_to_a_at_most = back.at_most;
  return result;
}

}  // namespace ballflow::geometry
