#include "topology/topology_repair.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "homology/inclusion_homology.hpp"
#include "power/power_diagram.hpp"
#include "power/union_betti.hpp"
#include "topology/diagnosis.hpp"
#include "topology/listing_3_2.hpp"
#include "topology/superfluous_balls.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

Ids merged(const Ids& a, Ids b) {
  b.insert(b.end(), a.begin(), a.end());
  std::sort(b.begin(), b.end());
  b.erase(std::unique(b.begin(), b.end()), b.end());
  return b;
}

std::int64_t defects(const InclusionHomology& h) {
  std::int64_t sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += h.part[k] + h.whole[k] - 2 * h.rank[k];
  return sum;
}

/// Returns balls until the inclusion is an isomorphism, then takes superfluous ones out again.
class Repair {
 public:
  Repair(const UnionOfBalls& whole, Ids kept, const TopologyRepairOptions& options, Monitor& monitor)
      : whole_(whole), kept_(std::move(kept)), options_(options), monitor_(monitor) {}

  TopologyRepair run() {
    check_.kept = static_cast<std::int64_t>(kept_.size());
    {
      const Inclusion inclusion = compare({});
      check_.whole = inclusion.homology().whole;
      check_.before = check_.after = inclusion.homology().part;
      check_.before_rank = check_.after_rank = inclusion.homology().rank;
      if (inclusion.homology().isomorphism()) return {{}, check_};
      only_components_ = defects(inclusion.homology()) > options_.most_defects;
    }
    if (options_.method == RepairMethod::literal && !only_components_)
      returned_ = listing_3_2(whole_.balls(), kept_, monitor_);
    grow();
    if (options_.method == RepairMethod::localised && !only_components_) {
      monitor_.note("doing with fewer of the " + std::to_string(returned_.size()) + " balls returned");
      returned_ = without_superfluous(whole_.balls(), kept_, returned_, monitor_);
      const InclusionHomology after = compare(returned_).homology();
      if (!after.isomorphism()) throw std::logic_error("balls were taken out that the topology needs");
      check_.everything = merged(kept_, returned_).size() == whole_.balls().size() ? 1 : 0;
    }
    check_.returned = static_cast<std::int64_t>(returned_.size());
    return {returned_, check_};
  }

 private:
  Inclusion compare(const Ids& returned) {
    ++check_.inclusions;
    monitor_.note(std::to_string(returned.size()) + " balls returned");
    return Inclusion(whole_, merged(kept_, returned));
  }

  /// Returns more and more balls until nothing differs.
  void grow() {
    std::map<Diagnosis::Place, std::size_t> efforts;
    std::size_t effort = 1;
    std::int64_t last = -1;
    for (;;) {
      const Ids ids = merged(kept_, returned_);
      const Inclusion inclusion = compare(returned_);
      check_.after = inclusion.homology().part;
      check_.after_rank = inclusion.homology().rank;
      if (inclusion.homology().isomorphism()) break;
      if (ids.size() == whole_.balls().size()) throw std::logic_error("a union of balls differs from itself");
      Diagnosis diagnosis(whole_, ids, inclusion, monitor_);
      Ids more = diagnosis.for_components();
      if (more.empty() && only_components_) return;
      if (more.empty()) {
        const std::int64_t now = defects(inclusion.homology());
        if (last >= 0 && now >= last) effort *= 2;
        last = now;
        more = merged(diagnosis.for_lost_loops(), diagnosis.for_filled(efforts, effort));
      }
      const std::size_t before = returned_.size();
      returned_ = merged(returned_, more);
      if (returned_.size() == before) {  // nothing left to try
        check_.everything = 1;
        returned_.clear();
        for (std::int32_t i = 0; at(i) < whole_.balls().size(); ++i) {
          if (!std::binary_search(kept_.begin(), kept_.end(), i)) returned_.push_back(i);
        }
      }
    }
    if (merged(kept_, returned_).size() == whole_.balls().size()) check_.everything = 1;
  }

  const UnionOfBalls& whole_;
  Ids kept_;
  const TopologyRepairOptions& options_;
  Monitor& monitor_;
  Ids returned_;
  bool only_components_ = false;
  TopologyCheck check_;
};

}  // namespace

TopologyRepair repair_topology(const Balls& balls, std::span<const std::int32_t> kept,
                               const TopologyRepairOptions& options, Monitor& monitor,
                               const PowerDiagram* diagram) {
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i] < 0 || at(kept[i]) >= balls.size() || (i > 0 && kept[i] <= kept[i - 1])) {
      throw InputError("the kept ball " + std::to_string(kept[i]) + " at place " + std::to_string(i) +
                           " is out of range or out of order (" + std::to_string(balls.size()) + " balls)",
                       "give every id of a kept ball once, ascending");
    }
  }
  constexpr std::size_t most_literal = 2000;
  if (options.method == RepairMethod::literal && balls.size() > most_literal) {
    throw InputError("Listing 3.2 of the thesis computes one alpha-shape per ball, " +
                         std::to_string(balls.size()) + " balls are too many for that (at most " +
                         std::to_string(most_literal) + ")",
                     "use method localised");
  }
  PartMonitor still(monitor, 0, 0);  // how many comparisons it takes is not known
  if (diagram != nullptr) check_diagram_of(*diagram, balls);
  PowerDiagram all = diagram != nullptr ? *diagram : power_diagram(balls, {}, still);
  if (union_betti(all, still) == of_a_ball &&
      union_betti(select(balls, kept), AlphaTolerance::none, still) == of_a_ball) {
    TopologyRepair repair;
    repair.check.kept = static_cast<std::int64_t>(kept.size());
    repair.check.whole = repair.check.before = repair.check.after = of_a_ball;
    repair.check.before_rank = repair.check.after_rank = of_a_ball;
    repair.check.inclusions = 1;
    return repair;
  }
  const UnionOfBalls whole(balls, std::move(all), still);
  const TopologyRepair repair = Repair(whole, Ids(kept.begin(), kept.end()), options, still).run();
  monitor.step(1);
  return repair;
}

TopologyRepair repair_topology(const Balls& balls, const CoverState& cover,
                               const TopologyRepairOptions& options, Monitor& monitor,
                               const PowerDiagram* diagram) {
  if (cover.balls != static_cast<std::int64_t>(balls.size())) {
    throw InputError("the cover is about " + std::to_string(cover.balls) + " balls, but there are " +
                         std::to_string(balls.size()),
                     "connect the balls that the covering matrix returned with the cover");
  }
  if (cover.remaining() != 0) {
    throw InputError(std::to_string(cover.remaining()) + " samples are not covered yet",
                     "repair after a pruning strategy that covers all samples");
  }
  Ids kept(cover.chosen.begin(), cover.chosen.end());
  std::sort(kept.begin(), kept.end());
  TopologyRepair repair = repair_topology(balls, kept, options, monitor, diagram);
  if (!repair.check.inclusion_after().isomorphism()) {
    monitor.warn("the pruned balls do NOT have the topology of all: " + describe(repair.check) +
                 "; sample more finely (delta) or grow less (epsilon), or raise most_defects and wait");
  } else if (!repair.check.inclusion_before().isomorphism()) {
    monitor.warn(describe(repair.check));
  }
  return repair;
}

CoverState with_returned(const CoverState& cover, std::span<const std::int32_t> returned) {
  CoverState result = cover;
  std::vector<std::int32_t> chosen(cover.chosen.begin(), cover.chosen.end());
  std::vector<std::uint8_t> how(cover.chosen_how.begin(), cover.chosen_how.end());
  chosen.insert(chosen.end(), returned.begin(), returned.end());
  how.resize(chosen.size(), static_cast<std::uint8_t>(Choice::returned));
  result.chosen = std::move(chosen);
  result.chosen_how = std::move(how);
  return result;
}

}  // namespace ballflow::geometry
