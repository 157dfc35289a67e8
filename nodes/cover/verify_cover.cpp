#include "cover/verify_cover.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "cover/cover_matrix.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

/// Samples sorted into equal cubes; a sample can be taken out.
class SampleGrid {
 public:
  explicit SampleGrid(std::span<const Vec3> samples) : samples_(samples), box_(bounding_box(samples)) {
    // About four samples a cell if they filled the box; on a surface most cells are empty, which costs
    // little.
    const double longest = box_.longest_edge();
    const double per_axis = std::clamp(std::cbrt(static_cast<double>(samples.size()) / 4), 1.0, 256.0);
    cell_ = longest > 0 ? longest / per_axis : 1;
    const Vec3 extent = samples.empty() ? Vec3{} : box_.upper - box_.lower;
    size_ = {steps(extent.x) + 1, steps(extent.y) + 1, steps(extent.z) + 1};
    first_.resize(size_[0] * size_[1] * size_[2] + 1);
    for (const Vec3& p : samples) ++first_[cell_of(p) + 1];
    for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
    last_.assign(first_.begin(), first_.end() - 1);
    ids_.resize(samples.size());
    for (std::size_t j = 0; j < samples.size(); ++j)
      ids_[last_[cell_of(samples[j])]++] = static_cast<std::int32_t>(j);
  }

  /// Takes out the samples that `in_ball` accepts; it accepts none outside the cube of half edge `radius`.
  template <class InBall>
  void take(Vec3 center, double radius, InBall in_ball) {
    for_cells(center, radius, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < last_[cell];) {
        if (in_ball(samples_[static_cast<std::size_t>(ids_[k])])) {
          std::swap(ids_[k], ids_[--last_[cell]]);
        } else {
          ++k;
        }
      }
    });
  }

  /// Calls `visit` with every sample in the cube of half edge `radius`, and some near it.
  template <class Visit>
  void near(Vec3 center, double radius, Visit visit) const {
    for_cells(center, radius, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < last_[cell]; ++k) visit(ids_[k]);
    });
  }

  /// What has not been taken out, ascending.
  std::vector<std::int32_t> rest() const {
    std::vector<std::int32_t> ids;
    for (std::size_t c = 0; c < last_.size(); ++c) {
      for (std::size_t k = first_[c]; k < last_[c]; ++k) ids.push_back(ids_[k]);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
  }

 private:
  template <class OnCell>
  void for_cells(Vec3 center, double radius, OnCell on_cell) const {
    if (ids_.empty()) return;
    const double reach = radius * (1 + 0x1p-20);  // beyond any slack of the predicate
    const auto low = clamped(center - Vec3{reach, reach, reach}),
               high = clamped(center + Vec3{reach, reach, reach});
    for (std::size_t z = low[2]; z <= high[2]; ++z) {
      for (std::size_t y = low[1]; y <= high[1]; ++y) {
        for (std::size_t x = low[0]; x <= high[0]; ++x) {
          on_cell((z * size_[1] + y) * size_[0] + x);
        }
      }
    }
  }

  std::size_t steps(double length) const { return static_cast<std::size_t>(length / cell_); }
  std::array<std::size_t, 3> clamped(Vec3 p) const {
    const auto step = [&](double offset, std::size_t size) {
      return offset > 0 ? static_cast<std::size_t>(std::min(offset / cell_, static_cast<double>(size - 1)))
                        : 0;
    };
    return {step(p.x - box_.lower.x, size_[0]), step(p.y - box_.lower.y, size_[1]),
            step(p.z - box_.lower.z, size_[2])};
  }
  std::size_t cell_of(Vec3 p) const {
    const auto at = clamped(p);
    return (at[2] * size_[1] + at[1]) * size_[0] + at[0];
  }

  std::span<const Vec3> samples_;
  Box box_;
  double cell_ = 1;
  std::array<std::size_t, 3> size_{1, 1, 1};
  std::vector<std::size_t> first_, last_;  // samples of a cell: ids_[first_ .. last_)
  std::vector<std::int32_t> ids_;
};

}  // namespace

CoverCheck verify_cover(const Balls& balls, const PointSet& points, const VerifyCoverOptions& options,
                        Monitor& monitor) {
  require_coverable(balls, points);
  monitor.step(0);
  const std::size_t n = points.points.size();
  SampleGrid grid(points.points);
  std::vector<std::uint8_t> defines(n);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i % 256 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(balls.size()));
    const double reach = squared_reach(balls.radii[i]);
    grid.take(balls.centers[i], balls.radii[i], [&](Vec3 s) { return in_reach(balls.centers[i], reach, s); });
    for (const std::int32_t s : balls.samples_of(i)) defines[static_cast<std::size_t>(s)] = 1;
  }
  std::vector<std::int32_t> uncovered = grid.rest();
  std::erase_if(uncovered, [&](std::int32_t s) { return defines[static_cast<std::size_t>(s)] != 0; });
  monitor.step(1);

  if (!uncovered.empty()) {
    const Vec3 p = points.points[static_cast<std::size_t>(uncovered.front())];
    char place[96];
    std::snprintf(place, sizeof place, "(%.9g, %.9g, %.9g)", p.x, p.y, p.z);
    const std::string cause = std::to_string(uncovered.size()) + " of " + std::to_string(n) +
                              " samples are in none of the " + std::to_string(balls.size()) +
                              " balls, the first is sample " + std::to_string(uncovered.front()) + " at " +
                              place;
    if (options.on_uncovered == OnUncovered::error) {
      throw InputError(cause,
                       "check that the balls were chosen for these points, or set on_uncovered to report");
    }
    monitor.warn(cause);
  }
  return {static_cast<std::int64_t>(balls.size()), static_cast<std::int64_t>(n), std::move(uncovered)};
}

std::int64_t verify_certificate(const CoverState& cover, const Balls& candidates, const PointSet& points,
                                Monitor& monitor) {
  monitor.step(0);
  const auto refuse = [](const std::string& cause) {
    throw InputError(
        "the certificate is refused: " + cause,
        "connect the cover, the balls of its covering matrix and its points; else compute it again");
  };
  if (cover.balls != static_cast<std::int64_t>(candidates.size()) ||
      cover.samples != static_cast<std::int64_t>(points.points.size())) {
    refuse("it is about " + std::to_string(cover.balls) + " balls and " + std::to_string(cover.samples) +
           " samples, there are " + std::to_string(candidates.size()) + " and " +
           std::to_string(points.points.size()));
  }
  require_coverable(candidates, points);
  if (const std::string broken = broken_invariant(cover); !broken.empty()) refuse(broken);

  const auto& listed = cover.certificate_samples;
  std::vector<Vec3> places;
  std::vector<std::int32_t> entry(points.points.size(), -1);  // of each sample in the certificate
  for (std::size_t k = 0; k < listed.size(); ++k) {
    places.push_back(points.points[static_cast<std::size_t>(listed[k])]);
    entry[static_cast<std::size_t>(listed[k])] = static_cast<std::int32_t>(k);
  }
  const SampleGrid grid(places);
  std::vector<std::int32_t> met_by(listed.size(), -1);  // the last ball that met the entry
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i % 256 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(candidates.size()));
    std::int64_t cost = 0;
    std::int32_t group = -1;
    const auto meet = [&](std::int32_t k) {
      const auto e = static_cast<std::size_t>(k);
      if (std::exchange(met_by[e], static_cast<std::int32_t>(i)) == static_cast<std::int32_t>(i)) return;
      cost += cover.certificate_prices[e];
      const std::int32_t other = std::exchange(group, cover.certificate_groups[e]);
      if (other >= 0 && other != group) {
        refuse("ball " + std::to_string(i) + " contains samples of the groups " + std::to_string(other) +
               " and " + std::to_string(group));
      }
    };
    const double reach = squared_reach(candidates.radii[i]);
    grid.near(candidates.centers[i], candidates.radii[i], [&](std::int32_t k) {
      if (in_reach(candidates.centers[i], reach, places[static_cast<std::size_t>(k)])) meet(k);
    });
    for (const std::int32_t s : candidates.samples_of(i)) {
      if (entry[static_cast<std::size_t>(s)] >= 0) meet(entry[static_cast<std::size_t>(s)]);
    }
    if (cost > price_unit) {
      refuse("ball " + std::to_string(i) + " contains samples whose prices sum to " + std::to_string(cost) +
             " / " + std::to_string(price_unit) + ", more than 1");
    }
  }
  monitor.step(1);
  return cover.certified_bound();
}

}  // namespace ballflow::geometry
