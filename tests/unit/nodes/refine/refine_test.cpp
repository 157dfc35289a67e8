// Samples that follow the shape. What is proven about them is checked by other code than made them: balls by
// the nodes that use the samples, depths over all triangles, topology against the formula of the model.
#include "refine/refine.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "io/read_mesh.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/union_betti.hpp"
#include "refine/start_points.hpp"
#include "sample/generate.hpp"
#include "shapes.hpp"
#include "test_data.hpp"
#include "topology/solid_topology.hpp"

namespace ballflow::geometry {
namespace {

/// A box with sides of the given lengths: 8 vertices, however thin.
TriangleMesh box(Vec3 size, Vec3 at = {}) {
  test::Mesh mesh = test::cube();
  for (Vec3& v : mesh.vertices)
    v = {at.x + size.x * v.x / 2, at.y + size.y * v.y / 2, at.z + size.z * v.z / 2};
  return mesh.mesh();
}

Betti betti_of_solid(const TriangleMesh& mesh) { return solid_topology(mesh, no_monitor()).betti.value(); }

Balls inner_balls(const PointSet& points, const TriangleMesh& mesh) {
  VoronoiPolesOptions all;
  all.vertices = Vertices::all;
  LabelPolesOptions label;
  label.vertices = Vertices::all;
  return label_poles(voronoi_poles(points, all), mesh, label).inner;
}

double distance_to_triangle(Vec3 p, Vec3 a, Vec3 b, Vec3 c) {  // by projections, not by sides
  const auto segment = [p](Vec3 u, Vec3 v) {
    const double t = std::clamp(dot(p - u, v - u) / squared_length(v - u), 0.0, 1.0);
    return distance(p, u + t * (v - u));
  };
  double least = std::min({segment(a, b), segment(b, c), segment(c, a)});
  const Vec3 u = b - a, v = c - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), wu = dot(w, u), wv = dot(w, v);
  const double det = uu * vv - uv * uv, s = (vv * wu - uv * wv) / det, t = (uu * wv - uv * wu) / det;
  if (s >= 0 && t >= 0 && s + t <= 1) least = std::min(least, distance(p, a + s * u + t * v));
  return least;
}

double distance_to_surface(Vec3 p, const TriangleMesh& mesh) {
  double least = 1e300;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](std::int32_t v) { return mesh.vertices[static_cast<std::size_t>(v)]; };
    least = std::min(least, distance_to_triangle(p, at(a), at(b), at(c)));
  }
  return least;
}

Refined refined(const TriangleMesh& mesh, const RefineOptions& options = {}) {
  return refine(mesh, {}, betti_of_solid(mesh), options);
}

class Solids : public testing::TestWithParam<const char*> {};

TEST_P(Solids, inner_balls_have_the_topology_of_the_solid_and_leave_it_by_at_most_delta) {
  const TriangleMesh mesh = generate(parse_shape(GetParam()));
  const double length = bounding_box(mesh.vertices.span()).longest_edge();
  const Refined result = refined(mesh);
  EXPECT_TRUE(result.report.reached()) << what_is_missing(result.report);
  EXPECT_EQ(result.report.wanted, betti_of_solid(mesh));
  EXPECT_EQ(result.report.samples, static_cast<std::int64_t>(result.points.points.size()));

  const Balls inner = inner_balls(result.points, mesh);
  EXPECT_EQ(union_betti(inner, AlphaTolerance::polar, no_monitor()), betti_of_solid(mesh));
  double deepest = 0, farthest = 0;
  for (std::size_t i = 0; i < inner.size(); i += 7) {
    deepest = std::max(deepest, inner.radii[i] - distance_to_surface(inner.centers[i], mesh));
  }
  EXPECT_LE(deepest, 0.005 * length * (1 + 1e-9));
  for (std::size_t i = 0; i < result.points.points.size(); i += 7) {
    farthest = std::max(farthest, distance_to_surface(result.points.points[i], mesh));
  }
  EXPECT_LE(farthest, 1e-12 * length);
}
INSTANTIATE_TEST_SUITE_P(Generated, Solids,
                         testing::Values("torus?n=600", "knot?n=1500", "doubleTorus?n=1500", "box?n=60",
                                         "bracket?n=500", "3cross?n=600"),
                         [](const auto& instance) {
                           const std::string name = instance.param;
                           const std::string letters = name.substr(0, name.find('?'));
                           return "model_" + letters;
                         });

/// Corners that are sharper than the floor asks for samples: their tips were in no ball, and far from all.
TEST(refine, balls_reach_into_sharp_ends) {
  for (const double width : {0.4, 0.1}) {
    const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, width, 0.1 * width}, {1, 0.3 * width, width}};
    const TriangleMesh mesh{corners, std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}}};
    const Refined result = refined(mesh);
    EXPECT_TRUE(result.report.reached()) << what_is_missing(result.report);
    const Balls inner = inner_balls(result.points, mesh);
    const double length = bounding_box(mesh.vertices.span()).longest_edge();
    for (const Vec3 tip : corners) {
      double away = 1e300;
      for (std::size_t i = 0; i < inner.size(); ++i)
        away = std::min(away, distance(tip, inner.centers[i]) - inner.radii[i]);
      EXPECT_LE(away, 0.004 * length) << "width " << width << ", corner " << tip.x << " " << tip.y;
    }
    EXPECT_LE(result.report.samples, 20'000) << width;
  }
}

TEST(refine, the_boundary_of_the_inner_cells_is_a_closed_oriented_surface_of_the_samples) {
  for (const char* shape : {"torus?n=600", "bracket?n=500", "doubleTorus?n=1500"}) {
    const TriangleMesh mesh = generate(parse_shape(shape));
    const Refined result = refined(mesh);
    EXPECT_EQ(result.surface.vertices, result.points.points);
    const MeshTopology topology = mesh_topology(result.surface), solid = mesh_topology(mesh);
    EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented) << shape;
    EXPECT_EQ(topology.genus, solid.genus) << shape;
    EXPECT_EQ(topology.components, solid.components) << shape;
    // Outwards: the volume is positive, and near that of the solid.
    const auto volume = [](const TriangleMesh& m) {
      double six = 0;
      for (const auto& [a, b, c] : m.triangles) {
        const auto at = [&](std::int32_t v) { return m.vertices[static_cast<std::size_t>(v)]; };
        six += dot(at(a), cross(at(b), at(c)));
      }
      return six / 6;
    };
    EXPECT_NEAR(volume(result.surface) / volume(mesh), 1, 0.03) << shape;
  }
  const PointSet points{{{0, 0, 0}, {1, 0, 0}}, {}};
  EXPECT_TRUE(refine({}, points, std::nullopt, {}).surface.triangles.empty());
}

TEST(refine, a_cube_of_eight_vertices_has_the_volume_of_a_cube) {
  const TriangleMesh mesh = box({1, 1, 1});
  const Refined result = refined(mesh);
  EXPECT_TRUE(result.report.reached());
  const Balls inner = inner_balls(result.points, mesh);
  // Points inside the union, of a lattice that knows nothing of the samples.
  int in_cube = 0, in_union = 0, outside = 0;
  for (int i = 0; i < 24; ++i) {
    for (int j = 0; j < 24; ++j) {
      for (int k = 0; k < 24; ++k) {
        const Vec3 p{(i + 0.5) / 20 - 0.6, (j + 0.5) / 20 - 0.6, (k + 0.5) / 20 - 0.6};
        const double reach = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        bool covered = false;
        for (std::size_t b = 0; b < inner.size() && !covered; ++b) {
          covered = distance(p, inner.centers[b]) <= inner.radii[b];
        }
        if (reach < 0.5) ++in_cube, in_union += covered ? 1 : 0;
        if (reach > 0.506 && covered) ++outside;
      }
    }
  }
  EXPECT_EQ(in_cube, in_union);
  EXPECT_EQ(outside, 0);
}

TEST(refine, a_plate_far_thinner_than_delta_stays_whole) {
  const TriangleMesh mesh = box({1, 1, 0.002});
  RefineOptions options;
  options.delta = 5;
  const Refined result = refined(mesh, options);
  EXPECT_TRUE(result.report.reached()) << what_is_missing(result.report);
  EXPECT_EQ(union_betti(inner_balls(result.points, mesh), AlphaTolerance::polar, no_monitor()),
            (Betti{1, 0, 0}));
}

TEST(refine, blocks_with_a_narrow_slot_between_them_stay_apart) {
  test::Mesh two = test::cube();
  test::Mesh other = test::cube();
  two.add(other.move({2.08, 0, 0}));
  const TriangleMesh mesh = two.mesh();
  const Refined result = refined(mesh);
  EXPECT_TRUE(result.report.reached()) << what_is_missing(result.report);
  EXPECT_EQ(result.report.balls, (Betti{2, 0, 0}));
}

TEST(refine, a_cavity_is_sampled_like_the_outside) {
  test::Mesh hollow = test::cube();
  test::Mesh cavity = test::cube();
  hollow.add(cavity.turn().move({}, 0.9));
  const TriangleMesh mesh = hollow.mesh();
  const Refined result = refined(mesh);
  EXPECT_TRUE(result.report.reached());
  EXPECT_EQ(result.report.balls, (Betti{1, 0, 1}));
}

TEST(refine, a_shell_inside_the_solid_that_bounds_nothing_is_left_out_and_told) {
  test::Mesh nested = test::cube();
  test::Mesh same_way = test::cube();
  nested.add(same_way.move({}, 0.9));
  const TriangleMesh mesh = nested.mesh();
  const Refined result = refined(mesh);
  EXPECT_EQ(result.report.balls, (Betti{1, 0, 0}));
  EXPECT_EQ(result.report.left_out, 12);
  EXPECT_EQ(result.points.points.size(), refined(test::cube().mesh()).points.points.size());
  EXPECT_NE(what_is_missing(result.report).find("12 triangles lie inside the solid"), std::string::npos);
}

TEST(refine, solids_that_cross_each_other_are_refined_without_end_or_complaint) {
  test::Mesh crossing = test::cube();
  test::Mesh other = test::cube();
  crossing.add(other.move({0.7, 0.6, 0.5}));
  const Refined result = refine(crossing.mesh(), {}, std::nullopt, {});
  EXPECT_EQ(result.report.complete, 1);
  EXPECT_LT(result.points.points.size(), 60'000u);
  EXPECT_EQ(inner_balls(result.points, crossing.mesh()).size() > 1000, true);
}

TEST(refine, smaller_delta_takes_more_samples) {
  const TriangleMesh mesh = generate(parse_shape("torus?n=3000"));
  RefineOptions coarse, fine;
  coarse.delta = 2;
  fine.delta = 0.25;
  EXPECT_LT(2 * refined(mesh, coarse).points.points.size(), refined(mesh, fine).points.points.size());
}

TEST(refine, same_samples_for_any_number_of_threads) {
  const TriangleMesh mesh = generate(parse_shape("bracket?n=500"));
  std::set<std::vector<Vec3>> results;
  for (const int threads : {1, 2, 4}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    const Refined result = refined(mesh);
    results.insert(std::vector<Vec3>(result.points.points.begin(), result.points.points.end()));
  }
  EXPECT_EQ(results.size(), 1u);
}

TEST(refine, points_are_kept_when_asked_for_and_come_first) {
  const TriangleMesh mesh = generate(parse_shape("torus?n=300"));
  RefineOptions options;
  options.keep_points = true;
  const PointSet vertices{mesh.vertices, {}};
  const Refined result = refine(mesh, vertices, betti_of_solid(mesh), options);
  ASSERT_GE(result.points.points.size(), vertices.points.size());
  for (std::size_t i = 0; i < vertices.points.size(); ++i) {
    EXPECT_EQ(result.points.points[i], vertices.points[i]);
  }
}

TEST(refine, points_of_what_is_not_closed_are_returned_or_refused_with_the_reason) {
  test::Mesh open = test::cube();
  open.triangles.pop_back();
  const PointSet vertices = open.points();
  const Refined as_it_is = refine(open.mesh(), vertices, std::nullopt, {});
  EXPECT_EQ(as_it_is.points.points.size(), 8u);
  EXPECT_EQ(as_it_is.report.refined, 0);
  RefineOptions always;
  always.when = RefineWhen::always;
  const auto cause = [&](const TriangleMesh& mesh) {
    try {
      refine(mesh, vertices, std::nullopt, always);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_NE(cause(open.mesh()).find("the mesh is open: 3 boundary edges"), std::string::npos);
  EXPECT_NE(cause(TriangleMesh{}).find("there are no triangles"), std::string::npos);
  RefineOptions never;
  never.when = RefineWhen::never;
  EXPECT_EQ(refine(test::cube().mesh(), vertices, std::nullopt, never).report.refined, 0);
}

TEST(refine, the_greatest_number_of_samples_stops_it_and_is_told) {
  RefineOptions options;
  options.delta = 0.05;
  options.max_samples = 1000;
  const Refined result = refined(generate(parse_shape("torus?n=600")), options);
  EXPECT_EQ(result.report.complete, 0);
  EXPECT_LE(result.report.samples, 1000);
  EXPECT_NE(what_is_missing(result.report).find("max_samples"), std::string::npos);
}

TEST(refine, options_out_of_range_are_refused) {
  const auto refused = [](auto change) {
    RefineOptions options;
    change(options);
    EXPECT_THROW(refine(test::cube().mesh(), {}, std::nullopt, options), InputError);
  };
  refused([](RefineOptions& o) { o.delta = 0; });
  refused([](RefineOptions& o) { o.floor = -1; });
  refused([](RefineOptions& o) { o.lowest_floor = 0; });
  refused([](RefineOptions& o) { o.wall_fraction = 0.9; });
  refused([](RefineOptions& o) { o.sharp = 0; });
  refused([](RefineOptions& o) { o.max_samples = 3; });
}

TEST(start_points, a_box_starts_from_its_corners_and_evenly_along_its_edges) {
  const auto points = start_points(box({1, 1, 1}), {});
  int corners = 0, on_edges = 0;
  for (const SurfacePoint& p : points) {
    int at_end = 0;
    for (const double x : {p.point.x, p.point.y, p.point.z})
      at_end += std::abs(std::abs(x) - 0.5) < 1e-12 ? 1 : 0;
    if (at_end == 3) ++corners;
    if (at_end == 2) ++on_edges;
  }
  EXPECT_EQ(corners, 8);
  EXPECT_NEAR(on_edges, 12 * 49, 12 * 2);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_NE(points[i - 1].point, points[i].point);
}

TEST(start_points, every_piece_is_there_however_small) {
  test::Mesh two = test::sphere(3);
  test::Mesh speck = test::sphere(1);
  two.add(speck.move({3, 0, 0}, 1e-3));
  const auto points = start_points(two.mesh(), {});
  const auto at_speck = [](const SurfacePoint& p) { return p.point.x > 2; };
  EXPECT_GE(std::count_if(points.begin(), points.end(), at_speck), 6);
}

// What strangers brought (few_vertices of the reports): a part as it was drawn.
TEST(refine, parts_of_few_vertices_keep_their_topology) {
  for (const char* name : {"cube8.off", "cylinder.stl", "tetra.off"}) {
    const std::string file = test::data_file("reports/few_vertices/" + std::string(name));
    if (file.empty()) GTEST_SKIP() << "no test data";
    const TriangleMesh mesh = read_mesh_file(file, {}, no_monitor()).mesh;
    const Refined result = refined(mesh);
    EXPECT_TRUE(result.report.reached()) << name << ": " << what_is_missing(result.report);
    EXPECT_EQ(result.report.balls, (Betti{1, 0, 0})) << name;
  }
}

TEST(refine, real_parts_and_organs_keep_their_topology) {
  const struct {
    const char* file;
    Betti betti;
    std::int64_t most_samples;
  } models[] = {{"three_holes.off.gz", {1, 3, 0}, 20'000}, {"fandisk.off.gz", {1, 0, 0}, 20'000}};
  for (const auto& model : models) {
    const std::string file = test::data_file("models/" + std::string(model.file));
    if (file.empty()) GTEST_SKIP() << "no test data";
    const TriangleMesh mesh = read_mesh_file(file, {}, no_monitor()).mesh;
    const Refined result = refined(mesh);
    EXPECT_TRUE(result.report.reached()) << model.file << ": " << what_is_missing(result.report);
    EXPECT_EQ(result.report.balls, model.betti) << model.file;
    EXPECT_LE(result.report.samples, model.most_samples) << model.file;
  }
}

}  // namespace
}  // namespace ballflow::geometry
