// What must become of results when all balls are mirrored, reordered or scaled, and when they are bad.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "binary_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "homology/inclusion_homology.hpp"
#include "measure/compare.hpp"
#include "measure/union_measure.hpp"
#include "power/alpha_shape.hpp"
#include "topology/topology.hpp"
#include "topology/topology_repair.hpp"
#include "topology/union_topology.hpp"

namespace ballflow::geometry {
namespace {

double unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

Balls random_balls(std::mt19937_64& random, std::size_t n, double size) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = unit(random) - 0.5, y = unit(random) - 0.5, z = unit(random) - 0.5;
    centers.push_back({x, y, z});
    radii.push_back(size * (0.4 + 0.6 * unit(random)));
  }
  return {centers, radii, {}, {}};
}

template <class F>
Balls moved(const Balls& balls, const F& f, double factor = 1) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Vec3 c : balls.centers) centers.push_back(f(c));
  for (const double r : balls.radii) radii.push_back(factor * r);
  return {centers, radii, {}, {}};
}

MedialAxis axis_of(const Balls& balls) {
  return medial_axis(alpha_shape(balls, {}, no_monitor()), {}, no_monitor());
}

/// Polygons as they are up to where they begin and which way they run.
std::multiset<std::vector<std::int32_t>> polygons_of(const MedialAxis& axis) {
  std::multiset<std::vector<std::int32_t>> all;
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto p = axis.polygon(i);
    std::vector<std::int32_t> corners(p.begin(), p.end());
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    if (corners[1] > corners.back()) std::reverse(corners.begin() + 1, corners.end());
    all.insert(corners);
  }
  return all;
}

TEST(metamorphic, mirrored_balls_have_the_mirrored_shape_and_axis) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 20; ++round) {
    const Balls balls = random_balls(random, 80, 0.1 + 0.01 * round);
    const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
    const MedialAxis axis = axis_of(balls);
    const auto mirrors = {+[](Vec3 p) {
                            return Vec3{-p.x, p.y, p.z};
                          },
                          +[](Vec3 p) {
                            return Vec3{p.x, p.y, -p.z};
                          },
                          +[](Vec3 p) {
                            return Vec3{-p.x, -p.y, -p.z};
                          }};
    for (const auto mirror : mirrors) {
      const Balls image = moved(balls, mirror);
      const SimplicialComplex other = alpha_shape(image, {}, no_monitor());
      ASSERT_EQ(complex.vertices, other.vertices);
      ASSERT_EQ(complex.edges, other.edges);
      ASSERT_EQ(complex.triangles, other.triangles);
      ASSERT_EQ(complex.tetrahedra, other.tetrahedra);
      ASSERT_EQ(complex.vertex_classes, other.vertex_classes);
      ASSERT_EQ(complex.edge_classes, other.edge_classes);
      ASSERT_EQ(complex.triangle_classes, other.triangle_classes);
      ASSERT_EQ(complex.betti, other.betti);
      const MedialAxis reflected = axis_of(image);
      ASSERT_EQ(axis.vertices.size(), reflected.vertices.size());
      for (std::size_t i = 0; i < axis.vertices.size(); ++i) {
        ASSERT_EQ(mirror(axis.vertices[i]), reflected.vertices[i]) << "round " << round << ", vertex " << i;
      }
      ASSERT_EQ(axis.radii, reflected.radii);
      ASSERT_EQ(axis.edges, reflected.edges);
      ASSERT_EQ(polygons_of(axis), polygons_of(reflected));
    }
  }
}

/// Coordinates are sums over balls in the order of their numbers, so they agree up to rounding only; what
/// they are the coordinates of agrees exactly.
TEST(metamorphic, reordered_balls_have_the_same_axis) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 20; ++round) {
    const Balls balls = random_balls(random, 80, 0.1 + 0.01 * round);
    std::vector<std::int32_t> order(balls.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    const MedialAxis a = axis_of(balls);
    MedialAxis b = axis_of(select(balls, order));
    ASSERT_EQ(a.vertices.size(), b.vertices.size());
    std::vector<std::int32_t> renamed;
    for (std::size_t i = 0; i < b.vertices.size(); ++i) {
      const auto nearest = std::min_element(a.vertices.begin(), a.vertices.end(), [&](Vec3 p, Vec3 q) {
        return distance(p, b.vertices[i]) < distance(q, b.vertices[i]);
      });
      ASSERT_LT(distance(*nearest, b.vertices[i]), 1e-10) << "round " << round << ", vertex " << i;
      renamed.push_back(static_cast<std::int32_t>(nearest - a.vertices.begin()));
      ASSERT_NEAR(a.radii[static_cast<std::size_t>(renamed[i])], b.radii[i], 1e-10);
    }
    ASSERT_EQ(std::set(renamed.begin(), renamed.end()).size(), renamed.size());
    std::vector<std::int32_t> corners;
    for (const std::int32_t v : b.polygon_vertices) corners.push_back(renamed[static_cast<std::size_t>(v)]);
    b.polygon_vertices = corners;
    ASSERT_EQ(polygons_of(a), polygons_of(b)) << "round " << round;
    EXPECT_EQ(a.edges.size(), b.edges.size());
  }
}

TEST(metamorphic, reordered_mirrored_and_scaled_balls_have_the_same_inclusion) {
  std::mt19937_64 random(3);
  for (int round = 0; round < 20; ++round) {
    const Balls balls = random_balls(random, 60, 0.15 + 0.01 * round);
    std::vector<std::int32_t> part, order(balls.size()), image;
    for (std::int32_t i = 0; i < 60; ++i) {
      if (random() % 3 != 0) part.push_back(i);
    }
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
    for (std::int32_t i = 0; i < 60; ++i) {
      if (std::binary_search(part.begin(), part.end(), order[static_cast<std::size_t>(i)]))
        image.push_back(i);
    }
    const InclusionHomology expected = UnionOfBalls(balls, no_monitor()).inclusion_of(part);
    EXPECT_EQ(UnionOfBalls(select(balls, order), no_monitor()).inclusion_of(image), expected);
    const Balls scaled = moved(
        balls, [](Vec3 p) { return 0x1p-200 * p; }, 0x1p-200);
    EXPECT_EQ(UnionOfBalls(scaled, no_monitor()).inclusion_of(part), expected);
    const Balls mirrored = moved(balls, [](Vec3 p) { return Vec3{p.x, -p.y, p.z}; });
    EXPECT_EQ(UnionOfBalls(mirrored, no_monitor()).inclusion_of(part), expected);
  }
}

struct BadSet {
  const char* name;
  Balls balls;
  Betti betti;    // of the union
  double volume;  // of the union, where a formula gives it
};

const double ball_volume = 4 * 3.141592653589793 / 3;

std::vector<BadSet> bad_sets() {
  const auto same = [](std::vector<Vec3> centers, double radius) {
    std::vector<double> radii(centers.size(), radius);
    return Balls{std::move(centers), std::move(radii), {}, {}};
  };
  std::vector<Vec3> line, plane, points;
  for (int i = 0; i < 6; ++i) line.push_back({3.0 * i, 6.0 * i, 6.0 * i});  // nine apart
  for (int i = 0; i < 16; ++i) plane.push_back({4.0 * (i % 4), 4.0 * (i / 4), 1});
  for (int i = 0; i < 30; ++i) points.push_back({0.1 * (i % 5), 0.1 * (i / 5 % 3), 0.1 * (i / 15)});
  std::vector<Vec3> scales;
  std::vector<double> radii;
  double x = 0, volume = 0;
  for (int i = 0; i <= 12; ++i) {  // a row of balls that do not meet, 1 to 10^-12
    const double r = std::pow(10.0, -i);
    scales.push_back({x, r, 0});
    radii.push_back(r);
    volume += ball_volume * r * r * r;
    x += 3 * r;
  }
  return {
      {"none", {}, {0, 0, 0}, 0},
      {"one", same({{1, 2, 3}}, 2), {1, 0, 0}, 8 * ball_volume},
      {"one of radius zero", same({{1, 2, 3}}, 0), {1, 0, 0}, 0},
      {"equal ones", same({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, 2), {1, 0, 0}, 8 * ball_volume},
      {"nested",
       {{{0, 0, 0}, {0.5, 0, 0}, {0, 0, 1}, {0.5, 0, 0}}, {4, 1, 2, 0}, {}, {}},
       {1, 0, 0},
       64 * ball_volume},
      {"concentric", {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 3, 2}, {}, {}}, {1, 0, 0}, 27 * ball_volume},
      {"collinear apart", same(line, 2), {6, 0, 0}, 6 * 8 * ball_volume},
      {"collinear touching", same({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}}, 1), {1, 0, 0}, 3 * ball_volume},
      {"coplanar apart", same(plane, 1), {16, 0, 0}, 16 * ball_volume},
      {"coplanar touching", same(plane, 2), {1, 9, 0}, 16 * 8 * ball_volume},
      {"all of radius zero", same(points, 0), {30, 0, 0}, 0},
      {"twelve orders of magnitude", {scales, radii, {}, {}}, {13, 0, 0}, volume},
  };
}

TEST(bad_balls, have_the_right_topology_axis_and_measure) {
  for (const BadSet& set : bad_sets()) {
    SCOPED_TRACE(set.name);
    const SimplicialComplex complex = alpha_shape(set.balls, {}, no_monitor());
    EXPECT_EQ(broken_invariant(complex), "");
    EXPECT_EQ(complex.betti, set.betti);
    const MedialAxis axis = medial_axis(complex, {.on_mismatch = AxisMismatch::error}, no_monitor());
    EXPECT_EQ(broken_invariant(axis), "");
    EXPECT_EQ(test::betti_of(axis), set.betti);
    EXPECT_EQ(axis_betti(axis, no_monitor()), set.betti);
    EXPECT_NEAR(union_measure(complex, no_monitor()).volume, set.volume, 1e-9 * std::max(1.0, set.volume));
    const TopologyTable kept = union_row(set.balls, {TopologyStage::kept}, no_monitor());
    const TopologyTable table = topology({.kept = &kept, .complex = &complex, .axis = &axis}, no_monitor());
    for (const Betti& row : table.betti) EXPECT_EQ(row, set.betti);
    std::vector<std::int32_t> all(set.balls.size());
    std::iota(all.begin(), all.end(), 0);
    EXPECT_TRUE(repair_topology(set.balls, all, {}, no_monitor()).returned.empty());
    EXPECT_TRUE(repair_topology(set.balls, std::vector<std::int32_t>{}, {}, no_monitor())
                    .check.inclusion_after()
                    .isomorphism());
  }
}

TEST(bad_balls, are_compared_or_refused_by_name) {
  for (const BadSet& set : bad_sets()) {
    SCOPED_TRACE(set.name);
    PointSet points;
    points.points = std::vector<Vec3>{{9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {9, 9, 9}};
    try {
      const Comparison c = compare(set.balls, points, {}, {.spacing = 20}, no_monitor());
      EXPECT_EQ(broken_invariant(c), "");
      EXPECT_GT(set.balls.size(), 0u);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find('\n'), std::string::npos) << "a cause and a hint";
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
