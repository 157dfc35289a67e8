#include "cover/verify_cover.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/patch_matrix.hpp"
#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

/// Samples sorted into equal cubes, row by row of cubes; a sample can be taken out.
class SampleGrid {
 public:
  /// The cubes that a ball may reach into, from `low` to `high`.
  struct Reach {
    std::array<std::uint16_t, 3> low, high;
  };

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

  Reach reach_of(Vec3 center, double radius) const {
    const double reach = radius * (1 + 0x1p-20);  // beyond any slack of the predicate
    const auto low = clamped(center - Vec3{reach, reach, reach}),
               high = clamped(center + Vec3{reach, reach, reach});
    Reach cells;
    for (std::size_t k = 0; k < 3; ++k) {
      cells.low[k] = static_cast<std::uint16_t>(low[k]);
      cells.high[k] = static_cast<std::uint16_t>(high[k]);
    }
    return cells;
  }

  /// Rows of cubes [result[k], result[k + 1]) hold about an equal share of the samples.
  std::vector<std::size_t> equal_parts(std::size_t parts) const {
    const std::size_t rows = size_[1] * size_[2];
    std::vector<std::size_t> ends = {0};
    for (std::size_t row = 0; row < rows; ++row) {
      const std::size_t before = first_[(row + 1) * size_[0]];
      if (row + 1 == rows || before * parts >= ends.size() * ids_.size()) ends.push_back(row + 1);
    }
    return ends;
  }

  /// Takes out the samples whose numbers `in_ball` accepts, in the rows of cubes [first, last) alone; it
  /// accepts none outside of `reach`. Calls for different rows may run at once.
  template <class InBall>
  void take(const Reach& reach, std::size_t first_row, std::size_t last_row, InBall in_ball) {
    for_cells(reach, first_row, last_row, [&](std::size_t cell) {
      for (std::size_t k = first_[cell]; k < last_[cell];) {
        if (in_ball(ids_[k])) {
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
    for_cells(reach_of(center, radius), 0, size_[1] * size_[2], [&](std::size_t cell) {
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
  void for_cells(const Reach& reach, std::size_t first_row, std::size_t last_row, OnCell on_cell) const {
    if (ids_.empty()) return;
    const std::size_t first_layer = std::max<std::size_t>(reach.low[2], first_row / size_[1]);
    const std::size_t last_layer = std::min<std::size_t>(reach.high[2], (last_row - 1) / size_[1]);
    for (std::size_t z = first_layer; z <= last_layer; ++z) {
      const std::size_t first = std::max(z * size_[1] + reach.low[1], first_row),
                        last = std::min(z * size_[1] + reach.high[1] + 1, last_row);
      for (std::size_t row = first; row < last; ++row) {
        for (std::size_t x = reach.low[0]; x <= reach.high[0]; ++x) on_cell(row * size_[0] + x);
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

// Balls between two looks at the monitor.
constexpr std::size_t block = 256;

/// What is to be covered: samples, or triangles of them where there are any.
class Demanded {
 public:
  Demanded(const PointSet& points, const TriangleMesh& patches) : patches_(patches) {
    if (patches.triangles.empty()) {
      places_ = points.points;
      return;
    }
    if (const std::string broken = broken_invariant(patches); !broken.empty()) {
      throw InputError("the patches are damaged: " + broken, "connect the patches of CoverPoints");
    }
    std::vector<Vec3> corners;
    for (const Triangle& patch : patches.triangles) {
      corners.push_back(patches.vertices[static_cast<std::size_t>(patch[0])]);
    }
    places_ = std::move(corners);
  }
  bool are_patches() const { return !patches_.triangles.empty(); }
  std::size_t size() const { return places_.size(); }
  /// A point of each, whose ball it must be in.
  const Array<Vec3>& places() const { return places_; }
  /// By membership.hpp alone: a sample that defines the ball is the caller's to know.
  bool is_in(Vec3 center, double reach, std::int32_t k) const {
    const auto i = static_cast<std::size_t>(k);
    return are_patches() ? contains_patch(center, reach, patches_, patches_.triangles[i])
                         : in_reach(center, reach, places_[i]);
  }
  /// Of those that define the ball `i` and are in it whatever the predicate says.
  std::span<const std::int32_t> defining(const Balls& balls, std::size_t i) const {
    return are_patches() ? std::span<const std::int32_t>() : balls.samples_of(i);
  }
  std::string name(std::size_t k) const {
    return (are_patches() ? "triangle " : "sample ") + std::to_string(k);
  }
  const char* plural() const { return are_patches() ? "triangles" : "samples"; }

 private:
  const TriangleMesh& patches_;
  Array<Vec3> places_;
};

std::string in_words(Vec3 p) {
  char place[96];
  std::snprintf(place, sizeof place, "(%.9g, %.9g, %.9g)", p.x, p.y, p.z);
  return place;
}

/// What is wrong with ball i, which has `inside` of the entries of the certificate, ascending, in it.
std::string broken_condition(const CoverState& cover, std::size_t i, std::span<const std::int32_t> inside) {
  std::int64_t cost = 0;
  for (const std::int32_t k : inside) {
    cost += cover.certificate_prices[static_cast<std::size_t>(k)];
    const std::int32_t one = cover.certificate_groups[static_cast<std::size_t>(inside.front())],
                       other = cover.certificate_groups[static_cast<std::size_t>(k)];
    if (other != one) {
      return "ball " + std::to_string(i) + " contains samples of the groups " + std::to_string(one) +
             " and " + std::to_string(other);
    }
  }
  if (cost <= price_unit) return {};
  return "ball " + std::to_string(i) + " contains samples whose prices sum to " + std::to_string(cost) +
         " / " + std::to_string(price_unit) + ", more than 1";
}

}  // namespace

CoverCheck verify_cover(const Balls& balls, const PointSet& points, const VerifyCoverOptions& options,
                        Monitor& monitor, std::span<const std::int32_t> without_candidate,
                        const TriangleMesh& patches) {
  require_coverable(balls, points);
  monitor.step(0);
  const Demanded demanded(points, patches);
  const std::size_t n = demanded.size();
  SampleGrid grid(demanded.places());
  std::vector<SampleGrid::Reach> reach(balls.size());
  for_each_block(balls.size(), block, monitor, 0, 0.2, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) reach[i] = grid.reach_of(balls.centers[i], balls.radii[i]);
  });
  // Every part of the grid goes through all balls; a sample that is taken out is not looked at again.
  const std::vector<std::size_t> parts = grid.equal_parts(64);
  for_each_block(parts.size() - 1, 1, monitor, 0.2, 0.9, [&](std::size_t part, std::size_t, std::size_t) {
    for (std::size_t i = 0; i < balls.size(); ++i) {
      if (i % 4096 == 0 && monitor.cancelled()) throw Cancelled();
      const double squared = squared_reach(balls.radii[i]);
      grid.take(reach[i], parts[part], parts[part + 1],
                [&](std::int32_t k) { return demanded.is_in(balls.centers[i], squared, k); });
    }
  });
  std::vector<std::uint8_t> defines(n);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    for (const std::int32_t s : demanded.defining(balls, i)) defines[static_cast<std::size_t>(s)] = 1;
  }
  std::vector<std::int32_t> uncovered = grid.rest();
  std::erase_if(uncovered, [&](std::int32_t s) { return defines[static_cast<std::size_t>(s)] != 0; });
  monitor.step(1);

  const auto describe = [&](std::span<const std::int32_t> listed, const char* what) {
    const auto first = static_cast<std::size_t>(listed.front());
    return std::to_string(listed.size()) + " of " + std::to_string(n) + " " + demanded.plural() + " " + what +
           ", the first is " + demanded.name(first) + " at " + in_words(demanded.places()[first]);
  };
  std::vector<std::int32_t> missed;  // a ball could cover them
  std::set_difference(uncovered.begin(), uncovered.end(), without_candidate.begin(), without_candidate.end(),
                      std::back_inserter(missed));
  if (!missed.empty()) {
    const std::string cause =
        describe(missed, ("are in none of the " + std::to_string(balls.size()) + " balls").c_str());
    if (options.on_uncovered == OnUncovered::error) {
      throw InputError(cause,
                       "check that the balls were chosen for these points, or set on_uncovered to report");
    }
    monitor.warn(cause);
  }
  if (uncovered.size() > missed.size()) {
    std::vector<std::int32_t> without;
    std::set_difference(uncovered.begin(), uncovered.end(), missed.begin(), missed.end(),
                        std::back_inserter(without));
    monitor.warn(describe(without, "have no ball that could cover them"));
  }
  return {static_cast<std::int64_t>(balls.size()), static_cast<std::int64_t>(n), std::move(uncovered)};
}

void verify_uncovered(const CoverState& cover, const Balls& candidates, const PointSet& points,
                      Monitor& monitor, const TriangleMesh& patches) {
  if (cover.uncovered.empty()) return;
  const Demanded demanded(points, patches);
  const auto refuse = [&](const std::string& cause) {
    throw InputError(
        std::string("the cover lists ") + demanded.plural() + " without a candidate, and " + cause,
        "connect the cover, the balls of its covering matrix and its points; else compute it again");
  };
  require_coverable(candidates, points);
  std::vector<std::uint8_t> listed(demanded.size(), 0);
  std::vector<Vec3> places;
  for (const std::int32_t s : cover.uncovered) {
    if (s < 0 || static_cast<std::size_t>(s) >= listed.size()) {
      refuse((demanded.are_patches() ? "triangle " : "sample ") + std::to_string(s) + " does not exist");
    }
    listed[static_cast<std::size_t>(s)] = 1;
    places.push_back(demanded.places()[static_cast<std::size_t>(s)]);
  }
  const auto covered = [&](std::size_t ball, std::int32_t sample) {
    refuse(demanded.name(static_cast<std::size_t>(sample)) + " is in ball " + std::to_string(ball));
  };
  const SampleGrid grid(places);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i % 4096 == 0 && monitor.cancelled()) throw Cancelled();
    for (const std::int32_t s : demanded.defining(candidates, i)) {
      if (listed[static_cast<std::size_t>(s)] == 1) covered(i, s);
    }
    const double reach = squared_reach(candidates.radii[i]);
    grid.near(candidates.centers[i], candidates.radii[i], [&](std::int32_t k) {
      const std::int32_t s = cover.uncovered[static_cast<std::size_t>(k)];
      if (demanded.is_in(candidates.centers[i], reach, s)) covered(i, s);
    });
  }
}

std::int64_t verify_certificate(const CoverState& cover, const Balls& candidates, const PointSet& points,
                                Monitor& monitor, const TriangleMesh& patches) {
  monitor.step(0);
  const Demanded demanded(points, patches);
  const auto refuse = [](const std::string& cause) {
    throw InputError(
        "the certificate is refused: " + cause,
        "connect the cover, the balls of its covering matrix and its points; else compute it again");
  };
  if (cover.balls != static_cast<std::int64_t>(candidates.size()) ||
      cover.samples != static_cast<std::int64_t>(demanded.size())) {
    refuse("it is about " + std::to_string(cover.balls) + " balls and " + std::to_string(cover.samples) +
           " " + demanded.plural() + ", there are " + std::to_string(candidates.size()) + " and " +
           std::to_string(demanded.size()));
  }
  require_coverable(candidates, points);
  if (const std::string broken = broken_invariant(cover); !broken.empty()) refuse(broken);

  const auto& listed = cover.certificate_samples;
  std::vector<Vec3> places;
  std::vector<std::int32_t> entry(demanded.size(), -1);  // of each sample in the certificate
  for (std::size_t k = 0; k < listed.size(); ++k) {
    places.push_back(demanded.places()[static_cast<std::size_t>(listed[k])]);
    entry[static_cast<std::size_t>(listed[k])] = static_cast<std::int32_t>(k);
  }
  const SampleGrid grid(places);
  std::vector<std::atomic<bool>> met(listed.size());
  const std::size_t blocks = blocks_of(candidates.size(), block);
  std::vector<std::string> causes(blocks);  // of each block, its first
  std::atomic<std::size_t> first_cause{blocks};
  for_each_block(candidates.size(), block, monitor, 0, 1,
                 [&](std::size_t b, std::size_t first, std::size_t last) {
                   std::vector<std::int32_t> inside;
                   for (std::size_t i = first; i < last && b < first_cause; ++i) {
                     inside.clear();
                     const double reach = squared_reach(candidates.radii[i]);
                     grid.near(candidates.centers[i], candidates.radii[i], [&](std::int32_t k) {
                       if (demanded.is_in(candidates.centers[i], reach, listed[static_cast<std::size_t>(k)]))
                         inside.push_back(k);
                     });
                     for (const std::int32_t s : demanded.defining(candidates, i)) {
                       if (entry[static_cast<std::size_t>(s)] >= 0)
                         inside.push_back(entry[static_cast<std::size_t>(s)]);
                     }
                     std::sort(inside.begin(), inside.end());
                     inside.erase(std::unique(inside.begin(), inside.end()), inside.end());
                     for (const std::int32_t k : inside)
                       met[static_cast<std::size_t>(k)].store(true, std::memory_order_relaxed);
                     causes[b] = broken_condition(cover, i, inside);
                     if (causes[b].empty()) continue;
                     // Blocks before this one go on: the first ball of all is named, whoever finds one first.
                     std::size_t known = first_cause;
                     while (b < known && !first_cause.compare_exchange_weak(known, b)) {
                     }
                     break;
                   }
                 });
  if (first_cause < blocks) refuse(causes[first_cause]);
  for (std::size_t k = 0; k < listed.size(); ++k) {
    if (met[k]) continue;
    refuse(demanded.name(static_cast<std::size_t>(listed[k])) + " at " + in_words(places[k]) +
           " is in none of the " + std::to_string(candidates.size()) +
           " balls, so that none has to pay its price " + std::to_string(cover.certificate_prices[k]) +
           " / " + std::to_string(price_unit));
  }
  monitor.step(1);
  return cover.certified_bound();
}

}  // namespace ballflow::geometry
