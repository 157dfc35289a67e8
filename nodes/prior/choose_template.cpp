#include "prior/choose_template.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "base/for_each_block.hpp"
#include "prior/align.hpp"
#include "prior/cloud.hpp"

namespace ballflow::geometry {
namespace {

// 45 000 pairs: more change the quantiles by less than one shape of an organ differs from another.
constexpr std::size_t points_of_pairs = 300, quantiles = 64;
// So many shapes are laid on each other, all pairs of them: a few seconds.
constexpr std::size_t most_candidates = 24;
constexpr double equal_residual = 1e-6;  // by the radius: rounding of coordinates, say in a file of floats

/// For one of several tasks that run side by side: how far each has come is not what is shown.
class Quiet final : public Monitor {
 public:
  explicit Quiet(Monitor& whole) : whole_(whole) {}
  bool cancelled() override { return whole_.cancelled(); }

 private:
  Monitor& whole_;
};

/// Of each row the sum, added up by size: so the order of the shapes does not matter.
std::vector<double> sums_of(std::vector<std::vector<double>> rows) {
  std::vector<double> sums;
  for (std::vector<double>& row : rows) {
    std::sort(row.begin(), row.end());
    double sum = 0;
    for (const double x : row) sum += x;
    sums.push_back(sum);
  }
  return sums;
}

}  // namespace

std::vector<double> distance_quantiles(std::span<const Vec3> points, Monitor& monitor) {
  std::vector<Vec3> chosen;
  for (const std::int32_t i : farthest_points(points, points_of_pairs, monitor))
    chosen.push_back(points[static_cast<std::size_t>(i)]);
  std::vector<double> distances;
  distances.reserve(chosen.size() * (chosen.size() - 1) / 2);
  for (std::size_t i = 0; i < chosen.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) distances.push_back(distance(chosen[i], chosen[j]));
  std::sort(distances.begin(), distances.end());
  double squares = 0;
  for (const double d : distances) squares += d * d;
  const double unit = std::sqrt(squares / static_cast<double>(distances.size()));
  std::vector<double> result;
  for (std::size_t q = 0; q < quantiles; ++q)
    result.push_back(distances[(2 * q + 1) * distances.size() / (2 * quantiles)] / unit);
  return result;
}

std::size_t choose_template(std::span<const PointSet> shapes, const ChooseTemplateOptions& options,
                            Monitor& monitor) {
  if (shapes.empty()) throw InputError("there is no shape to choose a template from", "give at least one");
  const auto n = static_cast<std::int64_t>(shapes.size());
  if (options.instance < -1 || options.instance >= n)
    throw InputError("instance " + std::to_string(options.instance) + " is to be the template, there are " +
                         std::to_string(n),
                     "give a number from 0 to " + std::to_string(n - 1) + ", or -1 for the medoid");
  std::vector<std::vector<double>> spread;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    monitor.step(0.2 * static_cast<double>(i) / static_cast<double>(n));
    const std::string shape = "instance " + std::to_string(i);
    if (shapes[i].points.size() < 4)
      throw InputError(shape + " has " + std::to_string(shapes[i].points.size()) + " samples, 4 are needed",
                       "leave it out, or sample its surface");
    spread.push_back(distance_quantiles(shapes[i].points, monitor));
    if (!std::isfinite(spread.back().front()))
      throw InputError("all samples of " + shape + " are at one place", "leave it out");
  }
  if (options.instance >= 0) return static_cast<std::size_t>(options.instance);

  // Quantiles choose who is a candidate and who is moved; what decides is how well shapes lie on each other.
  std::vector<std::vector<double>> differences;
  for (const std::vector<double>& a : spread) {
    differences.emplace_back();
    for (const std::vector<double>& b : spread) {
      double sum = 0;
      for (std::size_t q = 0; q < quantiles; ++q) sum += std::abs(a[q] - b[q]);
      differences.back().push_back(sum);
    }
  }
  const std::vector<double> usual = sums_of(differences);
  std::vector<std::size_t> candidates(shapes.size());
  std::iota(candidates.begin(), candidates.end(), std::size_t{0});
  std::stable_sort(candidates.begin(), candidates.end(), [&](std::size_t a, std::size_t b) {
    return usual[a] != usual[b] ? usual[a] < usual[b] : spread[a] < spread[b];
  });
  candidates.resize(std::min(candidates.size(), most_candidates));
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t b = 0; b < candidates.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) pairs.emplace_back(a, b);
  std::vector<std::vector<double>> residuals(candidates.size(), std::vector<double>(candidates.size(), 0.0));
  AlignOptions aligning;
  aligning.similarity = true;
  for_each_block(pairs.size(), 1, monitor, 0.2, 1, [&](std::size_t, std::size_t at, std::size_t) {
    const auto [a, b] = pairs[at];
    Quiet quiet(monitor);
    const double r = rough_residual(shapes[candidates[b]], shapes[candidates[a]], aligning, quiet);
    residuals[a][b] = residuals[b][a] = r;
  });
  for (const auto& [a, b] : pairs) {
    if (residuals[a][b] < equal_residual)
      monitor.warn("instances " + std::to_string(std::min(candidates[a], candidates[b])) + " and " +
                   std::to_string(std::max(candidates[a], candidates[b])) +
                   " are the same shape, counted twice");
  }
  const std::vector<double> sums = sums_of(residuals);
  return candidates[static_cast<std::size_t>(std::min_element(sums.begin(), sums.end()) - sums.begin())];
}

}  // namespace ballflow::geometry
