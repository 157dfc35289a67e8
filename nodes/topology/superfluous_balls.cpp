#include "topology/superfluous_balls.hpp"

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "base/for_each_block.hpp"
#include "homology/inclusion_homology.hpp"
#include "power/union_betti.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Tests groups that do not meet each other at once, on all cores: what one of them needs is not another
/// one's.
class Thinning {
 public:
  Thinning(const Balls& balls, std::span<const std::int32_t> kept, std::span<const std::int32_t> returned,
           Monitor& monitor)
      : balls_(balls), kept_(kept.size()), ids_(kept.begin(), kept.end()), monitor_(monitor) {
    ids_.insert(ids_.end(), returned.begin(), returned.end());
    there_.assign(ids_.size(), 1);
    claimed_.assign(ids_.size(), 0);
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (const std::int32_t id : ids_) {
      centers.push_back(balls.centers[at(id)]);
      radii.push_back(balls.radii[at(id)]);
    }
    tree_ = BoxTree(centers);
    tree_.set_slacks(radii);
  }

  std::vector<std::int32_t> run() {
    take_out_groups();
    take_out_singles();
    std::vector<std::int32_t> result;
    for (const std::size_t k : left()) result.push_back(ids_[k]);
    return result;
  }

 private:
  using Places = std::vector<std::size_t>;  // in ids_

  struct Group {
    Places places;
    std::size_t node = 0;  // of the tree that it is from
    Places around{};
    bool superfluous = false;
  };

  Vec3 center(std::size_t k) const { return balls_.centers[at(ids_[k])]; }
  double radius(std::size_t k) const { return balls_.radii[at(ids_[k])]; }

  Places left() const {
    Places places;
    for (std::size_t k = kept_; k < ids_.size(); ++k) {
      if (there_[k] == 1) places.push_back(k);
    }
    return places;
  }
  void tell() {
    monitor_.note(std::to_string(left().size()) + " of " + std::to_string(ids_.size() - kept_) +
                  " balls returned are left");
  }

  /// Neighbours together, which are many at first: groups of 64, else their halves.
  void take_out_groups() {
    constexpr std::int32_t largest = 64;
    std::vector<Vec3> centers;
    for (std::size_t k = kept_; k < ids_.size(); ++k) centers.push_back(center(k));
    const BoxTree tree(centers);
    const auto group_of = [&](std::size_t node) {
      Group group{{}, node};
      for (std::int32_t i = tree.nodes()[node].first; i < tree.nodes()[node].last; ++i) {
        group.places.push_back(kept_ + at(tree.order()[at(i)]));
      }
      return group;
    };
    std::vector<Group> waiting;
    for (std::size_t node = 0; node < tree.nodes().size();) {
      const auto [box, first, last, second] = tree.nodes()[node++];
      if (last - first > largest) continue;
      waiting.push_back(group_of(node - 1));
      while (node < tree.nodes().size() && tree.nodes()[node].first < last) ++node;  // what is below it
    }
    while (!waiting.empty()) {
      std::vector<Group> halves;
      for (const Group& group : test_some(waiting)) {
        const std::int32_t second = tree.nodes()[group.node].second;
        if (group.superfluous || second == 0) continue;
        halves.push_back(group_of(group.node + 1));
        halves.push_back(group_of(at(second)));
      }
      waiting.insert(waiting.end(), halves.begin(), halves.end());
      tell();
    }
  }

  void take_out_singles() {
    Places order = left();
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return std::tuple(radius(a), center(a), ids_[a]) < std::tuple(radius(b), center(b), ids_[b]);
    });
    // Whether a ball is needed changes only where one that it meets goes.
    std::vector<std::uint8_t> look(ids_.size(), 1);
    for (;;) {
      std::vector<Group> waiting;
      for (const std::size_t k : order) {
        if (there_[k] == 1 && look[k] == 1) waiting.push_back({{k}});
        look[k] = 0;
      }
      if (waiting.empty()) return;
      while (!waiting.empty()) {
        for (const Group& group : test_some(waiting)) {
          if (!group.superfluous) continue;
          for (const std::size_t j : group.around) look[j] = 1;
        }
      }
      tell();
    }
  }

  /// Takes groups from the front that do not meet each other, and takes those out of the union that are
  /// superfluous.
  std::vector<Group> test_some(std::vector<Group>& waiting) {
    constexpr std::size_t most = 64, farthest = 256;
    std::vector<Group> some, others;
    ++claim_;
    for (Group& group : waiting) {
      const bool looked_at = some.size() < most && some.size() + others.size() < farthest;
      const bool meets = looked_at && std::any_of(group.places.begin(), group.places.end(),
                                                  [&](std::size_t k) { return claimed_[k] == claim_; });
      if (!looked_at || meets) {
        others.push_back(std::move(group));
        continue;
      }
      group.around = neighbors(group.places);
      for (const std::size_t k : group.around) claimed_[k] = claim_;
      some.push_back(std::move(group));
    }
    waiting = std::move(others);
    for_each_block(some.size(), 1, monitor_, 0, 0, [&](std::size_t, std::size_t first, std::size_t) {
      some[first].superfluous = superfluous(some[first]);
    });
    for (const Group& group : some) {
      if (!group.superfluous) continue;
      for (const std::size_t k : group.places) there_[k] = 0;
    }
    return some;
  }

  /// All other balls that are there and meet one of these, ascending, and perhaps some that do not.
  Places neighbors(const Places& group) const {
    Places around;
    for (const std::size_t k : group) {
      tree_.below(center(k), radius(k) * (1 + 1e-9), [&](std::size_t j) {
        if (there_[j] == 1 && distance(center(j), center(k)) <= (radius(j) + radius(k)) * (1 + 1e-9))
          around.push_back(j);
      });
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    std::erase_if(around,
                  [&](std::size_t j) { return std::find(group.begin(), group.end(), j) != group.end(); });
    return around;
  }

  /// The union of the balls around has the homology of that with the group.
  bool superfluous(const Group& group) const {
    if (group.around.empty()) return false;
    std::vector<std::int32_t> ids, others;
    for (const std::size_t j : group.around) {
      others.push_back(static_cast<std::int32_t>(ids.size()));
      ids.push_back(ids_[j]);
    }
    for (const std::size_t k : group.places) ids.push_back(ids_[k]);
    PartMonitor still(monitor_, 0, 0);
    const Balls with = select(balls_, ids);
    const Betti betti = union_betti(with, AlphaTolerance::none, still);
    if (union_betti(select(with, others), AlphaTolerance::none, still) != betti) return false;
    return betti == of_a_ball || UnionOfBalls(with, still).isomorphic_to(others);
  }

  const Balls& balls_;
  std::size_t kept_;
  std::vector<std::int32_t> ids_;    // of the balls, those kept first
  std::vector<std::uint8_t> there_;  // per place in ids_
  std::vector<std::uint64_t> claimed_;
  std::uint64_t claim_ = 0;
  BoxTree tree_;
  Monitor& monitor_;
};

}  // namespace

std::vector<std::int32_t> without_superfluous(const Balls& balls, std::span<const std::int32_t> kept,
                                              std::span<const std::int32_t> returned, Monitor& monitor) {
  return Thinning(balls, kept, returned, monitor).run();
}

}  // namespace ballflow::geometry
