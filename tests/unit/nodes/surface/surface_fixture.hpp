// What tests of surfaces share: a cloud with everything that a surface of it needs, and counts of meshes that
// use none of the code that made them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "balls/select_balls.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "io/read_mesh.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/power_diagram.hpp"
#include "search/local_feature_size.hpp"
#include "surface/surface_balls.hpp"
#include "surface/surface_mesh.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {

struct Cloud {
  PointSet points;
  PoleSet poles;
  LocalFeatureSize size;
  Balls kept;
  PowerDiagram diagram;
};

/// The nodes of reconstruct.json in a row, without robustness.
inline Cloud cloud_of(const PointSet& points, double shrink = 0, bool by_place = false) {
  Cloud cloud;
  cloud.points = {points.points, {}};
  const PoleSet vertices = voronoi_poles(cloud.points, {});
  cloud.poles = label_poles(vertices, {}, {.method = LabelMethod::angle}).poles;
  cloud.size = local_feature_size(cloud.points, vertices);
  const SurfaceBalls balls = surface_balls(cloud.size, {.shrink = shrink, .by_place = by_place});
  cloud.kept = balls.balls;
  if (shrink > 0) {
    const CoverMatrix matrix = cover_matrix(balls.shrunk, balls.points);
    cloud.kept = select_balls(greedy(matrix.cover, {.mode = GreedyMode::until_covered}), balls.balls, {});
  }
  cloud.diagram = power_diagram(cloud.kept, {}, no_monitor());
  return cloud;
}

inline SurfaceMesh surface_of(const Cloud& cloud, const SurfaceMeshOptions& options = {}) {
  return surface_mesh(cloud.diagram, cloud.poles, cloud.points, options);
}

/// Edges and vertex links, counted without mesh_topology.
inline void expect_closed_manifold(const TriangleMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> directed;
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> link;  // per vertex: next of each neighbour
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      ++directed[{t[k], t[(k + 1) % 3]}];
      link[t[k]][t[(k + 1) % 3]] = t[(k + 2) % 3];
    }
  }
  for (const auto& [edge, uses] : directed) {
    ASSERT_EQ(uses, 1);
    ASSERT_EQ(directed.count({edge.second, edge.first}), 1u);
  }
  for (const auto& [v, next] : link) {
    std::size_t steps = 0;
    std::int32_t at = next.begin()->first;
    do {
      ASSERT_EQ(next.count(at), 1u);
      at = next.at(at);
      ++steps;
    } while (at != next.begin()->first && steps <= next.size());
    ASSERT_EQ(steps, next.size()) << "the triangles at a vertex are several fans";
  }
  EXPECT_EQ(link.size(), mesh.vertices.size()) << "vertices of no triangle";
}

/// Every coordinate with normally distributed noise of `percent` of the longest edge of the box.
inline PointSet with_noise(const PointSet& points, double percent, unsigned seed) {
  std::mt19937 random(seed);
  const double deviation = percent / 100 * bounding_box(points.points.span()).longest_edge();
  // Box and Muller's: std::normal_distribution differs between libraries.
  const auto normal = [&] {
    const double u = 1 - std::generate_canonical<double, 53>(random);
    const double v = std::generate_canonical<double, 53>(random);
    return deviation * std::sqrt(-2 * std::log(u)) * std::cos(6.283185307179586 * v);
  };
  std::vector<Vec3> moved(points.points.begin(), points.points.end());
  for (Vec3& p : moved) p = p + Vec3{normal(), normal(), normal()};
  return {std::move(moved), {}};
}

/// A file of models/, without its mesh; empty where there is no test data.
inline PointSet cloud_file(const std::string& name) {
  const std::string path = test::data_file("models/" + name);
  if (path.empty()) return {};
  return {read_mesh_file(path).points.points, {}};
}

}  // namespace ballflow::geometry
