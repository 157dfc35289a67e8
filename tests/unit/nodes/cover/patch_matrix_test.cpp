// Covering whole triangles: matrix, check and certificate against the definition.
#include "cover/patch_matrix.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "cover/cover_points.hpp"
#include "cover/greedy.hpp"
#include "cover/lagrangian_bound.hpp"
#include "cover/verify_cover.hpp"
#include "cover_oracle.hpp"
#include "sample/generate.hpp"

namespace ballflow::geometry {
namespace {

struct Patched {
  Balls balls;
  TriangleMesh mesh;
};

/// Balls around a sphere's triangles, the first of them large enough for one each.
Patched patched(std::uint32_t seed, std::size_t extra) {
  std::mt19937 random(seed);
  const TriangleMesh mesh = generate(parse_shape("sphere?n=66"));
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    centers.push_back((1.0 / 3) * (at(a) + at(b) + at(c)));
    radii.push_back(1.01 * std::max({distance(centers.back(), at(a)), distance(centers.back(), at(b)),
                                     distance(centers.back(), at(c))}));
  }
  for (std::size_t i = 0; i < extra; ++i) {
    centers.push_back(
        {2.4 * test::unit(random) - 1.2, 2.4 * test::unit(random) - 1.2, 2.4 * test::unit(random) - 1.2});
    radii.push_back(test::unit(random));
  }
  return {{centers, radii, {}, {}}, mesh};
}

/// By the distance of 28 points of the triangle, corners included, not by what patch_matrix asks.
bool holds_whole(Vec3 center, double radius, const TriangleMesh& mesh, const Triangle& t) {
  const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; i + j <= 6; ++j) {
      const Vec3 p = (i / 6.0) * at(0) + (j / 6.0) * at(1) + ((6 - i - j) / 6.0) * at(2);
      if (distance(p, center) > radius * (1 + 1e-9)) return false;
    }
  }
  return true;
}

TEST(patch_matrix, equals_the_definition_tried_pair_by_pair) {
  const Patched s = patched(1, 60);
  const CoverMatrix matrix = patch_matrix(s.balls, s.mesh);
  EXPECT_EQ(broken_invariant(matrix.cover), "");
  EXPECT_TRUE(matrix.cover.uncovered.empty());
  test::Sets expected;
  for (std::size_t i = 0; i < s.balls.size(); ++i) {
    expected.emplace_back();
    for (std::size_t t = 0; t < s.mesh.triangles.size(); ++t) {
      if (holds_whole(s.balls.centers[i], s.balls.radii[i], s.mesh, s.mesh.triangles[t]))
        expected.back().push_back(static_cast<std::int32_t>(t));
    }
  }
  EXPECT_EQ(test::row_sets(matrix.cover), expected);
}

TEST(patch_matrix, its_cover_and_bound_are_confirmed_from_geometry) {
  const Patched s = patched(2, 200);
  const PointSet points{s.mesh.vertices, {}};
  const CoverState cover = greedy(lagrangian_bound(patch_matrix(s.balls, s.mesh).cover));
  const Balls kept = select(s.balls, cover.chosen.span());
  const CoverCheck check = verify_cover(kept, points, {}, no_monitor(), {}, s.mesh);
  EXPECT_TRUE(check.uncovered.empty());
  EXPECT_EQ(check.samples, static_cast<std::int64_t>(s.mesh.triangles.size()));
  const std::int64_t bound = verify_certificate(cover, s.balls, points, no_monitor(), s.mesh);
  EXPECT_GT(bound, 1);
  EXPECT_LE(bound, static_cast<std::int64_t>(kept.size()));
  EXPECT_EQ(bound, cover.certified_bound());
  // Without any one ball that is the last to hold some triangle the check must fail.
  std::size_t noticed = 0;
  for (std::size_t missing = 0; missing < kept.size(); ++missing) {
    std::vector<std::int32_t> rest;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (i != missing) rest.push_back(static_cast<std::int32_t>(i));
    }
    const Balls fewer = select(kept, rest);
    const bool needed = std::any_of(s.mesh.triangles.begin(), s.mesh.triangles.end(), [&](const Triangle& t) {
      for (std::size_t i = 0; i < fewer.size(); ++i) {
        if (holds_whole(fewer.centers[i], fewer.radii[i], s.mesh, t)) return false;
      }
      return true;
    });
    const CoverCheck again =
        verify_cover(fewer, points, {.on_uncovered = OnUncovered::report}, no_monitor(), {}, s.mesh);
    EXPECT_EQ(!again.uncovered.empty(), needed) << missing;
    noticed += needed ? 1 : 0;
  }
  EXPECT_GT(noticed, 0u);
}

TEST(patch_matrix, a_triangle_in_no_ball_is_told_listed_and_no_error_of_the_cover) {
  Patched s = patched(3, 0);
  std::vector<Vec3> centers(s.balls.centers.begin() + 1, s.balls.centers.end());
  std::vector<double> radii(s.balls.radii.begin() + 1, s.balls.radii.end());
  const Balls balls{centers, radii, {}, {}};
  const CoverMatrix matrix = patch_matrix(balls, s.mesh);
  EXPECT_EQ(matrix.cover.uncovered, (Array<std::int32_t>{0}));
  const PointSet points{s.mesh.vertices, {}};
  verify_uncovered(matrix.cover, balls, points, no_monitor(), s.mesh);
  EXPECT_THROW(verify_uncovered(matrix.cover, s.balls, points, no_monitor(), s.mesh), InputError);
  try {
    patch_matrix(balls, s.mesh, {.uncovered = UncoveredPolicy::error});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("triangle 0"), std::string::npos) << error.what();
  }
  EXPECT_THROW(patch_matrix(balls, s.mesh, {.uncovered = UncoveredPolicy::ball}), InputError);
  EXPECT_THROW(patch_matrix(balls, {s.mesh.vertices, {{0, 1, 9999}}}), InputError);
}

TEST(patch_matrix, does_not_depend_on_the_number_of_threads) {
  const Patched s = patched(4, 300);
  const auto with = [&](int threads) {
    return tbb::task_arena(threads).execute([&] { return patch_matrix(s.balls, s.mesh).cover; });
  };
  const CoverState one = with(1), four = with(4);
  EXPECT_EQ(one.columns, four.columns);
  EXPECT_EQ(one.row_offsets, four.row_offsets);
}

TEST(cover_points, counts_of_a_closed_triangulation_follow_from_its_euler_characteristic) {
  const TriangleMesh mesh = generate(parse_shape("sphere?n=66"));
  const PointSet samples{mesh.vertices, {}};
  const std::size_t n = mesh.vertices.size(), faces = mesh.triangles.size();
  EXPECT_EQ(cover_points(samples, mesh, Demand::samples).points.points.size(), n);
  EXPECT_EQ(cover_points(samples, mesh, Demand::facets).points.points.size(), n + faces);
  const CoverPoints edges = cover_points(samples, mesh, Demand::edges);
  EXPECT_EQ(edges.points.points.size(), n + faces + (n + faces - 2));
  EXPECT_EQ(broken_invariant(edges.points), "");
  EXPECT_TRUE(std::equal(mesh.vertices.begin(), mesh.vertices.end(), edges.points.points.begin()));
  EXPECT_TRUE(edges.patches.triangles.empty());
  const CoverPoints patches = cover_points(samples, mesh, Demand::patches);
  EXPECT_EQ(patches.points.points.size(), n);
  EXPECT_EQ(patches.patches.triangles.size(), faces);
}

TEST(cover_points, a_centre_that_is_a_sample_is_added_once) {
  // Sample 3 is the middle of the edge from 0 to 1.
  const std::vector<Vec3> p{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {1, 0, 0}};
  const CoverPoints result = cover_points({p, {}}, {p, {{0, 1, 2}}}, Demand::edges);
  EXPECT_EQ(broken_invariant(result.points), "");
  EXPECT_EQ(result.points.points.size(), 4u + 1 + 2);
}

TEST(cover_points, thickness_is_that_of_a_plate_whose_balls_are_known) {
  // A lattice of spacing 1 on a plane, two balls through every sample: four edges of length 1 and two
  // diagonals at an inner one.
  std::vector<Vec3> p;
  std::vector<Triangle> triangles;
  const int n = 41;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) p.push_back({1.0 * i, 1.0 * j, 0});
  }
  for (int i = 0; i + 1 < n; ++i) {
    for (int j = 0; j + 1 < n; ++j) {
      const std::int32_t a = n * i + j;
      triangles.push_back({a, a + n, a + n + 1});
      triangles.push_back({a, a + n + 1, a + 1});
    }
  }
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> defining;
  std::vector<double> radii;
  std::vector<Vec3> centers;
  for (std::int32_t s = 0; s < n * n; ++s) {
    for (const double r : {0.5, 0.75}) {
      centers.push_back({0, 0, r});
      radii.push_back(r);
      defining.push_back(s);
      offsets.push_back(static_cast<std::int64_t>(defining.size()));
    }
  }
  EXPECT_NEAR(thickness({p, triangles}, {centers, radii, offsets, defining}),
              0.75 * 6 / (4 + 2 * std::sqrt(2.0)), 1e-12);
  EXPECT_EQ(thickness({p, triangles}, {centers, radii, {}, {}}), 0);
  const auto chosen = [&](const TriangleMesh& surface, const Balls& balls) {
    return cover_points({p, {}}, surface, Demand::automatic, balls).demand;
  };
  EXPECT_EQ(chosen({p, triangles}, {centers, radii, offsets, defining}), Demand::edges);
  EXPECT_EQ(chosen({p, triangles}, {centers, radii, {}, {}}), Demand::samples) << "nobody knows";
  EXPECT_EQ(chosen({p, {}}, {centers, radii, offsets, defining}), Demand::samples);
  EXPECT_EQ(demand_for(1.5), Demand::samples);
  EXPECT_EQ(demand_for(1.49), Demand::facets);
  EXPECT_EQ(demand_for(0.99), Demand::edges);
}

TEST(cover_points, a_surface_of_other_points_is_refused) {
  const TriangleMesh mesh = generate(parse_shape("sphere?n=50"));
  std::vector<Vec3> moved(mesh.vertices.begin(), mesh.vertices.end());
  moved[3].x += 1;
  EXPECT_THROW(cover_points({moved, {}}, mesh, Demand::facets), InputError);
  EXPECT_EQ(cover_points({moved, {}}, {}, Demand::facets).points.points.size(), moved.size());
}

}  // namespace
}  // namespace ballflow::geometry
