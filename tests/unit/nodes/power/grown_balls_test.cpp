#include "power/grown_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

Balls random_balls(std::uint64_t seed, std::size_t n, double reach) {
  std::mt19937_64 engine(seed);
  const auto unit = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    centers.push_back({unit(), unit(), unit()});
    radii.push_back(reach * (0.5 + unit()));
  }
  return {centers, radii, {}, {}};
}

std::vector<Vec3> cube() {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  return corners;
}

TEST(grown_balls, have_the_complex_of_the_balls_where_nothing_is_a_tie) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const SimplicialComplex complex = alpha_shape(random_balls(seed, 60, 0.15), {}, no_monitor());
    const GrownBalls balls(complex.centers.span(), complex.weights.span());
    const SimplicialComplex grown = grown_complex(balls, no_monitor());
    EXPECT_EQ(grown.vertices, complex.vertices);
    EXPECT_EQ(grown.edges, complex.edges);
    EXPECT_EQ(grown.triangles, complex.triangles);
    EXPECT_EQ(grown.tetrahedra, complex.tetrahedra);
  }
}

TEST(grown_balls, have_the_euler_characteristic_of_balls_that_touch) {
  for (const double radius : {0.5, std::sqrt(0.5), 0.75, 0.8660254037844386, 0.8660254037844387}) {
    const SimplicialComplex complex =
        alpha_shape({cube(), std::vector<double>(8, radius), {}, {}}, {}, no_monitor());
    const GrownBalls balls(complex.centers.span(), complex.weights.span());
    EXPECT_EQ(grown_complex(balls, no_monitor()).euler_characteristic(), complex.euler_characteristic())
        << radius;
  }
}

TEST(grown_balls, grow_by_other_amounts_that_do_not_depend_on_their_numbers) {
  std::vector<Vec3> centers = cube(), turned = centers;
  std::reverse(turned.begin(), turned.end());
  const std::vector<double> weights(8, 0.7);
  const GrownBalls balls(centers, weights), reversed(turned, weights);
  std::set<double> growths;
  for (std::int32_t i = 0; i < 8; ++i) {
    EXPECT_EQ(balls.growth(i), reversed.growth(7 - i));
    EXPECT_GE(balls.growth(i), 0x1p32);
    EXPECT_LT(balls.growth(i), 0x1p33);
    growths.insert(balls.growth(i));
    EXPECT_EQ((balls.grown_weight(i, 4096) - LongNumber(0.7, 4096)).sign(), 1);
  }
  EXPECT_EQ(growths.size(), 8u);
}

TEST(grown_balls, grow_by_less_than_the_smallest_double_makes_of_a_flat_tetrahedron) {
  const double z = 5e-324;
  const std::vector<Vec3> centers{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, z}};
  const std::vector<double> weights(4, 1.0);
  const GrownBalls balls(centers, weights);
  EXPECT_LT(balls.unit(), -4 * 1074);
  EXPECT_EQ(grown_complex(balls, no_monitor()).tetrahedra.size(), 1u);
}

TEST(grown_balls, in_a_plane_are_refused) {
  const std::vector<Vec3> centers{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const std::vector<double> weights(4, 1.0);
  EXPECT_THROW(grown_complex(GrownBalls(centers, weights), no_monitor()), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
