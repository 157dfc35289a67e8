#include "power/power_diagram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "power/alpha_shape.hpp"
#include "power/union_betti.hpp"

namespace ballflow::geometry {
namespace {

using Cell = std::array<std::int32_t, 4>;

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Balls random_balls(std::mt19937_64& random, int n) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    centers.push_back({x, y, z});
    radii.push_back(0.05 + 0.2 * uniform(random));
  }
  return {centers, radii, {}, {}};
}

/// Balls through the corners of a grid, eight and more of which share a corner: nothing but ties.
Balls grid_balls(int n) {
  std::vector<Vec3> centers;
  for (int i = 0; i < n * n * n; ++i) {
    centers.push_back({double(i % n), double(i / n % n), double(i / n / n)});
  }
  return {centers, std::vector<double>(centers.size(), std::sqrt(0.75)), {}, {}};
}

Cell ascending(Cell cell) {
  std::sort(cell.begin(), cell.end());
  return cell;
}

double volume(const Balls& balls, const Cell& c) {
  const auto at = [&](std::size_t k) { return balls.centers[static_cast<std::size_t>(c[k])]; };
  return dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0)));
}

TEST(power_diagram, lists_cells_in_order_positively_oriented_beside_their_neighbors) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 8; ++round) {
    const Balls balls = round % 2 == 0 ? random_balls(random, 60) : grid_balls(4);
    const PowerDiagram d = power_diagram(balls, {}, no_monitor());
    ASSERT_EQ(broken_invariant(d), "");
    ASSERT_EQ(d.dimension, 3);
    for (std::size_t c = 0; c < d.size(); ++c) {
      if (c > 0) {
        EXPECT_LT(ascending(d.cells[c - 1]), ascending(d.cells[c]));
      }
      if (ascending(d.cells[c])[0] != PowerDiagram::infinite) {
        EXPECT_GT(volume(balls, d.cells[c]), 0);
      }
      for (std::size_t k = 0; k < 4; ++k) {
        // All but vertex k are vertices of the neighbor, and it knows the facet to be in the complex as well.
        const auto n = static_cast<std::size_t>(d.neighbors[c][k]);
        for (std::size_t i = 0; i < 4; ++i) {
          const bool shared =
              std::find(d.cells[n].begin(), d.cells[n].end(), d.cells[c][i]) != d.cells[n].end();
          EXPECT_EQ(shared, i != k);
        }
        const auto back =
            std::find(d.neighbors[n].begin(), d.neighbors[n].end(), static_cast<std::int32_t>(c)) -
            d.neighbors[n].begin();
        EXPECT_EQ(d.in_complex[c] >> k & 1, d.in_complex[n] >> back & 1);
      }
    }
  }
}

TEST(power_diagram, has_the_flags_of_the_alpha_shape) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 10; ++round) {
    const Balls balls = random_balls(random, 20 + 20 * round);
    const PowerDiagram d = power_diagram(balls, {}, no_monitor());
    const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
    std::size_t tetrahedra = 0, facets = 0;
    for (std::size_t c = 0; c < d.size(); ++c) {
      const bool listed =
          std::binary_search(complex.tetrahedra.begin(), complex.tetrahedra.end(), ascending(d.cells[c]));
      EXPECT_EQ((d.in_complex[c] & PowerDiagram::whole) != 0, listed);
      tetrahedra += listed ? 1 : 0;
      for (std::size_t k = 0; k < 4; ++k) {
        std::array<std::int32_t, 3> facet{d.cells[c][(k + 1) & 3], d.cells[c][(k + 2) & 3],
                                          d.cells[c][(k + 3) & 3]};
        std::sort(facet.begin(), facet.end());
        const bool triangle = std::binary_search(complex.triangles.begin(), complex.triangles.end(), facet);
        EXPECT_EQ((d.in_complex[c] >> k & 1) != 0, triangle);
        facets += triangle ? 1 : 0;
      }
    }
    EXPECT_EQ(tetrahedra, complex.tetrahedra.size());
    EXPECT_EQ(facets, 2 * complex.triangles.size());
  }
}

TEST(power_diagram, does_not_depend_on_the_order_of_the_balls_but_for_their_numbers) {
  std::mt19937_64 random(3);
  const Balls balls = random_balls(random, 80);
  std::vector<std::int32_t> order(balls.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::int32_t>(i);
  std::shuffle(order.begin(), order.end(), random);
  const PowerDiagram a = power_diagram(balls, {}, no_monitor());
  const PowerDiagram b = power_diagram(select(balls, order), {}, no_monitor());
  std::vector<Cell> expected, found;
  for (const Cell& cell : a.cells) expected.push_back(ascending(cell));
  for (Cell cell : b.cells) {
    for (std::int32_t& ball : cell) ball = ball < 0 ? ball : order[static_cast<std::size_t>(ball)];
    found.push_back(ascending(cell));
  }
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, expected);
}

TEST(power_diagram, of_polar_balls_keeps_the_tolerance_it_was_made_with) {
  const Balls balls = grid_balls(3);
  const PowerDiagram d = power_diagram(balls, {AlphaTolerance::polar}, no_monitor());
  EXPECT_GT(d.delta, 0);
  EXPECT_EQ(d.weights[0], balls.radii[0] * balls.radii[0] + d.delta);
  EXPECT_EQ(alpha_shape(d, no_monitor()).delta, d.delta);
  EXPECT_THROW(check_diagram_of(d, balls), InputError);
  EXPECT_NO_THROW(check_diagram_of(power_diagram(balls, {}, no_monitor()), balls));
  EXPECT_THROW(check_diagram_of(d, alpha_shape(balls, {}, no_monitor())), InputError);
}

TEST(power_diagram, of_few_balls_has_few_dimensions) {
  EXPECT_EQ(power_diagram({}, {}, no_monitor()).dimension, -1);
  EXPECT_EQ(broken_invariant(power_diagram({}, {}, no_monitor())), "");
  std::vector<Vec3> centers;
  const Vec3 corners[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int n = 1; n <= 4; ++n) {
    centers.push_back(corners[n - 1]);
    const Balls balls{centers, std::vector<double>(centers.size(), 0.6), {}, {}};
    const PowerDiagram d = power_diagram(balls, {}, no_monitor());
    EXPECT_EQ(broken_invariant(d), "");
    EXPECT_EQ(d.dimension, n - 1);
    EXPECT_EQ(union_betti(d, no_monitor()), alpha_shape(balls, {}, no_monitor()).betti);
  }
}

TEST(power_diagram, says_what_is_broken) {
  const PowerDiagram good = power_diagram(grid_balls(2), {}, no_monitor());
  PowerDiagram bad = good;
  std::vector<Cell> cells(good.cells.begin(), good.cells.end());
  cells[3][1] = 99;
  bad.cells = cells;
  EXPECT_NE(broken_invariant(bad).find("ball 99 of 8"), std::string::npos);
  bad = good;
  std::vector<Cell> neighbors(good.neighbors.begin(), good.neighbors.end());
  neighbors[0][0] = static_cast<std::int32_t>(good.size());
  bad.neighbors = neighbors;
  EXPECT_NE(broken_invariant(bad).find("cell 0"), std::string::npos);
  bad = good;
  bad.in_complex = std::vector<std::uint8_t>(good.size() - 1);
  EXPECT_NE(broken_invariant(bad).find("flags"), std::string::npos);
  bad = good;
  std::vector<std::uint8_t> flags(good.size());
  flags[0] = PowerDiagram::whole;  // an infinite cell
  bad.in_complex = flags;
  EXPECT_NE(broken_invariant(bad).find("infinite"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
