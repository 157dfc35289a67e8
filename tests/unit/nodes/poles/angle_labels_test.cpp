#include "poles/angle_labels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "sample/sample.hpp"
#include "shapes.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

using test::Mesh;

constexpr LabelPolesOptions by_angle{LabelMethod::angle};

struct Agreement {
  std::size_t poles = 0, different = 0, uncertain = 0, both = 0;
  double part() const { return 1 - static_cast<double>(different) / static_cast<double>(poles); }
};

/// Labels from the points alone against those of the mesh, for the poles of all samples.
Agreement compare(const PointSet& points, const TriangleMesh& mesh) {
  const PoleSet poles = voronoi_poles(points, {});
  const AngleLabels found = angle_labels(poles, no_monitor());
  const LabelledPoles expected = label_poles(poles, mesh, {});
  std::map<Vec3, std::uint8_t> labels;
  for (std::size_t i = 0; i < expected.poles.size(); ++i)
    labels[expected.poles.centers[i]] = expected.poles.labels[i];
  const auto pole = is_pole(poles);
  Agreement result;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    if (pole[i] == 0) continue;
    ++result.poles;
    const bool different = labels.at(poles.centers[i]) != found.labels[i];
    result.different += different ? 1 : 0;
    result.uncertain += found.uncertain[i];
    result.both += different && found.uncertain[i] == 1 ? 1 : 0;
  }
  return result;
}

class angle_labels_of_smooth_shape : public testing::TestWithParam<const char*> {};

TEST_P(angle_labels_of_smooth_shape, are_those_of_the_mesh) {
  SampleOptions options;
  options.file = GetParam();
  const MeshFile model = sample(options, 0);
  const Agreement found = compare(model.points, model.mesh);
  EXPECT_GT(found.poles, model.points.points.size());
  EXPECT_GT(found.part(), 0.999) << found.different << " of " << found.poles;
  EXPECT_EQ(found.uncertain, 0u);
}

INSTANTIATE_TEST_SUITE_P(shapes, angle_labels_of_smooth_shape,
                         testing::Values("shape:sphere?n=2000", "shape:torus?n=12000",
                                         "shape:doubleTorus?n=8000", "shape:3cross?n=12000",
                                         "shape:knot?n=12000"));

TEST(angle_labels, of_a_scan_name_most_of_their_mistakes) {
  const std::string path = test::data_file("models/stanford_bunny.obj.gz");
  if (path.empty()) GTEST_SKIP() << "models/stanford_bunny.obj.gz is not there";
  SampleOptions options;
  options.file = path;
  const MeshFile model = sample(options, 0);
  const Agreement found = compare(model.points, model.mesh);
  EXPECT_GT(found.part(), 0.999) << found.different << " of " << found.poles;
  EXPECT_LT(found.uncertain, found.poles / 100);
  EXPECT_GE(2 * found.both, found.different);
}

TEST(angle_labels, keep_a_cavity) {
  Mesh hollow = test::sphere(4);
  hollow.add(test::sphere(4).move({0, 0, 0}, 0.5).turn());
  const LabelledPoles found = label_poles(voronoi_poles(hollow.points(), {}), {}, by_angle);
  EXPECT_EQ(found.method, LabelMethod::angle);
  for (std::size_t i = 0; i < found.inner.size(); ++i)
    EXPECT_NEAR(length(found.inner.centers[i]), 0.75, 0.02);
  for (std::size_t i = 0; i < found.outer.size(); ++i) {
    const double d = length(found.outer.centers[i]);
    EXPECT_TRUE(d < 0.02 || d > 1) << d;
  }
}

TEST(angle_labels, of_a_cloud_are_found_without_being_asked_for) {
  const Mesh torus = test::torus(60, 30, 0.4);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  const LabelledPoles found = label_poles(poles, {}, {});
  EXPECT_EQ(found.method, LabelMethod::angle);
  EXPECT_EQ(found.uncertain, 0);
  EXPECT_EQ(found.unlabelled, 0);
  EXPECT_EQ(found.inner.centers, label_poles(poles, torus.mesh(), {}).inner.centers);
  EXPECT_EQ(broken_invariant(found.poles), "");
}

TEST(angle_labels, of_a_coarse_and_crumpled_surface_come_with_a_warning) {
  struct Warnings final : Monitor {
    std::string text;
    void warn(const std::string& warning) override { text += warning + "\n"; }
  } warnings;
  Mesh crumpled = test::sphere(4);
  std::mt19937 random(2);
  for (Vec3& v : crumpled.vertices) v = (0.7 + 0.3 * static_cast<double>(random()) / 4294967296.0) * v;
  const LabelledPoles found = label_poles(voronoi_poles(crumpled.points(), {}), {}, by_angle, warnings);
  EXPECT_GT(found.uncertain * 100, static_cast<std::int64_t>(found.poles.size()));
  EXPECT_NE(warnings.text.find(std::to_string(found.uncertain) + " of "), std::string::npos) << warnings.text;
}

TEST(angle_labels, need_no_mesh_but_the_other_methods_do) {
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  EXPECT_NO_THROW(label_poles(poles, {}, by_angle));
  for (const LabelMethod method : {LabelMethod::mesh, LabelMethod::winding}) {
    try {
      label_poles(poles, {}, {method});
      ADD_FAILURE();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("method angle"), std::string::npos) << error.what();
    }
  }
}

TEST(angle_labels, of_permuted_and_scaled_points_are_the_same) {
  const Mesh torus = test::torus(60, 30, 0.4);
  std::vector<std::size_t> order(torus.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  Mesh other;
  for (const std::size_t i : order) other.vertices.push_back(4 * torus.vertices[i]);
  const auto labels = [](const Mesh& mesh, double scale) {
    const PoleSet poles = voronoi_poles(mesh.points(), {});
    const AngleLabels found = angle_labels(poles, no_monitor());
    std::map<Vec3, std::pair<std::uint8_t, std::uint8_t>> result;
    for (std::size_t i = 0; i < poles.size(); ++i)
      result[scale * poles.centers[i]] = {found.labels[i], found.uncertain[i]};
    return result;
  };
  EXPECT_EQ(labels(torus, 4), labels(other, 1));
}

TEST(angle_labels, of_mirrored_polar_balls_are_the_same) {
  PoleSet poles = voronoi_poles(test::lattice_cube(9, 0.4, 3).points(), {});
  const AngleLabels found = angle_labels(poles, no_monitor());
  std::vector<Vec3> centers(poles.centers.begin(), poles.centers.end());
  for (Vec3& c : centers) c.y = -c.y;
  poles.centers = centers;
  const AngleLabels other = angle_labels(poles, no_monitor());
  EXPECT_EQ(other.labels, found.labels);
  EXPECT_EQ(other.uncertain, found.uncertain);
}

TEST(angle_labels, without_an_outside_are_refused) {
  PoleSet poles = voronoi_poles(test::cube().points(), {});
  poles.unbounded = std::vector<std::uint8_t>(poles.size(), 0);
  EXPECT_THROW(angle_labels(poles, no_monitor()), InputError);
}

TEST(angle_labels, stop_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return true; }
  } impatient;
  const PoleSet poles = voronoi_poles(test::torus(60, 30, 0.4).points(), {});
  EXPECT_THROW(angle_labels(poles, impatient), Cancelled);
}

TEST(outer_balls, without_unbounded_ones_are_those_that_samples_bound) {
  const Mesh torus = test::torus(60, 30, 0.4);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  LabelPolesOptions options;
  const LabelledPoles all = label_poles(poles, torus.mesh(), options);
  options.outer = OuterBalls::bounded;
  const LabelledPoles bounded = label_poles(poles, torus.mesh(), options);
  const auto unbounded = std::count(all.poles.unbounded.begin(), all.poles.unbounded.end(), 1);
  EXPECT_GT(unbounded, 0);
  EXPECT_GT(bounded.outer.size(), 0u);
  EXPECT_EQ(bounded.outer.size() + static_cast<std::size_t>(unbounded), all.outer.size());
  EXPECT_EQ(bounded.inner.centers, all.inner.centers);
  for (const Vec3& c : bounded.outer.centers) EXPECT_GT(std::hypot(std::hypot(c.x, c.y) - 1, c.z), 0.4);
}

}  // namespace
}  // namespace ballflow::geometry
