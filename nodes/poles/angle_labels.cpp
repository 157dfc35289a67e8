#include "poles/angle_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <queue>
#include <span>
#include <string>
#include <utility>

namespace ballflow::geometry {
namespace {

constexpr auto unlabelled = static_cast<std::uint8_t>(PoleLabel::unlabelled);
constexpr auto inner = static_cast<std::uint8_t>(PoleLabel::inner);
constexpr auto outer = static_cast<std::uint8_t>(PoleLabel::outer);

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A list of numbers for each of something.
struct Lists {
  std::vector<std::size_t> begin;  // one more than entries
  std::vector<std::int32_t> items;
  std::span<const std::int32_t> of(std::size_t i) const {
    return {items.data() + begin[i], items.data() + begin[i + 1]};
  }
};

class Spreading {
 public:
  Spreading(const PoleSet& poles, Monitor& monitor)
      : poles_(poles), monitor_(monitor), evidence_(poles.size()) {
    find_entries();
    monitor_.step(0.1);
    rank_entries();
    monitor_.step(0.2);
  }

  AngleLabels run() {
    AngleLabels result{std::vector<std::uint8_t>(poles_.size(), unlabelled), {}};
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
    const double c = (a * a + b * b - squared_distance(poles_.centers[p], poles_.centers[q])) / (2 * a * b);
    return std::clamp(c, -1.0, 1.0);
  }

  std::span<const std::int32_t> samples_of(std::size_t p) const {
    const auto first = static_cast<std::size_t>(poles_.defining_offsets[p]);
    const auto last = static_cast<std::size_t>(poles_.defining_offsets[p + 1]);
    return poles_.defining_samples.span().subspan(first, last - first);
  }

  /// Calls visit(entry, whether the label is the same, certainty) for all evidence that p gives; for an entry
  /// that shares several samples with p more than once.
  template <class Visit>
  void for_neighbours(std::size_t p, Visit visit) const {
    for (const std::int32_t s : samples_of(p)) {
      look_(entries_.of(at(s)).size());  // an outlier inside a shape is a site of very many entries
      for (const std::int32_t q : entries_.of(at(s))) {
        if (at(q) == p) continue;
        const double d = cosine(p, at(q));
        if (d > 0) visit(at(q), true, d);
        if (d < 0) visit(at(q), false, -d);
      }
    }
  }

  std::vector<std::uint8_t> uncertain(const std::vector<std::uint8_t>& labels) const {
    std::vector<std::uint8_t> result(labels.size(), 0);
    for (std::size_t p = 0; p < labels.size(); ++p) {
      if (p % 4096 == 0) monitor_.step(0.95);
      double with = 0, against = 0;
      for_neighbours(p, [&](std::size_t q, bool same, double certainty) {
        if (labels[q] == unlabelled) return;
        double& side = (labels[p] == labels[q]) == same ? with : against;
        side = std::max(side, certainty);
      });
      result[p] = against >= with / 2 && against > 0 ? 1 : 0;
    }
    return result;
  }

  /// The entries whose spheres pass through a sample.
  void find_entries() {
    std::vector<std::size_t>& begin = entries_.begin;
    begin.assign(poles_.sample_poles.size() + 1, 0);
    for (const std::int32_t s : poles_.defining_samples) ++begin[at(s) + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    entries_.items.resize(begin.back());
    std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
    for (std::size_t p = 0; p < poles_.size(); ++p) {
      for (const std::int32_t s : samples_of(p)) entries_.items[end[at(s)]++] = static_cast<std::int32_t>(p);
    }
  }

  /// An order that does not depend on the numbering.
  void rank_entries() {
    std::vector<std::int32_t> order(poles_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
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
  mutable Lookout look_{monitor_};
  Lists entries_;  // of each sample
  std::vector<std::int32_t> ranks_;
  std::vector<Evidence> evidence_;
  std::priority_queue<Next> queue_;
};

}  // namespace

AngleLabels angle_labels(const PoleSet& poles, Monitor& monitor) { return Spreading(poles, monitor).run(); }

}  // namespace ballflow::geometry
