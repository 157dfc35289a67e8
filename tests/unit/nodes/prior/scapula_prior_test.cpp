// Models of four real bones: what they know of one that they have not seen. At night (BALLFLOW_TEST_LARGE)
// all bones and cuts, else one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "individuals.hpp"
#include "io/read_mesh.hpp"
#include "prior/shape_fit.hpp"
#include "prior/shape_instance.hpp"
#include "prior/shape_mesh.hpp"
#include "prior/shape_prior.hpp"
#include "search/surface_tree.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

constexpr double everywhere = 1e300;

bool at_night() { return std::getenv("BALLFLOW_TEST_LARGE") != nullptr; }

/// The bones, matched to the first of them; none without test data.
struct Scapulas {
  Scapulas() {
    for (const char* name : {"2", "23", "34", "48"}) {
      const std::string file = test::data_file("models/scapula_" + std::string(name) + ".stl.gz");
      if (file.empty()) return;
      bones.emplace_back(read_mesh_file(file, {}).mesh, at_night() ? 1000 : 500, at_night() ? 5000 : 2000,
                         3 + bones.size());
    }
    for (const Individual& bone : bones) meshes.push_back(bone.mesh);
    all = matched(bones, template_of(bones[0], at_night() ? 400 : 100), bones[0]);
  }
  std::vector<Individual> bones;
  std::vector<TriangleMesh> meshes;
  std::vector<MatchedBalls> all;
};

struct ScapulaModels : testing::Test {
  void SetUp() override {
    static const Scapulas made;
    if (made.all.empty()) GTEST_SKIP() << "no test data";
    scapulas = &made;
  }
  /// Of all but one.
  ShapePrior model_without(std::size_t left_out, const ShapePriorOptions& options) const {
    std::vector<MatchedBalls> rest;
    for (std::size_t i = 0; i < scapulas->all.size(); ++i) {
      if (i != left_out) rest.push_back(scapulas->all[i]);
    }
    return shape_prior(rest, {}, options);
  }
  const Scapulas* scapulas = nullptr;
};

/// The same without modes.
ShapePrior mean_of(const ShapePrior& prior) {
  ShapePrior mean = prior;
  mean.modes = {};
  mean.point_modes = {};
  mean.variances = mean.scores = mean.specificity = mean.specificity_deviation = {};
  return mean;
}

/// From the surface of a union: min over the balls of |x - c| - r, without its sign. Where x is inside of
/// several balls the boundary may be farther away than that.
double from_union(const Balls& balls, Vec3 x) {
  double least = everywhere;
  for (std::size_t i = 0; i < balls.size(); ++i)
    least = std::min(least, distance(x, balls.centers[i]) - balls.radii[i]);
  return std::abs(least);
}

TEST_F(ScapulaModels, know_a_bone_that_they_have_not_seen_better_than_their_mean) {
  const ShapePrior prior = shape_prior(scapulas->all, scapulas->meshes);
  ASSERT_EQ(prior.measure, static_cast<std::uint8_t>(SurfaceMeasure::meshes));
  ASSERT_EQ(prior.generalization.size(), 3u);
  std::printf("left out: %.3f, mean %.3f, ratio %.3f\n", prior.generalization[2], prior.generalization[0],
              prior.generalization[2] / prior.generalization[0]);
  EXPECT_LT(prior.generalization[2], 0.95 * prior.generalization[0]);
}

TEST_F(ScapulaModels, unions_of_their_balls_do_so_too) {
  const auto& [bones, meshes, all] = *scapulas;
  std::vector<ModelBalls> kinds = {ModelBalls::carried};
  if (at_night()) kinds.push_back(ModelBalls::replaced);
  for (const ModelBalls balls : kinds) {
    double from_mean = 0, from_model = 0, own = 0;
    const std::size_t count = at_night() ? 4 : 1;
    for (std::size_t i = 0; i < count; ++i) {
      ShapePriorOptions options;
      options.draws = 0;
      options.balls = balls;
      const ShapePrior prior = model_without(i, options);
      PointSet observed;  // the bone's own points, all of them sure
      observed.points = all[i].points;
      observed.normals = all[i].normals;
      ShapeFitOptions sure;
      sure.effective = 1e6;
      const Balls model = balls_of(shape_fit(prior, observed, pose_of(all[i]), sure));
      const Balls mean = balls_of(shape_fit(mean_of(prior), observed, pose_of(all[i]), sure));
      const PointSet surface = samples_of(bones[i].mesh, 2000, 99);
      const double part = 1 / (2000.0 * static_cast<double>(count));
      for (const Vec3& x : surface.points) {
        from_mean += part * from_union(mean, x);
        from_model += part * from_union(model, x);
        own += part * from_union(balls_of(all[i]), x);
      }
    }
    std::printf(
        "%s balls: union of the model %.3f, of its mean %.3f, ratio %.3f; of the bone's own balls %.3f\n",
        balls == ModelBalls::carried ? "carried" : "replaced", from_model, from_mean, from_model / from_mean,
        own);
    EXPECT_LT(from_model, (at_night() ? 0.95 : 1) * from_mean);
  }
}

/// A turn by about 10 degrees and a shift, around a point.
ShapePose astray(Random& random, Vec3 around) {
  ShapePose pose;
  Vec3 axis{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
  axis = (0.087 / length(axis)) * axis;  // the tangent of half the angle
  const auto [a, b, c] = axis;
  const double n = 1 + squared_length(axis);
  pose.rotation = {
      (1 + a * a - b * b - c * c) / n, 2 * (a * b - c) / n, 2 * (a * c + b) / n, 2 * (a * b + c) / n,
      (1 - a * a + b * b - c * c) / n, 2 * (b * c - a) / n, 2 * (a * c - b) / n, 2 * (b * c + a) / n,
      (1 - a * a - b * b + c * c) / n};
  pose.translation = around - turned(pose, around) + Vec3{3, -3, 3};
  return pose;
}

TEST_F(ScapulaModels, complete_a_half_at_least_as_well_as_their_mean) {
  const auto& [bones, meshes, all] = *scapulas;
  const bool large = at_night();
  Random random(8);
  double mean_error = 0, fit_error = 0, noisy_error = 0;
  int cuts = 0, better = 0;
  for (std::size_t i = 0; i < (large ? 4 : 1); ++i) {
    ShapePriorOptions options;
    options.draws = 0;
    const ShapePrior prior = model_without(i, options);
    const ShapePrior mean = mean_of(prior);
    const SurfaceTree tree(bones[i].mesh);
    const PointSet surface = samples_of(bones[i].mesh, 3000, 77);
    const Box box = bounding_box(surface.points.span());
    const Vec3 size = box.upper - box.lower;
    for (std::size_t cut = 0; cut < (large ? 6 : 1); ++cut) {
      Vec3 direction{cut / 2 == 0 ? 1.0 : 0, cut / 2 == 1 ? 1.0 : 0, cut / 2 == 2 ? 1.0 : 0};
      if (cut % 2 == 1) direction = -direction;
      std::vector<double> heights;
      for (const Vec3& p : surface.points) heights.push_back(dot(p, direction));
      std::nth_element(heights.begin(), heights.begin() + 1500, heights.end());
      const double half = heights[1500];
      std::vector<Vec3> points, normals;
      for (std::size_t k = 0; k < surface.points.size(); ++k) {
        if (dot(surface.points[k], direction) >= half) continue;
        const Vec3 noise{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5};
        points.push_back(surface.points[k] + noise);  // deviation .3 mm in each direction
        normals.push_back(surface.normals[k]);
      }
      PointSet clean;
      clean.points = points;
      clean.normals = normals;
      for (std::size_t k = clean.points.size() / 4; k > 0; --k) {
        points.push_back(box.lower +
                         Vec3{random.unit() * size.x, random.unit() * size.y, random.unit() * size.z});
        normals.push_back(turned(random_pose(random), {1, 0, 0}));
      }
      PointSet noisy;
      noisy.points = points;
      noisy.normals = normals;
      // Into the coordinates of the model, as the labels say, and astray.
      ShapePose start = pose_of(all[i]);
      const ShapePose aside = astray(random, 0.5 * (box.lower + box.upper));
      const ShapePose to_model = [&] {
        const std::vector<Vec3> corners = {{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {0, 0, 100}};
        ShapePose composed = start;
        for (int r = 0; r < 3; ++r) {
          for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (int k = 0; k < 3; ++k)
              sum += start.rotation[static_cast<std::size_t>(3 * r + k)] *
                     aside.rotation[static_cast<std::size_t>(3 * k + c)];
            composed.rotation[static_cast<std::size_t>(3 * r + c)] = sum;
          }
        }
        composed.translation = transformed(start, aside.translation);
        return composed;
      }();
      const auto missing = [&](const ShapePrior& model, const PointSet& observed) {
        const ShapeFit fit = shape_fit(model, observed, to_model);
        double sum = 0;
        int count = 0;
        for (const Vec3& p : points_of(model, fit).points) {
          if (dot(p, direction) < half) continue;
          sum += tree.nearest(p, everywhere)->distance;
          ++count;
        }
        EXPECT_GT(count, 0) << "no point of the model is where the half is missing";
        return sum / std::max(count, 1);
      };
      const double by_mean = missing(mean, clean), by_fit = missing(prior, clean);
      mean_error += by_mean;
      fit_error += by_fit;
      noisy_error += missing(prior, noisy);
      better += by_fit < by_mean ? 1 : 0;
      ++cuts;
    }
  }
  std::printf(
      "missing half: mean %.3f, fit %.3f (ratio %.3f, better in %d of %d), with outliers %.3f (ratio %.3f)\n",
      mean_error / cuts, fit_error / cuts, fit_error / mean_error, better, cuts, noisy_error / cuts,
      noisy_error / fit_error);
  EXPECT_LE(fit_error, mean_error);
  EXPECT_LE(noisy_error, 1.1 * fit_error);
}

// The balls of thin blades do not touch: the boundary of their union has dozens of pieces.
TEST_F(ScapulaModels, complete_halves_in_one_piece) {
  const auto& [bones, meshes, all] = *scapulas;
  ShapePriorOptions options;
  options.draws = 0;
  ShapePrior prior = model_without(0, options);
  TriangleMesh mean = mesh_of_mean(prior, meshes[0], bones[0].samples);  // the others were matched to it
  prior.vertices = std::move(mean.vertices);
  prior.triangles = std::move(mean.triangles);
  const MeshTopology own = mesh_topology(meshes[0]);
  const Box box = bounding_box(meshes[0].vertices.span());
  for (int cut = 0; cut < (at_night() ? 6 : 2); ++cut) {
    const Vec3 middle = 0.5 * (box.lower + box.upper);
    PointSet half;
    std::vector<Vec3> points, normals;
    for (std::size_t i = 0; i < bones[0].samples.points.size(); ++i) {
      const Vec3 p = bones[0].samples.points[i] - middle;
      const double height = cut / 2 == 0 ? p.x : cut / 2 == 1 ? p.z : p.y;
      if ((height < 0) != (cut % 2 == 0)) continue;
      points.push_back(bones[0].samples.points[i]);
      normals.push_back(bones[0].samples.normals[i]);
    }
    half.points = std::move(points);
    half.normals = std::move(normals);
    const ShapeFit fit = shape_fit(prior, half, pose_of(all[0]));
    Warnings warnings;
    const ShapeMesh made = shape_mesh(prior, fit.scores, fit.pose, balls_of(fit), warnings);
    const MeshTopology topology = mesh_topology(made.mesh);
    EXPECT_EQ(topology.components, own.components);
    EXPECT_EQ(topology.genus, own.genus);
    EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
    EXPECT_EQ(made.check.folded, 0);
    EXPECT_LE(made.check.intersections, made.check.of_mean);
    EXPECT_EQ(warnings.text, "");
    const SurfaceTree tree(meshes[0]);
    double sum = 0;
    for (const Vec3& p : made.mesh.vertices) sum += tree.nearest(p, everywhere)->distance;
    sum /= static_cast<double>(made.mesh.vertices.size());
    std::printf("half %d: %.3f from the bone, %.3f from the balls, volume %.4g\n", cut, sum,
                made.check.mean_distance, made.check.volume);
    EXPECT_LT(sum, 0.015 * length(box.upper - box.lower));
    // 100 balls that nobody chose leave much of the blade out.
    EXPECT_LT(made.check.mean_distance, 0.02 * length(box.upper - box.lower));
  }
}

}  // namespace
}  // namespace ballflow::geometry
