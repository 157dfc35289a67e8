#include "axis/grown_sites.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// A union of balls with its sites.
struct Sites {
  SimplicialComplex complex;
  GrownBalls balls;
  SimplicialComplex grown;
  GrownSites sites;

  explicit Sites(const Balls& of)
      : complex(alpha_shape(of, {}, no_monitor())),
        balls(complex.centers.span(), complex.weights.span()),
        grown(grown_complex(balls, no_monitor())),
        sites(grown, balls, no_monitor()) {}
};

Balls random_balls(std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto unit = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < 40; ++i) {
    centers.push_back({unit(), unit(), unit()});
    radii.push_back(0.2 + 0.2 * unit());
  }
  return {centers, radii, {}, {}};
}

template <std::size_t N>
std::array<std::int32_t, N> some_sites(std::mt19937_64& engine, std::size_t n) {
  std::set<std::int32_t> chosen;
  while (chosen.size() < N) chosen.insert(static_cast<std::int32_t>(engine() % n));
  std::array<std::int32_t, N> out{};
  std::copy(chosen.begin(), chosen.end(), out.begin());
  std::shuffle(out.begin(), out.end(), engine);
  return out;
}

TEST(grown_sites, see_what_cgal_sees_where_rounding_changes_nothing) {
  const Sites s(random_balls(1));
  const UnionVertices& table = s.sites.table();
  const auto point = [&](std::int32_t w) {
    const Vec3 p = table.points[static_cast<std::size_t>(w)];
    return Kernel::Point_3(p.x, p.y, p.z);
  };
  std::mt19937_64 engine(2);
  int orientations = 0, spheres = 0;
  for (int i = 0; i < 5000; ++i) {
    const auto four = some_sites<4>(engine, table.size());
    const int turn = CGAL::orientation(point(four[0]), point(four[1]), point(four[2]), point(four[3]));
    const int found = s.sites.orientation(four);
    orientations += found != 0;
    EXPECT_TRUE(found == 0 || found == turn);
    auto five = some_sites<5>(engine, table.size());
    const int side = CGAL::side_of_oriented_sphere(point(five[0]), point(five[1]), point(five[2]),
                                                   point(five[3]), point(five[4]));
    const int found_side = s.sites.side_of_oriented_sphere(five);
    spheres += found_side != 0;
    EXPECT_TRUE(found_side == 0 || found_side == side);
  }
  EXPECT_GT(orientations, 4000);
  EXPECT_GT(spheres, 4000);
}

TEST(grown_sites, on_one_sphere_are_cospherical) {
  const Sites s(random_balls(3));
  const UnionVertices& table = s.sites.table();
  std::map<std::int32_t, std::vector<std::int32_t>> on;
  for (std::size_t w = 0; w < table.size(); ++w) {
    for (const std::int32_t ball : table.balls_of(w)) on[ball].push_back(static_cast<std::int32_t>(w));
  }
  int checked = 0;
  for (const auto& [ball, sites] : on) {
    if (sites.size() < 5) continue;
    ++checked;
    EXPECT_EQ(s.sites.side_of_oriented_sphere({sites[0], sites[1], sites[2], sites[3], sites[4]}), 0);
  }
  EXPECT_GT(checked, 5);
}

TEST(grown_sites, of_a_tetrahedron_flatter_than_doubles_are_told_apart) {
  const double z = 1e-200;
  const Sites s(Balls{
      std::vector<Vec3>{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, z}}, std::vector<double>(4, 1.0), {}, {}});
  const UnionVertices& table = s.sites.table();
  ASSERT_EQ(table.size(), 4u + 4u) << "the vertices, and the points around them";
  std::set<Vec3> places(table.points.begin(), table.points.begin() + 4);
  EXPECT_LT(places.size(), 4u) << "they coincide in doubles";
  EXPECT_NE(s.sites.orientation({0, 1, 2, 3}), 0);
  const Vec3 middle = s.sites.circumcenter({0, 1, 2, 3});
  EXPECT_NEAR(middle.x, 0.5, 1e-15);
  EXPECT_NEAR(middle.y, 0.5, 1e-15);
  EXPECT_NEAR(middle.z, 0, 1e-15);
  for (std::int32_t w = 0; w < 4; ++w) EXPECT_EQ(s.sites.side_of_circumcenter(w, {0, 1, 2, 3}), 1);
}

TEST(grown_sites, have_delaunay_cells_that_are_empty) {
  const Sites s(random_balls(5));
  const std::vector<DelaunayCell> cells = s.sites.delaunay(no_monitor());
  const auto n = static_cast<std::int32_t>(s.sites.table().size());
  ASSERT_GT(cells.size(), 50u);
  for (const DelaunayCell& cell : cells) {
    if (!cell.finite()) continue;
    const int turn = s.sites.orientation(cell.corners);
    if (turn == 0) continue;  // of the vertices on two spheres
    for (std::int32_t w = 0; w < n; ++w) {
      if (std::find(cell.corners.begin(), cell.corners.end(), w) != cell.corners.end()) continue;
      const auto& c = cell.corners;
      EXPECT_LE(turn * s.sites.side_of_oriented_sphere({c[0], c[1], c[2], c[3], w}), 0);
    }
  }
}

TEST(grown_sites, see_which_ball_is_nearer_to_a_voronoi_vertex) {
  const Sites s(random_balls(7));
  std::size_t checked = 0;
  for (const DelaunayCell& cell : s.sites.delaunay(no_monitor())) {
    if (!cell.finite() || s.sites.orientation(cell.corners) == 0) continue;
    const Vec3 v = s.sites.circumcenter(cell.corners);
    for (std::int32_t b = 1; b < 40; ++b) {
      const double da = distance(s.balls.center(0), v), db = distance(s.balls.center(b), v);
      if (std::abs(da - db) < 1e-9 * (da + db)) continue;
      ++checked;
      EXPECT_EQ(s.sites.nearer(0, b, cell.corners), da < db);
    }
  }
  EXPECT_GT(checked, 1000u);
}

}  // namespace
}  // namespace ballflow::geometry
