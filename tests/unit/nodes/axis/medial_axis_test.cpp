#include "axis/medial_axis.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/arctangent.hpp"
#include "binary_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "power/alpha_shape.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

using test::betti_of;

class Listener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

struct Result {
  SimplicialComplex complex;
  MedialAxis axis;
  std::vector<std::string> warnings;
};

Result axis_of(const std::vector<Vec3>& centers, const std::vector<double>& radii) {
  Result r;
  Listener listener;
  r.complex = alpha_shape({centers, radii, {}, {}}, {}, listener);
  r.axis = medial_axis(r.complex, {}, listener);
  r.warnings = listener.warnings;
  EXPECT_EQ(broken_invariant(r.axis), "");
  return r;
}

Result axis_of(const std::vector<Vec3>& centers, double radius) {
  return axis_of(centers, std::vector<double>(centers.size(), radius));
}

std::int64_t count(const MedialAxis& axis, AxisKind kind) {
  return std::count(axis.polygon_kinds.begin(), axis.polygon_kinds.end(), static_cast<std::uint8_t>(kind));
}

/// A random number in [0, 1), the same everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(engine_() % n); }

 private:
  std::mt19937_64 engine_;
};

struct BallSet {
  std::vector<Vec3> centers;
  std::vector<double> radii;
};

BallSet random_balls(Random& random, double smallest, double largest, double height = 1) {
  BallSet balls;
  const std::size_t n = 5 + random.below(56);
  for (std::size_t i = 0; i < n; ++i) {
    balls.centers.push_back({random.unit(), random.unit(), height * random.unit()});
    balls.radii.push_back(smallest + (largest - smallest) * random.unit());
  }
  return balls;
}

/// The axis has the topology of the union: all Betti numbers, the Euler characteristic, no warning.
void expect_topology_of_the_union(const Result& r, const std::string& what) {
  SCOPED_TRACE(what);
  const AxisTopology topology = axis_topology(r.axis);
  EXPECT_EQ(topology.euler_characteristic, r.complex.euler_characteristic());
  EXPECT_EQ(topology.components, r.complex.betti[0]);
  EXPECT_EQ(betti_of(r.axis), r.complex.betti);
  EXPECT_TRUE(r.warnings.empty());
}

/// Points on three spheres and strictly inside no ball: the boundary vertices, from their definition.
std::vector<Vec3> boundary_vertices(const BallSet& balls) {
  std::vector<Vec3> result;
  const auto& c = balls.centers;
  const auto& r = balls.radii;
  for (std::size_t i = 0; i < c.size(); ++i) {
    for (std::size_t j = i + 1; j < c.size(); ++j) {
      const double ij = distance(c[i], c[j]);
      if (ij > r[i] + r[j]) continue;
      for (std::size_t k = j + 1; k < c.size(); ++k) {
        // Coordinates in the frame of the triangle: x along ij, y towards k.
        const Vec3 ex = (1 / ij) * (c[j] - c[i]);
        const double along = dot(ex, c[k] - c[i]);
        const Vec3 across = c[k] - c[i] - along * ex;
        const double up = length(across);
        const Vec3 ey = (1 / up) * across, ez = cross(ex, ey);
        const double x = (r[i] * r[i] - r[j] * r[j] + ij * ij) / (2 * ij);
        const double y = (r[i] * r[i] - r[k] * r[k] + along * along + up * up - 2 * along * x) / (2 * up);
        const double zz = r[i] * r[i] - x * x - y * y;
        if (!(zz >= 0)) continue;
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 p = c[i] + x * ex + y * ey + (sign * std::sqrt(zz)) * ez;
          bool covered = false;
          for (std::size_t m = 0; m < c.size(); ++m) {
            covered = covered || (m != i && m != j && m != k && distance(p, c[m]) < r[m]);
          }
          if (!covered) result.push_back(p);
        }
      }
    }
  }
  return result;
}

TEST(medial_axis, is_empty_for_no_ball) {
  const Result r = axis_of({}, {});
  EXPECT_EQ(r.axis.vertices.size(), 0u);
  EXPECT_EQ(r.axis.polygons(), 0u);
}

TEST(medial_axis, of_one_ball_is_its_centre) {
  const Result r = axis_of({{1, 2, 3}}, 4.0);
  ASSERT_EQ(r.axis.vertices.size(), 1u);
  EXPECT_EQ(r.axis.vertices[0], (Vec3{1, 2, 3}));
  EXPECT_EQ(r.axis.radii[0], 4.0);
  EXPECT_EQ(r.axis.edges.size(), 0u);
}

TEST(medial_axis, of_two_overlapping_balls_is_the_segment_between_the_centres) {
  const Result r = axis_of({{0, 0, 0}, {3, 0, 0}}, {2.0, 1.5});
  EXPECT_EQ(r.axis.vertices, (Array<Vec3>{{0, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(r.axis.radii, (Array<double>{2.0, 1.5}));
  EXPECT_EQ(r.axis.edges, (Array<std::array<std::int32_t, 2>>{{0, 1}}));
}

TEST(medial_axis, joins_two_balls_that_touch_in_one_point) {
  EXPECT_EQ(axis_of({{0, 0, 0}, {2, 0, 0}}, 1.0).axis.edges.size(), 1u);
  EXPECT_EQ(axis_of({{0, 0, 0}, {2.0000001, 0, 0}}, 1.0).axis.edges.size(), 0u);
}

TEST(medial_axis, leaves_out_a_ball_inside_another) {
  const Result r = axis_of({{0, 0, 0}, {0.1, 0, 0}}, {2.0, 0.5});
  EXPECT_EQ(r.axis.vertices, (Array<Vec3>{{0, 0, 0}}));
}

TEST(medial_axis, of_three_overlapping_balls_is_the_triangle_of_the_centres) {
  const Result r = axis_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 0.9);
  EXPECT_EQ(r.axis.polygons(), 1u);
  EXPECT_EQ(count(r.axis, AxisKind::singular), 1);
  EXPECT_EQ(r.axis.edges.size(), 0u);
  EXPECT_EQ(axis_topology(r.axis).euler_characteristic, 1);
}

TEST(medial_axis, of_a_chain_of_balls_is_the_chain_of_their_centres) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 20; ++i) centers.push_back({1.5 * i, 0.1 * (i % 2), 0});
  const Result r = axis_of(centers, 1.0);
  EXPECT_EQ(r.axis.vertices.size(), 20u);
  EXPECT_EQ(r.axis.edges.size(), 19u);
  EXPECT_EQ(r.axis.polygons(), 0u);
}

TEST(medial_axis, of_four_balls_at_a_regular_tetrahedron_is_six_walls_that_meet_in_its_centre) {
  const std::vector<Vec3> corners{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const double radius = 2;
  const Result r = axis_of(corners, radius);
  ASSERT_EQ(r.axis.vertices.size(), 5u);
  EXPECT_EQ(count(r.axis, AxisKind::wall), 6);
  EXPECT_EQ(r.axis.polygons(), 6u);
  EXPECT_EQ(axis_topology(r.axis).euler_characteristic, 1);
  EXPECT_NEAR(length(r.axis.vertices[4]), 0, 1e-14);
  // The boundary vertex of a face: the face's centre lies 1/sqrt(3) from the middle, its corners sqrt(8/3)
  // from the face's centre.
  EXPECT_NEAR(r.axis.radii[4], 1 / std::sqrt(3.0) + std::sqrt(radius * radius - 8.0 / 3), 1e-14);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(r.axis.radii[i], radius);
}

TEST(medial_axis, of_a_cube_of_balls_that_meet_in_the_middle_of_its_sides_is_found_by_name) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  const Result r = axis_of(corners, 0.9);
  // Six boundary vertices (four spheres through each): twelve facets, one hanging on each edge of the cube.
  EXPECT_EQ(count(r.axis, AxisKind::wall), 12);
  expect_topology_of_the_union(r, "cube");
  const Vec3 middle{0.5, 0.5, 0.5};
  for (const Vec3 v : r.axis.vertices) {
    const bool corner = std::find(corners.begin(), corners.end(), v) != corners.end();
    EXPECT_TRUE(corner || distance(v, middle) < 1e-12) << v.x << " " << v.y << " " << v.z;
  }
  // The six vertices are cospherical: their Delaunay cells are one Voronoi vertex.
  ASSERT_EQ(r.axis.vertices.size(), 9u);
  EXPECT_LT(distance(r.axis.vertices[8], middle), 1e-12);
  EXPECT_EQ(r.axis.polygons(), 12u);
  EXPECT_EQ(r.axis.sheet_orientable.size(), 12u);
  EXPECT_EQ(r.axis.seams.size(), 8u) << "from every corner to the middle";
  for (const std::int32_t degree : r.axis.seam_degrees) EXPECT_EQ(degree, 3);
}

TEST(medial_axis, of_a_ring_of_balls_has_one_tunnel) {
  std::vector<Vec3> centers;
  for (int i = -16; i < 16; ++i) {  // rational points of the unit circle
    const double t = (i + 0.5) / 4;
    centers.push_back({(1 - t * t) / (1 + t * t), 2 * t / (1 + t * t), 0});
  }
  const Result r = axis_of(centers, 0.5);
  EXPECT_EQ(r.complex.betti, (Betti{1, 1, 0}));
  expect_topology_of_the_union(r, "ring");
}

/// n points spread over the unit sphere.
std::vector<Vec3> sphere_points(Random& random, std::size_t n) {
  std::vector<Vec3> points;
  while (points.size() < n) {
    const Vec3 p{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
    const double l = length(p);
    if (l < 1 && l > 0.1) points.push_back((1 / l) * p);
  }
  return points;
}

TEST(medial_axis, of_a_shell_keeps_its_cavity) {
  Random random(3);
  const Result r = axis_of(sphere_points(random, 300), 0.35);
  EXPECT_EQ(r.complex.betti, (Betti{1, 0, 1}));
  EXPECT_EQ(axis_topology(r.axis).euler_characteristic, 2);
  expect_topology_of_the_union(r, "shell");
}

TEST(medial_axis, of_a_thick_torus_has_its_topology) {
  Random random(4);
  BallSet balls;
  for (const Vec3 p : sphere_points(random, 1500)) {
    const double flat = std::sqrt(p.x * p.x + p.y * p.y);
    balls.centers.push_back({p.x / flat + 0.1 * p.z, p.y / flat, 0.1 * p.z * p.x});
    balls.radii.push_back(0.25 + 0.05 * random.unit());
  }
  const Result r = axis_of(balls.centers, balls.radii);
  EXPECT_EQ(r.complex.betti, (Betti{1, 1, 0}));
  EXPECT_EQ(axis_topology(r.axis).euler_characteristic, 0);
  EXPECT_EQ(axis_topology(r.axis).components, 1);
  EXPECT_GT(count(r.axis, AxisKind::voronoi), 100);
}

TEST(medial_axis, has_the_betti_numbers_of_sparse_random_unions) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const BallSet balls = random_balls(random, 0.05, 0.25);
    expect_topology_of_the_union(axis_of(balls.centers, balls.radii), "seed " + std::to_string(seed));
  }
}

TEST(medial_axis, has_the_betti_numbers_of_dense_random_unions) {
  std::size_t solid = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(1000 + seed);
    const BallSet balls = random_balls(random, 0.2, 0.5);
    const Result r = axis_of(balls.centers, balls.radii);
    expect_topology_of_the_union(r, "seed " + std::to_string(seed));
    solid += r.complex.tetrahedra.empty() ? 0 : 1;
  }
  EXPECT_GT(solid, 150u);
}

TEST(medial_axis, of_balls_with_coplanar_centres_is_their_complex) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Random random(2000 + seed);
    const BallSet balls = random_balls(random, 0.05, 0.3, 0);
    const Result r = axis_of(balls.centers, balls.radii);
    expect_topology_of_the_union(r, "seed " + std::to_string(seed));
    EXPECT_EQ(r.axis.polygons(), r.complex.triangles.size());
    EXPECT_EQ(r.axis.vertices.size(), r.complex.vertices.size());
  }
}

TEST(medial_axis, has_the_betti_numbers_of_boxes_of_balls_on_a_grid) {
  for (int a = 1; a <= 4; ++a) {
    for (int b = 1; b <= 3; ++b) {
      for (int c = 1; c <= 3; ++c) {
        for (const double radius : {0.5, 0.6, 0.72, 0.8660254037844387, 0.875, 1.0}) {
          std::vector<Vec3> centers;
          for (int i = 0; i < a * b * c; ++i) {
            centers.push_back({double(i % a), double(i / a % b), double(i / a / b)});
          }
          expect_topology_of_the_union(axis_of(centers, radius),
                                       std::to_string(a) + " x " + std::to_string(b) + " x " +
                                           std::to_string(c) + ", radius " + std::to_string(radius));
        }
      }
    }
  }
}

TEST(medial_axis, has_the_betti_numbers_of_random_subsets_of_a_grid) {
  for (std::uint64_t seed = 0; seed < 240; ++seed) {
    Random random(3000 + seed);
    BallSet balls;
    const std::size_t n = 5 + random.below(40);
    for (std::size_t i = 0; i < n; ++i) {
      balls.centers.push_back({double(random.below(4)), double(random.below(4)), double(random.below(3))});
      // sqrt(3) / 2: the eight spheres of a cube pass through its centre, up to rounding.
      balls.radii.push_back(seed % 3 == 0   ? 0.75
                            : seed % 3 == 1 ? 0.8660254037844387
                                            : 0.5 + 0.25 * double(random.below(4)));
    }
    expect_topology_of_the_union(axis_of(balls.centers, balls.radii), "seed " + std::to_string(seed));
  }
}

TEST(medial_axis, has_voronoi_vertices_of_the_boundary_vertices_with_inscribed_balls) {
  std::size_t checked = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    SCOPED_TRACE(seed);
    Random random(4000 + seed);
    BallSet balls = random_balls(random, 0.2, 0.5);
    const Result r = axis_of(balls.centers, balls.radii);
    const std::vector<Vec3> boundary = boundary_vertices(balls);
    for (std::size_t i = 0; i < r.axis.vertices.size(); ++i) {
      const Vec3 v = r.axis.vertices[i];
      if (std::find(balls.centers.begin(), balls.centers.end(), v) != balls.centers.end()) continue;
      ++checked;
      std::vector<double> distances;
      for (const Vec3& w : boundary) distances.push_back(distance(v, w));
      std::sort(distances.begin(), distances.end());
      ASSERT_GE(distances.size(), 4u);
      EXPECT_NEAR(distances[0], r.axis.radii[i], 1e-9);
      EXPECT_NEAR(distances[3], r.axis.radii[i], 1e-9);
      for (int k = 0; k < 20; ++k) {  // the inscribed ball lies in the union
        const Vec3 d{2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
        const Vec3 x = v + (0.999999 * r.axis.radii[i] / length(d)) * d;
        bool covered = false;
        for (std::size_t b = 0; b < balls.radii.size(); ++b) {
          covered = covered || distance(x, balls.centers[b]) <= balls.radii[b];
        }
        EXPECT_TRUE(covered);
      }
    }
  }
  EXPECT_GT(checked, 500u);
}

TEST(medial_axis, has_plane_convex_polygons) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(5000 + seed);
    const BallSet balls = random_balls(random, 0.2, 0.5);
    const MedialAxis axis = axis_of(balls.centers, balls.radii).axis;
    for (std::size_t i = 0; i < axis.polygons(); ++i) {
      const auto p = axis.polygon(i);
      const auto corner = [&](std::size_t k) {
        return axis.vertices[static_cast<std::size_t>(p[k % p.size()])];
      };
      Vec3 normal;  // twice the area
      for (std::size_t k = 1; k + 1 < p.size(); ++k) {
        normal = normal + cross(corner(k) - corner(0), corner(k + 1) - corner(0));
      }
      for (std::size_t k = 0; k < p.size(); ++k) {
        EXPECT_LE(std::abs(dot(normal, corner(k) - corner(0))), 1e-9);
        EXPECT_GE(dot(normal, cross(corner(k + 1) - corner(k), corner(k + 2) - corner(k + 1))), -1e-9);
      }
    }
  }
}

TEST(medial_axis, scales_with_the_balls) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(6000 + seed);
    const BallSet balls = random_balls(random, 0.15, 0.45);
    BallSet scaled = balls;
    for (Vec3& c : scaled.centers) c = 1024.0 * c;
    for (double& radius : scaled.radii) radius *= 1024;
    const MedialAxis small = axis_of(balls.centers, balls.radii).axis;
    const MedialAxis large = axis_of(scaled.centers, scaled.radii).axis;
    ASSERT_EQ(small.vertices.size(), large.vertices.size());
    for (std::size_t i = 0; i < small.vertices.size(); ++i) {
      EXPECT_EQ(1024.0 * small.vertices[i], large.vertices[i]);
      EXPECT_EQ(1024.0 * small.radii[i], large.radii[i]);
    }
    EXPECT_EQ(small.polygon_vertices, large.polygon_vertices);
    EXPECT_EQ(small.edges, large.edges);
  }
}

TEST(medial_axis, does_not_depend_on_the_order_of_the_balls) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(7000 + seed);
    const BallSet balls = random_balls(random, 0.15, 0.45);
    BallSet reversed = balls;
    std::reverse(reversed.centers.begin(), reversed.centers.end());
    std::reverse(reversed.radii.begin(), reversed.radii.end());
    const MedialAxis a = axis_of(balls.centers, balls.radii).axis;
    const MedialAxis b = axis_of(reversed.centers, reversed.radii).axis;
    EXPECT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(a.edges.size(), b.edges.size());
    for (const AxisKind kind : {AxisKind::singular, AxisKind::voronoi, AxisKind::wall}) {
      EXPECT_EQ(count(a, kind), count(b, kind));
    }
    EXPECT_EQ(axis_topology(a).euler_characteristic, axis_topology(b).euler_characteristic);
  }
}

TEST(medial_axis, gives_the_same_bytes_again) {
  Random random(8);
  const BallSet balls = random_balls(random, 0.2, 0.5);
  const MedialAxis first = axis_of(balls.centers, balls.radii).axis;
  const std::vector<char> other_addresses(123457);  // keeps the allocator from repeating itself
  const MedialAxis second = axis_of(balls.centers, balls.radii).axis;
  ASSERT_EQ(first.vertices.size(), second.vertices.size());
  EXPECT_EQ(std::memcmp(first.vertices.data(), second.vertices.data(), first.vertices.size() * sizeof(Vec3)),
            0);
  EXPECT_EQ(first.radii, second.radii);
  EXPECT_EQ(first.polygon_offsets, second.polygon_offsets);
  EXPECT_EQ(first.polygon_vertices, second.polygon_vertices);
  EXPECT_EQ(first.polygon_kinds, second.polygon_kinds);
}

// --- Sheets and seams.

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

TEST(medial_axis, takes_a_complex_without_tetrahedra_as_it_is) {
  SimplicialComplex hollow = axis_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 2.0).complex;
  hollow.tetrahedra = {};
  EXPECT_EQ(axis_topology(medial_axis(hollow, {}, no_monitor())).euler_characteristic, 2);
}

/// Two solid tetrahedra through each other: no dual complex, hence no axis of the same topology.
SimplicialComplex crossing_tetrahedra() {
  std::vector<Vec3> centers{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  SimplicialComplex complex = axis_of(centers, 2.0).complex;
  for (std::size_t i = 0; i < 4; ++i) centers.push_back(-centers[i]);
  complex.centers = centers;
  complex.weights = std::vector<double>(8, 4.0);
  const auto twice = [](const auto& simplices) {
    using Simplex = typename std::decay_t<decltype(simplices)>::value_type;
    std::vector<Simplex> all(simplices.begin(), simplices.end());
    for (Simplex s : simplices) {
      for (auto& ball : s) ball += 4;
      all.push_back(s);
    }
    return all;
  };
  complex.vertices = {0, 1, 2, 3, 4, 5, 6, 7};
  complex.edges = twice(complex.edges);
  complex.triangles = twice(complex.triangles);
  complex.tetrahedra = twice(complex.tetrahedra);
  return complex;
}

TEST(medial_axis, warns_with_both_topologies_when_they_differ) {
  SimplicialComplex complex = crossing_tetrahedra();
  complex.betti = {2, 0, 0};
  ASSERT_EQ(complex.euler_characteristic(), 2);
  Listener listener;
  const MedialAxis axis = medial_axis(complex, {}, listener);
  ASSERT_NE(axis_topology(axis).euler_characteristic, 2);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("the axis has " + describe(axis_betti(axis, no_monitor()))),
            std::string::npos);
  EXPECT_NE(listener.warnings[0].find("the union has 2 components, no tunnel, no cavity"), std::string::npos);
}

TEST(medial_axis, fails_when_the_topologies_must_not_differ) {
  SimplicialComplex complex = crossing_tetrahedra();
  complex.betti = {2, 0, 0};
  EXPECT_THROW(medial_axis(complex, {AxisMismatch::error}, no_monitor()), InputError);
}

TEST(medial_axis, notices_a_component_and_a_tunnel_that_are_lost_together) {
  // The Euler characteristics agree: only the three numbers themselves tell.
  std::vector<Vec3> centers;
  for (int i = 0; i < 12; ++i) centers.push_back({std::cos(pi * i / 6), std::sin(pi * i / 6), 0});
  SimplicialComplex complex = axis_of(centers, 0.3).complex;
  ASSERT_EQ(complex.betti, (Betti{1, 1, 0}));
  Listener listener;
  medial_axis(complex, {}, listener);
  EXPECT_TRUE(listener.warnings.empty());
  complex.betti = {2, 2, 0};
  ASSERT_EQ(broken_invariant(complex), "");
  medial_axis(complex, {}, listener);
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("1 component, 1 tunnel, no cavity"), std::string::npos);
  EXPECT_THROW(medial_axis(complex, {AxisMismatch::error}, no_monitor()), InputError);
}

TEST(medial_axis, stops_when_it_is_cancelled) {
  class Impatient final : public Monitor {
    bool cancelled() override { return true; }
  };
  const Result r = axis_of({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, 2.0);
  Impatient monitor;
  EXPECT_THROW(medial_axis(r.complex, {}, monitor), Cancelled);
}

TEST(union_vertices, are_the_exposed_triple_points) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Random random(9000 + seed);
    const BallSet balls = random_balls(random, 0.1, 0.4);
    const UnionVertices found = union_vertices(axis_of(balls.centers, balls.radii).complex, 0x1p-40);
    const std::vector<Vec3> expected = boundary_vertices(balls);
    ASSERT_EQ(found.size(), expected.size());
    for (const Vec3& w : found.points) {
      double nearest = 1;
      for (const Vec3& e : expected) nearest = std::min(nearest, distance(w, e));
      EXPECT_LT(nearest, 1e-9);
    }
  }
}

TEST(union_vertices, merge_where_four_spheres_meet) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i) corners.push_back({double(i & 1), double(i >> 1 & 1), double(i >> 2 & 1)});
  const UnionVertices v = union_vertices(axis_of(corners, 0.9).complex, 0x1p-40);
  ASSERT_EQ(v.size(), 6u);
  for (std::size_t w = 0; w < 6; ++w) {
    EXPECT_EQ(v.balls_of(w).size(), 4u);
    EXPECT_EQ(v.faces_of(w).size(), 2u);
  }
}

TEST(union_vertices, of_one_triangle_lie_on_both_sides_of_it) {
  const UnionVertices v = union_vertices(axis_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, 1.0).complex, 0x1p-40);
  ASSERT_EQ(v.size(), 2u);
  EXPECT_NEAR(v.points[0].z, -std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(v.points[1].z, std::sqrt(0.5), 1e-15);
  EXPECT_TRUE(v.faces_of(0).empty());
}

}  // namespace
}  // namespace ballflow::geometry
