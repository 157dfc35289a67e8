// What is said against surfaces: gaps by formula, holes and sheets by shapes that have them, real clouds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sample/generate.hpp"
#include "shapes.hpp"
#include "surface/surface_evidence.hpp"
#include "surface_fixture.hpp"

namespace ballflow::geometry {
namespace {

struct Warnings : Monitor {
  void warn(const std::string& text) override { all += text + "\n"; }
  bool tell(const std::string& words) const { return all.find(words) != std::string::npos; }
  std::string all;
};

TEST(surface_evidence, a_gap_is_the_sphere_between_three_balls) {
  // An equilateral triangle of side s and three balls of radius r: the orthogonal sphere has its centre in
  // the middle, s / sqrt(3) away, and the squared radius s^2 / 3 - r^2.
  const double s = 3, r = 0.5;
  PowerDiagram diagram;
  diagram.centers = {{0, 0, 1}, {s, 0, 1}, {s / 2, s * std::sqrt(0.75), 1}, {1, 1, 9}};
  diagram.weights = {r * r, r * r, r * r, 25};
  diagram.cells = {{0, 1, 2, 3}};
  EXPECT_NEAR(facet_gap(diagram, {0, 3}), std::sqrt(s * s / 3 - r * r), 1e-12);
  diagram.weights = {4, 4, 4, 25};
  EXPECT_EQ(facet_gap(diagram, {0, 3}), 0) << "they have a point in common";
  // Balls of different sizes: every point of the sphere's centre has one power to all of them.
  diagram.weights = {0.04, 0.25, 1, 25};
  const double gap = facet_gap(diagram, {0, 3});
  double least = 1e9;
  for (int i = 0; i <= 600; ++i) {
    for (int j = 0; j <= 600; ++j) {
      const Vec3 x{i * 0.01 - 1.5, j * 0.01 - 1.5, 1};
      double most = 0;
      for (std::size_t k = 0; k < 3; ++k)
        most = std::max(most,
                        std::abs(squared_distance(x, diagram.centers[k]) - diagram.weights[k] - gap * gap));
      least = std::min(least, most);
    }
  }
  EXPECT_LT(least, 0.05);
}

TEST(without_holes, leaves_an_oriented_manifold_with_boundary_of_any_cells) {
  std::mt19937 random(1);
  std::int64_t loops = 0, copies = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> centers;
    const auto unit = [&] { return std::generate_canonical<double, 53>(random); };
    for (int i = 0; i < 60; ++i) centers.push_back({unit(), unit(), unit()});
    const PowerDiagram diagram =
        power_diagram({centers, std::vector<double>(60, 0.1), {}, {}}, {}, no_monitor());
    std::vector<std::uint8_t> inside(diagram.size(), 0);
    for (std::size_t c = 0; c < diagram.size(); ++c) {
      const auto& v = diagram.cells[c];
      if (std::find(v.begin(), v.end(), PowerDiagram::infinite) == v.end()) inside[c] = random() % 2;
    }
    const CellBoundary closed = cell_boundary(diagram, inside, {.smallest_component = 0});
    std::vector<std::uint8_t> filled(closed.mesh.triangles.size());
    std::size_t wide = 0;
    for (std::uint8_t& f : filled) wide += (f = static_cast<std::uint8_t>(random() % 3)) == 2 ? 1 : 0;
    const CellBoundary open = without_holes(closed, filled, 0, 0);
    const MeshTopology topology = mesh_topology(open.mesh);
    EXPECT_TRUE(topology.manifold);
    EXPECT_TRUE(topology.oriented);
    EXPECT_LE(open.mesh.triangles.size(), filled.size() - wide);
    EXPECT_EQ(open.facets.size(), open.mesh.triangles.size());
    EXPECT_EQ(open.ball.size(), open.mesh.vertices.size());
    for (std::size_t v = 0; v < open.ball.size(); ++v) {
      if (open.ball[v] < 0) continue;
      EXPECT_EQ(open.mesh.vertices[v], centers[static_cast<std::size_t>(open.ball[v])]);
    }
    loops += topology.boundary_loops;
    copies += open.split_vertices - closed.split_vertices;
    // Nothing is wide enough, or nothing is wide: nothing goes.
    EXPECT_EQ(without_holes(closed, filled, 2, 0).mesh.triangles, closed.mesh.triangles);
    EXPECT_EQ(without_holes(closed, std::vector<std::uint8_t>(filled.size(), 1), 0, 0).mesh.triangles,
              closed.mesh.triangles);
  }
  EXPECT_GT(loops, 0);
  EXPECT_GT(copies, 0);
}

PointSet below(const PointSet& points, double z) {
  std::vector<Vec3> kept;
  for (const Vec3& p : points.points) {
    if (p.z < z) kept.push_back(p);
  }
  return {kept, {}};
}

TEST(surface_mesh, a_bowl_is_refused_as_closed_and_has_one_boundary_loop_as_open) {
  const PointSet sphere{test::sphere(5).mesh().vertices, {}};
  const Cloud bowl = cloud_of(below(sphere, 0.1));
  try {
    surface_of(bowl);
    FAIL() << "the lid is nearly a third of the area";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("of the area would close holes"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("open=true"), std::string::npos);
  }
  const SurfaceMesh open = surface_of(bowl, {.open = true});
  const MeshTopology topology = mesh_topology(open.mesh);
  EXPECT_TRUE(topology.manifold);
  EXPECT_TRUE(topology.oriented);
  EXPECT_EQ(topology.boundary_loops, 1);
  EXPECT_EQ(open.report.boundary_loops, 1);
  EXPECT_EQ(open.report.genus, 0);
  EXPECT_EQ(open.report.components, 1);
  // A cap of height 1.1 has the area 2 pi 1.1; its normals look away from the centre.
  double area = 0;
  for (const auto& [a, b, c] : open.mesh.triangles) {
    const auto at = [&](std::int32_t v) { return open.mesh.vertices[static_cast<std::size_t>(v)]; };
    const Vec3 normal = cross(at(b) - at(a), at(c) - at(a));
    area += 0.5 * length(normal);
    EXPECT_GT(dot(normal, at(a) + at(b) + at(c)), 0);
  }
  EXPECT_NEAR(area, 2 * 3.14159265 * 1.1, 0.2);
}

TEST(surface_mesh, holes_of_a_ring_that_is_cut_are_closed_and_told_or_left) {
  std::vector<Vec3> ring;
  for (const Vec3& p : generate(parse_shape("torus?n=2000")).vertices) {
    if (p.x < 0 || std::abs(p.y) > 0.4) ring.push_back(p);
  }
  const Cloud cut = cloud_of({ring, {}});
  Warnings warnings, none;
  const SurfaceMesh closed = surface_mesh(cut.diagram, cut.poles, cut.points, {}, warnings);
  expect_closed_manifold(closed.mesh);
  EXPECT_EQ(closed.report.genus, 0);
  EXPECT_TRUE(warnings.tell("closes holes")) << warnings.all;
  EXPECT_GT(closed.report.wide_area, 0.02);
  const SurfaceMesh open = surface_mesh(cut.diagram, cut.poles, cut.points, {.open = true}, none);
  EXPECT_EQ(none.all, "");
  EXPECT_EQ(open.report.boundary_loops, 2);
  EXPECT_EQ(open.report.genus, 0);
  EXPECT_EQ(open.report.components, 1);
  EXPECT_LT(open.mesh.triangles.size(), closed.mesh.triangles.size());
  // Nothing is a hole of a ring that is not cut.
  const Cloud whole = cloud_of({generate(parse_shape("torus?n=2000")).vertices, {}});
  EXPECT_EQ(surface_of(whole, {.open = true}).mesh.triangles, surface_of(whole).mesh.triangles);
}

TEST(surface_mesh, strays_are_passed_by_and_told) {
  std::vector<Vec3> points;
  for (const Vec3& p : test::sphere(4).mesh().vertices) points.push_back(p);
  const std::size_t n = points.size();
  points.insert(points.end(), {{50, 0, 0}, {0, -50, 10}, {5, 5, 50}});
  for (const double shrink : {0.0, 0.3}) {
    const Cloud cloud = cloud_of({points, {}}, shrink);
    Warnings warnings;
    const SurfaceMesh surface = surface_mesh(cloud.diagram, cloud.poles, cloud.points, {}, warnings);
    expect_closed_manifold(surface.mesh);
    EXPECT_EQ(surface.report.genus, 0);
    EXPECT_EQ(surface.report.left_out, 3);
    EXPECT_GT(surface.report.farthest, 45);
    EXPECT_LE(surface.report.left_out_patch, 3);
    EXPECT_FALSE(warnings.tell("side by side"));
    EXPECT_LE(surface.mesh.vertices.size(), n);
    EXPECT_EQ(warnings.tell("passes by 3 of"), shrink > 0) << warnings.all;
  }
}

TEST(surface_mesh, a_part_of_the_shape_that_is_passed_by_is_told_and_where) {
  // A sphere, and a sheet beside it that bounds nothing.
  const test::Mesh sphere = test::sphere(4);
  const double spacing = std::sqrt(4 * 3.14159 / static_cast<double>(sphere.vertices.size()));
  std::mt19937 random(4);
  std::vector<Vec3> points(sphere.vertices.begin(), sphere.vertices.end()), sheet;
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 5; ++j) {
      const double bump = 0.1 * spacing * std::generate_canonical<double, 53>(random);
      sheet.push_back({2 + spacing * i, spacing * j, bump});
    }
  }
  points.insert(points.end(), sheet.begin(), sheet.end());
  Cloud cloud = cloud_of({points, {}});
  // As the spacing says: the nearest poles of what lies alone say nothing.
  Balls small = cloud.kept;
  small.radii = std::vector<double>(points.size(), 1.2 * spacing);
  cloud.diagram = power_diagram(small, {}, no_monitor());
  Warnings warnings;
  const SurfaceMesh surface = surface_mesh(cloud.diagram, cloud.poles, cloud.points, {}, warnings);
  EXPECT_EQ(broken_invariant(surface.report), "");
  EXPECT_EQ(surface.report.left_out, 25);
  EXPECT_EQ(surface.report.left_out_patch, 25);
  EXPECT_NE(std::find(sheet.begin(), sheet.end(), surface.report.patch_at), sheet.end());
  for (const Vec3& p : sheet) EXPECT_LE(length(p), length(surface.report.patch_at) + 1e-3);
  EXPECT_TRUE(warnings.tell("passes by 25 kept samples side by side, around (2.")) << warnings.all;
}

TEST(surface_mesh, a_sheet_that_bounds_nothing_is_refused_as_open_too) {
  std::mt19937 random(2);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) {
    const double x = std::generate_canonical<double, 53>(random);
    const double y = std::generate_canonical<double, 53>(random);
    points.push_back({x, y, 0.1 * std::sin(6 * x) * std::sin(5 * y)});
  }
  EXPECT_THROW(
      {
        const Cloud sheet = cloud_of({points, {}});
        surface_of(sheet, {.open = true});
      },
      InputError);
}

TEST(surface_mesh, of_clouds_that_it_gets_wrong_says_so) {
  if (test::data_file("models/scapula_23.stl.gz").empty()) GTEST_SKIP() << "no test data";
  for (const char* file : {"scapula_2.stl.gz", "scapula_23.stl.gz", "scapula_48.stl.gz"}) {
    try {
      surface_of(cloud_of(cloud_file(file), 0.3));
      FAIL() << file << ": a fifth of the bone is thinner than the spacing";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("would be missing"), std::string::npos) << error.what();
    }
  }
  Warnings dragon, kitten, knot;
  const auto surface = [](const PointSet& points, Warnings& warnings) {
    const Cloud cloud = cloud_of(points, 0.3);
    surface_balls(cloud.size, {}, warnings);
    return surface_mesh(cloud.diagram, cloud.poles, cloud.points, {}, warnings);
  };
  EXPECT_GT(surface(cloud_file("stanford_dragon_res4.ply.gz"), dragon).report.left_out, 0);
  EXPECT_TRUE(dragon.tell("passes by")) << dragon.all;
  EXPECT_EQ(surface(cloud_file("kitten_points.xyz.gz"), kitten).report.left_out, 0);
  EXPECT_EQ(kitten.all, "");
  surface({read_mesh_file(test::data_file("generated/knot_992.off.gz")).points.points, {}}, knot);
  EXPECT_TRUE(knot.tell("too coarse")) << knot.all;
}

TEST(surface_balls, are_larger_and_say_so_where_a_cloud_is_thinner_than_elsewhere_and_than_its_features) {
  // 100 samples on a line, a tenth of D^ apart; `few` of them far from others, at places with this D^.
  const auto told = [](int few, double pole_distance, bool backwards) {
    std::vector<Vec3> points;
    std::vector<double> poles, third;
    for (int i = 0; i < 100; ++i) {
      const int k = backwards ? 99 - i : i;
      points.push_back({1.0 * k, 0, 0});
      poles.push_back(k < few ? pole_distance : 1);
      third.push_back(k < few ? 1 + 0.1 * k : 0.1);
    }
    Warnings warnings;
    const SurfaceBalls made = surface_balls({points, poles, third}, {}, warnings);
    const double floor = warnings.tell("elsewhere") ? 0.9 : 0.7;
    for (std::size_t i = 0; i < 100; ++i)
      EXPECT_DOUBLE_EQ(made.balls.radii[i], std::max(0.56 * poles[i], floor * third[i])) << i;
    return warnings.all;
  };
  EXPECT_EQ(told(2, 1, false), "");
  EXPECT_EQ(told(3, 2, false), "") << "there the features are as large";
  EXPECT_NE(told(3, 1, false).find("at 3 of 100 samples, around (2, 0, 0)"), std::string::npos)
      << told(3, 1, false);
  EXPECT_EQ(told(3, 1, true), told(3, 1, false));
}

}  // namespace
}  // namespace ballflow::geometry
