// Surfaces of transformed, thinned and pierced clouds, and how far surfaces are from the true ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sample/generate.hpp"
#include "search/surface_tree.hpp"
#include "surface/assess_noise.hpp"
#include "surface/denoise.hpp"
#include "surface/restore_samples.hpp"
#include "surface_fixture.hpp"

namespace ballflow::geometry {
namespace {

using Corners = std::array<Vec3, 3>;

/// The triangles, each from its least corner on.
std::set<Corners> triangles_of(const TriangleMesh& mesh, const std::function<Vec3(Vec3)>& moved,
                               bool turned) {
  std::set<Corners> result;
  for (const Triangle& t : mesh.triangles) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = moved(mesh.vertices[static_cast<std::size_t>(t[k])]);
    if (turned) std::swap(corners[0], corners[1]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    result.insert(corners);
  }
  return result;
}

PointSet moved(const PointSet& points, const std::function<Vec3(Vec3)>& motion) {
  std::vector<Vec3> result;
  for (const Vec3& p : points.points) result.push_back(motion(p));
  return {result, {}};
}

const auto same = [](Vec3 p) { return p; };

class Transformed : public testing::TestWithParam<double> {};  // shrink

TEST_P(Transformed, clouds_have_the_transformed_surface) {
  const double shrink = GetParam();
  const PointSet points{generate(parse_shape("knot?n=2500")).vertices, {}};
  const TriangleMesh mesh = surface_of(cloud_of(points, shrink)).mesh;
  const auto twice = [](Vec3 p) { return 2 * p; };
  const auto mirrored = [](Vec3 p) { return Vec3{-p.x, p.y, p.z}; };
  const SurfaceMesh doubled = surface_of(cloud_of(moved(points, twice), shrink));
  EXPECT_EQ(doubled.mesh.triangles, mesh.triangles);
  EXPECT_EQ(triangles_of(doubled.mesh, same, false), triangles_of(mesh, twice, false));
  const SurfaceMesh mirror = surface_of(cloud_of(moved(points, mirrored), shrink));
  EXPECT_EQ(triangles_of(mirror.mesh, same, false), triangles_of(mesh, mirrored, true));
  // Pruning breaks ties by the order of samples: the vertices are others, the surface is as good.
  std::vector<Vec3> shuffled(points.points.begin(), points.points.end());
  std::mt19937 random(1);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  const SurfaceMesh permuted = surface_of(cloud_of({shuffled, {}}, shrink));
  if (shrink == 0) {
    EXPECT_EQ(triangles_of(permuted.mesh, same, false), triangles_of(mesh, same, false));
  }
  EXPECT_EQ(permuted.report.genus, 1);
  EXPECT_EQ(permuted.report.components, 1);
  EXPECT_NEAR(static_cast<double>(permuted.mesh.vertices.size()), static_cast<double>(mesh.vertices.size()),
              0.03 * static_cast<double>(mesh.vertices.size()));
}
INSTANTIATE_TEST_SUITE_P(Shrink, Transformed, testing::Values(0, 0.3), [](const auto& instance) {
  return instance.param == 0 ? std::string("all") : std::string("pruned");
});

TEST(surfaces, of_permuted_and_mirrored_clouds_are_pruned_alike_by_place) {
  const auto mirrored_in = [](int axis) {
    return [axis](Vec3 p) {
      (axis == 0 ? p.x : axis == 1 ? p.y : p.z) *= -1;
      return p;
    };
  };
  PointSet points{generate(parse_shape("knot?n=2500")).vertices, {}};
  // Not symmetric: of a sample and its mirror image one is first, which a mirror changes.
  points = moved(points, [](Vec3 p) { return p + Vec3{0.0123, 0.0357, 0.0211}; });
  for (const double shrink : {0.3, 0.6}) {
    const SurfaceMesh surface = surface_of(cloud_of(points, shrink, true));
    std::vector<Vec3> shuffled(points.points.begin(), points.points.end());
    std::mt19937 random(2);
    std::shuffle(shuffled.begin(), shuffled.end(), random);
    const SurfaceMesh permuted = surface_of(cloud_of({shuffled, {}}, shrink, true));
    EXPECT_EQ(permuted.mesh.vertices, surface.mesh.vertices);
    EXPECT_EQ(permuted.mesh.triangles, surface.mesh.triangles);
    for (int axis = 0; axis < 3; ++axis) {
      const SurfaceMesh mirror = surface_of(cloud_of(moved({shuffled, {}}, mirrored_in(axis)), shrink, true));
      EXPECT_EQ(triangles_of(mirror.mesh, same, false), triangles_of(surface.mesh, mirrored_in(axis), true));
    }
  }
}

/// Ten times as dense at one end of the longest axis as at the other.
PointSet thinned(const PointSet& points, unsigned seed) {
  std::mt19937 random(seed);
  const Box box = bounding_box(points.points.span());
  const Vec3 extent = box.upper - box.lower;
  double Vec3::*axis = &Vec3::x;
  if (extent.y > extent.*axis) axis = &Vec3::y;
  if (extent.z > extent.*axis) axis = &Vec3::z;
  std::vector<Vec3> kept;
  for (const Vec3& p : points.points) {
    const double along = (p.*axis - box.lower.*axis) / (extent.*axis);
    if (std::generate_canonical<double, 53>(random) < std::pow(0.1, along)) kept.push_back(p);
  }
  return {kept, {}};
}

/// Without the samples within `percent` of the longest edge of five of them.
PointSet pierced(const PointSet& points, double percent, unsigned seed) {
  std::mt19937 random(seed);
  const double radius = percent / 100 * bounding_box(points.points.span()).longest_edge();
  std::vector<Vec3> centers, kept;
  for (int i = 0; i < 5; ++i) centers.push_back(points.points[random() % points.points.size()]);
  for (const Vec3& p : points.points) {
    if (std::none_of(centers.begin(), centers.end(), [&](Vec3 c) { return distance(p, c) < radius; }))
      kept.push_back(p);
  }
  return {kept, {}};
}

TEST(uneven, clouds_have_the_genus_of_even_ones) {
  if (test::data_file("models/kitten_points.xyz.gz").empty()) GTEST_SKIP() << "no test data";
  for (const auto& [file, genus] :
       {std::pair("kitten_points.xyz.gz", 1), {"three_holes.off.gz", 3}, {"rocker_arm.obj.gz", 1}}) {
    const PointSet points = cloud_file(file);
    for (const PointSet& uneven :
         {thinned(points, 1), pierced(points, 4, 2), pierced(thinned(points, 3), 4, 4)}) {
      ASSERT_LT(uneven.points.size(), points.points.size());
      const SurfaceMesh surface = surface_of(cloud_of(uneven, 0.3));
      expect_closed_manifold(surface.mesh);
      EXPECT_EQ(surface.report.genus, genus) << file << " " << uneven.points.size();
      EXPECT_EQ(surface.report.components, 1) << file;
    }
  }
}

/// The largest distance of points of one surface from the other, of `samples` points evenly spread over it
/// and its vertices.
double farthest(const TriangleMesh& from, const TriangleMesh& to, std::size_t samples) {
  const auto corner = [&](const Triangle& t, std::size_t k) {
    return from.vertices[static_cast<std::size_t>(t[k])];
  };
  std::vector<double> area;  // up to each triangle
  for (const Triangle& t : from.triangles) {
    const double own = length(cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)));
    area.push_back(own + (area.empty() ? 0 : area.back()));
  }
  const SurfaceTree tree(to);
  double most = 0;
  const auto look = [&](Vec3 p) {
    most = std::max(most, tree.nearest(p, std::numeric_limits<double>::infinity())->distance);
  };
  std::mt19937 random(1);
  const auto unit = [&] { return std::generate_canonical<double, 53>(random); };
  for (std::size_t i = 0; i < samples; ++i) {
    const auto place = std::upper_bound(area.begin(), area.end(), unit() * area.back()) - area.begin();
    const Triangle& t = from.triangles[std::min(static_cast<std::size_t>(place), area.size() - 1)];
    double u = unit(), v = unit();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    look(corner(t, 0) + u * (corner(t, 1) - corner(t, 0)) + v * (corner(t, 2) - corner(t, 0)));
  }
  for (const Vec3& p : from.vertices) look(p);
  return most;
}

TEST(farthest, is_that_of_a_shifted_square) {
  const TriangleMesh square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const TriangleMesh above{{{0, 0, 0.25}, {1, 0, 0.25}, {1, 1, 0.25}, {0, 1, 0.25}}, {{0, 1, 2}}};
  EXPECT_DOUBLE_EQ(farthest(above, square, 100), 0.25);
  EXPECT_NEAR(farthest(square, above, 100), std::sqrt(0.5 + 0.0625), 1e-12)
      << "the corner without a triangle";
}

TEST(surfaces, of_a_third_fewer_samples_are_near_the_true_ones) {
  if (test::data_file("models/three_holes.off.gz").empty()) GTEST_SKIP() << "no test data";
  // Hausdorff distance at shrink .3, % of the longest edge of the box, both ways.
  for (const auto& [file, most] :
       {std::pair("three_holes.off.gz", 0.8), {"rocker_arm.obj.gz", 0.6}, {"fertility.off.gz", 1.0}}) {
    const TriangleMesh truth = read_mesh_file(test::data_file(std::string("models/") + file)).mesh;
    const double box = bounding_box(truth.vertices.span()).longest_edge();
    const TriangleMesh mesh = surface_of(cloud_of({truth.vertices, {}}, 0.3)).mesh;
    EXPECT_LT(mesh.vertices.size(), truth.vertices.size());
    EXPECT_LE(100 * farthest(mesh, truth, 20000) / box, most) << file;
    EXPECT_LE(100 * farthest(truth, mesh, 20000) / box, most) << file;
  }
}

TEST(surfaces, of_a_dense_cloud_with_noise_are_near_the_true_one) {
  // For tools/nightly: a minute.
  if (std::getenv("BALLFLOW_TEST_LARGE") == nullptr) GTEST_SKIP() << "BALLFLOW_TEST_LARGE is not set";
  const std::string file = test::data_file("generated/doubleTorus_85237.xyz.gz");
  if (file.empty()) GTEST_SKIP() << "no test data";
  const TriangleMesh truth = read_mesh_file(test::data_file("generated/doubleTorus.off.gz")).mesh;
  const double box = bounding_box(truth.vertices.span()).longest_edge();
  const PointSet clean{read_mesh_file(file).points.points, {}};
  for (const unsigned seed : {1u, 2u}) {
    SCOPED_TRACE(seed);
    const PointSet noisy = with_noise(clean, 0.1, seed);
    Cloud cloud = cloud_of(noisy, 0.3);
    NoiseReport report = assess_noise(noisy, cloud.poles, cloud.size, nullptr, {});
    while (report.next > 0) {
      cloud = cloud_of(denoise(noisy, {.neighbors = report.next}).points, 0.3);
      report = assess_noise(cloud.points, cloud.poles, cloud.size, &report, {});
    }
    EXPECT_EQ(report.neighbors, 48);
    const SurfaceMesh surface = surface_of(cloud);
    EXPECT_EQ(surface.report.genus, 2);
    const TriangleMesh kept = restore_samples(surface.mesh, surface.report, cloud.kept, noisy);
    const auto far = [&](const TriangleMesh& mesh) {
      return 100 * std::max(farthest(mesh, truth, 20000), farthest(truth, mesh, 20000)) / box;
    };
    const double of_moved = far(surface.mesh), of_kept = far(kept);
    RecordProperty("moved_" + std::to_string(seed), std::to_string(of_moved));
    RecordProperty("kept_" + std::to_string(seed), std::to_string(of_kept));
    EXPECT_LE(of_moved, 0.25);
    double most = 0;
    for (std::size_t v = 0; v < kept.vertices.size(); ++v)
      most = std::max(most, distance(kept.vertices[v], surface.mesh.vertices[v]));
    EXPECT_LE(of_kept, of_moved + 100 * most / box) << "as far as the vertex with the most noise";
  }
}

}  // namespace
}  // namespace ballflow::geometry
