#include "prior/shape_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "prior/shape_instance.hpp"
#include "prior/shape_prior.hpp"
#include "prior/smooth_map.hpp"
#include "search/surface_tree.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

TEST(smooth_map, goes_through_its_points_and_reproduces_affine_maps) {
  Random random(3);
  const std::vector<Vec3> from = random_points(random, 40);
  const auto affine = [](Vec3 p) {
    return Vec3{2 * p.x + 0.5 * p.y + 1000, p.y - p.z, 0.25 * p.x + 3 * p.z};
  };
  std::vector<Vec3> to, bent;
  for (const Vec3& p : from) {
    to.push_back(affine(p));
    bent.push_back(p + Vec3{std::sin(9 * p.y), 0, p.x * p.x});
  }
  const SmoothMap map(from, to), other(from, bent);
  const double determinant = 2 * 3 + 0.5 * (0.25 * -1 - 0);
  for (const Vec3& p : random_points(random, 20)) {
    EXPECT_LT(distance(map.at(p), affine(p)), 1e-9);
    EXPECT_NEAR(map.volume_factor(p), determinant, 1e-7);
  }
  for (std::size_t i = 0; i < from.size(); ++i) EXPECT_LT(distance(other.at(from[i]), bent[i]), 1e-9);
}

TEST(smooth_map, tells_where_it_turns_space_inside_out) {
  Random random(4);
  const std::vector<Vec3> from = random_points(random, 200);
  std::vector<Vec3> mirrored, folded;
  for (const Vec3& p : from) {
    mirrored.push_back({-p.x, p.y, p.z});
    folded.push_back({(p.x - 0.5) * (p.x - 0.5), p.y, p.z});
  }
  EXPECT_NEAR(SmoothMap(from, mirrored).volume_factor({0.4, 0.3, 0.6}), -1, 1e-9);
  const SmoothMap fold(from, folded);
  for (const Vec3& p : {Vec3{0.8, 0.5, 0.5}, Vec3{0.2, 0.5, 0.5}})
    EXPECT_NEAR(fold.volume_factor(p), 2 * (p.x - 0.5), 0.1) << p.x;
  // The derivative is that of the map.
  const Vec3 p{0.31, 0.52, 0.47};
  const double h = 1e-5;
  const auto column = [&](Vec3 d) { return (1 / (2 * h)) * (fold.at(p + h * d) - fold.at(p - h * d)); };
  EXPECT_NEAR(fold.volume_factor(p), dot(column({1, 0, 0}), cross(column({0, 1, 0}), column({0, 0, 1}))),
              1e-6);
}

TEST(smooth_map, refuses_points_in_one_plane_and_points_that_are_one) {
  Random random(5);
  std::vector<Vec3> flat = random_points(random, 10);
  for (Vec3& p : flat) p.z = 0.25;
  std::vector<Vec3> lifted = flat;
  for (Vec3& p : lifted) p.z += p.x * p.y;
  EXPECT_THROW(SmoothMap(flat, lifted), InputError);
  EXPECT_THROW(SmoothMap(std::vector<Vec3>(5), std::vector<Vec3>(5)), InputError);
  EXPECT_THROW(SmoothMap(std::vector<Vec3>(3), std::vector<Vec3>(3)), InputError);
}

/// The surface that the points of a member of the family lie on.
Vec3 surface_point(Vec3 u, double length, double growth) {
  const double taper = 1 + 0.25 * u.x;
  return {(1 + length) * 3 * u.x, 2 * taper * u.y + 0.4 * u.x * u.x, (1 + growth) * u.z};
}

TriangleMesh surface_of(double length, double growth) {
  constexpr std::int32_t around = 48, up = 24;
  std::vector<Vec3> vertices = {surface_point({0, 0, -1}, length, growth)};
  for (std::int32_t i = 1; i < up; ++i) {
    for (std::int32_t j = 0; j < around; ++j) {
      const double a = std::numbers::pi * i / up, b = 2 * std::numbers::pi * j / around;
      vertices.push_back(surface_point({std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), -std::cos(a)},
                                       length, growth));
    }
  }
  const auto top = static_cast<std::int32_t>(vertices.size());
  vertices.push_back(surface_point({0, 0, 1}, length, growth));
  std::vector<Triangle> triangles;
  for (std::int32_t j = 0; j < around; ++j) {
    const std::int32_t k = (j + 1) % around;
    triangles.push_back({0, 1 + k, 1 + j});
    for (std::int32_t i = 0; i + 2 < up; ++i) {
      const std::int32_t row = 1 + i * around, next = row + around;
      triangles.push_back({row + j, row + k, next + k});
      triangles.push_back({row + j, next + k, next + j});
    }
    triangles.push_back({top - around + j, top - around + k, top});
  }
  return {std::move(vertices), std::move(triangles)};
}

struct Surfaced {
  explicit Surfaced(std::size_t n) : members(family(n, 1, false)), prior(shape_prior(members.members, {})) {
    const TriangleMesh own = surface_of(members.lengths[0], members.growths[0]);
    PointSet points;
    points.points = members.members[0].points;
    TriangleMesh mean = mesh_of_mean(prior, own, points);
    prior.vertices = std::move(mean.vertices);
    prior.triangles = std::move(mean.triangles);
  }
  std::vector<double> scores_of(std::size_t i) const {
    const std::size_t q = prior.mode_count();
    return {prior.scores.begin() + static_cast<std::ptrdiff_t>(i * q),
            prior.scores.begin() + static_cast<std::ptrdiff_t>((i + 1) * q)};
  }
  Family members;
  ShapePrior prior;
};

TEST(shape_mesh, is_the_surface_of_a_member_with_its_scores) {
  const Surfaced shapes(6);
  EXPECT_EQ(broken_invariant(shapes.prior), "");
  for (const std::size_t i : {std::size_t{0}, std::size_t{3}, std::size_t{5}}) {
    const std::vector<double> scores = shapes.scores_of(i);
    // Back from the coordinates of the model to those of the member.
    const auto& t = shapes.prior.poses[i];
    ShapePose pose;
    pose.rotation = {t[0], t[1], t[2], t[4], t[5], t[6], t[8], t[9], t[10]};
    pose.translation = {t[3], t[7], t[11]};
    const ShapePose back = inverse(pose);
    const auto& r = back.rotation;
    const std::array<double, 12> rows = {r[0], r[1], r[2], back.translation.x,
                                         r[3], r[4], r[5], back.translation.y,
                                         r[6], r[7], r[8], back.translation.z};
    Balls balls;
    balls.centers = {{0, 0, 0}};
    balls.radii = {1};
    const ShapeMesh made = shape_mesh(shapes.prior, scores, rows, balls);
    const TriangleMesh truth = surface_of(shapes.members.lengths[i], shapes.members.growths[i]);
    ASSERT_EQ(made.mesh.triangles, truth.triangles);
    double worst = 0;
    for (std::size_t v = 0; v < truth.vertices.size(); ++v)
      worst = std::max(worst, distance(made.mesh.vertices[v], truth.vertices[v]));
    EXPECT_LT(worst, 0.03) << "member " << i << " of size 6 x 4 x 2";
    EXPECT_EQ(made.check.folded, 0);
    EXPECT_EQ(made.check.intersections, 0);
    // A sphere of radius 1 touches it from inside at the poles, and is nearly 2 away from its ends.
    EXPECT_NEAR(made.check.largest_distance, 3 * (1 + shapes.members.lengths[i]) - 1, 0.1);
    EXPECT_TRUE(made.check.closed);
    // u -> surface_point(u) is of degree 2 with determinant 3 (1 + length) 2 taper (1 + growth); the taper is
    // 1 in the mean over the unit ball.
    const double volume =
        4 * std::numbers::pi / 3 * 6 * (1 + shapes.members.lengths[i]) * (1 + shapes.members.growths[i]);
    EXPECT_NEAR(made.check.volume, volume, 0.02 * volume);
  }
}

TEST(shape_mesh, says_where_it_folds) {
  const Surfaced shapes(6);
  Warnings warnings;
  const std::vector<double> far = {30, 0};
  const std::vector<double> wide = {-30, 0};
  bool folded = false;
  for (const auto& scores : {far, wide}) {
    const ShapeMesh made =
        shape_mesh(shapes.prior, scores, {}, shape_instance(shapes.prior, scores), warnings);
    folded = folded || made.check.folded > 0;
  }
  EXPECT_TRUE(folded);
  EXPECT_TRUE(says(warnings, "the mesh folds")) << warnings.text;
  Warnings none;
  shape_mesh(shapes.prior, std::vector<double>{1, -1}, {}, shape_instance(shapes.prior, {}), none);
  EXPECT_EQ(none.text, "");
}

TEST(shape_mesh, keeps_a_template_without_inside_and_counts_what_crossed_before) {
  Surfaced shapes(4);
  // Two triangles that cross far inside, beside the surface.
  std::vector<Vec3> vertices(shapes.prior.vertices.begin(), shapes.prior.vertices.end());
  std::vector<Triangle> triangles(shapes.prior.triangles.begin(), shapes.prior.triangles.end());
  const auto base = static_cast<std::int32_t>(vertices.size());
  for (const Vec3& p : {Vec3{0, 0, 0}, Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}, Vec3{0.1, 0.1, -0.3},
                        Vec3{0.1, 0.1, 0.3}, Vec3{0.2, 0.4, 0.1}})
    vertices.push_back(p);
  triangles.push_back({base, base + 1, base + 2});
  triangles.push_back({base + 3, base + 4, base + 5});
  shapes.prior.vertices = std::move(vertices);
  shapes.prior.triangles = std::move(triangles);
  Warnings warnings;
  const ShapeMesh made = shape_mesh(shapes.prior, std::vector<double>{0.5}, {},
                                    shape_instance(shapes.prior, std::vector<double>{0.5}), warnings);
  EXPECT_EQ(made.check.of_mean, 1);
  EXPECT_EQ(made.check.intersections, 1);
  EXPECT_FALSE(made.check.closed);
  EXPECT_EQ(warnings.text, "");
}

TEST(shape_mesh, has_nothing_to_say_of_a_model_without_a_mesh) {
  const ShapePrior prior = shape_prior(family(4).members, {});
  Warnings warnings;
  EXPECT_TRUE(shape_mesh(prior, {}, {}, shape_instance(prior, {}), warnings).mesh.triangles.empty());
  EXPECT_TRUE(says(warnings, "has no mesh"));
  EXPECT_THROW(shape_mesh(prior, std::vector<double>(9, 1.0), {}, Balls{}), InputError);
  PointSet few;
  few.points = {{0, 0, 0}};
  EXPECT_THROW(mesh_of_mean(prior, surface_of(0, 0), few), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
