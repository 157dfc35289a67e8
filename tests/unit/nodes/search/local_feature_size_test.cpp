#include "search/local_feature_size.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "shapes.hpp"

namespace ballflow::geometry {
namespace {

using test::Mesh;

std::vector<double> pole_distances(const Mesh& mesh) {
  const LocalFeatureSize size = local_feature_size(mesh.points(), voronoi_poles(mesh.points(), {}));
  EXPECT_EQ(broken_invariant(size), "");
  return {size.pole_distances.begin(), size.pole_distances.end()};
}

TEST(local_feature_size, is_the_distance_to_the_nearest_pole) {
  const Mesh cube = test::lattice_cube(7, 0.3, 5);
  const PoleSet poles = voronoi_poles(cube.points(), {});
  const auto distances = pole_distances(cube);
  const auto pole = is_pole(poles);
  ASSERT_GT(std::count(pole.begin(), pole.end(), 0), 0)
      << "the cube should have candidates that are no poles";
  for (std::size_t s = 0; s < cube.vertices.size(); ++s) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < poles.size(); ++i) {
      if (pole[i] == 1) least = std::min(least, distance(cube.vertices[s], poles.centers[i]));
    }
    EXPECT_EQ(distances[s], least) << s;
  }
}

TEST(local_feature_size, does_not_ask_for_labels) {
  const Mesh torus = test::torus(40, 20, 0.3);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  const LabelledPoles labelled = label_poles(poles, torus.mesh(), {});
  EXPECT_EQ(local_feature_size(torus.points(), poles).pole_distances,
            local_feature_size(torus.points(), labelled.poles).pole_distances);
}

TEST(local_feature_size, does_not_count_third_poles) {
  // Voronoi vertices of four samples of a sharp edge; the third pole of sample 0 is the nearest entry to it.
  PoleSet poles;
  poles.centers = std::vector<Vec3>{{0, 0, 3}, {0, 0, -2}, {0.5, 0, 0}};
  poles.radii = std::vector<double>{3, 2, 0.5};
  poles.sample_poles = std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}};
  PointSet sample;
  sample.points = std::vector<Vec3>{{0, 0, 0}};
  EXPECT_EQ(local_feature_size(sample, poles).pole_distances[0], 2);
}

TEST(local_feature_size, of_few_poles_is_the_distance_to_the_nearest_of_them) {
  const Mesh torus = test::torus(40, 20, 0.3);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  std::vector<Vec3> few;
  for (std::size_t i = 0; i < poles.size(); i += 7) few.push_back(poles.centers[i]);
  const LocalFeatureSize all = local_feature_size(torus.points(), poles);
  const LocalFeatureSize size = local_feature_size(torus.points(), PoleDistance(few));
  ASSERT_EQ(broken_invariant(size), "");
  EXPECT_EQ(size.third_neighbors, all.third_neighbors);
  for (std::size_t s = 0; s < torus.vertices.size(); ++s) {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& p : few) least = std::min(least, distance(torus.vertices[s], p));
    EXPECT_EQ(size.pole_distances[s], least) << s;
  }
  EXPECT_THROW(local_feature_size(torus.points(), PoleDistance(std::vector<Vec3>{})), InputError);
  EXPECT_THROW(local_feature_size(torus.points(), PoleDistance(torus.vertices)), InputError);
}

TEST(local_feature_size, of_a_torus_bounds_what_the_formula_says) {
  // The medial axis is the core circle and the axis of rotation; lfs <= 1.2802 D^ (Lemma 4.8), and D^ comes
  // close to it as the sample is dense.
  const double tube = 0.6;
  const Mesh torus = test::torus(90, 60, tube);
  const auto distances = pole_distances(torus);
  double worst = 0, middle = 0;
  for (std::size_t s = 0; s < distances.size(); ++s) {
    const Vec3 p = torus.vertices[s];
    const double lfs = std::min(tube, std::hypot(p.x, p.y));
    EXPECT_LE(lfs, LocalFeatureSize::at_most * distances[s]) << s;
    worst = std::max(worst, distances[s] / lfs);
    middle = std::max(middle, lfs < tube ? distances[s] : 0);
  }
  EXPECT_LT(worst, 1.2);
  EXPECT_GT(middle, 0) << "some samples are nearest to the axis of rotation";
}

TEST(local_feature_size, of_a_scaled_mirrored_and_reversed_sample_is_scaled_and_reversed) {
  const Mesh torus = test::torus(40, 20, 0.3);
  const auto distances = pole_distances(torus);
  for (const bool mirrored : {false, true}) {
    Mesh other;
    for (const Vec3& v : torus.vertices)
      other.vertices.push_back({(mirrored ? -0.25 : 0.25) * v.x, 0.25 * v.y, 0.25 * v.z});
    std::reverse(other.vertices.begin(), other.vertices.end());
    auto found = pole_distances(other);
    std::reverse(found.begin(), found.end());
    // Poles are circumcentres of samples in the order of their coordinates: a mirror may change the last
    // bits.
    for (std::size_t s = 0; s < distances.size(); ++s)
      ASSERT_NEAR(found[s], distances[s] / 4, mirrored ? 1e-12 : 0) << s;
  }
}

TEST(local_feature_size, refuses_poles_of_another_sample) {
  const Mesh cube = test::cube();
  const PoleSet poles = voronoi_poles(cube.points(), {});
  PointSet more = cube.points();
  more.points = {{0, 0, 0}};
  EXPECT_THROW(local_feature_size(more, poles), InputError);
  try {
    local_feature_size(more, poles);
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("8 samples, but there are 1"), std::string::npos)
        << error.what();
  }
}

TEST(local_feature_size, says_whether_it_is_the_distance_to_all_poles) {
  const Mesh torus = test::torus(40, 20, 0.3);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  const LocalFeatureSize all = local_feature_size(torus.points(), poles);
  EXPECT_EQ(all.fewer_poles, 0);
  const LocalFeatureSize one = local_feature_size(torus.points(), PoleDistance(std::vector<Vec3>{{0, 0, 0}}));
  EXPECT_EQ(one.fewer_poles, 1);
  EXPECT_EQ(broken_invariant(one), "");
  // As that of a cloud with noise, D^ has no bound then.
  const auto [low, high] = std::minmax_element(one.pole_distances.begin(), one.pole_distances.end());
  EXPECT_GT(*low, 1.5 * *std::max_element(all.pole_distances.begin(), all.pole_distances.end())) << *high;
  LocalFeatureSize damaged = one;
  damaged.fewer_poles = 2;
  EXPECT_NE(broken_invariant(damaged), "");
}

TEST(local_feature_size, reports_broken_invariants) {
  ASSERT_EQ(broken_invariant(LocalFeatureSize{{{0, 0, 0}}, {1}, {1}}), "");
  EXPECT_NE(broken_invariant(LocalFeatureSize{{{0, 0, 0}}, {0}, {1}}).find("point 0"), std::string::npos);
  EXPECT_NE(broken_invariant(LocalFeatureSize{{{0, 0, 0}}, {1, 2}, {1}}), "");
  EXPECT_NE(broken_invariant(LocalFeatureSize{{{0, 0, 0}}, {1}, {}}), "");
  EXPECT_NE(broken_invariant(LocalFeatureSize{{{0, 0, 0}}, {1}, {0}}).find("third"), std::string::npos);
  LocalFeatureSize size{{{0, 0, 0}}, {1}, {1}};
  size.axis_distances = {0};
  EXPECT_EQ(broken_invariant(size), "") << "a sample may lie on the axis";
  size.axis_distances = {-1};
  EXPECT_NE(broken_invariant(size).find("axis"), std::string::npos);
  size.axis_distances = {1, 1};
  EXPECT_NE(broken_invariant(size).find("axis"), std::string::npos);
  size.axis_distances = {};
  size.r_at_least = 0.25;
  EXPECT_NE(broken_invariant(size).find("r is"), std::string::npos) << "at_most is missing";
  size.r_at_most = std::numeric_limits<double>::infinity();
  EXPECT_EQ(broken_invariant(size), "");
}

}  // namespace
}  // namespace ballflow::geometry
