// Unions whose structure doubles do not show.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "homology/axis_betti.hpp"
#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

class DegenerateListener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

SimplicialComplex complex_of(const std::vector<Vec3>& centers, double radius) {
  return alpha_shape({centers, std::vector<double>(centers.size(), radius), {}, {}}, {}, no_monitor());
}

std::vector<Vec3> nearly_flat(double z) { return {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, z}}; }

double area(const MedialAxis& axis) {
  double sum = 0;
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto p = axis.polygon(i);
    const auto corner = [&](std::size_t k) { return axis.vertices[static_cast<std::size_t>(p[k])]; };
    Vec3 normal;
    for (std::size_t k = 1; k + 1 < p.size(); ++k)
      normal = normal + cross(corner(k) - corner(0), corner(k + 1) - corner(0));
    sum += 0.5 * length(normal);
  }
  return sum;
}

TEST(degenerate_axis, of_a_tetrahedron_is_there_however_flat_it_is) {
  for (int exponent = 0; exponent >= -323; --exponent) {
    const double z = std::strtod(("1e" + std::to_string(exponent)).c_str(), nullptr);
    SCOPED_TRACE(z);
    DegenerateListener listener;
    const SimplicialComplex complex = complex_of(nearly_flat(z), 1);
    ASSERT_EQ(complex.tetrahedra.size(), 1u);
    const MedialAxis axis = medial_axis(complex, {}, listener);
    EXPECT_EQ(broken_invariant(axis), "");
    EXPECT_EQ(axis_betti(axis, no_monitor()), complex.betti);
    EXPECT_TRUE(listener.warnings.empty());
    if (z > 1e-3) continue;
    EXPECT_NEAR(area(axis), 1, 2 * z + 1e-12) << "nearly the square between the centres";
    for (const Vec3 corner : nearly_flat(z))
      EXPECT_NE(std::find(axis.vertices.begin(), axis.vertices.end(), corner), axis.vertices.end());
  }
}

TEST(degenerate_axis, without_thickness_is_the_complex) {
  const SimplicialComplex complex = complex_of(nearly_flat(0), 1);
  ASSERT_EQ(complex.triangles.size(), 2u);
  const MedialAxis axis = medial_axis(complex, {}, no_monitor());
  EXPECT_EQ(axis.polygons(), 2u);
  EXPECT_EQ(area(axis), 1);
}

/// Vertices and polygons in space, for comparison up to rounding.
void expect_near(const MedialAxis& a, const MedialAxis& b) {
  ASSERT_EQ(a.vertices.size(), b.vertices.size());
  for (const Vec3 v : a.vertices) {
    double nearest = 1;
    for (const Vec3 u : b.vertices) nearest = std::min(nearest, distance(u, v));
    EXPECT_LT(nearest, 1e-9);
  }
  EXPECT_EQ(a.polygons(), b.polygons());
  EXPECT_EQ(a.polygon_vertices.size(), b.polygon_vertices.size());
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.seams.size(), b.seams.size());
  EXPECT_NEAR(area(a), area(b), 1e-9);
}

TEST(degenerate_axis, by_exact_decisions_is_that_by_doubles_where_nothing_is_degenerate) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 engine(seed);
    const auto unit = [&engine] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < 40; ++i) {
      centers.push_back({unit(), unit(), unit()});
      radii.push_back(0.1 + (seed % 2 == 0 ? 0.1 : 0.3) * unit());
    }
    const SimplicialComplex complex = alpha_shape({centers, radii, {}, {}}, {}, no_monitor());
    MedialAxisOptions exact;
    exact.exact = true;
    expect_near(medial_axis(complex, {}, no_monitor()), medial_axis(complex, exact, no_monitor()));
  }
}

TEST(degenerate_axis, by_exact_decisions_has_the_betti_numbers_of_boxes_of_balls_on_a_grid) {
  MedialAxisOptions exact;
  exact.exact = true;
  for (int a = 2; a <= 3; ++a) {
    for (int b = 2; b <= 3; ++b) {
      for (const double radius : {0.5, 0.6, 0.7071067811865476, 0.8660254037844387, 1.0}) {
        std::vector<Vec3> centers;
        for (int i = 0; i < 2 * a * b; ++i)
          centers.push_back({double(i % a), double(i / a % b), double(i / a / b)});
        const SimplicialComplex complex = complex_of(centers, radius);
        const MedialAxis axis = medial_axis(complex, exact, no_monitor());
        EXPECT_EQ(axis_betti(axis, no_monitor()), complex.betti) << a << " x " << b << ", radius " << radius;
        EXPECT_EQ(broken_invariant(axis), "");
      }
    }
  }
}

TEST(degenerate_axis, of_a_cube_by_exact_decisions_has_no_polygon_that_is_there_for_rounding) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  MedialAxisOptions exact;
  exact.exact = true;
  const MedialAxis axis = medial_axis(complex_of(corners, 0.9), exact, no_monitor());
  EXPECT_EQ(axis.polygons(), 12u);
  EXPECT_EQ(axis.vertices.size(), 9u);
  EXPECT_EQ(axis.seams.size(), 8u);
}

TEST(degenerate_axis, says_what_is_wrong_when_the_complex_is_not_that_of_its_balls) {
  SimplicialComplex complex = complex_of(nearly_flat(1), 1);
  complex.betti = {1, 1, 0};
  DegenerateListener listener;
  medial_axis(complex, {}, listener);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("not that of its balls"), std::string::npos);
  EXPECT_EQ(listener.warnings[0].find("nlarge"), std::string::npos);
}

TEST(degenerate_axis, stops_in_the_middle_of_exact_decisions_when_it_is_cancelled) {
  class Counting final : public Monitor {
   public:
    explicit Counting(int looks) : left_(looks) {}
    bool cancelled() override { return left_-- == 0; }
    int left_;
  };
  const SimplicialComplex complex = complex_of(nearly_flat(1e-12), 1);
  Counting all(1 << 30);
  medial_axis(complex, {}, all);
  const int looks = (1 << 30) - all.left_;
  ASSERT_GT(looks, 10);
  for (int k = 0; k < looks; ++k) {
    Counting monitor(k);
    EXPECT_THROW(medial_axis(complex, {}, monitor), Cancelled) << k << " of " << looks;
  }
}

}  // namespace
}  // namespace ballflow::geometry
