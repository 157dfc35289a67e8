// Surfaces of clouds: cuts against all cuts, boundaries against independent counts, genus against formulas.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <string>

#include "power/power_diagram.hpp"
#include "sample/generate.hpp"
#include "search/neighbor_distances.hpp"
#include "shapes.hpp"
#include "surface/cell_boundary.hpp"
#include "surface/cell_labels.hpp"
#include "surface/minimum_cut.hpp"
#include "surface_fixture.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

double unit(std::mt19937& random) { return std::generate_canonical<double, 53>(random); }

TEST(neighbor_distances, are_those_of_sorting_all_distances) {
  std::mt19937 random(1);
  std::vector<Vec3> points;
  for (int i = 0; i < 300; ++i) points.push_back({unit(random), unit(random), i % 3 == 0 ? 0 : unit(random)});
  points.push_back(points.front());
  for (const int k : {1, 3, 6, 64}) {
    const std::vector<double> found = neighbor_distances(points, k);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::vector<double> all;
      for (std::size_t j = 0; j < points.size(); ++j) {
        if (j != i) all.push_back(distance(points[i], points[j]));
      }
      std::sort(all.begin(), all.end());
      ASSERT_EQ(found[i], all[static_cast<std::size_t>(k - 1)]);
    }
  }
  EXPECT_TRUE(std::isinf(neighbor_distances(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}}, 3)[0]));
}

TEST(minimum_cut, is_the_least_of_all_cuts_and_the_smallest_of_these) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    CutGraph graph;
    graph.nodes = 1 + static_cast<std::int32_t>(random() % 9);
    for (std::int32_t i = 0; i < graph.nodes; ++i) {
      graph.from_source.push_back(random() % 3 == 0 ? static_cast<std::int64_t>(random() % 20) : 0);
      graph.to_sink.push_back(random() % 3 == 0 ? static_cast<std::int64_t>(random() % 20) : 0);
    }
    for (std::uint32_t e = random() % 30; e > 0 && graph.nodes > 1; --e) {
      const auto a = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(graph.nodes));
      const auto b = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(graph.nodes));
      if (a != b) graph.edges.push_back({a, b, static_cast<std::int64_t>(random() % 15)});
    }
    std::int64_t least = -1;
    std::uint32_t best = 0;
    for (std::uint32_t side = 0; side < 1u << graph.nodes; ++side) {
      const auto in = [&](std::int32_t i) { return (side >> i & 1) != 0; };
      std::int64_t cost = 0;
      for (std::int32_t i = 0; i < graph.nodes; ++i) {
        cost += in(i) ? graph.to_sink[static_cast<std::size_t>(i)]
                      : graph.from_source[static_cast<std::size_t>(i)];
      }
      for (const auto& [a, b, capacity] : graph.edges) cost += in(a) != in(b) ? capacity : 0;
      if (least < 0 || cost < least || (cost == least && std::popcount(side) < std::popcount(best))) {
        least = cost;
        best = side;
      }
    }
    const MinimumCut found = minimum_cut(graph);
    ASSERT_EQ(found.capacity, least);
    for (std::int32_t i = 0; i < graph.nodes; ++i) {
      ASSERT_EQ(found.at_source[static_cast<std::size_t>(i)], best >> i & 1) << round << " " << i;
    }
  }
}

double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    six += dot(at(a), cross(at(b), at(c)));
  }
  return six / 6;
}

TEST(cell_boundary, of_any_cells_is_a_closed_oriented_manifold_of_their_volume) {
  std::mt19937 random(3);
  std::int64_t midpoints = 0, copies = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> centers;
    const bool lattice = round % 4 == 0;
    for (int i = 0; i < 60; ++i) {
      centers.push_back(lattice ? Vec3{double(i % 4), double(i / 4 % 4), double(i / 16)}
                                : Vec3{unit(random), unit(random), unit(random)});
    }
    const PowerDiagram diagram =
        power_diagram({centers, std::vector<double>(60, 0.1), {}, {}}, {}, no_monitor());
    std::vector<std::uint8_t> inside(diagram.size(), 0);
    double cells = 0;
    for (std::size_t c = 0; c < diagram.size(); ++c) {
      const auto& v = diagram.cells[c];
      if (std::find(v.begin(), v.end(), PowerDiagram::infinite) != v.end()) continue;
      inside[c] = random() % 5 < static_cast<unsigned>(1 + round % 4) ? 1 : 0;
      const auto at = [&](std::size_t k) { return diagram.centers[static_cast<std::size_t>(v[k])]; };
      if (inside[c] == 1) cells += dot(at(1) - at(0), cross(at(2) - at(0), at(3) - at(0))) / 6;
    }
    const CellBoundary surface = cell_boundary(diagram, inside, {.smallest_component = 0});
    expect_closed_manifold(surface.mesh);
    EXPECT_NEAR(volume(surface.mesh), cells, 1e-9 * (1 + cells));
    EXPECT_EQ(surface.ball.size(), surface.mesh.vertices.size());
    EXPECT_EQ(surface.facets.size(), surface.mesh.triangles.size());
    midpoints += surface.midpoints;
    copies += surface.split_vertices;
  }
  EXPECT_GT(midpoints, 0);
  EXPECT_GT(copies, 0);
}

TEST(surface_balls, have_the_radii_that_the_formula_says) {
  const LocalFeatureSize size{{{0, 0, 0}, {1, 0, 0}}, {0.5, 2.0}, {1.0, 1.0}};
  const SurfaceBalls found = surface_balls(size, {.radius = 0.5, .shrink = 0.2, .floor = 0.7, .smallest = 0});
  EXPECT_EQ(found.balls.radii, (Array<double>{0.7, 1.0}));
  EXPECT_DOUBLE_EQ(found.shrunk.radii[0], 0.4 * 0.7);
  EXPECT_DOUBLE_EQ(found.shrunk.radii[1], 0.4 * 1.0);
  EXPECT_EQ(found.report.raised, 1);
  EXPECT_EQ(found.report.regime, 2);
  const auto regime = [&](double radius, double shrink) {
    const SurfaceBalls balls =
        surface_balls(size, {.radius = radius, .shrink = shrink, .floor = 0, .smallest = 0});
    return static_cast<SurfaceRegime>(balls.report.regime);
  };
  EXPECT_EQ(regime(0.30, 0.0315), SurfaceRegime::proven);
  EXPECT_EQ(regime(0.30, 0.04), SurfaceRegime::supported);
  EXPECT_EQ(regime(0.45, 0), SurfaceRegime::supported);
  EXPECT_EQ(regime(0.8, 0.6), SurfaceRegime::heuristic);
  EXPECT_EQ(surface_balls(size, {.radius = 0, .shrink = 0.3}).report.radius, 0.56);
  EXPECT_DOUBLE_EQ(surface_balls(size, {.radius = 0, .shrink = 0.6}).report.radius, 0.8);
  EXPECT_THROW(surface_balls(size, {.radius = 0.3, .shrink = 0.31}), InputError);
  EXPECT_THROW(surface_balls(size, {.radius = -1}), InputError);
}

TEST(surface_balls, by_place_are_the_same_ones_and_know_their_samples) {
  const LocalFeatureSize size{{{3, 0, 0}, {-1, 0, 0}, {2, 5, 0}, {2, -4, 0}}, {1, 2, 3, 4}, {1, 1, 1, 1}};
  const SurfaceBalls given = surface_balls(size, {}), found = surface_balls(size, {.by_place = true});
  EXPECT_EQ(given.points.points, size.points);
  EXPECT_EQ(found.points.points, (Array<Vec3>{{-1, 0, 0}, {2, -4, 0}, {2, 5, 0}, {3, 0, 0}}));
  EXPECT_EQ(found.balls.centers, found.points.points);
  EXPECT_EQ(found.balls.defining_samples, (Array<std::int32_t>{1, 3, 2, 0}));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto sample = static_cast<std::size_t>(found.balls.defining_samples[i]);
    EXPECT_EQ(found.balls.radii[i], given.balls.radii[sample]);
    EXPECT_EQ(found.shrunk.radii[i], given.shrunk.radii[sample]);
    EXPECT_EQ(found.shrunk.samples_of(i)[0], static_cast<std::int32_t>(i));
  }
}

TEST(surface_balls, of_fewer_poles_than_all_are_heuristic) {
  LocalFeatureSize size{{{0, 0, 0}, {1, 0, 0}}, {0.5, 2.0}, {1.0, 1.0}};
  size.fewer_poles = 1;
  for (const auto& [radius, shrink] : {std::pair(0.30, 0.0315), std::pair(0.30, 0.04)}) {
    const SurfaceBalls balls =
        surface_balls(size, {.radius = radius, .shrink = shrink, .floor = 0, .smallest = 0});
    EXPECT_EQ(static_cast<SurfaceRegime>(balls.report.regime), SurfaceRegime::heuristic) << shrink;
  }
}

class Shapes : public testing::TestWithParam<std::pair<const char*, int>> {};

TEST_P(Shapes, have_a_closed_surface_of_their_genus_through_their_samples) {
  const auto& [shape, genus] = GetParam();
  const TriangleMesh model = generate(parse_shape(shape));
  const Cloud cloud = cloud_of({model.vertices, {}});
  const SurfaceMesh surface = surface_mesh(cloud.diagram, cloud.poles, cloud.points, {});
  expect_closed_manifold(surface.mesh);
  EXPECT_EQ(surface.report.genus, genus);
  EXPECT_EQ(surface.report.components, 1);
  EXPECT_LT(surface.report.overruled, 0.004);
  const Array<Vec3>& samples = cloud.points.points;
  const std::set<Vec3> known(samples.begin(), samples.end());
  for (std::size_t v = 0; v < surface.mesh.vertices.size(); ++v) {
    const std::int32_t ball = surface.report.vertex_balls[v];
    if (ball < 0) continue;
    EXPECT_EQ(known.count(surface.mesh.vertices[v]), 1u);
    EXPECT_EQ(surface.mesh.vertices[v], samples[static_cast<std::size_t>(ball)]);
  }
  EXPECT_NEAR(volume(surface.mesh) / volume(model), 1, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Generated, Shapes,
                         testing::Values(std::pair("torus?n=1200", 1), std::pair("doubleTorus?n=2500", 2),
                                         std::pair("knot?n=2500", 1)),
                         [](const auto& instance) {
                           const std::string name = instance.param.first;
                           return name.substr(0, name.find('?'));
                         });

TEST(surface_mesh, does_not_depend_on_threads_or_the_order_of_samples) {
  const TriangleMesh model = generate(parse_shape("torus?n=1200"));
  const auto triangles = [](const PointSet& points, int threads) {
    return tbb::task_arena(threads).execute([&] {
      const Cloud cloud = cloud_of(points);
      const SurfaceMesh surface = surface_mesh(cloud.diagram, cloud.poles, cloud.points, {});
      std::set<std::array<Vec3, 3>> result;
      for (const Triangle& t : surface.mesh.triangles) {
        std::array<Vec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k)
          corners[k] = surface.mesh.vertices[static_cast<std::size_t>(t[k])];
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
        result.insert(corners);
      }
      return result;
    });
  };
  std::vector<Vec3> shuffled(model.vertices.begin(), model.vertices.end());
  std::mt19937 random(5);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  const auto one = triangles({model.vertices, {}}, 1);
  EXPECT_EQ(one, triangles({model.vertices, {}}, 4));
  EXPECT_EQ(one, triangles({shuffled, {}}, 2));
}

TEST(surface_mesh, refuses_what_is_no_surface_of_a_solid) {
  const TriangleMesh sphere = test::sphere(4).mesh();
  std::vector<Vec3> bowl;
  for (const Vec3& p : sphere.vertices) {
    if (p.z < 0.1) bowl.push_back(p);
  }
  // Balls in one plane.
  const Cloud whole = cloud_of({sphere.vertices, {}});
  const PowerDiagram flat =
      power_diagram({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {1, 1, 1}, {}, {}}, {}, no_monitor());
  EXPECT_THROW(surface_mesh(flat, whole.poles, whole.points, {}), InputError);
  // Poles of another sample.
  EXPECT_THROW(surface_mesh(whole.diagram, whole.poles, {bowl, {}}, {}), InputError);
  EXPECT_EQ(surface_mesh(whole.diagram, whole.poles, whole.points, {}).report.genus, 0);
}

TEST(surface_mesh, real_clouds_have_their_genus_and_parts_with_edges_are_refused) {
  const std::string folder = test::data_file("models/three_holes.off.gz");
  if (folder.empty()) GTEST_SKIP() << "no test data";
  const auto surface = [](const char* file) {
    const PointSet points{read_mesh_file(test::data_file(std::string("models/") + file)).points.points, {}};
    const Cloud cloud = cloud_of(points);
    return surface_mesh(cloud.diagram, cloud.poles, cloud.points, {});
  };
  for (const auto& [file, genus] : {std::pair("three_holes.off.gz", 3),
                                    {"kitten_points.xyz.gz", 1},
                                    {"powercrust_knot_points.pts.gz", 1}}) {
    const SurfaceMesh found = surface(file);
    expect_closed_manifold(found.mesh);
    EXPECT_EQ(found.report.genus, genus) << file;
    EXPECT_EQ(found.report.components, 1) << file;
  }
  EXPECT_THROW(surface("cheese.off.gz"), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
