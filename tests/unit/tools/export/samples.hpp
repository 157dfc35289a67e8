// One small artifact of every type that has formats of its own.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "types/shape_types.hpp"
#include "types/surface_types.hpp"

namespace ballflow::test {

inline const geometry::Vec3 odd{0.1, -1.0 / 3, 1e-300}, far{-12345.678901234567, 2e17, 0};

inline geometry::PointSet sample_points(bool normals) {
  geometry::PointSet set;
  set.points = {odd, far, {1, 2, 3}};
  if (normals) set.normals = {{1, 0, 0}, {0, 0, -1}, {0.6, 0.8, 0}};
  return set;
}

inline geometry::TriangleMesh sample_mesh() {
  return {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

inline geometry::Balls sample_balls() { return {{odd, far}, {0.1, 7}, {0, 1, 1}, {5}}; }

inline geometry::PoleSet sample_poles() {
  geometry::PoleSet poles;
  poles.centers = {odd, far};
  poles.radii = {0.25, 0.3};
  poles.labels = {2, 1};
  poles.defining_offsets = {0, 4, 8};
  poles.defining_samples = {0, 1, 2, 3, 1, 2, 3, 4};
  poles.unbounded = {0, 0};
  poles.sample_poles = {{0, -1, -1}, {1, 0, -1}, {1, -1, -1}, {0, 1, -1}, {1, -1, -1}};
  return poles;
}

inline geometry::LocalFeatureSize sample_feature_size() { return {{odd, far}, {0.1, 7}, {1, 2}}; }

inline geometry::ShapePrior sample_prior() {
  geometry::ShapePrior prior;
  prior.centers = {odd, far};
  prior.radii = {0.1, 7};
  prior.points = {{1, 0, 0}};
  prior.normals = {{0, 0, 1}};
  prior.point_share = 0.5;
  prior.radius_unit = 3.55;
  prior.modes = {{1, 0, 0, 0.1}, {0, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, -0.5, 0}};
  prior.point_modes = {{1, 0, 0}, {0, 1, 0}};
  prior.variances = {2, 0.1};
  prior.total_variance = 2.5;
  prior.scores = {1, -0.1, -1, 1.0 / 3, 0, 0};
  prior.poses = std::vector<std::array<double, 12>>(3, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0});
  prior.distances = {1, 2, 0.1};
  prior.generalization = {1, 0.5};
  prior.generalization_deviation = {0.1, 0};
  prior.specificity = {1, 2};
  prior.specificity_deviation = {0.1, 0.1};
  return prior;
}

inline geometry::ShapeFit sample_fit() {
  geometry::ShapeFit fit;
  fit.scores = {1, -2};
  fit.covariance = {0.5, 0.1, 0.1, 0.25};
  fit.centers = {odd, far};
  fit.radii = {0.1, 7};
  fit.deviations = {0, 0.5};
  fit.observed = 100;
  return fit;
}

inline geometry::SampleAssignment sample_assignment(bool surface) {
  geometry::SampleAssignment assignment{{odd, far, {1, 2, 3}}, {0, 7, 70000}, {}};
  if (surface) assignment.vertices = {2, 0, 100000};
  return assignment;
}

inline geometry::SurfaceReport sample_surface_report() {
  geometry::SurfaceReport report;
  report.vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  report.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  report.vertex_balls = {0, 1, -1, 3};
  report.filled = {0, 1, 2, 2};
  report.contradicted = {0, 0, 0, 1};
  return report;
}

inline geometry::Growth sample_growth() {
  geometry::Growth growth;
  growth.centers = {odd, far};
  growth.radii = {0.1, 7};
  growth.grown_radii = {0.25, 7.5};
  growth.limits = {0.25, std::numeric_limits<double>::infinity()};
  growth.stops = {2, 0};
  return growth;
}

/// Tetrahedron 1 2 3 4, triangle 4 5 6, edge 6 7, vertex 9; balls 0 and 8 are hidden.
inline geometry::SimplicialComplex sample_complex() {
  geometry::SimplicialComplex c;
  std::vector<geometry::Vec3> centers;
  std::vector<double> weights;
  for (int i = 0; i < 10; ++i) {
    centers.push_back({1.0 * i, i % 3 + 0.1, i % 2 + 0.3});
    weights.push_back(i * i);
  }
  c.centers = centers;
  c.weights = weights;
  c.vertices = {1, 2, 3, 4, 5, 6, 7, 9};
  c.vertex_classes = {1, 1, 1, 1, 1, 1, 1, 2};
  c.edges = {{1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}, {4, 5}, {4, 6}, {5, 6}, {6, 7}};
  c.edge_classes = {1, 1, 1, 1, 1, 1, 1, 1, 1, 2};
  c.triangles = {{1, 2, 3}, {1, 2, 4}, {1, 3, 4}, {2, 3, 4}, {4, 5, 6}};
  c.triangle_classes = {1, 1, 0, 1, 2};  // 1 3 4 plays an interior one
  c.tetrahedra = {{1, 2, 3, 4}};
  c.betti = {2, 0, 0};
  return c;
}

inline geometry::MedialAxis sample_axis() {
  geometry::MedialAxis axis;
  axis.vertices = {odd, far, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {5, 5, 5}};
  axis.radii = {1, 2, 3, 4, 5, 6.5};
  axis.edges = {{0, 5}};
  axis.polygon_offsets = {0, 3, 8};
  axis.polygon_vertices = {0, 1, 2, 4, 3, 2, 1, 0};
  axis.polygon_kinds = {0, 1};
  return with_sheets(std::move(axis));
}

}  // namespace ballflow::test
