// Denoising against formulas of surfaces, and the rule that decides about it.
#include "surface/denoise.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>

#include "sample/generate.hpp"
#include "shapes.hpp"
#include "surface/assess_noise.hpp"
#include "surface/restore_samples.hpp"
#include "surface_fixture.hpp"

namespace ballflow::geometry {
namespace {

double canonical(std::mt19937& random) { return std::generate_canonical<double, 53>(random); }

/// Points of h(x, y) above the unit square.
template <class Height>
PointSet graph_of(int n, unsigned seed, Height h) {
  std::mt19937 random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double x = canonical(random), y = canonical(random);
    points.push_back({x, y, h(x, y)});
  }
  return {points, {}};
}

TEST(denoise, leaves_planes_and_gentle_quadrics_where_they_are) {
  const PointSet plane = graph_of(800, 1, [](double x, double y) { return 0.3 * x - 0.2 * y; });
  const Denoised flat = denoise(plane, {});
  for (std::size_t i = 0; i < plane.points.size(); ++i) {
    EXPECT_LT(distance(flat.points.points[i], plane.points[i]), 1e-12);
    EXPECT_LT(flat.deviations[i], 1e-12);
  }
  // Of a quadric in a frame that is not its own only terms of the third order are left.
  const PointSet bowl = graph_of(4000, 2, [](double x, double y) { return 0.1 * (x * x + y * y); });
  const Denoised curved = denoise(bowl, {.neighbors = 24, .rounds = 1});
  for (std::size_t i = 0; i < bowl.points.size(); ++i)
    EXPECT_LT(distance(curved.points.points[i], bowl.points[i]), 3e-5);
}

double mean_error(const PointSet& points) {  // of a unit sphere
  double sum = 0;
  for (const Vec3& p : points.points) sum += std::abs(length(p) - 1);
  return sum / static_cast<double>(points.points.size());
}

TEST(denoise, takes_most_of_the_noise_from_a_sphere_and_keeps_its_radius) {
  const PointSet sphere{test::sphere(5).mesh().vertices, {}};
  const PointSet noisy = with_noise(sphere, 0.5, 3);
  const Denoised result = denoise(noisy, {.neighbors = 48, .rounds = 2});
  EXPECT_LT(mean_error(result.points), 0.35 * mean_error(noisy));
  double radius = 0;
  for (const Vec3& p : result.points.points) radius += length(p) / static_cast<double>(sphere.points.size());
  EXPECT_NEAR(radius, 1, 1e-3) << "averages shrink, quadrics do not";
  // The deviation that it saw in the first round is that of the noise: .5 % of 2.
  const std::vector<double> seen = local_noise(noisy);
  const double mean = std::accumulate(seen.begin(), seen.end(), 0.0) / static_cast<double>(seen.size());
  EXPECT_NEAR(mean, 0.01, 0.001);
}

TEST(denoise, does_not_mix_two_sheets_that_are_near_each_other) {
  // 16 neighbours reach .04 far, 48 of them .07: across the gap.
  std::vector<Vec3> points;
  std::mt19937 random(4);
  for (int i = 0; i < 6000; ++i)
    points.push_back({canonical(random), canonical(random), i % 2 == 0 ? 0.0 : 0.06});
  const PointSet noisy = with_noise({points, {}}, 0.2, 5);
  const Denoised result = denoise(noisy, {.neighbors = 48, .rounds = 2});
  double worst = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 p = points[i];
    const bool at_rim = std::min({p.x, p.y, 1 - p.x, 1 - p.y}) < 0.1;
    if (!at_rim) worst = std::max(worst, std::abs(result.points.points[i].z - p.z));
  }
  EXPECT_LT(worst, 0.01) << "as far as noise alone goes";
}

TEST(denoise, depends_neither_on_the_order_of_samples_nor_on_threads_and_follows_scaling) {
  std::vector<Vec3> lattice;  // all distances have ties
  for (int i = 0; i < 400; ++i) lattice.push_back({double(i % 20), double(i / 20), double(i % 3 == 0)});
  const PointSet points{lattice, {}};
  const auto with = [&](const PointSet& set, int threads) {
    return tbb::task_arena(threads).execute(
        [&] { return denoise(set, {.neighbors = 20, .rounds = 2}).points; });
  };
  const PointSet one = with(points, 1);
  EXPECT_EQ(one.points, with(points, 4).points);
  std::vector<std::size_t> order(lattice.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937 random(6);
  std::shuffle(order.begin(), order.end(), random);
  std::vector<Vec3> shuffled, doubled;
  for (const std::size_t i : order) shuffled.push_back(lattice[i]);
  for (const Vec3& p : lattice) doubled.push_back(2 * p);
  const PointSet again = with({shuffled, {}}, 2), larger = with({doubled, {}}, 2);
  for (std::size_t i = 0; i < order.size(); ++i) {
    EXPECT_EQ(again.points[i], one.points[order[i]]);
    EXPECT_EQ(larger.points[i], 2 * one.points[i]);
  }
}

TEST(denoise, keeps_samples_apart_and_what_has_no_quadric_in_its_place) {
  // Above each point of a plane one of the other: both belong into the plane.
  std::vector<Vec3> pairs;
  for (int i = 0; i < 25; ++i) {
    for (const double z : {-0.125, 0.125}) pairs.push_back({double(i % 5), double(i / 5), z});
  }
  std::vector<Vec3> found;
  for (const Vec3& p : denoise({pairs, {}}, {.neighbors = 50, .rounds = 1}).points.points) found.push_back(p);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
  std::vector<Vec3> line;
  for (int i = 0; i < 50; ++i) line.push_back({double(i), 2.0 * i, 0});
  EXPECT_EQ(denoise({line, {}}, {}).points.points, Array<Vec3>(line));
  EXPECT_EQ(denoise({{{0, 0, 0}, {1, 0, 0}}, {}}, {}).points.points, (Array<Vec3>{{0, 0, 0}, {1, 0, 0}}));
  EXPECT_TRUE(denoise({}, {}).points.points.empty());
  EXPECT_THROW(denoise({}, {.neighbors = 7}), InputError);
  EXPECT_THROW(denoise({}, {.rounds = 0}), InputError);
}

NoiseReport assess(const Cloud& cloud, const NoiseReport* before = nullptr, bool act = true) {
  return assess_noise(cloud.points, cloud.poles, cloud.size, before, {.act = act});
}
NoiseVerdict verdict(const NoiseReport& report) { return static_cast<NoiseVerdict>(report.verdict); }

/// What robustness/auto.json does.
std::pair<Cloud, NoiseReport> robust(const PointSet& points, double shrink) {
  Cloud cloud = cloud_of(points, shrink);
  NoiseReport report = assess(cloud);
  for (int round = 0; report.next > 0 && round < 10; ++round) {
    cloud = cloud_of(denoise(points, {.neighbors = report.next, .rounds = 2}).points, shrink);
    report = assess(cloud, &report);
  }
  return {std::move(cloud), report};
}

TEST(assess_noise, leaves_clean_clouds_and_sharp_edges_alone) {
  EXPECT_EQ(verdict(assess(cloud_of({generate(parse_shape("torus?n=1500")).vertices, {}}))),
            NoiseVerdict::clean);
  // A box, sampled as CAD programs do: poles at its edges know nothing.
  const PointSet box{generate(parse_shape("box?n=2000")).vertices, {}};
  NoiseReport report = assess_noise(box, cloud_of(box).poles, cloud_of(box).size, nullptr, {.suspect = 0});
  EXPECT_EQ(verdict(report), NoiseVerdict::sharp_edges);
  EXPECT_EQ(report.next, 0);
}

TEST(assess_noise, tries_more_neighbours_and_goes_back_to_the_best) {
  // Poles of which half are uncertain, whatever is done.
  Cloud cloud = cloud_of(with_noise({generate(parse_shape("torus?n=1500")).vertices, {}}, 1.5, 7));
  const auto uncertain = [&](double share) {
    std::vector<std::uint8_t> flags(cloud.poles.size(), 0);
    std::fill_n(flags.begin(), static_cast<std::size_t>(share * static_cast<double>(flags.size())), 1);
    cloud.poles.uncertain = flags;
  };
  uncertain(0.5);
  EXPECT_EQ(verdict(assess(cloud, nullptr, false)), NoiseVerdict::left);
  NoiseReport report = assess(cloud);
  EXPECT_EQ(verdict(report), NoiseVerdict::noisy);
  std::vector<std::int32_t> tried;
  const auto try_all = [&](const std::vector<double>& shares) {
    uncertain(0.5);
    report = assess(cloud);
    tried.clear();
    for (const double share : shares) {
      tried.push_back(report.next);
      uncertain(share);
      report = assess(cloud, &report);
    }
    EXPECT_EQ(report.next, 0);
  };
  using Tried = std::vector<std::int32_t>;
  try_all({0.6, 0.3, 0.35, 0.3});
  EXPECT_EQ(tried, (Tried{24, 48, 96, 48})) << "96 neighbours were too many";
  EXPECT_EQ(report.neighbors, 48);
  EXPECT_EQ(verdict(report), NoiseVerdict::too_noisy);
  try_all({0.4, 0.3, 0.2, 0.1});
  EXPECT_EQ(tried, (Tried{24, 48, 96, 192}));
  EXPECT_EQ(verdict(report), NoiseVerdict::denoised);
  try_all({0.3, 0.04});
  EXPECT_EQ(tried, (Tried{24, 48}));
  EXPECT_EQ(verdict(report), NoiseVerdict::denoised);
}

TEST(assess_noise, takes_twice_as_many_neighbours_of_a_dense_cloud_unless_they_are_too_many) {
  Cloud cloud = cloud_of(with_noise({generate(parse_shape("torus?n=1500")).vertices, {}}, 1.5, 7));
  const auto look = [&](double uncertain, double coarseness, const NoiseReport* before) {
    std::vector<std::uint8_t> flags(cloud.poles.size(), 0);
    std::fill_n(flags.begin(), static_cast<std::size_t>(uncertain * static_cast<double>(flags.size())), 1);
    cloud.poles.uncertain = flags;
    std::vector<double> third;
    for (const double d : cloud.size.pole_distances) third.push_back(coarseness * d);
    cloud.size.third_neighbors = third;
    return assess(cloud, before);
  };
  const NoiseReport noisy = assess(cloud);
  ASSERT_EQ(noisy.next, 24);
  // 48 neighbours reach sqrt(48 / 3) = 4 times as far as the third.
  const NoiseReport coarse = look(0.04, 0.26, &noisy), dense = look(0.04, 0.24, &noisy);
  EXPECT_EQ(verdict(coarse), NoiseVerdict::denoised);
  EXPECT_EQ(coarse.next, 0);
  EXPECT_EQ(verdict(dense), NoiseVerdict::noisy);
  ASSERT_EQ(dense.next, 48);
  const NoiseReport taken = look(0.045, 0.1, &dense);
  EXPECT_EQ(verdict(taken), NoiseVerdict::denoised);
  EXPECT_EQ(taken.neighbors, 48);
  EXPECT_EQ(taken.next, 0) << "once";
  const NoiseReport too_many = look(0.06, 0.1, &dense);
  ASSERT_EQ(too_many.next, 24);
  const NoiseReport back = look(0.04, 0.24, &too_many);
  EXPECT_EQ(verdict(back), NoiseVerdict::denoised);
  EXPECT_EQ(back.neighbors, 24);
  EXPECT_EQ(back.next, 0);
}

TEST(assess_noise, refuses_what_does_not_belong_together) {
  Cloud cloud = cloud_of({generate(parse_shape("torus?n=600")).vertices, {}});
  EXPECT_THROW(assess_noise({}, cloud.poles, cloud.size, nullptr, {}), InputError);
  EXPECT_THROW(assess_noise(cloud.points, cloud.poles, {}, nullptr, {}), InputError);
  EXPECT_THROW(assess_noise(cloud.points, cloud.poles, cloud.size, nullptr, {.neighbors = 4}), InputError);
  cloud.poles.uncertain = {};
  EXPECT_THROW(assess(cloud), InputError);
}

TEST(robustness, noisy_clouds_have_their_genus_and_vertices_are_samples_as_they_came) {
  if (test::data_file("models/three_holes.off.gz").empty()) GTEST_SKIP() << "no test data";
  for (const auto& [file, genus] : {std::pair("three_holes.off.gz", 3), {"fertility.off.gz", 4}}) {
    const PointSet noisy = with_noise(cloud_file(file), 0.5, 8);
    const auto& [cloud, report] = robust(noisy, 0.3);
    EXPECT_EQ(verdict(report), NoiseVerdict::denoised) << file;
    const SurfaceMesh surface = surface_of(cloud);
    EXPECT_EQ(surface.report.genus, genus) << file;
    EXPECT_EQ(surface.report.components, 1) << file;
    const TriangleMesh mesh = restore_samples(surface.mesh, surface.report, cloud.kept, noisy);
    expect_closed_manifold(mesh);
    std::vector<Vec3> samples(noisy.points.begin(), noisy.points.end());
    std::sort(samples.begin(), samples.end());
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (surface.report.vertex_balls[v] < 0) continue;
      EXPECT_TRUE(std::binary_search(samples.begin(), samples.end(), mesh.vertices[v]));
    }
  }
}

TEST(restore_samples, keeps_the_bytes_where_nothing_moved_and_refuses_what_does_not_belong_together) {
  const Cloud cloud = cloud_of({generate(parse_shape("torus?n=800")).vertices, {}}, 0.3);
  const SurfaceMesh surface = surface_of(cloud);
  const TriangleMesh same = restore_samples(surface.mesh, surface.report, cloud.kept, cloud.points);
  EXPECT_EQ(same.vertices, surface.mesh.vertices);
  EXPECT_EQ(same.triangles, surface.mesh.triangles);
  EXPECT_THROW(restore_samples({}, surface.report, cloud.kept, cloud.points), InputError);
  EXPECT_THROW(restore_samples(surface.mesh, surface.report, {}, cloud.points), InputError);
  EXPECT_THROW(restore_samples(surface.mesh, surface.report, cloud.kept, {}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
