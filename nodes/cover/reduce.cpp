#include "cover/reduce.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "cover/certificate.hpp"
#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

// Notation: a pass looks at a family of sets (the rows, as sets of columns, or the columns, as sets of
// rows). `members` is the transposed family: members[e] are the sets that contain element e.

using Flags = std::vector<std::uint8_t>;
using Ids = std::vector<std::int32_t>;

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

enum class Keep { maximal, minimal };

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

/// `rank` orders the elements, by their number where it is empty.
std::vector<Outline> outlines_of(const Csr& sets, std::size_t universe, SubsetTest test, const Ids& rank,
                                 Monitor& monitor) {
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
        const auto by_rank = [&rank](std::int32_t x, std::int32_t y) {
          return rank[static_cast<std::size_t>(x)] < rank[static_cast<std::size_t>(y)];
        };
        const auto [first, last] = std::minmax_element(set.begin(), set.end(), by_rank);
        o.first = rank[static_cast<std::size_t>(*first)];
        o.last = rank[static_cast<std::size_t>(*last)];
      }
      for (const std::int32_t e : set) {
        o.signature |= test == SubsetTest::hash ? section_bit(e, universe) : hashed_bit(e);
      }
    }
  });
  return outlines;
}

bool marked(std::uint8_t& flag) { return std::atomic_ref(flag).load(std::memory_order_relaxed) != 0; }
void mark(std::uint8_t& flag) { std::atomic_ref(flag).store(1, std::memory_order_relaxed); }

/// Breadth-first numbering of rows and columns that keeps the entries of the matrix near its diagonal: the
/// variant of Cuthill and McKee's algorithm in Listing 3.3. Every search begins at a vertex of least degree,
/// and goes on to neighbours by degree; ties go to rows before columns, then to the lowest number.
class BandwidthOrder {
 public:
  BandwidthOrder(const Csr& rows, const Csr& columns, Monitor& monitor)
      : look_(monitor), sides_{Side{rows, Ids(rows.size(), -1)}, Side{columns, Ids(columns.size(), -1)}} {
    std::vector<Vertex> starts;
    for (const bool column : {false, true}) {
      for (std::size_t v = 0; v < side(column).adjacent.size(); ++v)
        starts.push_back({column, static_cast<std::int32_t>(v)});
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [this](Vertex a, Vertex b) { return degree(a) < degree(b); });
    for (const Vertex start : starts) search(start);
  }
  /// The new number of each row, of each column.
  const Ids& row_rank() const { return sides_[0].rank; }
  const Ids& column_rank() const { return sides_[1].rank; }

 private:
  struct Vertex {
    bool column;
    std::int32_t number;
  };
  struct Side {
    const Csr& adjacent;
    Ids rank;
    std::int32_t next = 0;
  };

  Side& side(bool column) { return sides_[column ? 1 : 0]; }
  std::size_t degree(Vertex v) { return side(v.column).adjacent.degree(static_cast<std::size_t>(v.number)); }
  /// Vertices leave the queue in the order in which they enter it, so they can be numbered as they enter.
  void enter(Vertex v) {
    queue_.push_back(v);
    side(v.column).rank[static_cast<std::size_t>(v.number)] = side(v.column).next++;
  }
  bool met(Vertex v) { return side(v.column).rank[static_cast<std::size_t>(v.number)] >= 0; }
  void search(Vertex start) {
    if (met(start)) return;
    queue_.clear();
    enter(start);
    Ids neighbours;
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      const Vertex v = queue_[at];
      look_(degree(v));
      neighbours.clear();
      for (const std::int32_t u : side(v.column).adjacent[static_cast<std::size_t>(v.number)]) {
        if (!met({!v.column, u})) neighbours.push_back(u);
      }
      std::stable_sort(neighbours.begin(), neighbours.end(), [&](std::int32_t a, std::int32_t b) {
        return degree({!v.column, a}) < degree({!v.column, b});
      });
      for (const std::int32_t u : neighbours) enter({!v.column, u});
    }
  }

  Lookout look_;
  std::array<Side, 2> sides_;
  std::vector<Vertex> queue_;
};

/// The sets by their first element. A set that contains another one begins no later than it, and ends no
/// earlier: so it begins at most the longest extent of a set before the other one's last element.
struct Window {
  Ids sets;                 // by first element
  Ids starts;               // where in `sets` those with this first element begin, one more than elements
  std::int32_t extent = 0;  // last - first + 1, at most

  explicit Window(const std::vector<Outline>& outlines) {
    std::int32_t last = -1;
    for (const Outline& o : outlines) last = std::max(last, o.last);
    const auto universe = static_cast<std::size_t>(last + 1);
    starts.resize(universe + 1);
    for (const Outline& o : outlines) {
      if (o.degree == 0) continue;
      ++starts[static_cast<std::size_t>(o.first) + 1];
      extent = std::max(extent, o.last - o.first + 1);
    }
    for (std::size_t e = 0; e < universe; ++e) starts[e + 1] += starts[e];
    sets.resize(static_cast<std::size_t>(starts.back()));
    Ids next(starts.begin(), starts.end() - 1);
    for (std::size_t i = 0; i < outlines.size(); ++i) {
      if (outlines[i].degree == 0) continue;
      sets[static_cast<std::size_t>(next[static_cast<std::size_t>(outlines[i].first)]++)] =
          static_cast<std::int32_t>(i);
    }
  }

  std::span<const std::int32_t> around(const Outline& inner) const {
    const auto first = static_cast<std::size_t>(std::max(inner.last - extent + 1, 0));
    const auto begin = static_cast<std::size_t>(starts[first]);
    const auto end = static_cast<std::size_t>(starts[static_cast<std::size_t>(inner.first) + 1]);
    return std::span(sets).subspan(begin, end - begin);
  }
};

/// Marks the sets that are not maximal (a proper superset exists, or an equal set of lower index) or not
/// minimal. Only pairs are looked at whose inner set is in `dirty`.
///
/// The order by inclusion, then index, is strict, so what must go goes whatever else went before it: sets
/// already marked may be skipped, and threads may mark in any order, without changing the outcome.
///
/// Why dirty sets suffice after the first pass: sets only lose elements, so an inclusion is new only if
/// its inner set has lost one since the last pass.
///
/// `rank` orders the elements for SubsetTest::bandwidth, and is empty otherwise.
Flags dominated(const Csr& sets, const Csr& members, const Ids& dirty, Keep keep, SubsetTest test,
                const Ids& rank, ReduceStatistics& statistics, Monitor& monitor) {
  const std::vector<Outline> outlines = outlines_of(sets, members.size(), test, rank, monitor);
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

/// The matrix in both orientations, and the original ids of what is left of it.
struct Matrix {
  Csr rows, columns;
  Ids row_ids, column_ids;
  Ids row_rank, column_rank;  // SubsetTest::bandwidth: where a row or column is in that order; else empty

  void erase_rows(const Flags& gone) {
    erase(row_ids, gone);
    erase(row_rank, gone);
  }
  void erase_columns(const Flags& gone) {
    erase(column_ids, gone);
    erase(column_rank, gone);
  }

 private:
  static void erase(Ids& ids, const Flags& gone) {
    std::size_t k = 0;
    std::erase_if(ids, [&](std::int32_t) { return gone[k++] != 0; });
  }
};

/// `sets` without those in `gone_sets` and without the elements in `gone_elements`, renumbered. `shrunk`
/// becomes the new numbers of the sets that lost elements.
Csr without(const Csr& sets, const Flags& gone_sets, const Flags& gone_elements, Ids& shrunk,
            Monitor& monitor) {
  const bool all_elements = std::find(gone_elements.begin(), gone_elements.end(), 1) == gone_elements.end();
  std::vector<std::int32_t> number(gone_elements.size(), -1);
  std::int32_t next = 0;
  for (std::size_t e = 0; e < number.size(); ++e) {
    if (gone_elements[e] == 0) number[e] = next++;
  }
  std::vector<std::int64_t> offsets{0};
  std::size_t most = 0;
  for (std::size_t i = 0; i < sets.size(); ++i) most += gone_sets[i] == 0 ? sets.degree(i) : 0;
  auto entries = zeros<std::int32_t>(most, monitor);
  std::size_t size = 0;
  Lookout look(monitor);
  shrunk.clear();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    if (gone_sets[i] != 0) continue;
    const auto set = sets[i];
    look(set.size());
    if (all_elements) {
      std::copy(set.begin(), set.end(), entries.begin() + static_cast<std::ptrdiff_t>(size));
      size += set.size();
    } else {
      for (const std::int32_t e : set) {
        entries[size] = number[static_cast<std::size_t>(e)];
        size += entries[size] >= 0 ? 1 : 0;
      }
    }
    const auto degree = static_cast<std::size_t>(static_cast<std::int64_t>(size) - offsets.back());
    if (degree < set.size()) shrunk.push_back(static_cast<std::int32_t>(offsets.size() - 1));
    offsets.push_back(static_cast<std::int64_t>(size));
  }
  entries.resize(size);
  return {std::move(offsets), std::move(entries)};
}

bool any(const Flags& flags) { return std::find(flags.begin(), flags.end(), 1) != flags.end(); }

Ids all_of(std::size_t count) {
  Ids ids(count);
  std::iota(ids.begin(), ids.end(), 0);
  return ids;
}

}  // namespace

CoverState reduce(const CoverState& state, const ReduceOptions& options, Monitor& monitor,
                  ReduceStatistics* statistics) {
  monitor.step(0);
  Matrix matrix{rows_of(state),
                transpose(rows_of(state), state.cols(), monitor),
                Ids(state.row_ids.begin(), state.row_ids.end()),
                Ids(state.column_ids.begin(), state.column_ids.end()),
                {},
                {}};
  if (options.subset_test == SubsetTest::bandwidth) {
    BandwidthOrder order(matrix.rows, matrix.columns, monitor);
    matrix.row_rank = order.row_rank();
    matrix.column_rank = order.column_rank();
  }
  ReduceStatistics counts;
  Ids chosen(state.chosen.begin(), state.chosen.end());
  std::vector<std::uint8_t> chosen_how(state.chosen_how.begin(), state.chosen_how.end());
  PricedGroups witnesses;  // of the essential balls
  Ids dirty_rows = all_of(matrix.rows.size()), dirty_columns = all_of(matrix.columns.size());

  for (int round = 1; !dirty_rows.empty() || !dirty_columns.empty(); ++round) {
    monitor.step(1 - 1.0 / round);
    const Flags none_of_columns(matrix.columns.size());
    const Flags gone_rows = dominated(matrix.rows, matrix.columns, dirty_rows, Keep::maximal,
                                      options.subset_test, matrix.column_rank, counts, monitor);
    dirty_rows.clear();
    if (any(gone_rows)) {
      Ids shrunk;
      matrix.rows = without(matrix.rows, gone_rows, none_of_columns, shrunk, monitor);
      matrix.columns = without(matrix.columns, none_of_columns, gone_rows, shrunk, monitor);
      matrix.erase_rows(gone_rows);
      if (round > 1) dirty_columns = std::move(shrunk);
    }
    if (dirty_columns.empty()) continue;

    monitor.step(1 - 1.0 / (round + 0.5));
    Flags gone_columns = dominated(matrix.columns, matrix.rows, dirty_columns, Keep::minimal,
                                   options.subset_test, matrix.row_rank, counts, monitor);
    dirty_columns.clear();
    // A column of one row is in all other columns of that row, which have just been marked: the choice
    // takes this column and its row, nothing else.
    Flags essential(matrix.rows.size());
    Ids witness(matrix.rows.size());
    for (std::size_t c = 0; c < matrix.columns.size(); ++c) {
      if (gone_columns[c] != 0 || matrix.columns.degree(c) != 1) continue;
      gone_columns[c] = 1;
      essential[static_cast<std::size_t>(matrix.columns[c][0])] = 1;
      witness[static_cast<std::size_t>(matrix.columns[c][0])] = matrix.column_ids[c];
    }
    for (std::size_t i = 0; i < essential.size(); ++i) {
      if (essential[i] == 0) continue;
      chosen.push_back(matrix.row_ids[i]);
      chosen_how.push_back(static_cast<std::uint8_t>(Choice::essential));
      witnesses.add(witness[i], price_unit);
      witnesses.close();
    }
    if (any(gone_columns)) {
      Ids unchanged;
      matrix.columns = without(matrix.columns, gone_columns, essential, unchanged, monitor);
      matrix.rows = without(matrix.rows, essential, gone_columns, dirty_rows, monitor);
      matrix.erase_columns(gone_columns);
      matrix.erase_rows(essential);
    }
  }

  CoverState next = state;
  next.row_offsets = matrix.rows.offsets;
  next.columns = matrix.rows.entries;
  next.row_ids = std::move(matrix.row_ids);
  next.column_ids = std::move(matrix.column_ids);
  next.chosen = std::move(chosen);
  next.chosen_how = std::move(chosen_how);
  settle(next, witnesses);
  raise_lower_bound(next);
  if (statistics != nullptr) *statistics = counts;
  monitor.step(1);
  return next;
}

}  // namespace ballflow::geometry
