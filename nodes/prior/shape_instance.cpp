#include "prior/shape_instance.hpp"

#include <charconv>
#include <cmath>
#include <string>

#include "base/first_equal.hpp"
#include "exact/exponential.hpp"

namespace ballflow::geometry {
namespace {

void refuse(const ShapePrior& prior, std::span<const double> scores) {
  if (scores.size() > prior.mode_count()) {
    throw InputError(std::to_string(scores.size()) + " scores for a model with " +
                         std::to_string(prior.mode_count()) + " modes",
                     "give at most as many scores as modes; the others are 0");
  }
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

std::vector<double> parse_scores(std::string_view text) {
  const char* const hint = "write standard deviations with commas between them: 2,-1";
  std::string_view rest = trimmed(text);
  if (rest.starts_with('[')) {
    if (!rest.ends_with(']'))
      throw InputError("modes \"" + std::string(text) + "\" is a list without an end", hint);
    rest = trimmed(rest.substr(1, rest.size() - 2));
  }
  std::vector<double> scores;
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    std::string_view entry = trimmed(rest.substr(0, comma));
    if (entry.size() > 1 && entry.front() == '"' && entry.back() == '"')
      entry = entry.substr(1, entry.size() - 2);
    double value = 0;
    const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), value);
    const bool last = comma == std::string_view::npos;
    if (error != std::errc() || end != entry.data() + entry.size() || !std::isfinite(value) ||
        (!last && trimmed(rest.substr(comma + 1)).empty())) {
      throw InputError("modes \"" + std::string(text) + "\" has \"" + std::string(entry) +
                           "\", which is no number, or a comma at its end",
                       hint);
    }
    scores.push_back(value);
    rest = last ? std::string_view() : rest.substr(comma + 1);
  }
  return scores;
}

Balls shape_instance(const ShapePrior& prior, std::span<const double> scores) {
  refuse(prior, scores);
  const std::size_t k = prior.balls();
  std::vector<Vec3> centers(prior.centers.begin(), prior.centers.end());
  std::vector<double> radii;
  for (std::size_t i = 0; i < k; ++i) {
    double growth = 0;
    for (std::size_t mode = 0; mode < scores.size(); ++mode) {
      const auto& [x, y, z, log_radius] = prior.modes[mode * k + i];
      centers[i] = centers[i] + scores[mode] * Vec3{x, y, z};
      growth += scores[mode] * log_radius;
    }
    radii.push_back(prior.radii[i] * exponential(growth));
    if (!is_finite(centers[i]) || !std::isfinite(radii[i]) || !(radii[i] > 0)) {
      throw InputError("ball " + std::to_string(i) + " of this instance is not finite, or a point",
                       "take scores between -3 and 3: they are standard deviations");
    }
  }
  Balls balls;
  balls.centers = std::move(centers);
  balls.radii = std::move(radii);
  return balls;
}

std::vector<Vec3> labelled_instance_points(const ShapePrior& prior, std::span<const double> scores) {
  refuse(prior, scores);
  const std::size_t m = prior.points.size();
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < m; ++i) {
    Vec3 point = prior.points[i];
    for (std::size_t mode = 0; mode < scores.size(); ++mode)
      point = point + scores[mode] * prior.point_modes[mode * m + i];
    points.push_back(point + Vec3{0, 0, 0});  // no -0
  }
  return points;
}

PointSet instance_points(const ShapePrior& prior, std::span<const double> scores) {
  const std::vector<Vec3> points = labelled_instance_points(prior, scores);
  const std::vector<std::int32_t> first = first_equal_point(points);
  std::vector<Vec3> distinct;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (first[i] == static_cast<std::int32_t>(i)) distinct.push_back(points[i]);
  }
  PointSet result;
  result.points = std::move(distinct);
  return result;
}

}  // namespace ballflow::geometry
