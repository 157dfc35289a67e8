#include "surface/assess_noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "surface/denoise.hpp"

namespace ballflow::geometry {
namespace {

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

void check(const PointSet& sample, const PoleSet& poles, const LocalFeatureSize& size,
           const AssessNoiseOptions& options) {
  const std::size_t n = sample.points.size();
  if (poles.sample_poles.size() != n || size.points.size() != n) {
    throw InputError("there are " + std::to_string(n) + " samples, poles of " +
                         std::to_string(poles.sample_poles.size()) + " and sizes of " +
                         std::to_string(size.points.size()),
                     "connect what was computed from these samples");
  }
  if (poles.uncertain.size() != poles.size())
    throw InputError("the poles do not know how certain their labels are", "label them with method angle");
  if (options.neighbors < 8 || options.most_neighbors < options.neighbors || options.most_neighbors > 1000) {
    throw InputError("neighbors is " + std::to_string(options.neighbors) + ", most_neighbors " +
                         std::to_string(options.most_neighbors),
                     "use 8 <= neighbors <= most_neighbors <= 1000");
  }
}

void set(NoiseReport& report, NoiseVerdict verdict) { report.verdict = static_cast<std::uint8_t>(verdict); }

/// Of the cloud as it came.
void begin(NoiseReport& report, const PointSet& sample, const LocalFeatureSize& size,
           const AssessNoiseOptions& options, Monitor& monitor) {
  if (report.uncertain < options.suspect) return set(report, NoiseVerdict::clean);
  std::vector<double> level = local_noise(sample, monitor);
  for (std::size_t i = 0; i < level.size(); ++i) level[i] /= size.third_neighbors[i];
  report.level = quantile(std::move(level), 0.1);
  const std::string share = percent(report.uncertain) + " of the poles are uncertain";
  if (report.level < options.level) {
    set(report, NoiseVerdict::sharp_edges);
    monitor.warn(share +
                 ", but the samples lie on smooth patches: there are sharp edges, or sheets as thin as the "
                 "spacing, which smoothing would not help");
  } else if (!options.act) {
    set(report, NoiseVerdict::left);
    monitor.warn(share + ", and the samples are noisy: denoise them (robustness=auto)");
  } else {
    set(report, NoiseVerdict::noisy);
    report.next = options.neighbors;
  }
}

/// Whether k neighbours lie within D^, by the median: on a surface the k-th is sqrt(k / 3) times as far as
/// the third.
bool fits(std::int32_t k, double coarseness) { return std::sqrt(k / 3.0) * coarseness <= 1; }

/// Of denoised samples.
void go_on(NoiseReport& report, const NoiseReport& before, const AssessNoiseOptions& options,
           Monitor& monitor) {
  report.level = before.level;
  report.neighbors = before.next;
  set(report, NoiseVerdict::noisy);
  if (report.uncertain < options.certain) {
    const std::int32_t twice = 2 * report.neighbors;
    if (before.neighbors == 0 && twice <= options.most_neighbors && fits(twice, report.coarseness)) {
      report.next = twice;
    } else {
      set(report, NoiseVerdict::denoised);
    }
    return;
  }
  const bool going_back = before.neighbors > before.next;
  const bool worse = before.neighbors > 0 && report.uncertain > before.uncertain;
  if (!going_back && worse) {
    report.next = before.neighbors;
  } else if (!going_back && !worse && 2 * report.neighbors <= options.most_neighbors) {
    report.next = 2 * report.neighbors;
  } else {
    set(report, report.uncertain < options.suspect ? NoiseVerdict::denoised : NoiseVerdict::too_noisy);
    if (report.uncertain >= options.suspect) {
      monitor.warn("denoised with " + std::to_string(report.neighbors) + " neighbours, and still " +
                   percent(report.uncertain) +
                   " of the poles are uncertain: the noise hides features, and gaps may close");
    }
  }
}

}  // namespace

NoiseReport assess_noise(const PointSet& sample, const PoleSet& poles, const LocalFeatureSize& size,
                         const NoiseReport* before, const AssessNoiseOptions& options, Monitor& monitor) {
  check(sample, poles, size, options);
  monitor.step(0);
  NoiseReport report;
  const auto flagged = std::count(poles.uncertain.begin(), poles.uncertain.end(), 1);
  if (poles.size() > 0) report.uncertain = static_cast<double>(flagged) / static_cast<double>(poles.size());
  std::vector<double> coarseness;
  for (std::size_t i = 0; i < size.points.size(); ++i) {
    if (std::isfinite(size.third_neighbors[i]))
      coarseness.push_back(size.third_neighbors[i] / size.pole_distances[i]);
  }
  report.coarseness = quantile(std::move(coarseness), 0.5);
  if (before == nullptr) {
    begin(report, sample, size, options, monitor);
  } else {
    go_on(report, *before, options, monitor);
  }
  monitor.step(1);
  return report;
}

}  // namespace ballflow::geometry
