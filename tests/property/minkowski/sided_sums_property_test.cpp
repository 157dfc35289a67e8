// What is claimed of the sum of two solids, against points of the solids: sums of vertices and triangles, and
// of edges, of which the boundary of the sum is a part, and membership in the sum by crossing triangles.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "enclose/one_sided_balls.hpp"
#include "enclose/verify_enclosure.hpp"
#include "measure/union_measure.hpp"
#include "minkowski/sum_of_solids.hpp"
#include "power/alpha_shape.hpp"
#include "power/power_diagram.hpp"
#include "random_solids.hpp"
#include "refine/refine.hpp"
#include "search/box_tree.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Rational = CGAL::Exact_rational;

std::size_t number(const char* variable, std::size_t otherwise) {
  const char* const text = std::getenv(variable);
  return text == nullptr ? otherwise : std::stoul(text);
}
std::size_t pairs() { return number("BALLFLOW_TEST_PAIRS", 8); }
std::size_t points() { return number("BALLFLOW_TEST_POINTS", 1000); }

std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::size_t t) {
  std::array<Vec3, 3> p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
  return p;
}

/// A point of a triangle: weights in 64ths, of which some may be 0.
struct SurfacePlace {
  std::array<Vec3, 3> corners;
  std::array<int, 3> weights;

  Vec3 rounded() const {
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k) p = p + weights[k] / 64.0 * corners[k];
    return p;
  }
  Rational exact(double Vec3::*axis) const {
    Rational sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += Rational(weights[k]) * Rational(corners[k].*axis);
    return sum / 64;
  }
};

enum class On { vertex, edge, triangle };

SurfacePlace random_place(const TriangleMesh& mesh, On what, Random& random) {
  SurfacePlace place{corners_of(mesh, below(random, mesh.triangles.size())), {64, 0, 0}};
  std::rotate(place.corners.begin(), place.corners.begin() + static_cast<std::ptrdiff_t>(below(random, 3)),
              place.corners.end());
  if (what == On::vertex) return place;
  const int a = static_cast<int>(below(random, 65)), b = static_cast<int>(below(random, 65));
  if (what == On::edge)
    place.weights = {a, 64 - a, 0};
  else
    place.weights = {std::min(a, b), std::max(a, b) - std::min(a, b), 64 - std::max(a, b)};
  return place;
}

/// The vertex farthest in a direction: sums of these lie on the boundary of the sum for sure.
SurfacePlace farthest_place(const TriangleMesh& mesh, Vec3 direction) {
  SurfacePlace best{{}, {64, 0, 0}};
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3 p : mesh.vertices) {
    if (dot(p, direction) <= most) continue;
    most = dot(p, direction);
    best.corners = {p, p, p};
  }
  return best;
}

/// A ball set that tells how far points are.
class Union {
 public:
  explicit Union(const Balls& balls) : balls_(balls), tree_(balls.centers.span()) {
    tree_.set_slacks(balls.radii.span());
    for (const Vec3 c : balls.centers)
      largest_ = std::max({largest_, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
  }
  double distance_of(Vec3 p) const {
    return tree_.smallest(p, std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity(),
                          [&](std::size_t i) { return distance(p, balls_.centers[i]) - balls_.radii[i]; });
  }
  /// Exact: whether p + q lies in a ball.
  bool holds(const SurfacePlace& p, const SurfacePlace& q) const {
    const Vec3 sum = p.rounded() + q.rounded();
    const double unsure = 1e-9 * (1 + largest_);
    if (distance_of(sum) < -unsure) return true;
    bool held = false;
    const auto square = [](const Rational& x) { return Rational(x * x); };
    tree_.below(sum, unsure, [&](std::size_t i) {
      if (held || distance(sum, balls_.centers[i]) - balls_.radii[i] > unsure) return;
      const Vec3 c = balls_.centers[i];
      const Rational x = p.exact(&Vec3::x) + q.exact(&Vec3::x) - Rational(c.x),
                     y = p.exact(&Vec3::y) + q.exact(&Vec3::y) - Rational(c.y),
                     z = p.exact(&Vec3::z) + q.exact(&Vec3::z) - Rational(c.z);
      held = square(x) + square(y) + square(z) <= square(Rational(balls_.radii[i]));
    });
    return held;
  }

 private:
  const Balls& balls_;
  BoxTree tree_;
  double largest_ = 0;
};

/// Whether a point is in A + B, or no farther from it than a distance: A meets x - B, or comes as near.
class Sum {
 public:
  Sum(const TriangleMesh& a, const TriangleMesh& b)
      : a_(a), b_(b), in_a_(a, no_monitor()), in_b_(b, no_monitor()) {}

  bool holds(Vec3 x) const { return within(x, 0); }

  bool within(Vec3 x, double reach) const {
    // Either lies in the other, in part.
    for (const Vec3 q : b_.vertices)
      if (in_a_.around(x - q).number != 0) return true;
    for (const Vec3 p : a_.vertices)
      if (in_b_.around(x - p).number != 0) return true;
    for (std::size_t s = 0; s < a_.triangles.size(); ++s) {
      const auto p = corners_of(a_, s);
      Box box;
      for (const Vec3 corner : p) box.add(corner);
      for (std::size_t t = 0; t < b_.triangles.size(); ++t) {
        auto q = corners_of(b_, t);
        Box other;
        for (Vec3& corner : q) {
          corner = x - corner;
          other.add(corner);
        }
        if (apart(box, other, reach)) continue;
        if (CGAL::do_intersect(triangle(p), triangle(q))) return true;
        if (reach > 0 && squared(p, q) <= reach * reach) return true;
      }
    }
    return false;
  }

 private:
  static Kernel::Point_3 point(Vec3 p) { return {p.x, p.y, p.z}; }
  static Kernel::Triangle_3 triangle(const std::array<Vec3, 3>& p) {
    return {point(p[0]), point(p[1]), point(p[2])};
  }
  static bool apart(const Box& one, const Box& other, double reach) {
    for (const auto axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
      if (one.lower.*axis > other.upper.*axis + reach || other.lower.*axis > one.upper.*axis + reach)
        return true;
    }
    return false;
  }
  /// Of triangles that do not meet: between a corner and a triangle, or two edges.
  static double squared(const std::array<Vec3, 3>& p, const std::array<Vec3, 3>& q) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < 3; ++i) {
      least = std::min({least, CGAL::squared_distance(point(p[i]), triangle(q)),
                        CGAL::squared_distance(point(q[i]), triangle(p))});
      for (std::size_t j = 0; j < 3; ++j) {
        const Kernel::Segment_3 one(point(p[i]), point(p[(i + 1) % 3])),
            other(point(q[j]), point(q[(j + 1) % 3]));
        least = std::min(least, CGAL::squared_distance(one, other));
      }
    }
    return least;
  }

  const TriangleMesh &a_, &b_;
  WindingNumber in_a_, in_b_;
};

struct Side {
  Balls balls;
  Enclosure enclosure;
};

Side side_of(const TriangleMesh& mesh, const Balls& few, SumMode mode) {
  Side side{few, {}};
  if (mode != SumMode::balanced)
    side.balls =
        one_sided_balls(mesh, few, {.side = mode == SumMode::inner ? BallSide::inner : BallSide::outer});
  side.enclosure = verify_enclosure(mesh, side.balls, {.on_open = OnOpen::expect});
  return side;
}

Vec3 random_direction(Random& random) {
  Vec3 u;
  do {
    u = {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
  } while (!(length(u) > 0.1 && length(u) < 1));
  return 1 / length(u) * u;
}

TEST(sums_of_random_solids, are_bounded_as_the_report_says) {
  std::size_t outside_balanced = 0;
  double closest_gap = 0, closest_excess = 0;
  for (std::size_t pair = 0; pair < pairs(); ++pair) {
    SCOPED_TRACE("pair " + std::to_string(pair));
    Random random(1000 + pair);
    const TriangleMesh a = random_solid(random), b = random_solid(random);
    const Balls few_a = few_balls(a, 150, between(random, 0.5, 3), pair),
                few_b = few_balls(b, 100, between(random, 0.5, 3), pair);
    // The same points for all modes.
    std::vector<std::array<SurfacePlace, 2>> sums;
    for (std::size_t k = 0; k < points(); ++k) {
      const Vec3 u = random_direction(random);
      switch (k % 4) {
        case 0:
          sums.push_back({farthest_place(a, u), farthest_place(b, u)});
          break;
        case 1:
          sums.push_back({random_place(a, On::edge, random), random_place(b, On::edge, random)});
          break;
        case 2:
          sums.push_back({random_place(a, On::vertex, random), random_place(b, On::triangle, random)});
          break;
        default:
          sums.push_back({random_place(a, On::triangle, random), random_place(b, On::vertex, random)});
      }
    }
    const Sum sum(a, b);
    for (const SumMode mode : {SumMode::balanced, SumMode::inner, SumMode::outer}) {
      SCOPED_TRACE(mode == SumMode::balanced ? "balanced" : mode == SumMode::inner ? "inner" : "outer");
      const Side of_a = side_of(a, few_a, mode), of_b = side_of(b, few_b, mode);
      const MinkowskiSum found =
          sum_of_solids(of_a.balls, of_b.balls, mode, {}, {.a = &of_a.enclosure, .b = &of_b.enclosure});
      ASSERT_EQ(found.report.contains(), mode == SumMode::outer);
      ASSERT_EQ(found.report.inside(), mode == SumMode::inner);
      ASSERT_GE(found.report.error_bound, 0);
      ASSERT_GE(found.report.excess_bound, 0);
      const Union balls(found.balls);
      double farthest = 0;
      std::size_t outside = 0;
      for (const auto& [p, q] : sums) {
        if (mode == SumMode::outer) {
          outside += balls.holds(p, q) ? 0 : 1;
        } else {
          farthest = std::max(farthest, balls.distance_of(p.rounded() + q.rounded()));
          outside_balanced += mode == SumMode::balanced && !balls.holds(p, q) ? 1 : 0;
        }
      }
      EXPECT_EQ(outside, 0u);
      EXPECT_LE(farthest, found.report.error_bound * (1 + 1e-9) + 1e-12);
      if (mode != SumMode::outer) closest_gap = std::max(closest_gap, farthest / found.report.error_bound);
      // Points of the balls. Of the inner ones none is outside; of the others none too far.
      const std::size_t tries = mode == SumMode::inner ? points() / 4 : points() / 20;
      for (std::size_t k = 0; k < tries; ++k) {
        const std::size_t i = below(random, found.balls.size());
        const Vec3 x = found.balls.centers[i] + found.balls.radii[i] * random_direction(random);
        if (mode == SumMode::inner) {
          EXPECT_TRUE(sum.holds(x)) << "ball " << i;
        } else {
          EXPECT_TRUE(sum.within(x, found.report.excess_bound * (1 + 1e-9) + 1e-12)) << "ball " << i;
          if (!sum.within(x, 0.1 * found.report.excess_bound)) closest_excess = std::max(closest_excess, 0.1);
        }
      }
    }
  }
  // The claims are not idle: what is balanced leaves points out, and bounds are reached in part.
  EXPECT_GT(outside_balanced, 0u);
  EXPECT_GT(closest_gap, 0.2);
  EXPECT_GT(closest_excess, 0);
}

/// The volume of the points within `reach` of the solid, by counting a lattice.
double counted_volume(const TriangleMesh& mesh, double reach, double step) {
  const SurfaceTree surface(mesh);
  const WindingNumber winding(mesh, no_monitor());
  const Box box = bounding_box(mesh.vertices.span());
  std::int64_t count = 0;
  for (double x = box.lower.x - reach + step / 2; x < box.upper.x + reach; x += step) {
    for (double y = box.lower.y - reach + step / 2; y < box.upper.y + reach; y += step) {
      for (double z = box.lower.z - reach + step / 2; z < box.upper.z + reach; z += step) {
        const Vec3 p{x, y, z};
        count += surface.nearest(p, reach) || winding.around(p).number != 0 ? 1 : 0;
      }
    }
  }
  return static_cast<double>(count) * step * step * step;
}

TEST(offset_of_a_frame, has_its_volume_its_area_and_its_tunnels_within_the_bounds) {
  // A cube of edge 2 less a ball of radius 1.2, grown by 0.1.
  const double volume = 4.508, area = 32.92;
  const TriangleMesh frame = generate(parse_shape("frame?n=3000"));
  EXPECT_NEAR(counted_volume(frame, 0.1, 0.04), volume, 0.01 * volume);
  const Balls few = few_balls(frame, refine(frame, {}, {}, {.delta = 0.7}).points, 0.5),
              ball{{{0, 0, 0}}, {0.1}, {}, {}};
  std::array<double, 3> volumes{}, areas{};
  for (const SumMode mode : {SumMode::inner, SumMode::balanced, SumMode::outer}) {
    const Side side = side_of(frame, few, mode);
    const MinkowskiSum found = sum_of_solids(side.balls, ball, mode, {}, {.a = &side.enclosure});
    const PowerDiagram diagram = power_diagram(found.balls, {}, no_monitor());
    const SimplicialComplex complex = alpha_shape(diagram, no_monitor());
    EXPECT_EQ(complex.betti, (std::array<std::int64_t, 3>{1, 5, 0}));
    const MassProperties measured = union_measure(complex, diagram);
    const auto k = static_cast<std::size_t>(mode == SumMode::inner ? 0 : mode == SumMode::balanced ? 1 : 2);
    volumes[k] = measured.volume;
    areas[k] = measured.area;
    // What is between the boundaries is no thicker than the larger bound; a fifth more for curvature.
    const double bound = std::max(found.report.error_bound, found.report.excess_bound);
    EXPECT_LT(bound, 0.05);
    EXPECT_LE(std::abs(measured.volume - volume), 1.2 * bound * std::max(area, measured.area));
    EXPECT_LE(std::abs(measured.area - area), 0.1 * area);
  }
  EXPECT_LE(volumes[0], volume);
  EXPECT_GE(volumes[2], volume);
  EXPECT_LT(volumes[0], volumes[1]);
  EXPECT_LT(volumes[1], volumes[2]);
}

}  // namespace
}  // namespace ballflow::geometry
