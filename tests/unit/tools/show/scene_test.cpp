#include "show/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballflow/error.hpp"
#include "sealed.hpp"
#include "types/motion_types.hpp"
#include "types/planar_types.hpp"
#include "types/prior_types.hpp"
#include "types/shape_types.hpp"
#include "types/surface_types.hpp"

namespace ballflow::show {
namespace {

using namespace geometry;

std::vector<Layer> shown(const auto& value) {
  std::vector<Layer> layers = layers_of(*test::sealed(value));
  for (const Layer& layer : layers) EXPECT_EQ(broken_invariant(layer), "") << layer.name;
  return layers;
}

std::vector<std::string> names(const std::vector<Layer>& layers) {
  std::vector<std::string> all;
  for (const Layer& layer : layers) all.push_back(layer.name);
  return all;
}

using Names = std::vector<std::string>;

TEST(scene, shows_balls_with_their_radii) {
  Balls balls;
  balls.centers = std::vector<Vec3>{{0, 0, 0}, {5, 0, 0}};
  balls.radii = std::vector<double>{1, 2};
  const auto layers = shown(balls);
  ASSERT_EQ(names(layers), Names{"balls"});
  EXPECT_EQ(layers[0].elements(), 2u);
  EXPECT_EQ(layers[0].find("radius")->values, (std::vector<double>{1, 2}));
  EXPECT_EQ(layers[0].find("order")->values, (std::vector<double>{0, 1}));
  const Box box = bounding_box(layers);
  EXPECT_EQ(box.lower, (Vec3{-1, -2, -2}));
  EXPECT_EQ(box.upper, (Vec3{7, 2, 2}));
}

TEST(scene, shows_matched_balls_and_how_they_came_there) {
  MatchedBalls matched;
  matched.centers = {{0, 0, 0}, {5, 0, 0}, {9, 0, 0}};
  matched.radii = {1, 2, 1};
  matched.carried = {{0, 1, 0}, {5, 1, 0}, {9, 0, 0}};
  matched.residuals = {1, 1, 0};
  matched.partners = {1, 1, 0};
  matched.unique = {1, 0, 0};
  matched.points = {{1, 0, 0}};
  matched.normals = {{1, 0, 0}};
  matched.point_residuals = {0.5};
  const auto layers = shown(matched);
  ASSERT_EQ(names(layers), (Names{"matched balls", "from where they were carried", "surface points"}));
  EXPECT_EQ(layers[0].find("partner")->values, (std::vector<double>{2, 1, 0}));
  EXPECT_EQ(layers[0].find("residual")->values, (std::vector<double>{1, 1, 0}));
  ASSERT_EQ(layers[1].elements(), 3u);
  EXPECT_EQ(layers[1].vertices[layers[1].segments[1][0]], (Vec3{5, 1, 0}));
  EXPECT_EQ(layers[1].vertices[layers[1].segments[1][1]], (Vec3{5, 0, 0}));
  EXPECT_EQ(layers[2].find("residual")->values, (std::vector<double>{0.5}));
}

TEST(scene, leaves_layers_without_elements_out) {
  EXPECT_TRUE(shown(Balls{}).empty());
  EXPECT_TRUE(bounding_box({}).empty());
}

TEST(scene, draws_the_rings_of_polygons) {
  Polygon2 polygon;
  polygon.vertices = {{0, 0}, {9, 0}, {0, 9}, {1, 1}, {1, 2}, {2, 1}};
  polygon.ring_offsets = {0, 3, 6};
  polygon.component_offsets = {0, 2};
  const auto layers = shown(polygon);
  ASSERT_EQ(names(layers), Names{"polygon"});
  EXPECT_EQ(layers[0].segments,
            (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}}));
  EXPECT_EQ(layers[0].find("ring")->values, (std::vector<double>{0, 0, 0, 1, 1, 1}));
}

TEST(scene, colours_balls_by_their_clearance_and_draws_what_is_nearest) {
  geometry::BallDistance d;
  d.balls_a = 2;
  d.balls_b = 1;
  d.a = 1;
  d.separation = 2;
  d.point_a = {4, 0, 0};
  d.point_b = {6, 0, 0};
  d.solids_at_least = d.solids_at_most = 2;
  const auto bare = shown(d);
  ASSERT_EQ(names(bare), Names{"nearest points"});
  EXPECT_EQ(bare[0].vertices, (geometry::Array<Vec3>{{4, 0, 0}, {6, 0, 0}}));
  d.threshold = 3;
  d.pairs = {{1, 0}};
  d.separations = {2};
  d.pair_points_a = {{4, 0, 0}};
  d.pair_points_b = {{6, 0, 0}};
  d.centers_a = {{0, 0, 0}, {3, 0, 0}};
  d.radii_a = {0.5, 1};
  d.clearances_a = {5.5, 2};
  d.nearest_a = {0, 0};
  d.centers_b = {{7, 0, 0}};
  d.radii_b = {1};
  d.clearances_b = {2};
  d.nearest_b = {1};
  const auto layers = shown(d);
  ASSERT_EQ(names(layers),
            (Names{"clearance of a", "clearance of b", "nearest points", "pairs below the threshold"}));
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{5.5, 2}));
  EXPECT_EQ(layers[0].radii, (geometry::Array<double>{0.5, 1}));
  EXPECT_FALSE(layers[3].visible);
  EXPECT_EQ(layers[3].find(layers[3].colour_by)->values, std::vector<double>{2});
}

TEST(scene, draws_paths_as_segments_and_a_path_of_one_point_as_a_point) {
  geometry::Path path;
  path.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  path.radii = {0, 0.5, 0};
  const auto layers = shown(path);
  ASSERT_EQ(names(layers), Names{"path"});
  EXPECT_EQ(layers[0].segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(layers[0].find("radius")->values, (std::vector<double>{0, 0.5, 0}));
  path.points = {{3, 0, 0}};
  path.radii = {0};
  EXPECT_EQ(shown(path)[0].shape, Shape::points);
}

TEST(scene, draws_ways_by_their_clearance_and_their_ends_also_where_there_is_none) {
  geometry::Way way;
  way.balls = 1;
  way.start = {0, 0, 0};
  way.goal = {2, 0, 0};
  way.start_component = way.goal_component = 0;
  way.points = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  way.clearances = {0.5, 1, 0.25};
  way.clearance = 0.25;
  const auto layers = shown(way);
  ASSERT_EQ(names(layers), (Names{"way", "start and goal"}));
  EXPECT_EQ(layers[0].segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{0.5, 1, 0.25}));
  EXPECT_EQ(layers[1].find(layers[1].colour_by)->values, (std::vector<double>{0, 1}));
  way.answer = 2;
  way.start_component = -1;
  way.start_ball = 0;
  way.points = {};
  way.clearances = {};
  EXPECT_EQ(names(shown(way)), Names{"start and goal"});
}

TEST(scene, tells_inner_from_outer_poles) {
  PoleSet poles;
  poles.centers = std::vector<Vec3>{{0, 0, 0}, {9, 0, 0}, {0, 1, 0}};
  poles.radii = std::vector<double>{1, 2, 3};
  poles.labels = std::vector<std::uint8_t>{1, 2, 1};
  poles.defining_offsets = std::vector<std::int64_t>{0, 4, 8, 12};
  poles.defining_samples = std::vector<std::int32_t>{0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
  poles.unbounded = std::vector<std::uint8_t>{0, 1, 0};
  poles.sample_poles =
      std::vector<std::array<std::int32_t, 3>>{{0, 1, -1}, {2, 1, -1}, {0, 1, -1}, {0, 1, -1}};
  const auto layers = shown(poles);
  ASSERT_EQ(names(layers),
            (Names{"inner poles", "inner poles as balls", "outer poles", "outer poles as balls"}));
  EXPECT_EQ(layers[0].find("radius")->values, (std::vector<double>{1, 3}));
  EXPECT_TRUE(layers[0].visible);
  EXPECT_FALSE(layers[2].visible);
  EXPECT_EQ(layers[3].radii[0], 2);
}

TEST(scene, colours_grown_balls_by_what_stopped_them) {
  geometry::Growth growth;
  growth.centers = std::vector<Vec3>{{0, 0, 0}, {9, 0, 0}};
  growth.radii = std::vector<double>{1, 2};
  growth.grown_radii = std::vector<double>{1.5, 2};
  growth.limits = std::vector<double>{1.5, 2};
  growth.stops = std::vector<std::uint8_t>{0, 2};
  const auto layers = shown(growth);
  ASSERT_EQ(names(layers), (Names{"grown balls"}));
  EXPECT_EQ(layers[0].radii[0], 1.5);
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{0, 2}));
  EXPECT_EQ(layers[0].find("growth")->values, (std::vector<double>{0.5, 0}));
}

TEST(scene, moves_the_mean_of_a_prior_by_a_slider_for_each_mode) {
  ShapePrior prior;
  prior.centers = {{0, 0, 0}, {9, 0, 0}};
  prior.radii = {1, 2};
  prior.modes = {{3, 4, 0, 0.5}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 2, 0, 0}};
  prior.variances = {2, 1};
  prior.specificity = prior.specificity_deviation = {0, 0};
  const auto layers = shown(prior);
  ASSERT_EQ(names(layers), (Names{"mean", "mode 0", "mode 1"}));
  EXPECT_EQ(layers[0].find("variation")->values, (std::vector<double>{std::sqrt(26), 2}));
  ASSERT_NE(layers[0].chain, nullptr);
  const Chain& chain = *layers[0].chain;
  EXPECT_EQ(broken_invariant(chain), "");
  ASSERT_EQ(chain.joints.size(), 2u);
  EXPECT_EQ(chain.joints[1].name, "mode 1");
  // Ball 0 hangs on two frames: the second one of them moves with the first one, too.
  EXPECT_EQ(layers[0].frames, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(chain.frames[1].parent, 0);
  EXPECT_EQ(chain.frames[0].factor, 5);
  EXPECT_NEAR(length(chain.frames[0].axis - Vec3{0.6, 0.8, 0}), 0, 1e-15);
  EXPECT_EQ(chain.frames[2].joint, -1) << "ball 1 does not move in mode 0";
  EXPECT_EQ(layers[1].vertices[1], (Vec3{6, 8, 0}));
  EXPECT_FALSE(layers[1].visible);
}

TEST(scene, changes_the_radii_of_a_prior_with_its_modes) {
  ShapePrior prior;
  prior.centers = {{0, 0, 0}, {9, 0, 0}};
  prior.radii = {1, 2};
  prior.modes = {{3, 4, 0, 0.5}, {0, 0, 0, -0.25}, {0, 0, 1, 0.125}, {0, 2, 0, 0}};
  prior.variances = {2, 1};
  prior.specificity = prior.specificity_deviation = {0, 0};
  const auto layers = shown(prior);
  ASSERT_NE(layers[0].chain, nullptr);
  EXPECT_EQ(chain_json(*layers[0].chain).at("frames").at(2).at("growth"), -0.25) << "though its center stays";
  // As an instance has them: exp(score * the fourth number).
  const Layer grown = with_joint(layers, "mode 0", 2)[0];
  EXPECT_NEAR(grown.radii[0], std::exp(1.0), 1e-15);
  EXPECT_NEAR(grown.radii[1], 2 * std::exp(-0.5), 1e-15);
  EXPECT_NEAR(length(grown.vertices[0] - Vec3{6, 8, 0}), 0, 1e-14);
  const Layer second = with_joint(with_joint(layers, "mode 0", -1), "mode 1", 3)[0];
  EXPECT_NEAR(second.radii[0], std::exp(-0.5 + 0.375), 1e-15) << "one after the other";
}

TEST(scene, shows_the_mesh_of_a_mean_that_has_one) {
  ShapePrior prior;
  prior.centers = {{0, 0, 0}};
  prior.radii = {1};
  prior.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  prior.triangles = {{0, 2, 1}, {0, 1, 3}};
  const auto layers = shown(prior);
  ASSERT_EQ(names(layers), (Names{"mean", "mean mesh"}));
  EXPECT_EQ(layers[1].shape, Shape::triangles);
  EXPECT_EQ(layers[1].vertices[3], (Vec3{0, 0, 1}));
  EXPECT_EQ(layers[1].triangles[1], (std::array<std::uint32_t, 3>{0, 1, 3}));
  EXPECT_FALSE(layers[1].visible);
}

TEST(scene, colours_fitted_balls_by_their_uncertainty) {
  ShapeFit fit;
  fit.centers = {{0, 0, 0}, {9, 0, 0}};
  fit.radii = {1, 2};
  fit.deviations = {0.25, 3};
  const auto layers = shown(fit);
  ASSERT_EQ(names(layers), (Names{"fitted balls"}));
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{0.25, 3}));
}

TEST(scene, colours_samples_by_the_local_feature_size) {
  geometry::LocalFeatureSize size;
  size.points = std::vector<Vec3>{{0, 0, 0}, {9, 0, 0}};
  size.pole_distances = std::vector<double>{1, 2};
  size.third_neighbors = std::vector<double>{9, 9};
  const auto layers = shown(size);
  ASSERT_EQ(names(layers), (Names{"local feature size"}));
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{1, 2}));
  EXPECT_EQ(layers[0].find("axis distance"), nullptr);
  size.axis_distances = std::vector<double>{0.9, 1.5};
  const auto with_axis = shown(size);
  EXPECT_EQ(with_axis[0].find("axis distance")->values, (std::vector<double>{0.9, 1.5}));
}

TEST(scene, colours_samples_by_the_vertex_that_they_belong_to) {
  geometry::SampleAssignment assignment{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {4, 4, 5}, {7, 7, 3}};
  auto layers = shown(assignment);
  ASSERT_EQ(names(layers), (Names{"samples by vertex"}));
  EXPECT_EQ(layers[0].find("vertex")->values, (std::vector<double>{7, 7, 3}));
  const auto& groups = layers[0].find(layers[0].colour_by)->values;
  EXPECT_EQ(groups[0], groups[1]);
  EXPECT_NE(groups[0], groups[2]);
  assignment.vertices = {};
  layers = shown(assignment);
  EXPECT_EQ(layers[0].find("ball")->values, (std::vector<double>{4, 4, 5}));
}

TEST(scene, colours_a_surface_by_what_speaks_against_it) {
  SurfaceReport report;
  report.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  report.triangles = std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  report.vertex_balls = std::vector<std::int32_t>{0, 1, 2, 3};
  report.filled = std::vector<std::uint8_t>{0, 1, 2, 2};
  report.contradicted = std::vector<std::uint8_t>{0, 0, 0, 1};
  const auto layers = shown(report);
  ASSERT_EQ(names(layers), (Names{"evidence"}));
  EXPECT_EQ(layers[0].find(layers[0].colour_by)->values, (std::vector<double>{0, 1, 2, 3}));
}

TEST(scene, shows_of_a_complex_only_what_can_be_seen) {
  // Two tetrahedra with a triangle in common (interior), an edge that hangs on vertex 4, and vertex 6 alone.
  SimplicialComplex complex;
  complex.centers =
      std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {2, 2, 2}, {9, 9, 9}};
  complex.weights = std::vector<double>{1, 1, 1, 1, 1, 4, 1};
  complex.vertices = std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6};
  complex.edges = std::vector<std::array<std::int32_t, 2>>{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3},
                                                           {1, 4}, {2, 3}, {2, 4}, {3, 4}, {4, 5}};
  complex.triangles = std::vector<std::array<std::int32_t, 3>>{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3},
                                                               {1, 2, 4}, {1, 3, 4}, {2, 3, 4}};
  complex.tetrahedra = std::vector<std::array<std::int32_t, 4>>{{0, 1, 2, 3}, {1, 2, 3, 4}};
  complex.vertex_classes = std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 2};
  complex.edge_classes = std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 1, 1, 1, 2};
  complex.triangle_classes = std::vector<std::uint8_t>{1, 1, 1, 0, 1, 1, 1};
  complex.betti = {2, 0, 0};
  const auto layers = shown(complex);
  ASSERT_EQ(names(layers), (Names{"regular triangles", "singular edges", "isolated vertices"}));
  EXPECT_EQ(layers[0].elements(), 6u);
  EXPECT_EQ(layers[0].vertices.size(), 5u);
  EXPECT_EQ(layers[1].vertices[layers[1].segments[0][1]], (Vec3{2, 2, 2}));
  EXPECT_EQ(layers[1].find("radius")->values, (std::vector<double>{1, 2}));
  EXPECT_EQ(layers[2].vertices[0], (Vec3{9, 9, 9}));
}

TEST(scene, colours_sheets_of_a_medial_axis_that_meet_differently_and_shows_their_seams) {
  MedialAxis axis;  // three leaves of a book, the third of two triangles
  axis.vertices = std::vector<Vec3>{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {-2, -2, 1}};
  axis.radii = std::vector<double>{1, 2, 3, 4, 5, 6};
  axis.polygon_offsets = std::vector<std::int64_t>{0, 3, 6, 9, 12};
  axis.polygon_vertices = std::vector<std::int32_t>{0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 4, 5};
  axis.polygon_kinds = std::vector<std::uint8_t>{0, 0, 0, 0};
  const auto layers = shown(with_sheets(axis));
  ASSERT_EQ(names(layers), (Names{"medial axis", "medial axis seams"}));
  const Attribute* sheet = layers[0].find("sheet");
  ASSERT_NE(sheet, nullptr);
  EXPECT_FALSE(sheet->per_vertex);
  EXPECT_EQ(sheet->values, (std::vector<double>{0, 1, 2, 2}));
  EXPECT_GT(sheet->categories.size(), 2u);
  EXPECT_EQ(layers[1].segments, (std::vector<std::array<std::uint32_t, 2>>{{0, 1}}));
  EXPECT_EQ(layers[1].find("degree")->values, (std::vector<double>{3}));
  EXPECT_FALSE(layers[1].visible);
}

TEST(scene, cuts_polygons_of_a_medial_axis_into_triangles_and_shows_loose_ends) {
  MedialAxis axis;
  axis.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}, {7, 7, 7}};
  axis.radii = std::vector<double>{1, 2, 3, 4, 5, 6};
  axis.edges = std::vector<std::array<std::int32_t, 2>>{{2, 4}};
  axis.polygon_offsets = std::vector<std::int64_t>{0, 4};
  axis.polygon_vertices = std::vector<std::int32_t>{0, 1, 2, 3};
  axis.polygon_kinds = std::vector<std::uint8_t>{1};
  const auto layers = shown(with_sheets(axis));
  ASSERT_EQ(names(layers), (Names{"medial axis", "medial axis edges", "medial axis points"}));
  EXPECT_EQ(layers[0].elements(), 2u);
  EXPECT_EQ(layers[0].find("kind")->values, (std::vector<double>{1, 1}));
  EXPECT_FALSE(layers[0].find("kind")->per_vertex);
  EXPECT_EQ(layers[1].elements(), 1u);
  EXPECT_EQ(layers[2].vertices[0], (Vec3{7, 7, 7}));
}

TEST(scene, says_what_can_be_drawn_when_a_type_cannot) {
  Comparison comparison;
  comparison.compared_with = static_cast<std::uint8_t>(ComparedWith::cloud);
  try {
    layers_of(*test::sealed(comparison));
    FAIL() << "nothing was thrown";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "a Comparison cannot be drawn");
    EXPECT_NE(error.hint().find("MedialAxis"), std::string::npos);
  }
  EXPECT_FALSE(can_be_shown("Comparison"));
  EXPECT_TRUE(can_be_shown("Balls"));
}

TEST(scene, names_the_broken_part_of_a_layer) {
  Layer layer;
  layer.name = "x";
  layer.shape = Shape::triangles;
  layer.vertices = std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}};
  layer.triangles = {{0, 1, 2}};
  EXPECT_EQ(broken_invariant(layer), "a triangle names a vertex that is not there");
  layer.triangles = {{0, 1, 1}};
  EXPECT_EQ(broken_invariant(layer), "");
  layer.attributes = {{"kind", "", {"a", "b"}, false, {2}}};
  EXPECT_EQ(broken_invariant(layer), "the attribute kind has a value outside of its categories");
  layer.attributes[0].values = {1};
  layer.colour_by = "nothing";
  EXPECT_EQ(broken_invariant(layer), "there is no attribute nothing to colour by");
}

}  // namespace
}  // namespace ballflow::show
