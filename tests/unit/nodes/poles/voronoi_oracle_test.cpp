// Poles against all empty circumspheres of four samples, in rational arithmetic.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "poles/voronoi_diagram.hpp"
#include "voronoi_cases.hpp"

namespace ballflow {
namespace {

using namespace voronoi_cases;
using Rational = CGAL::Gmpq;
using Exact = CGAL::Simple_cartesian<Rational>;

// An independent construction: all circumspheres of four points without a point inside, in rational
// arithmetic.
struct BruteVertex {
  Vec3 center;
  double radius;
  std::vector<std::int32_t> samples;
};

std::vector<BruteVertex> brute_force_vertices(const PointSet& sample) {
  std::vector<Exact::Point_3> points;
  for (const Vec3& p : sample.points) points.emplace_back(p.x, p.y, p.z);
  const auto n = static_cast<std::int32_t>(points.size());
  using Inexact = CGAL::Exact_predicates_inexact_constructions_kernel;  // its predicates are exact
  std::vector<Inexact::Point_3> doubles;
  for (const Vec3& p : sample.points) doubles.emplace_back(p.x, p.y, p.z);
  std::set<std::vector<std::int32_t>> seen;
  std::vector<BruteVertex> vertices;
  for (std::int32_t a = 0; a < n; ++a) {
    for (std::int32_t b = a + 1; b < n; ++b) {
      for (std::int32_t c = b + 1; c < n; ++c) {
        for (std::int32_t d = c + 1; d < n; ++d) {
          const auto& p = doubles;
          if (CGAL::coplanar(p[index(a)], p[index(b)], p[index(c)], p[index(d)])) continue;
          std::vector<std::int32_t> on;
          bool empty = true;
          for (std::int32_t e = 0; e < n && empty; ++e) {
            const auto side =
                CGAL::side_of_bounded_sphere(p[index(a)], p[index(b)], p[index(c)], p[index(d)], p[index(e)]);
            if (side == CGAL::ON_BOUNDED_SIDE) empty = false;
            if (side == CGAL::ON_BOUNDARY) on.push_back(e);
          }
          if (!empty || !seen.insert(on).second) continue;
          const Exact::Point_3 center =
              CGAL::circumcenter(points[index(a)], points[index(b)], points[index(c)], points[index(d)]);
          const Rational squared = CGAL::squared_distance(center, points[index(a)]);
          vertices.push_back(
              {{CGAL::to_double(center.x()), CGAL::to_double(center.y()), CGAL::to_double(center.z())},
               std::sqrt(CGAL::to_double(squared)),
               on});
        }
      }
    }
  }
  return vertices;
}

// Outward normals of all planes through s that support the convex hull in three points; none inside the hull.
std::vector<Vec3> hull_normals(const PointSet& sample, std::int32_t s) {
  using K = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<K::Point_3> p;
  for (const Vec3& v : sample.points) p.emplace_back(v.x, v.y, v.z);
  std::vector<Vec3> normals;
  for (std::size_t a = 0; a < p.size(); ++a) {
    for (std::size_t b = 0; b < p.size(); ++b) {
      if (CGAL::collinear(p[index(s)], p[a], p[b])) continue;
      bool above = false;
      for (std::size_t c = 0; c < p.size() && !above; ++c) {
        above = CGAL::orientation(p[index(s)], p[a], p[b], p[c]) == CGAL::POSITIVE;
      }
      if (above) continue;
      const Vec3 from = sample.points[index(s)];
      const Vec3 normal = cross(sample.points[a] - from, sample.points[b] - from);
      normals.push_back(1 / length(normal) * normal);
    }
  }
  return normals;
}

// Adds how many poles could be compared.
void compare_with_brute_force(const PointSet& sample, int& compared) {
  const std::vector<BruteVertex> vertices = brute_force_vertices(sample);
  const PoleSet poles = poles_of(sample);
  const geometry::Box box = geometry::bounding_box(sample.points.span());
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  // The documented claim: far-away points are 10 box edges away, other vertices than those whose ball reaches
  // there are untouched.
  const auto untouched = [&](const BruteVertex& v) {
    return distance(v.center, middle) + v.radius < 9.9 * box.longest_edge();
  };
  for (const std::size_t i : bounded(poles)) {
    const auto match = std::find_if(vertices.begin(), vertices.end(), [&](const BruteVertex& v) {
      return v.samples == defining_samples_of(poles, i);
    });
    EXPECT_NE(match, vertices.end()) << "pole " << i << " is no Voronoi vertex of the sample";
    if (match == vertices.end()) continue;
    EXPECT_LT(distance(match->center, poles.centers[i]), 1e-9 * (1 + match->radius));
    EXPECT_NEAR(match->radius, poles.radii[i], 1e-9 * (1 + match->radius));
  }
  for (std::int32_t s = 0; s < static_cast<std::int32_t>(sample.points.size()); ++s) {
    const Vec3 p = sample.points[index(s)];
    const auto pair = poles.sample_poles[index(s)];
    std::vector<const BruteVertex*> cell;
    bool all_untouched = true;
    for (const BruteVertex& v : vertices) {
      if (!std::binary_search(v.samples.begin(), v.samples.end(), s)) continue;
      if (untouched(v)) {
        cell.push_back(&v);
      } else {
        all_untouched = false;
      }
    }
    // The radius is the distance: it identifies a pole up to ties, which any of the equals may win.
    const auto farthest = [&](auto accept) {
      double best = -1;
      for (const BruteVertex* v : cell) {
        if (accept(*v)) best = std::max(best, v->radius);
      }
      return best;
    };
    const std::vector<Vec3> normals = hull_normals(sample, s);
    if (!normals.empty()) {
      EXPECT_EQ(poles.unbounded[index(pair[0])], 1) << "sample " << s << " is on the convex hull";
      // Whatever the mean outward direction is: vertices well behind all supporting planes are behind.
      const double sure = farthest([&](const BruteVertex& v) {
        return std::all_of(normals.begin(), normals.end(),
                           [&](Vec3 n) { return dot(v.center - p, n) < -0.3 * v.radius; });
      });
      if (sure < 0) continue;
      ASSERT_GE(pair[1], 0);
      EXPECT_EQ(poles.unbounded[index(pair[1])], 0);
      EXPECT_GE(poles.radii[index(pair[1])], sure - 1e-9);
      ++compared;
      continue;
    }
    if (!all_untouched) continue;
    EXPECT_EQ(poles.unbounded[index(pair[0])], 0) << "sample " << s << " is inside the convex hull";
    EXPECT_NEAR(poles.radii[index(pair[0])], farthest([](const BruteVertex&) { return true; }), 1e-9);
    ASSERT_GE(pair[1], 0);
    const Vec3 outwards = poles.centers[index(pair[0])] - p;
    // Vertices at a right angle up to rounding may count or not.
    const double slack = 1e-9 * length(outwards);
    const double sure = farthest([&](const BruteVertex& v) { return dot(v.center - p, outwards) < -slack; });
    const double most = farthest([&](const BruteVertex& v) { return dot(v.center - p, outwards) < slack; });
    EXPECT_GE(poles.radii[index(pair[1])], sure - 1e-9);
    EXPECT_LE(poles.radii[index(pair[1])], most + 1e-9);
    compared += 2;
  }
}

// Candidates are the vertices behind first poles that second poles are not opposite to.
void compare_candidates_with_brute_force(const PointSet& sample, int& compared) {
  const PoleSet poles = poles_of(sample);
  const std::vector<std::uint8_t> is_pole = geometry::is_pole(poles);
  std::set<std::vector<std::int32_t>> candidates, listed;
  for (const std::size_t i : bounded(poles)) {
    listed.insert(defining_samples_of(poles, i));
    if (is_pole[i] == 0) candidates.insert(defining_samples_of(poles, i));
  }
  const geometry::Box box = geometry::bounding_box(sample.points.span());
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  for (const BruteVertex& v : brute_force_vertices(sample)) {
    if (distance(v.center, middle) + v.radius > 9.9 * box.longest_edge()) continue;
    bool expected = false, doubtful = false;
    for (const std::int32_t s : v.samples) {
      const Vec3 p = sample.points[index(s)];
      const auto& own = poles.sample_poles[index(s)];
      const Vec3 first = poles.centers[index(own[0])] - p, second = poles.centers[index(own[1])] - p;
      const double angle = std::acos(dot(first, second) / (length(first) * length(second)));
      const double behind = dot(v.center - p, first) / (length(v.center - p) * length(first));
      if (std::abs(std::cos(angle) + 0.75) < 1e-9 || std::abs(behind) < 1e-9) doubtful = true;
      if (angle < std::acos(-0.75) && behind < 0) expected = true;
    }
    if (doubtful) continue;
    if (expected) {
      EXPECT_TRUE(listed.count(v.samples) == 1) << "a vertex of radius " << v.radius << " is missing";
    } else {
      EXPECT_TRUE(candidates.count(v.samples) == 0) << "a vertex of radius " << v.radius << " is too much";
    }
    if (expected) ++compared;
  }
}

TEST(voronoi_poles, come_with_candidates_where_they_are_not_opposite) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    compare_candidates_with_brute_force(random_points(seed, 30), compared);
    compare_candidates_with_brute_force(random_lattice_points(seed, 26, 3), compared);
  }
  EXPECT_GT(compared, 100);
}

TEST(voronoi_poles, are_those_of_all_empty_circumspheres) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) compare_with_brute_force(random_points(seed, 30), compared);
  EXPECT_GT(compared, 100);
}

TEST(voronoi_poles, are_those_of_all_empty_circumspheres_of_degenerate_points) {
  int compared = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    compare_with_brute_force(random_lattice_points(seed, 26, 3), compared);
  }
  EXPECT_GT(compared, 60);
}

TEST(voronoi_poles, of_flat_cells_are_right_to_the_last_digits) {
  // Tetrahedra from flat to very flat, and the centres of their spheres by rational numbers.
  for (int k = 12; k <= 24; ++k) {
    const double h = std::ldexp(1.0, -k);
    const std::vector<Vec3> points = {{1, 0, 0}, {-1, 0.25, 0}, {0.125, 1, 0}, {-0.25, -1, h}};
    const geometry::VoronoiDiagram diagram = geometry::voronoi_diagram({points, {}}, 1e10);
    // |x - p|^2 is the same for all four: three linear equations, solved by Cramer's rule.
    std::array<std::array<Rational, 4>, 3> row;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = points[0], q = points[i + 1];
      const auto square = [](const Vec3& v) {
        return Rational(v.x) * Rational(v.x) + Rational(v.y) * Rational(v.y) + Rational(v.z) * Rational(v.z);
      };
      row[i] = {2 * (Rational(q.x) - Rational(p.x)), 2 * (Rational(q.y) - Rational(p.y)),
                2 * (Rational(q.z) - Rational(p.z)), square(q) - square(p)};
    }
    const auto determinant = [&](std::size_t x, std::size_t y, std::size_t z) -> Rational {
      return row[0][x] * (row[1][y] * row[2][z] - row[2][y] * row[1][z]) -
             row[1][x] * (row[0][y] * row[2][z] - row[2][y] * row[0][z]) +
             row[2][x] * (row[0][y] * row[1][z] - row[1][y] * row[0][z]);
    };
    const Rational all = determinant(0, 1, 2);
    const std::array<Rational, 3> center = {determinant(3, 1, 2) / all, determinant(0, 3, 2) / all,
                                            determinant(0, 1, 3) / all};
    const double radius =
        std::sqrt(CGAL::to_double(center[0] * center[0] + center[1] * center[1] + center[2] * center[2]));
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < diagram.size(); ++c) {
      if (!std::all_of(diagram.sites[c].begin(), diagram.sites[c].end(),
                       [&](std::int32_t site) { return diagram.is_sample(site); })) {
        continue;
      }
      const Vec3 got = diagram.centers[c];
      // Differences in rational numbers: the last digits count.
      const double off = std::max({std::abs(CGAL::to_double(Rational(got.x) - center[0])),
                                   std::abs(CGAL::to_double(Rational(got.y) - center[1])),
                                   std::abs(CGAL::to_double(Rational(got.z) - center[2]))});
      nearest = std::min(nearest, off);
    }
    // Flat ones are computed in pairs of doubles: nothing is lost but the last rounding.
    const bool flat = h * h < 1e-9;
    EXPECT_LE(nearest, (flat ? 0x1p-52 : 1e-10) * radius) << "height 2^-" << k;
  }
}

}  // namespace
}  // namespace ballflow
