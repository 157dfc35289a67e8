#include "poles/angle_labels.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <queue>
#include <span>
#include <string>
#include <utility>

#include "base/lists.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr auto unlabelled = static_cast<std::uint8_t>(PoleLabel::unlabelled);
constexpr auto inner = static_cast<std::uint8_t>(PoleLabel::inner);
constexpr auto outer = static_cast<std::uint8_t>(PoleLabel::outer);

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A sample with more entries than that is crowded: an outlier inside a shape is a site of as many Voronoi
// vertices as the shape has samples. Up to it all pairs of the entries at a sample are looked at, which is
// what every sample of an ordinary model needs; at crowded ones so many of the strongest pairs of every
// entry, of either kind.
constexpr std::size_t crowd = 64, strongest = 8;

/// The entries at a crowded sample as points of the unit sphere, each in the direction in which its centre is
/// seen from the sample, or in the opposite one: the scalar product of two is the certainty of the pair.
class Directions {
 public:
  Directions(std::vector<Vec3> points, Monitor& monitor)
      : points_(std::move(points)), tree_(points_, BoxTree::default_leaf_size, monitor) {}

  /// The nearest to `p` of all points but number `self`, as many as `found` has room for, the nearest first.
  /// Returns their number.
  std::size_t nearest(Vec3 p, std::size_t self, std::span<std::size_t> found) const {
    std::array<double, strongest> distances{};
    std::size_t size = 0;
    tree_.smallest(p, std::numeric_limits<double>::infinity(), 0, [&](std::size_t i) {
      // To the tree the value of every point is the distance of the last one found so far.
      const bool full = size == found.size();
      const double d = distance(p, points_[i]);
      if (i != self && (!full || d < distances[size - 1])) {
        std::size_t k = full ? size - 1 : size++;
        for (; k > 0 && d < distances[k - 1]; --k) {
          distances[k] = distances[k - 1];
          found[k] = found[k - 1];
        }
        distances[k] = d;
        found[k] = i;
      }
      return size == found.size() ? distances[size - 1] : std::numeric_limits<double>::infinity();
    });
    return size;
  }

 private:
  std::vector<Vec3> points_;
  BoxTree tree_;
};

class Spreading {
 public:
  Spreading(const PoleSet& poles, Monitor& monitor)
      : poles_(poles), monitor_(monitor), evidence_(poles.size()) {
    entries_ = lists_of<std::int32_t>(poles_.sample_poles.size(), [&](auto&& put) {
      for (std::size_t p = 0; p < poles_.size(); ++p) {
        for (const std::int32_t s : samples_of(p)) put(at(s), static_cast<std::int32_t>(p));
      }
    });
    monitor_.step(0.1);
    rank_entries();
    monitor_.step(0.15);
    pair_at_crowded_samples();
    monitor_.step(0.2);
  }

  AngleLabels run() {
    AngleLabels result{std::vector<std::uint8_t>(poles_.size(), unlabelled), {}, 0};
    std::size_t seeds = 0;
    for (std::size_t i = 0; i < poles_.size(); ++i) {
      if (poles_.unbounded[i] == 0) continue;
      ++seeds;
      evidence_[i].outer = 1;
      push(i);
    }
    if (seeds == 0) {
      throw InputError("no pole is unbounded, so nothing says where the outside is",
                       "compute the poles of all samples with VoronoiPoles");
    }
    std::size_t done = 0;
    while (!queue_.empty()) {
      const Next next = queue_.top();
      queue_.pop();
      const std::size_t p = at(next.entry);
      if (result.labels[p] != unlabelled || next.priority != evidence_[p].priority()) continue;
      if (++done % 4096 == 0)
        monitor_.step(0.8 + 0.15 * static_cast<double>(done) / static_cast<double>(poles_.size()));
      result.labels[p] = evidence_[p].inner > evidence_[p].outer ? inner : outer;
      for_neighbours(p, [&](std::size_t q, bool same, double certainty) {
        if (result.labels[q] != unlabelled) return;
        const bool to_inner = (result.labels[p] == inner) == same;
        double& known = to_inner ? evidence_[q].inner : evidence_[q].outer;
        if (certainty <= known) return;
        known = certainty;
        push(q);
      });
    }
    result.uncertain = uncertain(result.labels);
    result.pairs = pairs_;
    return result;
  }

 private:
  struct Evidence {
    double inner = 0, outer = 0;
    double priority() const {
      return inner > 0 && outer > 0 ? std::abs(inner - outer) - 1 : std::max(inner, outer);
    }
  };
  struct Next {
    double priority;
    std::int32_t rank, entry;
    friend bool operator<(const Next& a, const Next& b) {
      return a.priority != b.priority ? a.priority < b.priority : a.rank > b.rank;
    }
  };

  void push(std::size_t i) {
    queue_.push({evidence_[i].priority(), ranks_[i], static_cast<std::int32_t>(i)});
  }

  /// The cosine of the angle p s q where s is on both spheres. Rounding must not make anything more certain
  /// than the seeds, whose certainty is 1.
  double cosine(std::size_t p, std::size_t q) const {
    const double a = poles_.radii[p], b = poles_.radii[q];
    if (!(a > 0 && b > 0)) return 0;  // a sphere without a radius says nothing
    const double c = (a * a + b * b - squared_distance(poles_.centers[p], poles_.centers[q])) / (2 * a * b);
    return std::clamp(c, -1.0, 1.0);
  }

  std::span<const std::int32_t> samples_of(std::size_t p) const {
    const auto first = static_cast<std::size_t>(poles_.defining_offsets[p]);
    const auto last = static_cast<std::size_t>(poles_.defining_offsets[p + 1]);
    return poles_.defining_samples.span().subspan(first, last - first);
  }

  std::span<const std::int32_t> entries_at(std::size_t s) const { return entries_[s]; }
  bool crowded(std::size_t s) const { return entries_at(s).size() > crowd; }

  /// Calls visit(entry, whether the label is the same, certainty) for what p says about the entries in
  /// `list`.
  template <class Visit>
  void look_at(std::size_t p, std::span<const std::int32_t> list, const Visit& visit) {
    look_(list.size());
    pairs_ += static_cast<std::int64_t>(list.size());
    weigh_all(p, list, visit);
  }
  /// The same from any thread, and without counting.
  template <class Visit>
  void weigh_all(std::size_t p, std::span<const std::int32_t> list, const Visit& visit) const {
    for (const std::int32_t q : list) {
      if (at(q) == p) continue;
      const double d = cosine(p, at(q));
      if (d > 0) visit(at(q), true, d);
      if (d < 0) visit(at(q), false, -d);
    }
  }
  /// All evidence that p gives at samples that are not crowded, for an entry that shares several samples with
  /// p more than once, and the strongest at crowded samples.
  template <class Visit>
  void for_neighbours(std::size_t p, const Visit& visit) {
    for (const std::int32_t s : samples_of(p)) {
      if (!crowded(at(s))) look_at(p, entries_at(at(s)), visit);
    }
    look_at(p, std::as_const(strong_pairs_)[p], visit);
  }

  /// The directions from a sample to the centres of `entries`, whose spheres pass through it, as unit vectors
  /// in some orthogonal frame: their scalar products are cosines, so three of the entries span a frame for
  /// all.
  std::vector<Vec3> directions(std::span<const std::int32_t> entries) const {
    constexpr double flat = 1e-6;  // what is nearer to a line or a plane than that is in it
    std::vector<Vec3> result(entries.size());
    const auto cosines_of = [&](std::size_t pivot, double Vec3::*to) {
      for (std::size_t i = 0; i < entries.size(); ++i)
        result[i].*to = cosine(at(entries[i]), at(entries[pivot]));
    };
    const auto pivot = [&](const auto& key) {
      std::size_t best = 0;
      double greatest = -1;
      for (std::size_t i = 0; i < entries.size(); ++i) {
        if (const double k = key(result[i]); poles_.radii[at(entries[i])] > 0 && k > greatest) {
          greatest = k;
          best = i;
        }
      }
      return best;
    };
    const auto near = std::find_if(entries.rbegin(), entries.rend(),
                                   [this](std::int32_t p) { return poles_.radii[at(p)] > 0; });
    if (near == entries.rend()) return result;
    cosines_of(static_cast<std::size_t>(entries.rend() - near) - 1, &Vec3::x);
    const std::size_t b = pivot([](const Vec3& u) { return 1 - u.x * u.x; });
    cosines_of(b, &Vec3::y);
    const double bx = result[b].x, by = std::sqrt(std::max(0.0, 1 - bx * bx));
    for (Vec3& u : result) u.y = by > flat ? (u.y - u.x * bx) / by : 0;
    const std::size_t c = pivot([](const Vec3& u) { return 1 - u.x * u.x - u.y * u.y; });
    cosines_of(c, &Vec3::z);
    const double cx = result[c].x, cy = result[c].y, cz = std::sqrt(std::max(0.0, 1 - cx * cx - cy * cy));
    for (Vec3& u : result) u.z = cz > flat ? (u.z - u.x * cx - u.y * cy) / cz : 0;
    return result;
  }

  void pair_at_crowded_samples() {
    std::vector<std::array<std::int32_t, 2>> pairs;
    for (std::size_t s = 0; s < entries_.size(); ++s) {
      if (!crowded(s)) continue;
      const std::span<std::int32_t> entries = entries_[s];
      std::sort(entries.begin(), entries.end(),
                [this](std::int32_t a, std::int32_t b) { return ranks_[at(a)] < ranks_[at(b)]; });
      const std::vector<Vec3> to = directions(entries);
      const Directions all(to, monitor_);
      const std::size_t before = pairs.size();
      pairs.resize(before + 2 * strongest * entries.size(), {-1, -1});
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, entries.size(), 512), [&](const auto& range) {
        if (monitor_.cancelled()) throw Cancelled();
        for (std::size_t i = range.begin(); i != range.end(); ++i) {
          auto* pair = &pairs[before + 2 * strongest * i];
          for (const Vec3 side : {to[i], -to[i]}) {
            std::array<std::size_t, strongest> found{};
            const std::size_t size = all.nearest(side, i, found);
            for (std::size_t k = 0; k < size; ++k) {
              const auto [low, high] = std::minmax(entries[i], entries[found[k]]);
              *pair++ = {low, high};
            }
          }
        }
      });
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    strong_pairs_ = lists_of<std::int32_t>(poles_.size(), [&](auto&& put) {
      for (const auto& [p, q] : pairs) {
        if (p < 0) continue;
        put(at(p), q);
        put(at(q), p);
      }
    });
  }

  /// What the evidence against every label is, and what that for it.
  std::vector<std::uint8_t> uncertain(const std::vector<std::uint8_t>& labels) {
    std::vector<double> with(labels.size(), 0), against(labels.size(), 0);
    const auto weigh = [&](std::size_t p) {
      return [&, p](std::size_t q, bool same, double certainty) {
        if (labels[q] == unlabelled) return;
        double& side = (labels[p] == labels[q]) == same ? with[p] : against[p];
        side = std::max(side, certainty);
      };
    };
    monitor_.step(0.95);
    std::atomic<std::int64_t> looked_at = 0;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, labels.size(), 4096), [&](const auto& range) {
      if (monitor_.cancelled()) throw Cancelled();
      std::int64_t pairs = 0;
      for (std::size_t p = range.begin(); p != range.end(); ++p) {
        for (const std::int32_t s : samples_of(p)) {
          if (crowded(at(s))) continue;
          pairs += static_cast<std::int64_t>(entries_at(at(s)).size());
          weigh_all(p, entries_at(at(s)), weigh(p));
        }
      }
      looked_at.fetch_add(pairs, std::memory_order_relaxed);
    });
    pairs_ += looked_at;
    for (std::size_t s = 0; s < entries_.size(); ++s) {
      if (!crowded(s)) continue;
      // With the directions of outer entries turned around, what is near speaks for a label, what is opposite
      // against it, so that the strongest of either kind is found among all.
      std::vector<std::int32_t> labelled;
      for (const std::int32_t p : entries_at(s)) {
        if (labels[at(p)] != unlabelled) labelled.push_back(p);
      }
      if (labelled.size() < 2) continue;
      std::vector<Vec3> to = directions(labelled);
      for (std::size_t i = 0; i < to.size(); ++i) {
        if (labels[at(labelled[i])] == outer) to[i] = -to[i];
      }
      const Directions all(to, monitor_);
      for (std::size_t i = 0; i < to.size(); ++i) {
        for (const Vec3 side : {to[i], -to[i]}) {
          std::size_t found = 0;
          all.nearest(side, i, {&found, 1});
          look_at(at(labelled[i]), {&labelled[found], 1}, weigh(at(labelled[i])));
        }
      }
    }
    std::vector<std::uint8_t> result(labels.size());
    for (std::size_t p = 0; p < labels.size(); ++p)
      result[p] = against[p] >= with[p] / 2 && against[p] > 0 ? 1 : 0;
    return result;
  }

  /// An order that does not depend on the numbering.
  void rank_entries() {
    std::vector<std::int32_t> order(poles_.size());
    std::iota(order.begin(), order.end(), 0);
    tbb::parallel_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
      if (poles_.radii[at(a)] != poles_.radii[at(b)]) return poles_.radii[at(a)] > poles_.radii[at(b)];
      if (poles_.centers[at(a)] != poles_.centers[at(b)])
        return poles_.centers[at(a)] < poles_.centers[at(b)];
      return a < b;
    });
    ranks_.resize(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) ranks_[at(order[i])] = static_cast<std::int32_t>(i);
  }

  const PoleSet& poles_;
  Monitor& monitor_;
  Lookout look_{monitor_};
  Lists<std::int32_t> entries_;       // of each sample: those whose spheres pass through it
  Lists<std::int32_t> strong_pairs_;  // of each entry: others at a crowded sample
  std::int64_t pairs_ = 0;
  std::vector<std::int32_t> ranks_;
  std::vector<Evidence> evidence_;
  std::priority_queue<Next> queue_;
};

}  // namespace

AngleLabels angle_labels(const PoleSet& poles, Monitor& monitor) { return Spreading(poles, monitor).run(); }

}  // namespace ballflow::geometry
