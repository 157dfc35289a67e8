#include "balls/power_growth.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "homology/inclusion_homology.hpp"
#include "power/alpha_shape.hpp"
#include "power/gabriel_points.hpp"
#include "power/union_betti.hpp"
#include "search/box_tree.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double stop_before = 1 - 0x1p-41;  // closed balls that reach a point would touch there

/// How large a ball at each of the centers may be so that it does not reach a point.
std::vector<double> largest_radii(std::span<const Vec3> points, std::span<const Vec3> centers,
                                  Monitor& monitor) {
  const BoxTree tree(points);
  std::vector<double> radii(centers.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, centers.size(), 512), [&](const auto& range) {
    if (monitor.cancelled()) throw Cancelled();
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const Vec3 c = centers[i];
      radii[i] = stop_before *
                 tree.smallest(c, infinity, -infinity, [&](std::size_t g) { return distance(c, points[g]); });
    }
  });
  return radii;
}

/// The smallest radius whose square is at least the weight: the ball of the weight lies in that of the
/// radius.
double radius_of(double weight) {
  double radius = std::sqrt(weight);
  while (radius * radius < weight) radius = std::nextafter(radius, infinity);
  return radius;
}

class Growing {
 public:
  Growing(const Balls& balls, std::span<const double> wished, Monitor& monitor)
      : balls_(balls), wished_(wished), monitor_(monitor) {}

  PowerGrowth run(const PowerGrowthOptions& options, const PowerDiagram* diagram) {
    prepare(options, diagram);
    if (!balls_.centers.empty()) {
      find_limits();
      grow();
    }
    explain();
    monitor_.step(1);
    return std::move(result_);
  }

 private:
  void prepare(const PowerGrowthOptions& options, const PowerDiagram* diagram) {
    PartMonitor triangulating(monitor_, 0, 0.35), counting(monitor_, 0.35, 0.45);
    if (diagram != nullptr) {
      check_diagram_of(*diagram, balls_, options.tolerance);
      diagram_ = *diagram;
    } else {
      diagram_ = power_diagram(balls_, {options.tolerance}, triangulating);
    }
    weights_ = diagram_.weights;
    first_ = {balls_.radii.begin(), balls_.radii.end()};
    if (options.tolerance == AlphaTolerance::polar) {
      for (std::size_t i = 0; i < first_.size(); ++i) first_[i] = radius_of(weights_[i]);
    }
    result_.betti_before = result_.betti_after = union_betti(diagram_, counting);
  }

  void find_limits() {
    PartMonitor searching(monitor_, 0.45, 0.55);
    const auto points = critical_gabriel_points(diagram_, searching);
    result_.limits = largest_radii(points, balls_.centers, monitor_);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      last_.push_back(std::max(first_[i], std::min(wished_[i], result_.limits[i])));
      added_.push_back(std::max(0.0, last_[i] * last_[i] - weights_[i]));
      ceased_.push_back(last_[i] < wished_[i] ? 1 : 0);
    }
    own_ = added_;
    // Without any, balls that have got what was asked for have changed the topology.
    if (std::find(ceased_.begin(), ceased_.end(), 1) == ceased_.end()) ceased_.assign(balls_.size(), 1);
    monitor_.step(0.6);
  }

  void grow() {
    int taken = 0;
    for (const int steps : {0, 1, 2, 3, 4, 6, 8, 16, 64}) {
      for (; taken < steps; ++taken) spread();
      if (accept()) return;
    }
    added_.assign(balls_.size(), *std::min_element(added_.begin(), added_.end()));
    if (accept()) return;
    result_.radii = first_;
    monitor_.warn("balls touch within rounding: only the tolerance was added to their radii");
  }

  /// Balls that have ceased take their neighbours along. Balls without neighbours are hidden in others, and
  /// stay so when they grow no more than any other.
  void spread() {
    monitor_.step(0.6 + 0.04 * static_cast<double>(result_.unions));
    std::vector<double> added = added_;
    std::vector<std::uint8_t> ceased = ceased_, hidden(balls_.size(), 1);
    for (const auto& cell : diagram_.cells) {
      for (const std::int32_t i : cell) {
        if (i < 0) continue;
        hidden[at(i)] = 0;
        for (const std::int32_t j : cell) {
          if (j < 0 || ceased_[at(j)] == 0) continue;
          added[at(i)] = std::min(added[at(i)], added_[at(j)]);
          ceased[at(i)] = 1;
        }
      }
    }
    const double least = *std::min_element(added.begin(), added.end());
    for (std::size_t i = 0; i < hidden.size(); ++i) {
      if (hidden[i] == 1) added[i] = least;
    }
    added_ = std::move(added);
    ceased_ = std::move(ceased);
  }

  /// Takes what was grown so far when the union has the topology of the start.
  bool accept() {
    const double from = 0.6 + 0.04 * static_cast<double>(result_.unions);
    PartMonitor part(monitor_, from, from + 0.04);
    std::vector<double> radii(balls_.size());
    for (std::size_t i = 0; i < radii.size(); ++i) {
      radii[i] = added_[i] == own_[i]
                     ? last_[i]
                     : std::max(first_[i], std::min(last_[i], std::sqrt(weights_[i] + added_[i])));
    }
    Balls grown;
    grown.centers = balls_.centers;
    grown.radii = radii;
    PowerDiagram diagram = power_diagram(grown, {AlphaTolerance::none}, part);
    const Betti betti = union_betti(diagram, part);
    ++result_.unions;
    if (betti != result_.betti_before) return false;
    if (betti != of_a_ball && !includes_start(grown, std::move(diagram), from + 0.04)) return false;
    result_.betti_after = betti;
    result_.radii = std::move(radii);
    return true;
  }

  /// The inclusion of the union at the start in the grown one is an isomorphism.
  bool includes_start(const Balls& grown, PowerDiagram diagram, double progress) {
    PartMonitor still(monitor_, progress, progress);
    if (complex_.vertices.empty()) complex_ = alpha_shape(diagram_, still);
    Balls start;
    start.centers = balls_.centers;
    start.radii = first_;
    std::vector<std::int32_t> ids(balls_.size());
    std::iota(ids.begin(), ids.end(), 0);
    const UnionOfBalls whole(grown, std::move(diagram), still);
    return Inclusion(whole, ids, UnionOfBalls(start, diagram_, complex_, still)).homology().isomorphism();
  }

  void explain() {
    for (std::size_t i = 0; i < result_.radii.size(); ++i) {
      const double grown = result_.radii[i];
      GrowthStop stop = GrowthStop::neighbour;
      if (grown >= wished_[i]) {
        stop = GrowthStop::wish;
      } else if (grown >= last_[i]) {
        stop = GrowthStop::gabriel;
      }
      result_.stops.push_back(static_cast<std::uint8_t>(stop));
    }
  }

  const Balls& balls_;
  std::span<const double> wished_;
  Monitor& monitor_;
  PowerDiagram diagram_;              // of the balls at the start, with the tolerance
  SimplicialComplex complex_;         // of their union; without vertices until it is asked for
  Array<double> weights_;             // of the balls at the start
  std::vector<double> first_;         // radii at the start
  std::vector<double> last_;          // radii at which balls cease by themselves
  std::vector<double> own_;           // what is added to weights when balls cease by themselves
  std::vector<double> added_;         // what is added
  std::vector<std::uint8_t> ceased_;  // 1 for balls that take their neighbours along
  PowerGrowth result_;
};

}  // namespace

PowerGrowth power_growth(const Balls& balls, std::span<const double> wished,
                         const PowerGrowthOptions& options, Monitor& monitor, const PowerDiagram* diagram) {
  return Growing(balls, wished, monitor).run(options, diagram);
}

}  // namespace ballflow::geometry
