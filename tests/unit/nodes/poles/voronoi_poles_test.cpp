#include "poles/voronoi_poles.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "io/read_mesh.hpp"
#include "shapes.hpp"
#include "test_data.hpp"
#include "voronoi_cases.hpp"

namespace ballflow {
namespace {

using namespace voronoi_cases;
using geometry::InputError;
using geometry::VoronoiPolesOptions;

bool same(const PoleSet& a, const PoleSet& b) {
  return a.centers == b.centers && a.radii == b.radii && a.labels == b.labels && a.unbounded == b.unbounded &&
         a.defining_offsets == b.defining_offsets && a.defining_samples == b.defining_samples &&
         a.sample_poles == b.sample_poles;
}

TEST(voronoi_poles, of_a_cube_meet_in_its_center) {
  const PoleSet poles = poles_of(test::cube().points());
  const auto inside = bounded(poles);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_EQ(poles.centers[inside[0]], (Vec3{0, 0, 0}));
  EXPECT_EQ(poles.radii[inside[0]], std::sqrt(3.0));
  EXPECT_EQ(defining_samples_of(poles, inside[0]), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const auto& pair : poles.sample_poles) {
    EXPECT_EQ(poles.unbounded[index(pair[0])], 1);
    EXPECT_EQ(pair[1], static_cast<std::int32_t>(inside[0]));
  }
}

TEST(voronoi_poles, of_all_integer_points_of_norm_9_are_one_vertex) {
  std::vector<Vec3> points;
  for (int x = -9; x <= 9; ++x) {
    for (int y = -9; y <= 9; ++y) {
      for (int z = -9; z <= 9; ++z) {
        if (x * x + y * y + z * z == 81) points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  ASSERT_EQ(points.size(), 102U);
  const PoleSet poles = poles_of({points, {}});
  const auto inside = bounded(poles);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_LT(length(poles.centers[inside[0]]), 1e-14);
  EXPECT_NEAR(poles.radii[inside[0]], 9, 1e-14);
  EXPECT_EQ(defining_samples_of(poles, inside[0]).size(), 102U);
}

TEST(voronoi_poles, of_a_lattice_are_the_centers_of_its_cells) {
  const PoleSet poles = poles_of(lattice(5));
  const auto inside = bounded(poles);
  // The corner cells are the far vertices of all samples: cells of the 4 x 4 x 4 that no sample prefers are
  // absent.
  ASSERT_GT(inside.size(), 20U);
  for (const std::size_t i : inside) {
    const Vec3 c = poles.centers[i];
    for (const double x : {c.x, c.y, c.z}) EXPECT_EQ(x - std::floor(x), 0.5);
    EXPECT_EQ(defining_samples_of(poles, i).size(), 8U);
    EXPECT_EQ(poles.radii[i], std::sqrt(0.75));
  }
}

TEST(voronoi_poles, of_a_sphere_lie_at_its_center) {
  const PoleSet poles = poles_of(test::sphere(4).points());
  for (const auto& pair : poles.sample_poles) {
    EXPECT_EQ(poles.unbounded[index(pair[0])], 1);
    EXPECT_LT(length(poles.centers[index(pair[1])]), 1e-6);
  }
}

TEST(voronoi_poles, of_a_torus_lie_near_its_core_circle) {
  const double tube = 0.3;
  const PoleSet poles = poles_of(test::torus(160, 60, tube).points());
  std::size_t near = 0;
  for (const std::size_t i : bounded(poles)) {
    const Vec3 c = poles.centers[i];
    const double from_axis = std::sqrt(c.x * c.x + c.y * c.y);
    const double to_core = std::sqrt((from_axis - 1) * (from_axis - 1) + c.z * c.z);
    if (to_core > tube) continue;  // outside the torus
    ++near;
    EXPECT_LT(to_core, 0.02);
    EXPECT_NEAR(poles.radii[i], tube, 0.02);
  }
  EXPECT_GT(near, poles.sample_poles.size() / 4);  // every inner pole belongs to at most four samples
  EXPECT_LE(near, poles.sample_poles.size());
}

// Poles by coordinates: what must not depend on the numbering.
auto renamed(const PoleSet& poles, const std::vector<std::int32_t>& name) {
  std::vector<std::tuple<Vec3, double, std::vector<std::int32_t>, int>> entries;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    std::vector<std::int32_t> samples;
    for (const std::int32_t s : defining_samples_of(poles, i)) samples.push_back(name[index(s)]);
    std::sort(samples.begin(), samples.end());
    entries.emplace_back(poles.centers[i], poles.radii[i], samples, poles.unbounded[i]);
  }
  std::sort(entries.begin(), entries.end());
  std::vector<std::array<Vec3, 2>> pairs(poles.sample_poles.size());
  for (std::size_t s = 0; s < pairs.size(); ++s) {
    for (std::size_t k = 0; k < 2; ++k) {
      const std::int32_t pole = poles.sample_poles[s][k];
      pairs[index(name[s])][k] = pole < 0 ? Vec3{} : poles.centers[index(pole)];
    }
  }
  return std::pair(entries, pairs);
}

void expect_independent_of_numbering(const PointSet& sample) {
  std::vector<std::int32_t> identity(sample.points.size());
  std::iota(identity.begin(), identity.end(), 0);
  std::vector<std::int32_t> name = identity;
  std::mt19937 random(7);
  std::shuffle(name.begin(), name.end(), random);
  std::vector<Vec3> permuted;
  for (const std::int32_t s : name) permuted.push_back(sample.points[index(s)]);
  EXPECT_TRUE(renamed(poles_of(sample), identity) == renamed(poles_of({permuted, {}}), name));
}

TEST(voronoi_poles, do_not_depend_on_the_numbering) {
  expect_independent_of_numbering(random_points(3, 500));
  expect_independent_of_numbering(lattice(6));
  expect_independent_of_numbering(random_lattice_points(5, 60, 5));
  expect_independent_of_numbering(test::sphere(3).points());
}

TEST(voronoi_poles, of_a_technical_model_do_not_depend_on_numbering_or_threads) {
  const auto path = test::data_file("models/fandisk.off.gz");
  if (path.empty()) GTEST_SKIP() << "models/fandisk.off.gz is not there";
  const PointSet sample = geometry::read_mesh_file(path).points;
  expect_independent_of_numbering(sample);
  const PoleSet parallel = poles_of(sample);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(same(parallel, poles_of(sample)));
}

TEST(voronoi_poles, of_cospherical_points_are_the_same_for_any_number_of_threads) {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 4);
  // Every choice is between equal distances: only the order of the vertices decides.
  for (const PointSet& sample : {lattice(12), random_lattice_points(9, 3000, 19)}) {
    const auto with_threads = [&](int threads) {
      return tbb::task_arena(threads).execute([&] { return poles_of(sample); });
    };
    const PoleSet one = with_threads(1);
    for (const int threads : {2, 4}) EXPECT_TRUE(same(with_threads(threads), one)) << threads;
  }
}

TEST(voronoi_poles, far_away_points_touch_only_unbounded_poles) {
  const PointSet sample = test::torus(60, 20, 0.4).points();
  const PoleSet near = poles_of(sample);
  const PoleSet far = voronoi_poles(sample, {.bounding_distance = 40});
  const auto inside_box = [](const PoleSet& poles) {
    std::set<std::pair<Vec3, double>> kept;
    for (std::size_t i = 0; i < poles.size(); ++i) {
      const Vec3 c = poles.centers[i];
      if (std::max({std::abs(c.x), std::abs(c.y), std::abs(c.z)}) > 3) continue;
      EXPECT_EQ(poles.unbounded[i], 0);
      kept.insert({c, poles.radii[i]});
    }
    return kept;
  };
  EXPECT_EQ(inside_box(near), inside_box(far));
  EXPECT_GT(inside_box(near).size(), sample.points.size() / 2);
}

TEST(voronoi_poles, of_nearly_flat_points_are_finite) {
  std::mt19937 random(11);
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) {
    const double x = static_cast<double>(random() % 100000) / 3,
                 y = static_cast<double>(random() % 100000) / 7;
    points.push_back({x, y, x / 3 + y / 7});  // a plane, up to rounding
  }
  const PoleSet poles = poles_of({points, {}});  // the invariants say that centres and radii are finite
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double tolerance = 1e-9 * poles.radii[i];
    for (const std::int32_t s : defining_samples_of(poles, i)) {
      EXPECT_NEAR(distance(poles.centers[i], points[index(s)]), poles.radii[i], tolerance);
    }
  }
}

TEST(voronoi_poles, scale_with_the_model) {
  const PointSet sample = random_points(9, 200);
  std::vector<Vec3> tiny;
  for (const Vec3& p : sample.points) tiny.push_back(0x1p-100 * p);
  const PoleSet large = poles_of(sample), small = poles_of({tiny, {}});
  EXPECT_EQ(large.sample_poles, small.sample_poles);
  for (const std::size_t i : bounded(large)) EXPECT_EQ(0x1p-100 * large.centers[i], small.centers[i]);
}

std::string refusal(std::vector<Vec3> points) {
  try {
    voronoi_poles({std::move(points), {}}, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(voronoi_poles, refuse_samples_without_voronoi_vertices) {
  EXPECT_NE(refusal({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).find("has 3 points"), std::string::npos);
  EXPECT_NE(
      refusal({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {.5, .25, 1}}).find("5 samples lie in one plane"),
      std::string::npos);
  EXPECT_NE(refusal({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).find("one plane"), std::string::npos);
  EXPECT_NE(refusal({{2, 2, 2}, {2, 2, 2}, {2, 2, 2}, {2, 2, 2}}).find("one plane"), std::string::npos);
}

TEST(voronoi_poles, refuse_bad_points_by_number) {
  std::vector<Vec3> points = test::cube().vertices;
  points.push_back({0, 0, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_NE(refusal(points).find("sample 8 "), std::string::npos);
  points[8] = points[2];
  EXPECT_NE(refusal(points).find("samples 2 and 8 are the same point"), std::string::npos);
  points[8] = {1e41, 0, 0};
  EXPECT_NE(refusal(points).find("[1e-40, 1e40]"), std::string::npos);
  EXPECT_THROW(voronoi_poles(test::cube().points(), {.bounding_distance = 1}), InputError);
}

TEST(voronoi_poles, stop_when_cancelled) {
  struct Impatient final : geometry::Monitor {
    int calls = 0;
    bool cancelled() override { return ++calls > 20; }
  } monitor;
  EXPECT_THROW(voronoi_poles(random_points(1, 50000), {}, monitor), geometry::Cancelled);
  EXPECT_LT(monitor.calls, 30);
}

}  // namespace
}  // namespace ballflow
