// Whether posteriors of ShapeFit are as wide as they are wrong: every instance of a known family fitted from
// half of its surface with the model of the others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "individuals.hpp"
#include "prior/shape_fit.hpp"
#include "prior/shape_prior.hpp"
#include "shape_family.hpp"

namespace ballflow::geometry {
namespace {

/// A number of successes among n that is rarer than this, in each direction, is no chance.
constexpr double rare = 0.001;
/// Of a normal distribution within one and two standard deviations.
constexpr double in_one = 0.6827, in_two = 0.9545;

struct Bounds {
  int least = 0, most = 0;
};

/// What of n independent trials succeeds: fewer or more than this with a probability of at most `rare` each.
Bounds binomial(int n, double p) {
  Bounds bounds{-1, n};
  double probability = std::pow(1 - p, n), sum = 0;
  for (int k = 0; k <= n; ++k) {
    sum += probability;
    if (bounds.least < 0 && sum > rare) bounds.least = k;
    if (1 - sum <= rare) {
      bounds.most = k;
      break;
    }
    probability *= static_cast<double>(n - k) / (k + 1.0) * p / (1 - p);
  }
  return bounds;
}

TEST(binomial_bounds, leave_out_what_is_rare) {
  EXPECT_EQ(binomial(10, 0.5).least, 1);  // none of ten: 1 in 1024
  EXPECT_EQ(binomial(10, 0.5).most, 9);
  EXPECT_EQ(binomial(9, 0.5).least, 0);  // 1 in 512 happens
  EXPECT_EQ(binomial(9, 0.5).most, 9);
}

/// ScoreErrors of one score by its posterior standard deviation.
struct ScoreErrors {
  std::vector<double> in_deviations;
  double squares = 0, deviations = 0;  // sums: of squared errors; of posterior deviations

  void add(double error, double deviation) {
    in_deviations.push_back(error / deviation);
    squares += error * error;
    deviations += deviation;
  }
  int count() const { return static_cast<int>(in_deviations.size()); }
  int within(double limit) const {
    return static_cast<int>(std::count_if(in_deviations.begin(), in_deviations.end(),
                                          [&](double e) { return std::abs(e) <= limit; }));
  }
  double in_root_mean_square() const {
    double sum = 0;
    for (const double e : in_deviations) sum += e * e;
    return std::sqrt(sum / count());
  }
  void print(const std::string& of) const {
    std::printf(
        "%s: %d of %d within one, %d within two; root mean square %.3f deviations; error %.3f, deviation "
        "%.3f\n",
        of.c_str(), within(1), count(), within(2), in_root_mean_square(), std::sqrt(squares / count()),
        deviations / count());
  }
};

std::vector<double> scores_of(const ShapePrior& prior, std::size_t mode) {
  std::vector<double> scores;
  for (std::size_t i = 0; i < prior.instances(); ++i)
    scores.push_back(prior.scores[i * prior.mode_count() + mode]);
  return scores;
}

/// y where the x are `at`, by the least squares plane through all (x, y): one of the x after the other is
/// taken out of the rest.
double predicted(std::vector<double> y, std::vector<std::vector<double>> x, std::vector<double> at) {
  x.insert(x.begin(), std::vector<double>(y.size(), 1.0));
  at.insert(at.begin(), 1.0);
  double result = 0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const double own = std::inner_product(x[j].begin(), x[j].end(), x[j].begin(), 0.0);
    const auto take_out = [&](std::vector<double>& of) {
      const double part = std::inner_product(x[j].begin(), x[j].end(), of.begin(), 0.0) / own;
      for (std::size_t i = 0; i < of.size(); ++i) of[i] -= part * x[j][i];
      return part;
    };
    result += take_out(y) * at[j];
    for (std::size_t l = j + 1; l < x.size(); ++l) at[l] -= take_out(x[l]) * at[j];
  }
  return result;
}

template <class T>
std::vector<T> without(const std::vector<T>& all, std::size_t i) {
  std::vector<T> rest = all;
  rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
  return rest;
}

/// The half of the points on one side of a plane across `direction`.
PointSet half_of(const PointSet& all, Vec3 direction) {
  std::vector<double> heights;
  for (const Vec3& p : all.points) heights.push_back(dot(p, direction));
  const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
  std::nth_element(heights.begin(), middle, heights.end());
  const double height = *middle;
  std::vector<Vec3> points, normals;
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    if (dot(all.points[i], direction) < height) continue;
    points.push_back(all.points[i]);
    normals.push_back(all.normals[i]);
  }
  PointSet half;
  half.points = std::move(points);
  half.normals = std::move(normals);
  return half;
}

/// Standard normal, but for its tails: the sum of twelve uniform numbers.
double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

/// Displacements along normals of deviation `size`: of each point its own, or smooth ones, waves of about
/// the `length` in random directions, which no mode explains.
PointSet displaced(const PointSet& points, Random& random, double size, double length) {
  constexpr int waves = 8;
  std::vector<Vec3> directions;
  std::vector<double> amplitudes, phases;
  for (int w = 0; w < waves; ++w) {
    Vec3 direction{normal(random), normal(random), normal(random)};
    const double l = std::sqrt(dot(direction, direction));
    directions.push_back((2 * std::numbers::pi / length / l) * direction);
    amplitudes.push_back(normal(random) * std::sqrt(2.0 / waves));
    phases.push_back(2 * std::numbers::pi * random.unit());
  }
  std::vector<Vec3> result;
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    double by = 0;
    if (length > 0) {
      for (std::size_t w = 0; w < waves; ++w)
        by += amplitudes[w] * std::cos(dot(directions[w], points.points[i]) + phases[w]);
    } else {
      by = normal(random);
    }
    result.push_back(points.points[i] + (size * by) * points.normals[i]);
  }
  PointSet moved;
  moved.points = std::move(result);
  moved.normals = points.normals;
  return moved;
}

std::vector<ScoreErrors> of_ellipsoids(std::size_t n, double noise, double wave, double effective,
                                       std::size_t m) {
  const Family known = family(n, 3, false);
  Random random(11);
  std::vector<ScoreErrors> errors(2);
  for (std::size_t i = 0; i < n; ++i) {
    ShapePriorOptions options;
    options.modes = 2;
    options.draws = 0;
    const ShapePrior prior = shape_prior(without(known.members, i), {}, options);
    const MatchedBalls dense = family_member(known.lengths[i], known.growths[i], 30, 2 * m);
    PointSet surface;
    surface.points = dense.points;
    surface.normals = dense.normals;
    const Vec3 direction{normal(random), normal(random), normal(random)};
    const PointSet seen = displaced(half_of(surface, direction), random, noise, wave);
    ShapeFitOptions fitting;
    fitting.effective = effective;
    const ShapeFit fit = shape_fit(prior, seen, {}, fitting);
    for (std::size_t mode = 0; mode < 2; ++mode) {
      const double truth =
          predicted(scores_of(prior, mode), {without(known.lengths, i), without(known.growths, i)},
                    {known.lengths[i], known.growths[i]});
      errors[mode].add(fit.scores[mode] - truth, std::sqrt(fit.covariance[3 * mode]));
    }
  }
  return errors;
}

/// Boxes with a bump, from their meshes on: samples, balls and matches are those of the graphs.
ScoreErrors of_boxes(std::size_t n, double effective) {
  Random random(1);
  std::vector<double> places;
  std::vector<Individual> boxes;
  for (std::size_t i = 0; i < n; ++i) {
    places.push_back(2.8 + 2.0 * static_cast<double>(i) / static_cast<double>(n - 1));
    boxes.emplace_back(bump_box(places.back()), 1000, 2000, i);
  }
  const Individual& middle = boxes[n / 2];
  const std::vector<MatchedBalls> all = matched(boxes, template_of(middle, 100), middle);
  ScoreErrors errors;
  for (std::size_t i = 0; i < n; ++i) {
    ShapePriorOptions options;
    options.modes = 1;
    options.draws = 0;
    const ShapePrior prior = shape_prior(without(all, i), {}, options);
    const double truth = predicted(scores_of(prior, 0), {without(places, i)}, {places[i]});
    const PointSet surface = samples_of(boxes[i].mesh, 1000, 1000 + i);
    ShapeFitOptions fitting;
    fitting.effective = effective;
    for (int side = 0; side < 2; ++side) {
      const Vec3 direction{normal(random), normal(random), normal(random)};
      const ShapeFit fit = shape_fit(prior, half_of(surface, direction), {}, fitting);
      errors.add(fit.scores[0] - truth, std::sqrt(fit.covariance[0]));
    }
  }
  return errors;
}

void expect_calibrated(const ScoreErrors& errors) {
  const Bounds one = binomial(errors.count(), in_one), two = binomial(errors.count(), in_two);
  EXPECT_GE(errors.within(1), one.least);
  EXPECT_LE(errors.within(1), one.most);
  EXPECT_GE(errors.within(2), two.least);  // all of them is no rare event
}

// With the usual number, 30, the counts are just within their bounds and the root mean square is not near 1:
// see docs/shape_priors.md for how far from it.
TEST(calibration, of_halves_of_ellipsoids_holds_with_a_third_of_the_usual_observations) {
  const std::vector<ScoreErrors> cautious = of_ellipsoids(44, 0.05, 0, 10, 300);
  const std::vector<ScoreErrors> usual = of_ellipsoids(44, 0.05, 0, ShapeFitOptions().effective, 300);
  for (std::size_t mode = 0; mode < 2; ++mode) {
    cautious[mode].print("10, mode " + std::to_string(mode));
    usual[mode].print("30, mode " + std::to_string(mode));
    expect_calibrated(cautious[mode]);
    EXPECT_LT(cautious[mode].in_root_mean_square(), 1.4);
    EXPECT_LT(usual[mode].in_root_mean_square(), 1.7);
  }
}

// What no mode explains is taken for what a mode does: errors that hang together all over a shape.
TEST(calibration, of_halves_with_waves_of_their_own_is_missed_within_one_deviation_alone) {
  const std::vector<ScoreErrors> errors = of_ellipsoids(44, 0.15, 4, 10, 300);
  for (const ScoreErrors& of_mode : errors) {
    of_mode.print("10, waves");
    EXPECT_GE(of_mode.within(2), binomial(of_mode.count(), in_two).least);
    EXPECT_LT(of_mode.in_root_mean_square(), 1.6);
  }
}

TEST(calibration, of_halves_of_boxes_holds_with_a_third_of_the_usual_observations) {
  const auto n = static_cast<std::size_t>(from_environment("BALLFLOW_TEST_INSTANCES", 0));
  if (n < 20) GTEST_SKIP() << "BALLFLOW_TEST_INSTANCES=30 has enough cases, and takes half a minute";
  const ScoreErrors cautious = of_boxes(n, 10);
  cautious.print("10");
  expect_calibrated(cautious);
}

}  // namespace
}  // namespace ballflow::geometry
