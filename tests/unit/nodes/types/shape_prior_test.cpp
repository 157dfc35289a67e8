#include "types/shape_prior.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "types/shape_fit.hpp"

namespace ballflow::geometry {
namespace {

ShapePrior small_prior() {
  ShapePrior prior;
  prior.centers = {{0, 0, 0}, {1, 0, 0}};
  prior.radii = {1, 2};
  prior.points = {{0, 0, 1}};
  prior.normals = {{0, 0, 1}};
  prior.modes = {{1, 0, 0, 0}, {0, 1, 0, 0}};
  prior.point_modes = {{1, 0, 0}};
  prior.variances = {1};
  prior.total_variance = 1;
  prior.scores = {1, -1};
  prior.poses = std::vector<std::array<double, 12>>(2);
  prior.distances = {1, 1};
  prior.specificity = prior.specificity_deviation = {0.5};
  return prior;
}

TEST(shape_prior_type, tells_what_is_wrong) {
  EXPECT_EQ(broken_invariant(small_prior()), "");
  const std::vector<std::pair<const char*, std::function<void(ShapePrior&)>>> cases = {
      {"without balls", [](ShapePrior& p) { p.radii = {}; }},
      {"as many centers",
       [](ShapePrior& p) {
         p.centers = {{0, 0, 0}};
       }},
      {"modes x balls",
       [](ShapePrior& p) {
         p.modes = {{1, 0, 0, 0}};
       }},
      {"the mesh of the mean: ",
       [](ShapePrior& p) {
         p.vertices = {{0, 0, 0}};
         p.triangles = {{0, 0, 1}};
       }},
      {"modes x points", [](ShapePrior& p) { p.point_modes = {}; }},
      {"instances x modes", [](ShapePrior& p) { p.scores = {1}; }},
      {"ball 1 is not above 0",
       [](ShapePrior& p) {
         p.radii = {1, 0};
       }},
      {"variance of mode 0", [](ShapePrior& p) { p.variances = {0}; }},
      {"not of length 1",
       [](ShapePrior& p) {
         p.normals = {{0, 0, 2}};
       }},
      {"score 1 is not finite",
       [](ShapePrior& p) {
         p.scores = {0, std::numeric_limits<double>::infinity()};
       }},
      {"specificity 0 is negative", [](ShapePrior& p) { p.specificity = {-1}; }},
      {"not in [0, 1]", [](ShapePrior& p) { p.point_share = 2; }}};
  for (const auto& [words, breaks] : cases) {
    ShapePrior prior = small_prior();
    breaks(prior);
    EXPECT_NE(broken_invariant(prior).find(words), std::string::npos)
        << words << ": " << broken_invariant(prior);
  }
}

TEST(shape_fit_type, tells_what_is_wrong) {
  ShapeFit fit;
  fit.scores = {1, 2};
  fit.covariance = {1, 0.5, 0.5, 1};
  fit.centers = {{0, 0, 0}};
  fit.radii = {1};
  fit.deviations = {0};
  EXPECT_EQ(broken_invariant(fit), "");
  const std::vector<std::pair<const char*, std::function<void(ShapeFit&)>>> cases = {
      {"scores x scores", [](ShapeFit& f) { f.covariance = {1}; }},
      {"not symmetric",
       [](ShapeFit& f) {
         f.covariance = {1, 0.5, 0.25, 1};
       }},
      {"variance of score 1",
       [](ShapeFit& f) {
         f.covariance = {1, 0, 0, -1};
       }},
      {"radius of ball 0", [](ShapeFit& f) { f.radii = {0}; }},
      {"outliers", [](ShapeFit& f) { f.outliers = 1.5; }},
      {"distance", [](ShapeFit& f) { f.residual = -1; }}};
  for (const auto& [words, breaks] : cases) {
    ShapeFit wrong = fit;
    breaks(wrong);
    EXPECT_NE(broken_invariant(wrong).find(words), std::string::npos)
        << words << ": " << broken_invariant(wrong);
  }
}

}  // namespace
}  // namespace ballflow::geometry
