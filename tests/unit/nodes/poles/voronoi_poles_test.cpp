#include "poles/voronoi_poles.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Gmpq.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "io/read_mesh.hpp"
#include "poles/voronoi_diagram.hpp"
#include "shapes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using geometry::InputError;
using geometry::PoleSet;
using geometry::voronoi_poles;
using geometry::VoronoiPolesOptions;
using test::PointSet;
using test::Vec3;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

PoleSet poles_of(const PointSet& points) {
  PoleSet poles = voronoi_poles(points, {});
  EXPECT_EQ(geometry::broken_invariant(poles), "");
  EXPECT_EQ(poles.sample_poles.size(), points.points.size());
  for (const auto& own : poles.sample_poles) EXPECT_EQ(own[2], -1);
  return poles;
}

std::vector<std::int32_t> defining_samples_of(const PoleSet& poles, std::size_t pole) {
  return {poles.defining_samples.begin() + poles.defining_offsets[pole],
          poles.defining_samples.begin() + poles.defining_offsets[pole + 1]};
}

std::vector<std::size_t> bounded(const PoleSet& poles) {
  std::vector<std::size_t> ids;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (poles.unbounded[i] == 0) ids.push_back(i);
  }
  return ids;
}

bool same(const PoleSet& a, const PoleSet& b) {
  return a.centers == b.centers && a.radii == b.radii && a.labels == b.labels && a.unbounded == b.unbounded &&
         a.defining_offsets == b.defining_offsets && a.defining_samples == b.defining_samples &&
         a.sample_poles == b.sample_poles;
}

PointSet random_points(unsigned seed, int count) {
  std::mt19937 random(seed);
  std::vector<Vec3> points;
  const auto coordinate = [&] { return static_cast<double>(random()) / 4294967296.0; };
  for (int i = 0; i < count; ++i) {
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.push_back({x, y, z});
  }
  return {points, {}};
}

// Integer coordinates from 0 to `top`: cospherical and coplanar points everywhere.
PointSet random_lattice_points(unsigned seed, int count, unsigned top) {
  std::mt19937 random(seed);
  std::set<Vec3> points;
  while (points.size() < static_cast<std::size_t>(count)) {
    const auto coordinate = [&] { return static_cast<double>(random() % (top + 1)); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    points.insert({x, y, z});
  }
  std::vector<Vec3> order(points.begin(), points.end());
  std::shuffle(order.begin(), order.end(), random);
  return {order, {}};
}

PointSet lattice(int side) {
  std::vector<Vec3> points;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      for (int z = 0; z < side; ++z) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
    }
  }
  return {points, {}};
}

TEST(voronoi_poles, of_a_cube_meet_in_its_center) {
  const PoleSet poles = poles_of(test::cube().points());
  const auto inside = bounded(poles);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_EQ(poles.centers[inside[0]], (Vec3{0, 0, 0}));
  EXPECT_EQ(poles.radii[inside[0]], std::sqrt(3.0));
  EXPECT_EQ(defining_samples_of(poles, inside[0]), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const auto& pair : poles.sample_poles) {
    EXPECT_EQ(poles.unbounded[index(pair[0])], 1);
    EXPECT_EQ(pair[1], static_cast<std::int32_t>(inside[0]));
  }
}

TEST(voronoi_poles, of_all_integer_points_of_norm_9_are_one_vertex) {
  std::vector<Vec3> points;
  for (int x = -9; x <= 9; ++x) {
    for (int y = -9; y <= 9; ++y) {
      for (int z = -9; z <= 9; ++z) {
        if (x * x + y * y + z * z == 81) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  ASSERT_EQ(points.size(), 102U);
  const PoleSet poles = poles_of({points, {}});
  const auto inside = bounded(poles);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_LT(length(poles.centers[inside[0]]), 1e-14);
  EXPECT_NEAR(poles.radii[inside[0]], 9, 1e-14);
  EXPECT_EQ(defining_samples_of(poles, inside[0]).size(), 102U);
}

TEST(voronoi_poles, of_a_lattice_are_the_centers_of_its_cells) {
  const PoleSet poles = poles_of(lattice(5));
  const auto inside = bounded(poles);
  // The corner cells are the far vertices of all samples: cells of the 4 x 4 x 4 that no sample prefers are
  // absent.
  ASSERT_GT(inside.size(), 20U);
  for (const std::size_t i : inside) {
    const Vec3 c = poles.centers[i];
    for (const double x : {c.x, c.y, c.z}) EXPECT_EQ(x - std::floor(x), 0.5);
    EXPECT_EQ(defining_samples_of(poles, i).size(), 8U);
    EXPECT_EQ(poles.radii[i], std::sqrt(0.75));
  }
}

TEST(voronoi_poles, of_a_sphere_lie_at_its_center) {
  const PoleSet poles = poles_of(test::sphere(4).points());
  for (const auto& pair : poles.sample_poles) {
    EXPECT_EQ(poles.unbounded[index(pair[0])], 1);
    EXPECT_LT(length(poles.centers[index(pair[1])]), 1e-6);
  }
}

TEST(voronoi_poles, of_a_torus_lie_near_its_core_circle) {
  const double tube = 0.3;
  const PoleSet poles = poles_of(test::torus(160, 60, tube).points());
  std::size_t near = 0;
  for (const std::size_t i : bounded(poles)) {
    const Vec3 c = poles.centers[i];
    const double from_axis = std::sqrt(c.x * c.x + c.y * c.y);
    const double to_core = std::sqrt((from_axis - 1) * (from_axis - 1) + c.z * c.z);
    if (to_core > tube) continue;  // outside the torus
    ++near;
    EXPECT_LT(to_core, 0.02);
    EXPECT_NEAR(poles.radii[i], tube, 0.02);
  }
  EXPECT_GT(near, poles.sample_poles.size() / 4);  // every inner pole belongs to at most four samples
  EXPECT_LE(near, poles.sample_poles.size());
}

// An independent construction: all circumspheres of four points without a point inside, in rational
// arithmetic.
struct BruteVertex {
  Vec3 center;
  double radius;
  std::vector<std::int32_t> samples;
};

using Rational = CGAL::Gmpq;
using Exact = CGAL::Simple_cartesian<Rational>;

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

// Poles by coordinates: what must not depend on the numbering.
auto renamed(const PoleSet& poles, const std::vector<std::int32_t>& name) {
  std::vector<std::tuple<Vec3, double, std::vector<std::int32_t>, int>> entries;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    std::vector<std::int32_t> samples;
    for (const std::int32_t s : defining_samples_of(poles, i)) samples.push_back(name[index(s)]);
    std::sort(samples.begin(), samples.end());
    entries.emplace_back(poles.centers[i], poles.radii[i], samples, poles.unbounded[i]);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::array<Vec3, 2>> pairs(poles.sample_poles.size());
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int32_t pole = poles.sample_poles[s][k];
      pairs[index(name[s])][k] = pole < 0 ? Vec3{} : poles.centers[index(pole)];
    }
  }
  return std::pair(entries, pairs);
}

void expect_independent_of_numbering(const PointSet& sample) {
  std::vector<std::int32_t> identity(sample.points.size());
  std::iota(identity.begin(), identity.end(), 0);
  std::vector<std::int32_t> name = identity;
  std::mt19937 random(7);
  std::shuffle(name.begin(), name.end(), random);
  std::vector<Vec3> permuted;
  for (const std::int32_t s : name) permuted.push_back(sample.points[index(s)]);
  EXPECT_TRUE(renamed(poles_of(sample), identity) == renamed(poles_of({permuted, {}}), name));
}

TEST(voronoi_poles, do_not_depend_on_the_numbering) {
  expect_independent_of_numbering(random_points(3, 500));
  expect_independent_of_numbering(lattice(6));
  expect_independent_of_numbering(random_lattice_points(5, 60, 5));
  expect_independent_of_numbering(test::sphere(3).points());
}

TEST(voronoi_poles, of_a_technical_model_do_not_depend_on_numbering_or_threads) {
  const auto path = test::data_file("models/fandisk.off.gz");
  if (path.empty()) GTEST_SKIP() << "models/fandisk.off.gz is not there";
  const PointSet sample = geometry::read_mesh_file(path).points;
  expect_independent_of_numbering(sample);
  const PoleSet parallel = poles_of(sample);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(same(parallel, poles_of(sample)));
}

TEST(voronoi_poles, of_cospherical_points_are_the_same_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  // Every choice is between equal distances: only the order of the vertices decides.
  for (const PointSet& sample : {lattice(12), random_lattice_points(9, 3000, 19)}) {
    const auto with_threads = [&](int threads) {
      return tbb::task_arena(threads).execute([&] { return poles_of(sample); });
    };
    const PoleSet one = with_threads(1);
    for (const int threads : {2, 4}) EXPECT_TRUE(same(with_threads(threads), one)) << threads;
  }
}

TEST(voronoi_poles, far_away_points_touch_only_unbounded_poles) {
  const PointSet sample = test::torus(60, 20, 0.4).points();
  const PoleSet near = poles_of(sample);
  const PoleSet far = voronoi_poles(sample, {.bounding_distance = 40});
  const auto inside_box = [](const PoleSet& poles) {
    std::set<std::pair<Vec3, double>> kept;
    for (std::size_t i = 0; i < poles.size(); ++i) {
      const Vec3 c = poles.centers[i];
      if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > 3) continue;
      EXPECT_EQ(poles.unbounded[i], 0);
      kept.insert({c, poles.radii[i]});
    }
    return kept;
  };
  EXPECT_EQ(inside_box(near), inside_box(far));
  EXPECT_GT(inside_box(near).size(), sample.points.size() / 2);
}

TEST(voronoi_poles, of_nearly_flat_points_are_finite) {
  std::mt19937 random(11);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) {
    const double x = static_cast<double>(random() % 100000) / 3,
                 y = static_cast<double>(random() % 100000) / 7;
    points.push_back({x, y, x / 3 + y / 7});  // a plane, up to rounding
  }
  const PoleSet poles = poles_of({points, {}});  // the invariants say that centres and radii are finite
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double tolerance = 1e-9 * poles.radii[i];
    for (const std::int32_t s : defining_samples_of(poles, i)) {
      EXPECT_NEAR(distance(poles.centers[i], points[index(s)]), poles.radii[i], tolerance);
    }
  }
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

TEST(voronoi_poles, scale_with_the_model) {
  const PointSet sample = random_points(9, 200);
  std::vector<Vec3> tiny;
  for (const Vec3& p : sample.points) tiny.push_back(0x1p-100 * p);
  const PoleSet large = poles_of(sample), small = poles_of({tiny, {}});
  EXPECT_EQ(large.sample_poles, small.sample_poles);
  for (const std::size_t i : bounded(large)) EXPECT_EQ(0x1p-100 * large.centers[i], small.centers[i]);
}

std::string refusal(std::vector<Vec3> points) {
  try {
    voronoi_poles({std::move(points), {}}, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(voronoi_poles, refuse_samples_without_voronoi_vertices) {
  EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("has 3 points"), std::string::npos);
  EXPECT_NE(
      refusal({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {.5, .25, 1}}).find("5 samples lie in one plane"),
      std::string::npos);
  EXPECT_NE(refusal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one plane"), std::string::npos);
  EXPECT_NE(refusal({{2, 2, 2}, {2, 2, 2}, {2, 2, 2}, {2, 2, 2}}).find("one plane"), std::string::npos);
}

TEST(voronoi_poles, refuse_bad_points_by_number) {
  std::vector<Vec3> points = test::cube().vertices;
  points.push_back({0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_NE(refusal(points).find("sample 8 "), std::string::npos);
  points[8] = points[2];
  EXPECT_NE(refusal(points).find("samples 2 and 8 are the same point"), std::string::npos);
  points[8] = {1e41, 0, 0};
  EXPECT_NE(refusal(points).find("[1e-40, 1e40]"), std::string::npos);
  EXPECT_THROW(voronoi_poles(test::cube().points(), {.bounding_distance = 1}), InputError);
}

TEST(voronoi_poles, stop_when_cancelled) {
  struct Impatient final : geometry::Monitor {
    int calls = 0;
    bool cancelled() override { return ++calls > 20; }
  } monitor;
  EXPECT_THROW(voronoi_poles(random_points(1, 50000), {}, monitor), geometry::Cancelled);
  EXPECT_LT(monitor.calls, 30);
}

}  // namespace
}  // namespace ballflow
