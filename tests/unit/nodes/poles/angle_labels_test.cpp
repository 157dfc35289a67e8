#include "poles/angle_labels.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

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

/// A cloud on the unit sphere and one point inside, a site of twice as many Voronoi vertices as there are
/// points.
PointSet sphere_with_outlier(std::size_t count) {
  std::mt19937 random(4);
  const auto coordinate = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
  std::vector<Vec3> points{{0.1, 0.05, 0.02}};
  while (points.size() <= count) {
    const Vec3 p{coordinate(), coordinate(), coordinate()};
    if (const double l = length(p); l > 0.1 && l < 1) points.push_back(1 / l * p);
  }
  return {std::move(points), {}};
}

std::size_t most_entries_at_a_sample(const PoleSet& poles) {
  std::vector<std::size_t> entries(poles.sample_poles.size(), 0);
  for (const std::int32_t s : poles.defining_samples) ++entries[static_cast<std::size_t>(s)];
  return *std::max_element(entries.begin(), entries.end());
}

TEST(angle_labels, of_a_cloud_with_an_outlier_look_at_few_pairs) {
  const PoleSet poles = voronoi_poles(sphere_with_outlier(100'000), {});
  ASSERT_GT(most_entries_at_a_sample(poles), 130'000u);
  const AngleLabels found = angle_labels(poles, no_monitor());
  EXPECT_LT(found.pairs, 100 * static_cast<std::int64_t>(poles.size()));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const PoleLabel side = length(poles.centers[i]) < 1 ? PoleLabel::inner : PoleLabel::outer;
    wrong += found.labels[i] != static_cast<std::uint8_t>(side) ? 1 : 0;
  }
  // Balls on opposite sides of an outlier are taken for opposite sides of a surface, with all pairs 15 % of
  // them.
  EXPECT_LT(wrong * 6, poles.size());
}

TEST(angle_labels, at_a_crowded_sample_are_as_uncertain_as_all_pairs_say) {
  PoleSet poles = voronoi_poles(sphere_with_outlier(1500), {});
  // Some labels that the evidence contradicts: balls inside that count as the outside.
  std::vector<std::uint8_t> unbounded(poles.unbounded.begin(), poles.unbounded.end());
  for (std::size_t i = 0; i < unbounded.size(); i += 97) unbounded[i] = 1;
  poles.unbounded = unbounded;
  const AngleLabels found = angle_labels(poles, no_monitor());
  std::vector<std::vector<std::size_t>> entries(poles.sample_poles.size());
  std::vector<double> with(poles.size(), 0), against(poles.size(), 0);
  for (std::size_t p = 0; p < poles.size(); ++p) {
    for (auto k = poles.defining_offsets[p]; k < poles.defining_offsets[p + 1]; ++k)
      entries[static_cast<std::size_t>(poles.defining_samples[static_cast<std::size_t>(k)])].push_back(p);
  }
  ASSERT_GT(most_entries_at_a_sample(poles), 2000u);
  for (const auto& list : entries) {
    for (const std::size_t p : list) {
      for (const std::size_t q : list) {
        if (p == q) continue;
        const double a = poles.radii[p], b = poles.radii[q];
        const double d = (a * a + b * b - squared_distance(poles.centers[p], poles.centers[q])) / (2 * a * b);
        double& side = (found.labels[p] == found.labels[q]) == (d > 0) ? with[p] : against[p];
        side = std::max(side, std::min(1.0, std::abs(d)));
      }
    }
  }
  std::size_t uncertain = 0;
  for (std::size_t p = 0; p < poles.size(); ++p) {
    const bool clear = std::abs(against[p] - with[p] / 2) > 1e-9;  // the directions are rounded
    EXPECT_TRUE(!clear || found.uncertain[p] == (against[p] >= with[p] / 2 ? 1 : 0)) << p;
    uncertain += found.uncertain[p];
  }
  EXPECT_GT(uncertain, 0u);
  EXPECT_LT(uncertain, poles.size());
}

TEST(angle_labels, at_a_crowded_sample_are_the_same_for_any_numbering_and_number_of_threads) {
  const PointSet sample = sphere_with_outlier(3000);
  std::vector<Vec3> permuted(sample.points.begin(), sample.points.end());
  std::shuffle(permuted.begin(), permuted.end(), std::mt19937(6));
  const auto labels = [](const PointSet& points, int threads) {
    return tbb::task_arena(threads).execute([&] {
      const PoleSet poles = voronoi_poles(points, {});
      const AngleLabels found = angle_labels(poles, no_monitor());
      std::map<Vec3, std::pair<std::uint8_t, std::uint8_t>> result;
      for (std::size_t i = 0; i < poles.size(); ++i)
        result[poles.centers[i]] = {found.labels[i], found.uncertain[i]};
      return result;
    });
  };
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  const auto one = labels(sample, 1);
  EXPECT_EQ(labels(sample, 4), one);
  EXPECT_EQ(labels({permuted, {}}, 2), one);
}

TEST(angle_labels, at_a_crowded_sample_take_nothing_from_spheres_without_a_radius) {
  PoleSet poles = voronoi_poles(sphere_with_outlier(300), {});
  ASSERT_GT(most_entries_at_a_sample(poles), 300u);
  std::vector<double> radii(poles.radii.begin(), poles.radii.end());
  for (std::size_t i = 0; i < radii.size(); i += 50) radii[i] = 0;
  poles.radii = radii;
  const AngleLabels found = angle_labels(poles, no_monitor());
  EXPECT_EQ(found.labels.size(), poles.size());
  for (std::size_t i = 0; i < radii.size(); i += 50) {
    EXPECT_EQ(found.uncertain[i], 0) << i;
    EXPECT_EQ(found.labels[i],
              static_cast<std::uint8_t>(poles.unbounded[i] == 1 ? PoleLabel::outer : PoleLabel::unlabelled));
  }
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
