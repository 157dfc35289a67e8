// Sheets and seams of medial axes, and axes in space whatever the order of the balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <vector>

#include "axis_cases.hpp"

namespace ballflow::geometry {
namespace {

using namespace axis_cases;

/// What the labels say, from the definitions: every pair of polygons is looked at.
void expect_sheets_and_seams(const MedialAxis& axis) {
  std::map<std::array<std::int32_t, 2>, std::vector<std::pair<std::size_t, bool>>> sides;
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto p = axis.polygon(i);
    for (std::size_t k = 0; k < p.size(); ++k) {
      const std::int32_t a = p[k], b = p[(k + 1) % p.size()];
      sides[{std::min(a, b), std::max(a, b)}].emplace_back(i, a < b);
    }
  }
  std::vector<std::array<std::int32_t, 2>> seams;
  std::vector<std::size_t> root(axis.polygons());
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&root](std::size_t i) {
    while (root[i] != i) i = root[i];
    return i;
  };
  for (const auto& [edge, at] : sides) {
    if (at.size() > 2) {
      ASSERT_LT(seams.size(), axis.seams.size());
      EXPECT_EQ(static_cast<std::size_t>(axis.seam_degrees[seams.size()]), at.size());
      seams.push_back(edge);
    }
    if (at.size() != 2) continue;
    EXPECT_EQ(axis.polygon_sheets[at[0].first], axis.polygon_sheets[at[1].first]);
    root[find(at[0].first)] = find(at[1].first);
    const auto sheet = static_cast<std::size_t>(axis.polygon_sheets[at[0].first]);
    EXPECT_TRUE(axis.sheet_orientable[sheet] == 0 || at[0].second != at[1].second);
  }
  EXPECT_EQ(axis.seams, Array(seams));
  std::set<std::size_t> pieces;
  for (std::size_t i = 0; i < axis.polygons(); ++i) pieces.insert(find(i));
  EXPECT_EQ(pieces.size(), axis.sheet_orientable.size()) << "polygons of one sheet are joined";
}

TEST(medial_axis, has_no_sheet_for_two_balls_and_one_for_three) {
  EXPECT_EQ(axis_of({{0, 0, 0}, {3, 0, 0}}, {2.0, 1.5}).axis.sheet_orientable.size(), 0u);
  const MedialAxis axis = axis_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.9).axis;
  EXPECT_EQ(axis.polygon_sheets, (Array<std::int32_t>{0}));
  EXPECT_EQ(axis.sheet_orientable, (Array<std::uint8_t>{1}));
  EXPECT_EQ(axis.seams.size(), 0u);
}

TEST(medial_axis, of_four_balls_at_a_regular_tetrahedron_has_six_sheets_and_four_seams_from_its_centre) {
  const MedialAxis axis = axis_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 2.0).axis;
  EXPECT_EQ(axis.sheet_orientable.size(), 6u);
  EXPECT_EQ(axis.seams, (Array<std::array<std::int32_t, 2>>{{0, 4}, {1, 4}, {2, 4}, {3, 4}}));
  EXPECT_EQ(axis.seam_degrees, (Array<std::int32_t>{3, 3, 3, 3}));
  EXPECT_EQ(axis.seam_curves, (Array<std::int32_t>{0, 1, 2, 3}));
}

// Balls in rows that are shifted by half a step against each other meet in threes and never in fours: the
// axis is the surface through their centres.

TEST(medial_axis, of_balls_around_a_torus_is_one_sheet_with_two_sides) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 70; ++i) {
    for (int k = 0; k < 12; ++k) {
      const double u = 2 * pi * i / 70, v = 2 * pi * (k + 0.5 * (i % 2)) / 12;
      const double flat = 4 + 0.8 * std::cos(v);
      centers.push_back({flat * std::cos(u), flat * std::sin(u), 0.8 * std::sin(v)});
    }
  }
  const Result r = axis_of(centers, 0.3);
  ASSERT_EQ(r.complex.betti, (Betti{1, 2, 1}));
  ASSERT_EQ(r.complex.tetrahedra.size(), 0u);
  EXPECT_EQ(r.axis.sheet_orientable, (Array<std::uint8_t>{1}));
  EXPECT_EQ(r.axis.seams.size(), 0u);
  expect_sheets_and_seams(r.axis);
}

TEST(medial_axis, of_a_flat_box_of_balls_is_a_plane_of_rectangles_and_a_wall_for_every_edge_of_its_boundary) {
  // 4 x 4 x 2 balls. The boundary has 30 squares with one vertex of the union above each, 60 edges, 32
  // corners. Half-way between the layers the vertices above and below are equally far: nine rectangles, the
  // outer ones cut off by the vertices beside the box.
  std::vector<Vec3> centers;
  for (int i = 0; i < 32; ++i) centers.push_back({double(i % 4), double(i / 4 % 4), double(i / 16)});
  const Result r = axis_of(centers, 0.9);
  expect_topology_of_the_union(r, "flat box");
  expect_sheets_and_seams(r.axis);
  EXPECT_EQ(count(r.axis, AxisKind::wall), 60);
  EXPECT_EQ(count(r.axis, AxisKind::voronoi), 9);
  EXPECT_EQ(r.axis.sheet_orientable.size(), 69u);
  ASSERT_EQ(r.axis.vertices.size(), 32u + 16u);
  std::vector<Vec3> expected;
  for (const double x : {0.5, 1.0, 2.0, 2.5}) {
    for (const double y : {0.5, 1.0, 2.0, 2.5}) expected.push_back({x, y, 0.5});
  }
  for (const Vec3 e : expected) {
    double nearest = 1;
    for (std::size_t v = 32; v < 48; ++v) nearest = std::min(nearest, distance(r.axis.vertices[v], e));
    EXPECT_LT(nearest, 1e-12) << e.x << " " << e.y;
  }
}

TEST(medial_axis, of_balls_along_a_moebius_band_is_one_sheet_with_one_side) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 72; ++i) {
    for (int k = 0; k < 7 - i % 2; ++k) {
      const double u = 2 * pi * i / 72, across = 0.3 * (k - 3 + 0.5 * (i % 2));
      const double flat = 3 + across * std::cos(u / 2);
      centers.push_back({flat * std::cos(u), flat * std::sin(u), across * std::sin(u / 2)});
    }
  }
  const Result r = axis_of(centers, 0.22);
  ASSERT_EQ(r.complex.betti, (Betti{1, 1, 0}));
  ASSERT_EQ(r.complex.tetrahedra.size(), 0u);
  EXPECT_EQ(r.axis.sheet_orientable, (Array<std::uint8_t>{0}));
  EXPECT_EQ(r.axis.seams.size(), 0u);
  expect_sheets_and_seams(r.axis);
}

TEST(medial_axis, of_three_walls_of_balls_that_meet_has_three_sheets_and_one_seam) {
  std::vector<Vec3> centers;
  for (int z = 0; z < 12; ++z) {
    centers.push_back({0, 0, double(z)});
    for (int leaf = 0; leaf < 3; ++leaf) {
      const double angle = 2 * pi * leaf / 3 + 0.1;
      for (int k = 1; k < 6; ++k)
        centers.push_back({0.9 * k * std::cos(angle), 0.9 * k * std::sin(angle), z + 0.5 * (k % 2)});
    }
  }
  const Result r = axis_of(centers, 0.6);
  ASSERT_EQ(r.complex.betti, (Betti{1, 0, 0}));
  ASSERT_EQ(r.complex.tetrahedra.size(), 0u);
  EXPECT_EQ(r.axis.sheet_orientable, (Array<std::uint8_t>{1, 1, 1}));
  EXPECT_EQ(r.axis.seams.size(), 11u);
  for (const std::int32_t curve : r.axis.seam_curves) EXPECT_EQ(curve, 0);
  for (const std::int32_t degree : r.axis.seam_degrees) EXPECT_EQ(degree, 3);
  expect_sheets_and_seams(r.axis);
}

TEST(medial_axis, labels_the_sheets_and_seams_of_random_unions_as_they_are_defined) {
  std::size_t seams = 0, sheets_of_several = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(10000 + seed);
    const BallSet balls = random_balls(random, 0.05, 0.2 + 0.3 * random.unit(), seed % 3 == 0 ? 0.1 : 1);
    const MedialAxis axis = axis_of(balls.centers, balls.radii).axis;
    expect_sheets_and_seams(axis);
    seams += axis.seams.size();
    if (axis.sheet_orientable.size() < axis.polygons()) ++sheets_of_several;
  }
  EXPECT_GT(seams, 1000u);
  EXPECT_GT(sheets_of_several, 20u);
}

/// Sheets as sets of polygons, polygons as corners that begin with the least one; sheets turned over as a
/// whole are the same.
std::set<std::set<std::vector<Vec3>>> sheets_in_space(const MedialAxis& axis) {
  std::vector<std::array<std::set<std::vector<Vec3>>, 2>> sheets(axis.sheet_orientable.size());
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    std::vector<Vec3> corners;
    for (const std::int32_t v : axis.polygon(i))
      corners.push_back(axis.vertices[static_cast<std::size_t>(v)]);
    for (auto& faces : sheets[static_cast<std::size_t>(axis.polygon_sheets[i])]) {
      std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
      faces.insert(corners);
      std::reverse(corners.begin(), corners.end());
    }
  }
  std::set<std::set<std::vector<Vec3>>> all;
  for (const auto& [front, back] : sheets) all.insert(std::min(front, back));
  return all;
}

/// Vertices with their radii, edges and seams with their degrees.
struct InSpace {
  std::map<Vec3, double> vertices;
  std::set<std::set<Vec3>> edges;
  std::map<std::set<Vec3>, std::int32_t> seams;
  std::set<std::set<std::vector<Vec3>>> sheets;

  explicit InSpace(const MedialAxis& axis) : sheets(sheets_in_space(axis)) {
    const auto at = [&axis](std::int32_t v) { return axis.vertices[static_cast<std::size_t>(v)]; };
    for (std::size_t i = 0; i < axis.vertices.size(); ++i) vertices[axis.vertices[i]] = axis.radii[i];
    for (const auto& [u, v] : axis.edges) edges.insert({at(u), at(v)});
    for (std::size_t i = 0; i < axis.seams.size(); ++i)
      seams[{at(axis.seams[i][0]), at(axis.seams[i][1])}] = axis.seam_degrees[i];
  }
  friend bool operator==(const InSpace&, const InSpace&) = default;
};

TEST(medial_axis, is_exactly_the_same_in_space_whatever_the_order_of_the_balls) {
  std::size_t voronoi = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(11000 + seed);
    BallSet balls = random_balls(random, 0.05, 0.15 + 0.3 * random.unit(), seed % 5 == 0 ? 0.02 : 1);
    const MedialAxis a = axis_of(balls.centers, balls.radii).axis;
    for (std::size_t i = balls.radii.size(); i > 1; --i) {
      const std::size_t k = random.below(i);
      std::swap(balls.centers[i - 1], balls.centers[k]);
      std::swap(balls.radii[i - 1], balls.radii[k]);
    }
    EXPECT_TRUE(InSpace(a) == InSpace(axis_of(balls.centers, balls.radii).axis));
    voronoi += static_cast<std::size_t>(count(a, AxisKind::voronoi));
  }
  EXPECT_GT(voronoi, 1000u);
}

TEST(medial_axis, is_mirrored_exactly_with_the_balls) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(12000 + seed);
    BallSet balls = random_balls(random, 0.1, 0.4);
    MedialAxis a = axis_of(balls.centers, balls.radii).axis;
    for (Vec3& c : balls.centers) c.x = -c.x;
    const MedialAxis b = axis_of(balls.centers, balls.radii).axis;
    std::vector<Vec3> mirrored(a.vertices.begin(), a.vertices.end());
    for (Vec3& v : mirrored) v.x = -v.x;
    a.vertices = std::move(mirrored);
    EXPECT_TRUE(InSpace(a) == InSpace(b));
  }
}

}  // namespace
}  // namespace ballflow::geometry
