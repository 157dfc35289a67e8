#include "cover/dominated_sets.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "base/lists.hpp"

namespace ballflow::geometry {
namespace {

using Flags = std::vector<std::uint8_t>;

constexpr std::size_t block = 128;  // sets handled in one task

/// What two sets must satisfy before one can contain the other, cheaper to compare than the sets.
struct Outline {
  std::uint64_t signature;  // the union of one bit for each element
  std::int32_t first, last, degree;

  bool may_contain(const Outline& inner) const {
    return inner.degree <= degree && first <= inner.first && inner.last <= last &&
           (inner.signature & ~signature) == 0;
  }
};

bool contains(std::span<const std::int32_t> outer, std::span<const std::int32_t> inner) {
  auto at = outer.begin();
  for (const std::int32_t e : inner) {
    while (at != outer.end() && *at < e) ++at;
    if (at == outer.end() || *at != e) return false;
    ++at;
  }
  return true;
}

std::uint64_t hashed_bit(std::int32_t element) {
  // The top bits of a multiplication by 2^64 / golden ratio spread neighbours over all bits.
  return std::uint64_t{1} << (static_cast<std::uint64_t>(element) * 0x9e3779b97f4a7c15u >> 58);
}

/// The section of the universe that holds `element`, of 64 equal ones (the thesis takes 32).
std::uint64_t section_bit(std::int32_t element, std::size_t universe) {
  return std::uint64_t{1} << (static_cast<std::uint64_t>(element) * 64 / universe);
}

/// Elements are ordered by rank, by their number where there is none.
std::vector<Outline> outlines_of(const SetFamily& family, Monitor& monitor) {
  const Csr& sets = family.sets;
  const std::span<const std::int32_t> rank = family.rank;
  const std::size_t universe = family.members.size();
  const bool sections = family.test == SubsetTest::hash;
  std::vector<Outline> outlines(sets.size());
  tbb::parallel_for(std::size_t{0}, (sets.size() + block - 1) / block, [&](std::size_t b) {
    Lookout look(monitor);
    for (std::size_t i = b * block; i < std::min(sets.size(), (b + 1) * block); ++i) {
      const auto set = sets[i];
      look(set.size());
      Outline& o = outlines[i];
      o = {0, -1, -1, static_cast<std::int32_t>(set.size())};
      if (set.empty()) continue;
      o.first = set.front();
      o.last = set.back();
      if (!rank.empty()) {
        const auto by_rank = [rank](std::int32_t x, std::int32_t y) {
          return rank[static_cast<std::size_t>(x)] < rank[static_cast<std::size_t>(y)];
        };
        const auto [first, last] = std::minmax_element(set.begin(), set.end(), by_rank);
        o.first = rank[static_cast<std::size_t>(*first)];
        o.last = rank[static_cast<std::size_t>(*last)];
      }
      for (const std::int32_t e : set) {
        o.signature |= sections ? section_bit(e, universe) : hashed_bit(e);
      }
    }
  });
  return outlines;
}

bool marked(std::uint8_t& flag) { return std::atomic_ref(flag).load(std::memory_order_relaxed) != 0; }
void mark(std::uint8_t& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }

/// The sets by their first element. A set that contains another one begins no later than it, and ends no
/// earlier: so it begins at most the longest extent of a set before the other one's last element.
class Window {
 public:
  explicit Window(const std::vector<Outline>& outlines) {
    std::int32_t last = -1;
    for (const Outline& o : outlines) last = std::max(last, o.last);
    by_first_ = lists_of<std::int32_t>(static_cast<std::size_t>(last + 1), [&](auto&& put) {
      for (std::size_t i = 0; i < outlines.size(); ++i) {
        if (outlines[i].degree > 0)
          put(static_cast<std::size_t>(outlines[i].first), static_cast<std::int32_t>(i));
      }
    });
    for (const Outline& o : outlines) {
      if (o.degree > 0) extent_ = std::max(extent_, o.last - o.first + 1);
    }
  }

  std::span<const std::int32_t> around(const Outline& inner) const {
    const auto first = static_cast<std::size_t>(std::max(inner.last - extent_ + 1, 0));
    return by_first_.range(first, static_cast<std::size_t>(inner.first) + 1);
  }

 private:
  Lists<std::int32_t> by_first_;
  std::int32_t extent_ = 0;  // last - first + 1, at most
};

}  // namespace

Flags dominated_sets(const SetFamily& family, Keep keep, std::span<const std::int32_t> dirty,
                     ReduceStatistics& statistics, Monitor& monitor) {
  const Csr &sets = family.sets, &members = family.members;
  const SubsetTest test = family.test;
  const std::vector<Outline> outlines = outlines_of(family, monitor);
  const Window window(test == SubsetTest::bandwidth ? outlines : std::vector<Outline>());
  Flags gone(sets.size());
  std::atomic<std::int64_t> candidates{0}, compared{0};
  tbb::parallel_for(std::size_t{0}, (dirty.size() + block - 1) / block, [&](std::size_t b) {
    Lookout look(monitor);
    std::int64_t looked_at = 0, opened = 0;
    for (std::size_t d = b * block; d < std::min(dirty.size(), (b + 1) * block); ++d) {
      const auto i = static_cast<std::size_t>(dirty[d]);
      const auto inner = sets[i];
      if (inner.empty()) {
        mark(gone[i]);  // an empty row; no column is ever empty
        continue;
      }
      if (marked(gone[i])) continue;
      // Returns false when nothing more can follow from i.
      const auto look_at = [&](std::size_t k) {
        ++looked_at;
        look(1);
        if (k == i || !outlines[k].may_contain(outlines[i]) || marked(gone[k])) return true;
        ++opened;
        look(inner.size() + sets[k].size());
        if (!contains(sets[k], inner)) return true;
        const bool equal = outlines[k].degree == outlines[i].degree;
        const bool inner_goes = keep == Keep::maximal ? !equal || k < i : equal && k < i;
        mark(gone[inner_goes ? i : k]);
        return !inner_goes;
      };
      if (test == SubsetTest::hash) {
        for (std::size_t k = 0; k < sets.size() && look_at(k); ++k) {
        }
        continue;
      }
      if (test == SubsetTest::bandwidth) {
        for (const std::int32_t k : window.around(outlines[i])) {
          if (!look_at(static_cast<std::size_t>(k))) break;
        }
        continue;
      }
      look(inner.size());
      const std::int32_t rarest =
          *std::min_element(inner.begin(), inner.end(), [&](std::int32_t x, std::int32_t y) {
            return members.degree(static_cast<std::size_t>(x)) < members.degree(static_cast<std::size_t>(y));
          });
      for (const std::int32_t k : members[static_cast<std::size_t>(rarest)]) {
        if (!look_at(static_cast<std::size_t>(k))) break;
      }
    }
    candidates += looked_at;
    compared += opened;
  });
  statistics.candidates += candidates;
  statistics.compared += compared;
  ++statistics.passes;
  return gone;
}

}  // namespace ballflow::geometry
