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

#include "axis_cases.hpp"
#include "base/arctangent.hpp"
#include "binary_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "power/alpha_shape.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

using namespace axis_cases;

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
