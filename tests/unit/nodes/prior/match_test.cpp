#include "prior/match.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "io/read_mesh.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "prior/align.hpp"
#include "prior/cloud.hpp"
#include "prior_examples.hpp"
#include "sample/generate.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

/// A shape with samples for matching and inner balls from others.
struct Subject {
  explicit Subject(TriangleMesh surface, std::int64_t samples_wanted = 300) : mesh(std::move(surface)) {
    samples = samples_of(mesh, samples_wanted, 11);
    inner = label_poles(voronoi_poles(samples_of(mesh, 1000, 12), {}), mesh, {}).inner;
  }
  TriangleMesh mesh;
  PointSet samples;
  Balls inner;
};

Subject moved(const Subject& subject, const ShapePose& pose) {
  Subject result = subject;
  result.mesh.vertices = moved(subject.mesh.vertices.span(), pose);
  result.samples = moved(subject.samples, pose);
  result.inner.centers = moved(subject.inner.centers.span(), pose);
  std::vector<double> radii;
  for (const double r : subject.inner.radii) radii.push_back(pose.scale * r);
  result.inner.radii = std::move(radii);
  return result;
}

Balls every_kth(const Balls& balls, std::size_t k) {
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < balls.size(); i += k) ids.push_back(static_cast<std::int32_t>(i));
  return select(balls, ids);
}

TEST(template_balls, are_the_inner_balls_before_they_grew_without_tiny_ones) {
  Balls inner, grown;
  inner.centers = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  inner.radii = {1, 2, 1, 1, 0.01};
  // The last but one was put in for a sample that no ball covers, the last one is the first again.
  grown.centers = {{2, 0, 0}, {1, 0, 0}, {4, 0, 0}, {9, 9, 9}, {2, 0, 0}};
  grown.radii = {1.5, 2.5, 0.5, 0, 1.7};
  const Balls found = template_balls(grown, inner);
  EXPECT_EQ(found.centers, (Array<Vec3>{{2, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(found.radii, (Array<double>{1, 2}));
  EXPECT_THROW(template_balls({}, inner), InputError);
  EXPECT_THROW(template_balls(grown, {}), InputError);
}

TEST(match, a_turned_copy_gives_its_own_balls_back) {
  const Subject bracket(generate({Shape::bracket, 2000}));
  const Balls wanted = every_kth(template_balls(bracket.inner, bracket.inner), 20);
  Random random(1);
  const ShapePose away = random_pose(random, 2.5, 100);
  const Subject copy = moved(bracket, away);
  const MatchedBalls found = match(wanted, bracket.samples, copy.samples, copy.inner, inverse(away), {});
  EXPECT_EQ(broken_invariant(found), "");
  ASSERT_EQ(found.size(), wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    EXPECT_LT(distance(found.centers[i], transformed(away, wanted.centers[i])), 1e-9);
    EXPECT_NEAR(found.radii[i], 2.5 * wanted.radii[i], 1e-9);
    EXPECT_NEAR(found.carried_radii[i], 2.5 * wanted.radii[i], 1e-6);
    EXPECT_EQ(found.partners[i], 1);
    EXPECT_EQ(found.unique[i], 1);
  }
  EXPECT_LT(degrees_between(pose_of(found), inverse(away)), 1e-4);
  EXPECT_NEAR(found.scale, 0.4, 1e-6);
}

TEST(match, a_mirror_image_is_matched_where_it_may_be) {
  const Subject shape(handed_shape());
  ShapePose mirror;
  mirror.rotation[0] = -1;
  mirror.mirrored = 1;
  const Subject other = moved(shape, mirror);
  const Balls wanted = every_kth(template_balls(shape.inner, shape.inner), 20);
  const ShapePose pose = align(other.samples, shape.samples, {.reflections = Reflections::allow});
  ASSERT_EQ(pose.mirrored, 1);
  const MatchedBalls found = match(wanted, shape.samples, other.samples, other.inner, pose, {});
  EXPECT_EQ(broken_invariant(found), "");
  EXPECT_EQ(found.mirrored, 1);
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_LT(distance(found.centers[i], transformed(mirror, wanted.centers[i])), 1e-6);
  // Normals stay outward.
  for (std::size_t j = 0; j < shape.samples.points.size(); ++j)
    EXPECT_GT(dot(found.normals[j], turned(mirror, shape.samples.normals[j])), 0.5) << j;
}

TEST(match, points_of_a_bump_go_with_it) {
  // The summit of the bump is the only place of its kind; points of the far end are not moved.
  const TriangleMesh from = bump_box(4.2), to = bump_box(3.4);
  const PointSet a = samples_of(from, 600, 1), b = samples_of(to, 600, 2);
  PointSet target = a;
  std::vector<Vec3> points(a.points.begin(), a.points.end()), normals(a.normals.begin(), a.normals.end());
  points.push_back({4.2, 2, 4.6});
  normals.push_back({0, 0, 1});
  target.points = points;
  target.normals = normals;
  Balls one;
  one.centers = {{5, 2, 1.5}};
  one.radii = {1};
  const MatchedBalls found = match(one, target, b, one, {}, {});
  EXPECT_NEAR(found.points.back().x, 3.4, 0.25);
  EXPECT_NEAR(found.points.back().z, 4.6, 0.15);
  double mean = 0, far_end = 0;
  std::size_t at_end = 0;
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    mean += found.point_residuals[i] / static_cast<double>(a.points.size());
    if (a.points[i].x < 9) continue;
    far_end += distance(found.points[i], a.points[i]);
    ++at_end;
  }
  EXPECT_LT(mean, 0.06);  // of a diagonal of 11.7: the bump is followed
  EXPECT_LT(far_end / static_cast<double>(at_end), 0.25);
}

TEST(match, results_have_the_same_bytes_for_any_number_of_threads) {
  const Subject bracket(generate({Shape::bracket, 2000})), other(generate({Shape::bracket, 2000, 1, 0.35}));
  const Balls wanted = every_kth(template_balls(bracket.inner, bracket.inner), 20);
  const auto run = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const ShapePose pose = align(other.samples, bracket.samples, {});
    return match(wanted, bracket.samples, other.samples, other.inner, pose, {.centers = 50});
  };
  const MatchedBalls one = run(1), two = run(2);
  EXPECT_TRUE(one.centers == two.centers && one.carried == two.carried && one.points == two.points &&
              one.normals == two.normals && one.rotation == two.rotation && one.scale == two.scale);
}

TEST(match, tells_what_is_missing) {
  const Subject bracket(generate({Shape::bracket, 2000}));
  const Balls wanted = every_kth(template_balls(bracket.inner, bracket.inner), 20);
  const auto with = [&](const Balls& balls, const PointSet& samples, const Balls& inner) {
    Warnings warnings;
    match(balls, bracket.samples, samples, inner, {}, {}, warnings);
    return warnings.text;
  };
  Balls few;
  few.centers = {wanted.centers[0], wanted.centers[1]};
  few.radii = {wanted.radii[0], wanted.radii[1]};
  const std::string text = with(wanted, bracket.samples, few);
  EXPECT_NE(text.find("2 inner balls, fewer than"), std::string::npos) << text;
  EXPECT_NE(text.find("no partner"), std::string::npos) << text;
  Balls flat = few;
  flat.radii = {0, 1};
  EXPECT_THROW(with(flat, bracket.samples, bracket.inner), InputError);
  EXPECT_THROW(with({}, bracket.samples, bracket.inner), InputError);
  EXPECT_THROW(with(wanted, bracket.samples, {}), InputError);
  EXPECT_THROW(with(wanted, {}, bracket.inner), InputError);
  PointSet bare = bracket.samples;
  bare.normals = {};
  EXPECT_THROW(with(wanted, bare, bracket.inner), InputError);
}

/// Where a smooth map that takes every `from` to its `to` takes `points`: the interpolant of least bending,
/// by Gaussian elimination. The oracle of correspondence inside of labelled surfaces.
std::vector<Vec3> interpolated(const std::vector<Vec3>& from, const std::vector<Vec3>& to,
                               std::span<const Vec3> points) {
  const std::size_t n = from.size(), size = n + 4;
  std::vector<std::vector<double>> rows(size, std::vector<double>(size + 3, 0.0));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) rows[i][j] = distance(from[i], from[j]);
    const double affine[4] = {1, from[i].x, from[i].y, from[i].z};
    for (std::size_t k = 0; k < 4; ++k) rows[i][n + k] = rows[n + k][i] = affine[k];
    rows[i][size] = to[i].x;
    rows[i][size + 1] = to[i].y;
    rows[i][size + 2] = to[i].z;
  }
  for (std::size_t c = 0; c < size; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < size; ++r)
      if (std::abs(rows[r][c]) > std::abs(rows[pivot][c])) pivot = r;
    std::swap(rows[c], rows[pivot]);
    for (std::size_t r = c + 1; r < size; ++r) {
      const double factor = rows[r][c] / rows[c][c];
      for (std::size_t k = c; k < size + 3; ++k) rows[r][k] -= factor * rows[c][k];
    }
  }
  std::vector<Vec3> weights(size);
  for (std::size_t r = size; r-- > 0;) {
    Vec3 sum{rows[r][size], rows[r][size + 1], rows[r][size + 2]};
    for (std::size_t k = r + 1; k < size; ++k) sum = sum - rows[r][k] * weights[k];
    weights[r] = (1 / rows[r][r]) * sum;
  }
  std::vector<Vec3> result;
  for (const Vec3& p : points) {
    Vec3 sum = weights[n] + p.x * weights[n + 1] + p.y * weights[n + 2] + p.z * weights[n + 3];
    for (std::size_t i = 0; i < n; ++i) sum = sum + distance(p, from[i]) * weights[i];
    result.push_back(sum);
  }
  return result;
}

/// Mean distances of the balls of a template from where the labels say, as parts of its diagonal.
struct Errors {
  double carried = 0, found = 0, aligned = 0, unique = 0;
};

Errors errors_of(const Subject& model, const Subject& bone) {
  const Balls wanted = every_kth(template_balls(model.inner, model.inner), 6);
  const Box box = bounding_box(model.samples.points);
  const double diagonal = length(box.upper - box.lower);
  const ShapePose pose = align(bone.samples, model.samples, {});
  const MatchedBalls matched = match(wanted, model.samples, bone.samples, bone.inner, pose, {});
  std::vector<Vec3> from, to;
  for (const std::int32_t v : farthest_points(model.mesh.vertices, 200)) {
    from.push_back(model.mesh.vertices[static_cast<std::size_t>(v)]);
    to.push_back(bone.mesh.vertices[static_cast<std::size_t>(v)]);
  }
  const std::vector<Vec3> truth = interpolated(from, to, wanted.centers);
  Errors errors;
  const double one = 1 / static_cast<double>(wanted.size()), unit = pose.scale / diagonal * one;
  for (std::size_t b = 0; b < wanted.size(); ++b) {
    errors.carried += unit * distance(matched.carried[b], truth[b]);
    errors.found += unit * distance(matched.centers[b], truth[b]);
    errors.aligned += unit * distance(transformed(inverse(pose), wanted.centers[b]), truth[b]);
    errors.unique += one * matched.unique[b];
  }
  return errors;
}

TEST(match, balls_of_scapulae_are_carried_to_where_the_labels_say) {
  std::vector<Subject> bones;
  for (const char* name : {"2", "23", "34", "48"}) {
    const std::string file = test::data_file("models/scapula_" + std::string(name) + ".stl.gz");
    if (file.empty()) GTEST_SKIP() << "no test data";
    bones.emplace_back(read_mesh_file(file, {}).mesh, 700);
  }
  const bool all = std::getenv("BALLFLOW_TEST_LARGE") != nullptr;  // every bone is the template, else one
  Random random(9);
  Errors mean;
  double pairs = 0;
  for (std::size_t t = all ? 0 : 2; t < (all ? 4 : 3); ++t) {
    for (std::size_t i = 0; i < 4; ++i) {
      if (i == t) continue;
      const Subject bone = moved(bones[i], random_pose(random, 0.8 + 0.5 * random.unit(), 300));
      const Errors errors = errors_of(bones[t], bone);
      EXPECT_LT(errors.carried, 0.012) << i << " on " << t;
      EXPECT_GT(errors.unique, 0.7) << i << " on " << t;
      mean.carried += errors.carried;
      mean.found += errors.found;
      mean.aligned += errors.aligned;
      ++pairs;
    }
  }
  EXPECT_LT(mean.carried, 0.65 * mean.aligned);
  EXPECT_LT(mean.found / pairs, 0.012);
  RecordProperty("carried_percent", std::to_string(100 * mean.carried / pairs));
  RecordProperty("found_percent", std::to_string(100 * mean.found / pairs));
  RecordProperty("aligned_percent", std::to_string(100 * mean.aligned / pairs));
}

}  // namespace
}  // namespace ballflow::geometry
