#include "motion/near_pairs.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <limits>

#include "base/for_each_block.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

using Node = BallBoxes::Node;
using Ball = BallBoxes::Ball;

constexpr double infinity = std::numeric_limits<double>::infinity();

NearPair pair_of(const Ball& a, const Ball& b) {
  return {{a.center, b.center, a.radius, b.radius}, a.index, b.index};
}

double gap(const Box& a, const Box& b) {
  const auto along = [](double low_a, double high_a, double low_b, double high_b) {
    return std::max(std::max(low_a - high_b, low_b - high_a), 0.0);
  };
  return length({along(a.lower.x, a.upper.x, b.lower.x, b.upper.x),
                 along(a.lower.y, a.upper.y, b.lower.y, b.upper.y),
                 along(a.lower.z, a.upper.z, b.lower.z, b.upper.z)});
}

/// No ball of one node is nearer to one of the other, whatever was rounded.
double least_separation(const Node& a, const Node& b) {
  const RoughSeparation rough = rough_separation(gap(a.box, b.box), a.largest, b.largest);
  return rough.value - rough.error;
}

/// Balls whose centers are farther apart than this are not as near as `separation`, whatever was rounded;
/// also where it is negative. Finite.
double reach_for(double separation, double radii) {
  return separation + radii + 0x1p-40 * (std::abs(separation) + radii) + 1e-150;
}
bool beyond(double squared, double reach) { return reach < 0 || squared > reach * reach; }

double most_of(const BallPair& pair) {
  const RoughSeparation rough = rough_separation(pair);
  return rough.value + rough.error;
}

void lower(std::atomic<double>& bound, double value) {
  double known = bound.load(std::memory_order_relaxed);
  while (value < known && !bound.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
  }
}

struct NodePair {
  double least;  // least_separation
  std::int32_t a, b;
};
/// A heap with the nearest on top; ties in an order that sees low indices early.
bool comes_later(const NodePair& p, const NodePair& q) {
  if (p.least != q.least) return p.least > q.least;
  return p.a != q.a ? p.a > q.a : p.b > q.b;
}

/// What all threads know of each other's finds: nothing above has to be looked at. What is found in the end
/// does not depend on who found what first: it is the first pairs in a strict order, decided exactly.
struct Bounds {
  std::atomic<double> nearest{infinity};  // some pair has at most this separation
  std::atomic<double> listed{-infinity};  // as many pairs as are wanted have, or it is above the threshold
};

class Found {
 public:
  Found(const BallBoxes& a, const BallBoxes& b, double threshold, std::size_t most, Bounds& bounds)
      : a_(a), b_(b), threshold_(threshold), most_(most), bounds_(bounds) {}

  void offer(const Ball& x, const Ball& y, bool to_list) {
    const RoughSeparation rough = rough_separation(distance(x.center, y.center), x.radius, y.radius);
    const double least = rough.value - rough.error;
    const bool may_be_nearest = least <= bounds_.nearest.load(std::memory_order_relaxed);
    const bool may_be_listed = to_list && least <= bounds_.listed.load(std::memory_order_relaxed);
    if (!may_be_nearest && !may_be_listed) return;
    const NearPair pair = pair_of(x, y);
    if (may_be_nearest && (none_ || comes_before(pair, nearest_))) {
      none_ = false;
      nearest_ = pair;
      lower(bounds_.nearest, rough.value + rough.error);
    }
    if (!may_be_listed || compare_separation(pair.balls, threshold_) > 0) return;
    if (below_.size() == most_) {
      if (!comes_before(pair, below_.front())) return;
      std::pop_heap(below_.begin(), below_.end(), comes_before);
      below_.back() = pair;
    } else {
      below_.push_back(pair);
    }
    std::push_heap(below_.begin(), below_.end(), comes_before);
    if (below_.size() == most_) lower(bounds_.listed, most_of(below_.front().balls));
  }

  /// Everything below two nodes, or what one step shows: pairs of children are handed to `push`.
  template <class Push>
  void visit(const NodePair& at, const Push& push) {
    const Node &x = a_.node(at.a), &y = b_.node(at.b);
    if (!may_matter(at.least)) return;
    const bool listed = at.least <= bounds_.listed.load(std::memory_order_relaxed);
    if (x.concentric() && y.concentric()) {
      if (!listed) {
        offer(a_.ball(x.prime), b_.ball(y.prime), false);
        return;
      }
      if (x.smallest == x.largest && y.smallest == y.largest && all_come_after(x, y)) return;
    }
    if (x.leaf() && y.leaf()) {
      look_at_leaves(x, y, listed);
      return;
    }
    const auto push_pair = [&](std::int32_t i, std::int32_t j) {
      const double least = least_separation(a_.node(i), b_.node(j));
      if (may_matter(least)) push(NodePair{least, i, j});
    };
    if (y.leaf() || (!x.leaf() && x.size() >= y.size())) {
      push_pair(at.a + 1, at.b);
      push_pair(x.second, at.b);
    } else {
      push_pair(at.a, at.b + 1);
      push_pair(at.a, y.second);
    }
  }

  bool may_matter(double least) const {
    return least <= bounds_.nearest.load(std::memory_order_relaxed) ||
           least <= bounds_.listed.load(std::memory_order_relaxed);
  }

  void into(NearPairs& all, bool& none) const {
    if (!none_ && (none || comes_before(nearest_, all.nearest))) {
      none = false;
      all.nearest = nearest_;
    }
    all.below.insert(all.below.end(), below_.begin(), below_.end());
  }

 private:
  void look_at_leaves(const Node& x, const Node& y, bool listed) {
    for (const Ball& p : a_.balls_of(x)) {
      double wanted = bounds_.nearest.load(std::memory_order_relaxed);
      if (listed) wanted = std::max(wanted, bounds_.listed.load(std::memory_order_relaxed));
      const double away = distance_to_box(y.box, p.center);
      if (beyond(away * away, reach_for(wanted, p.radius + y.largest))) continue;
      for (const Ball& q : b_.balls_of(y)) {
        if (!beyond(squared_distance(p.center, q.center), reach_for(wanted, p.radius + q.radius)))
          offer(p, q, listed);
      }
    }
  }

  /// Equal balls against equal balls: a table of ties, of which only the first can be of use.
  bool all_come_after(const Node& x, const Node& y) const {
    if (below_.size() < most_) return false;
    NearPair first = pair_of(a_.ball(x.prime), b_.ball(y.prime));
    first.a = x.lowest;
    first.b = y.lowest;
    return !comes_before(first, below_.front());
  }

  const BallBoxes &a_, &b_;
  double threshold_;
  std::size_t most_;
  Bounds& bounds_;
  bool none_ = true;
  NearPair nearest_;
  std::vector<NearPair> below_;  // a heap, the last on top
};

}  // namespace

bool comes_before(const NearPair& p, const NearPair& q) {
  const int sign = compare_separations(p.balls, q.balls);
  if (sign != 0) return sign < 0;
  return p.a != q.a ? p.a < q.a : p.b < q.b;
}

NearPairs near_pairs(const BallBoxes& a, const BallBoxes& b, double threshold, std::size_t most,
                     Monitor& monitor) {
  Bounds bounds;
  if (most > 0) bounds.listed = threshold + 0x1p-50 * std::abs(threshold) + 1e-160;

  // A first look at what is nearest, so that all threads begin with a good bound: straight down, no further.
  {
    NodePair at{least_separation(a.node(0), b.node(0)), 0, 0};
    while (!a.node(at.a).leaf() || !b.node(at.b).leaf()) {
      const Node &x = a.node(at.a), &y = b.node(at.b);
      const bool split_a = y.leaf() || (!x.leaf() && x.size() >= y.size());
      const NodePair one{0, split_a ? at.a + 1 : at.a, split_a ? at.b : at.b + 1};
      const NodePair two{0, split_a ? x.second : at.a, split_a ? at.b : y.second};
      const auto least = [&](const NodePair& p) { return least_separation(a.node(p.a), b.node(p.b)); };
      at = least(two) < least(one) ? two : one;
    }
    for (const Ball& p : a.balls_of(a.node(at.a))) {
      for (const Ball& q : b.balls_of(b.node(at.b))) lower(bounds.nearest, most_of(pair_of(p, q).balls));
    }
  }

  // Parts of the work: pairs of nodes, as many whatever the number of threads, nearest ones first.
  constexpr std::size_t parts = 512;
  std::vector<NodePair> open{{least_separation(a.node(0), b.node(0)), 0, 0}};
  Found early(a, b, threshold, most, bounds);
  for (std::size_t begin = 0; begin < open.size() && open.size() - begin < parts; ++begin) {
    const NodePair at = open[begin];
    early.visit(at, [&](const NodePair& next) { open.push_back(next); });
    open[begin].a = -1;
  }
  std::erase_if(open, [](const NodePair& p) { return p.a < 0; });
  std::sort(open.begin(), open.end(), [](const NodePair& p, const NodePair& q) { return comes_later(q, p); });

  tbb::enumerable_thread_specific<Found> found([&] { return Found(a, b, threshold, most, bounds); });
  std::atomic<std::size_t> next{0}, done{0};
  tbb::parallel_for(std::size_t{0}, open.size(), [&](std::size_t) {
    const NodePair& root = open[next++];  // in order, whichever thread asks
    Found& mine = found.local();
    Lookout look(monitor);
    std::vector<NodePair> heap{root};
    while (!heap.empty()) {
      std::pop_heap(heap.begin(), heap.end(), comes_later);
      const NodePair at = heap.back();
      heap.pop_back();
      if (!mine.may_matter(at.least)) break;  // and so do all others
      look(64);
      mine.visit(at, [&](const NodePair& pair) {
        heap.push_back(pair);
        std::push_heap(heap.begin(), heap.end(), comes_later);
      });
    }
    monitor.step(static_cast<double>(++done) / static_cast<double>(open.size()));
  });

  NearPairs all;
  bool none = true;
  early.into(all, none);
  for (const Found& part : found) part.into(all, none);
  std::sort(all.below.begin(), all.below.end(), comes_before);
  if (all.below.size() > most) all.below.resize(most);
  return all;
}

std::vector<NearPair> nearest_of_every(const BallBoxes& a, const BallBoxes& b, Monitor& monitor) {
  std::vector<NearPair> nearest(a.balls().size());
  for_each_block(nearest.size(), 4096, monitor, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
    Lookout look(monitor);
    std::vector<std::pair<double, std::int32_t>> stack;
    const auto least = [&](std::int32_t i, const Ball& p) {
      const Node& node = b.node(i);
      const RoughSeparation rough =
          rough_separation(distance_to_box(node.box, p.center), p.radius, node.largest);
      return rough.value - rough.error;
    };
    std::int32_t start = b.node(0).prime;
    for (std::size_t place = first; place < last; ++place) {
      const Ball& p = a.balls()[place];
      // The one that is nearest to the ball before is probably near.
      NearPair best = pair_of(p, b.ball(start));
      double bound = most_of(best.balls);
      const auto offer = [&](std::int32_t at) {
        const Ball& q = b.ball(at);
        if (beyond(squared_distance(p.center, q.center), reach_for(bound, p.radius + q.radius))) return;
        const RoughSeparation rough = rough_separation(distance(p.center, q.center), p.radius, q.radius);
        if (rough.value - rough.error > bound || q.index == best.b) return;
        const NearPair pair = pair_of(p, q);
        if (!comes_before(pair, best)) return;
        best = pair;
        bound = rough.value + rough.error;
        start = at;
      };
      stack.assign(1, {least(0, p), 0});
      while (!stack.empty()) {
        const auto [at_least, i] = stack.back();
        stack.pop_back();
        if (at_least > bound) continue;
        look(16);
        const Node& node = b.node(i);
        if (node.concentric()) {
          offer(node.prime);
        } else if (node.leaf()) {
          for (std::int32_t at = node.first; at < node.last; ++at) offer(at);
        } else {
          std::pair<double, std::int32_t> near{least(i + 1, p), i + 1},
              far{least(node.second, p), node.second};
          if (far.first < near.first) std::swap(near, far);
          stack.push_back(far);
          stack.push_back(near);
        }
      }
      nearest[static_cast<std::size_t>(p.index)] = best;
    }
  });
  return nearest;
}

}  // namespace ballflow::geometry
