#include "sample/surface_sample.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.hpp"
#include "mesh_files.hpp"
#include "sample/generate.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

/// Two squares in the planes z = 0 (side 1) and z = 1 (side 3).
TriangleMesh two_squares() {
  return {std::vector<Vec3>{
              {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {3, 0, 1}, {3, 3, 1}, {0, 3, 1}},
          std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}}};
}

double least_distance(const PointSet& set) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) least = std::min(least, distance(set.points[i], set.points[j]));
  }
  return least;
}

TEST(sample_surface, spreads_points_by_area) {
  for (const Spread spread : {Spread::random, Spread::poisson}) {
    const PointSet set = sample_surface(two_squares(), {spread, 5000, 1});
    ASSERT_EQ(set.points.size(), 5000u);
    EXPECT_EQ(broken_invariant(set), "");
    const auto small =
        std::count_if(set.points.begin(), set.points.end(), [](const Vec3& p) { return p.z == 0; });
    EXPECT_NEAR(static_cast<double>(small), 500, 80);  // 3.8 standard deviations of independent points
  }
}

TEST(sample_surface, points_lie_on_the_triangles_and_carry_their_normals) {
  const PointSet set = sample_surface(two_squares(), {Spread::random, 1000, 2});
  for (std::size_t i = 0; i < set.points.size(); ++i) {
    const Vec3& p = set.points[i];
    const double side = p.z == 0 ? 1 : 3;
    EXPECT_TRUE(p.z == 0 || p.z == 1);
    EXPECT_TRUE(p.x >= 0 && p.x <= side && p.y >= 0 && p.y <= side);
    EXPECT_EQ(set.normals[i], (Vec3{0, 0, 1}));
  }
}

TEST(sample_surface, poisson_points_keep_their_distance) {
  const TriangleMesh torus = generate(parse_shape("torus?n=3000"));
  double area = 0;
  for (const Triangle& t : torus.triangles) {
    const auto at = [&](std::size_t k) { return torus.vertices[static_cast<std::size_t>(t[k])]; };
    area += 0.5 * length(cross(at(1) - at(0), at(2) - at(0)));
  }
  const double best = 2 * std::sqrt(area / (2 * std::sqrt(3.0) * 2000));  // of a hexagonal packing
  EXPECT_GT(least_distance(sample_surface(torus, {Spread::poisson, 2000, 3})), 0.55 * best);
  EXPECT_LT(least_distance(sample_surface(torus, {Spread::random, 2000, 3})), 0.2 * best);
}

TEST(sample_surface, depends_on_the_seed_and_on_nothing_else) {
  const TriangleMesh mesh = two_squares();
  for (const Spread spread : {Spread::random, Spread::poisson}) {
    const PointSet a = sample_surface(mesh, {spread, 300, 1}), b = sample_surface(mesh, {spread, 300, 1});
    EXPECT_EQ(a.points, b.points);
    EXPECT_FALSE(a.points == sample_surface(mesh, {spread, 300, 2}).points);
  }
}

TEST(sample_surface, passes_over_triangles_without_area) {
  TriangleMesh mesh = two_squares();
  std::vector<Triangle> triangles = {{0, 0, 1}};
  triangles.insert(triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
  triangles.push_back({5, 5, 5});
  mesh.triangles = triangles;
  EXPECT_EQ(broken_invariant(sample_surface(mesh, {Spread::random, 2000, 1})), "");
}

TEST(sample_surface, refuses_a_cloud_and_counts_out_of_range) {
  EXPECT_THROW(sample_surface({}, {}), InputError);
  EXPECT_THROW(sample_surface({two_squares().vertices, {{0, 0, 1}}}, {}), InputError);
  EXPECT_THROW(sample_surface(two_squares(), {Spread::random, 3, 0}), InputError);
  EXPECT_THROW(sample_surface(two_squares(), {Spread::random, 3'000'000, 0}), InputError);
}

TEST(random, gives_the_numbers_of_the_published_generator) {
  // splitmix64 of seed 0 begins with these words (Vigna's reference code).
  // xoshiro256++ then returns rotl(s0 + s3, 23) + s0 first.
  const std::uint64_t s0 = 0xe220a8397b1dcdafull, s3 = 0xf88bb8a8724c81ecull;
  Random random(0);
  EXPECT_EQ(random.bits(), std::rotl(s0 + s3, 23) + s0);
}

TEST(sample, takes_shapes_by_name_and_files_by_path) {
  SampleOptions options;
  options.file = "shape:torus?n=500";
  const MeshFile shape = sample(options, 0);
  EXPECT_EQ(shape.points.points, shape.mesh.vertices);
  EXPECT_EQ(mesh_topology(shape.mesh).genus, 1);
  EXPECT_EQ(shape.mesh.vertices, generate(parse_shape("torus?n=500")).vertices);

  const test::TempFolder folder;
  test::write_file(folder.file("a.ply"), test::as_ply(test::small_mesh(), test::Ply::big));
  options.file = folder.file("a.ply");
  EXPECT_EQ(sample(options, 0).points.points, test::small_mesh().vertices);

  options.scale = "0.5";
  for (const std::string& file : {folder.file("a.ply"), std::string("shape:torus?n=500")}) {
    SampleOptions whole = options;
    whole.scale = "1";
    whole.file = options.file = file;
    const MeshFile half = sample(options, 0), model = sample(whole, 0);
    ASSERT_EQ(half.points.points.size(), model.points.points.size());
    for (std::size_t i = 0; i < half.points.points.size(); ++i) {
      ASSERT_EQ(half.points.points[i], 0.5 * model.points.points[i]);
      ASSERT_EQ(half.mesh.vertices[i], half.points.points[i]);
    }
  }
  options.scale = "1";
  options.file = folder.file("a.ply");

  options.mode = SampleMode::surface;
  options.count = 100;
  const MeshFile surface = sample(options, 0);
  EXPECT_EQ(surface.points.points.size(), 100u);
  EXPECT_EQ(surface.mesh.vertices, test::small_mesh().vertices);
  options.file = "shape:none";
  EXPECT_THROW(sample(options, 0), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
