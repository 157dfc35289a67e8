#include "cover/weighting_search.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "cover/near_order.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t no_key = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t group = 8;          // slots
constexpr std::size_t block = group * 8;  // slots; for covers of 1000 to 10 000 rows
constexpr std::int32_t always = 1 << 20;  // rows that cover the column that fills up rows

constexpr std::int64_t loss_unit = std::int64_t{1} << 32;  // of a key

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Keys are compared without jumps: nobody can foresee where these would go, and that takes longer than the
// comparison.
std::int64_t lesser(std::int64_t a, std::int64_t b) { return b < a ? b : a; }

inline std::int64_t least_of_8(const std::int64_t* k) {
  return lesser(lesser(lesser(k[0], k[1]), lesser(k[2], k[3])),
                lesser(lesser(k[4], k[5]), lesser(k[6], k[7])));
}

/// The first of 8 keys that is `key`; one of them is.
inline std::size_t first_of_8(const std::int64_t* k, std::int64_t key) {
  const std::size_t a = k[0] == key ? 0 : 1, b = k[2] == key ? 2 : 3, c = k[4] == key ? 4 : 5,
                    d = k[6] == key ? 6 : 7;
  const std::size_t low = k[a] == key ? a : b, high = k[c] == key ? c : d;
  return k[low] == key ? low : high;
}

}  // namespace

WeightingSearch::FullLists::FullLists(const Csr& lists, const std::vector<Id>& rank,
                                      const std::vector<Id>& rank_of_value, Lookout& look) {
  const auto filler = static_cast<Id>(rank_of_value.size());
  begin_.push_back(0);
  values_.reserve(lists.entries.size() + 2 * lists.size());
  for (const Id i : inverse(rank)) {
    const auto list = lists[at(i)];
    look(list.size());
    length_.push_back(static_cast<Id>(list.size()));
    for (const Id value : list) values_.push_back(rank_of_value[at(value)]);
    values_.resize((values_.size() + 3) / 4 * 4, filler);
    begin_.push_back(values_.size());
  }
}

WeightingSearch::WeightingSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound,
                                 std::uint64_t seed, Monitor& monitor, std::int64_t weight_limit,
                                 std::span<const std::int32_t> weights)
    : row_ids_(std::move(part.row_ids)),
      column_ids_(std::move(part.column_ids)),
      bound_(bound),
      random_(seed),
      weight_limit_(weight_limit),
      gains_(part.rows.size() + 1),
      moved_(part.rows.size()),
      keepers_(part.columns.size() + 1),
      states_(part.columns.size()),
      slot_of_(part.rows.size(), -1),
      row_in_(cover.size(), -1),
      keys_((cover.size() + block - 1) / block * block, no_key),
      group_key_(keys_.size() / group, no_key),
      least_key_(keys_.size() / block, no_key),
      least_slot_(least_key_.size(), -1),
      best_(cover) {
  Lookout look(monitor);
  NearOrder near = near_order(part.rows, part.columns, monitor);
  rows_ = {part.rows, near.row_rank, near.column_rank, look};
  part.rows = {};  // as large as what was made of it
  columns_ = {part.columns, near.column_rank, near.row_rank, look};
  part.columns = {};
  number_ = inverse(near.row_rank);
  keepers_.back() = Keepers(always);
  last_tick_ = static_cast<std::int32_t>(most_weight / std::max<std::int64_t>(states_.size(), 1));
  for (std::size_t c = 0; c < weights.size(); ++c) states_[at(near.column_rank[c])].weight = weights[c];
  const auto sum_weights = [&] {
    weight_sum_ = 0;
    for (const State& column : states_) weight_sum_ += column.weight;
    return weight_sum_;
  };
  while (sum_weights() >= weight_limit_ && weight_sum_ > static_cast<std::int64_t>(states_.size())) {
    for (State& column : states_) column.weight = (column.weight + 1) / 2;
  }
  uncovered_.reserve(states_.size());
  for (std::size_t c = 0; c < states_.size(); ++c) {
    states_[c].place = static_cast<Id>(c);
    uncovered_.push_back(static_cast<Id>(c));
  }
  std::size_t longest = 0;
  for (std::size_t i = 0; i < number_.size(); ++i) {
    longest = std::max(longest, rows_.full(i).size());
    for (const Id c : rows_.full(i).first(rows_.length(i))) gains_[i] += Gain(states_[at(c)].weight);
  }
  first_.resize(longest + 1);
  second_.resize(longest + 1);
  stale_.resize(longest + 2);
  for (std::size_t c = 0; c < states_.size(); ++c) longest = std::max(longest, columns_.length(c));
  ranks_.resize(longest);
  for (std::size_t s = cover.size(); s > 0; --s) free_.push_back(static_cast<Id>(s - 1));
  std::sort(best_.begin(), best_.end());
  for (const Id row : best_) add(near.row_rank[at(row)], look);
  rank_of_column_ = std::move(near.column_rank);
}

std::vector<std::int32_t> WeightingSearch::weights() const {
  std::vector<std::int32_t> result;
  result.reserve(states_.size());
  for (const Id c : rank_of_column_) {
    const bool uncovered = keepers_[at(c)].times() == 0;
    result.push_back(states_[at(c)].weight + (uncovered ? tick_ : 0));
  }
  return result;
}

void WeightingSearch::raise_key(Id slot, std::int64_t key) {
  const std::int64_t before = std::exchange(keys_[at(slot)], key);
  const std::size_t g = at(slot) / group;
  if (before == group_key_[g]) group_key_[g] = least_of_8(&keys_[g * group]);
}

void WeightingSearch::lower_key(Id slot, std::int64_t key) {
  keys_[at(slot)] = key;
  std::int64_t& least = group_key_[at(slot) / group];
  least = lesser(least, key);
  const std::size_t b = at(slot) / block;
  if (key > least_key_[b]) return;
  // Of equal keys the slot that was least before stays so, which need not be the first.
  if (key == least_key_[b] && slot != least_slot_[b]) {
    rest_is_known_ = false;
    return;
  }
  set_least(b, {key, slot});
}

WeightingSearch::Least WeightingSearch::least_of_block(std::size_t b) const {
  const std::int64_t* const groups = &group_key_[b * (block / group)];
  const std::int64_t key = least_of_8(groups);
  const std::size_t g = b * (block / group) + first_of_8(groups, key);
  return {key, static_cast<Id>(g * group + first_of_8(&keys_[g * group], key))};
}

void WeightingSearch::change_gains(Id column, Gain by) {
  Gain* const gains = gains_.data();
  const auto rows = columns_.full(at(column));
  for (const Id *row = rows.data(), *const end = row + rows.size(); row != end; row += 4) {
    gains[at(row[0])] += by;
    gains[at(row[1])] += by;
    gains[at(row[2])] += by;
    gains[at(row[3])] += by;
  }
}

void WeightingSearch::add(Id row, Lookout& look) {
  const Id slot = free_.back();
  free_.pop_back();
  std::size_t covered = 0, shared = 0;
  Change *const first = first_.data(), *const second = second_.data();
  Keepers* const keepers = keepers_.data();
  const auto meet = [&](Id c) {
    Keepers& k = keepers[at(c)];
    const std::int32_t times = k.times();
    first[covered] = second[shared] = {c, k.slot()};
    covered += times == 0;
    shared += times == 1;
    k.add(slot);
  };
  const auto columns = rows_.full(at(row));
  for (const Id *c = columns.data(), *const end = c + columns.size(); c != end; c += 4) {
    meet(c[0]);
    meet(c[1]);
    meet(c[2]);
    meet(c[3]);
  }
  std::int32_t loss = 0;
  std::size_t visited = columns.size();
  for (std::size_t i = 0; i < covered; ++i) {
    const Id c = first[i].column;
    State& column = states_[at(c)];
    change_gains(c, -Gain(column.weight));
    visited += columns_.length(at(c));
    column.weight += tick_;
    loss += column.weight;
    const Id last = uncovered_.back();
    uncovered_[at(column.place)] = last;
    states_[at(last)].place = column.place;
    uncovered_.pop_back();
  }
  for (std::size_t i = 0; i < shared; ++i) {
    const Id s = second[i].slot;
    lower_key(s, keys_[at(s)] - states_[at(second[i].column)].weight * loss_unit);
  }
  moved_[at(row)] = step_;
  slot_of_[at(row)] = slot;
  row_in_[at(slot)] = row;
  rest_ = {least_key_[at(slot) / block], least_slot_[at(slot) / block]};
  lower_key(slot, loss * loss_unit + step_);
  ++size_;
  look(visited);
}

void WeightingSearch::drop(Id row, Lookout& look) {
  const Id slot = slot_of_[at(row)];
  slot_of_[at(row)] = -1;
  row_in_[at(slot)] = -1;
  free_.push_back(slot);
  --size_;
  moved_[at(row)] = step_;
  std::size_t bare = 0, alone = 0;
  Change *const first = first_.data(), *const second = second_.data();
  Keepers* const keepers = keepers_.data();
  const auto leave = [&](Id c) {
    Keepers& k = keepers[at(c)];
    k.drop(slot);
    const std::int32_t times = k.times();
    first[bare] = second[alone] = {c, k.slot()};
    bare += times == 0;
    alone += times == 1;
  };
  const auto columns = rows_.full(at(row));
  for (const Id *c = columns.data(), *const end = c + columns.size(); c != end; c += 4) {
    leave(c[0]);
    leave(c[1]);
    leave(c[2]);
    leave(c[3]);
  }
  // Keys rise: only blocks whose least slot is among them have another one.
  std::size_t stale = 0;
  const auto raise = [&](Id s, std::int64_t key) {
    raise_key(s, key);
    stale_[stale] = at(s) / block;
    stale += least_slot_[at(s) / block] == s;
  };
  rest_is_known_ = least_slot_[at(slot) / block] == slot;  // as it is looked for, and add() takes that slot
  raise(slot, no_key);
  for (std::size_t i = 0; i < alone; ++i) {
    const Id s = second[i].slot;
    raise(s, keys_[at(s)] + states_[at(second[i].column)].weight * loss_unit);
  }
  for (std::size_t i = 0; i < stale; ++i) set_least(stale_[i], least_of_block(stale_[i]));
  std::size_t visited = columns.size();
  for (std::size_t i = 0; i < bare; ++i) {
    const Id c = first[i].column;
    State& column = states_[at(c)];
    column.weight -= tick_;
    change_gains(c, Gain(column.weight));
    visited += columns_.length(at(c));
    column.place = static_cast<Id>(uncovered_.size());
    uncovered_.push_back(c);
  }
  look(visited);
}

WeightingSearch::Id WeightingSearch::least_loss() {
  // The tabu row hides from its block while the others are compared.
  const Id tabu = last_added_ < 0 ? -1 : slot_of_[at(last_added_)];
  const std::size_t b = tabu < 0 ? 0 : at(tabu) / block;
  const bool hidden = tabu >= 0 && least_slot_[b] == tabu;
  const Least of_tabu{least_key_[b], tabu};
  if (hidden && rest_is_known_) {
    set_least(b, rest_);
  } else if (hidden) {
    raise_key(tabu, no_key);
    set_least(b, least_of_block(b));
    keys_[at(tabu)] = group_key_[at(tabu) / group] = of_tabu.key;
  }
  std::int64_t least = no_key, other = no_key;  // side by side: neither waits for the other
  for (std::size_t i = 0; i + 1 < least_key_.size(); i += 2) {
    least = lesser(least, least_key_[i]);
    other = lesser(other, least_key_[i + 1]);
  }
  least = lesser(lesser(least, other), least_key_.back());
  const auto first = std::find(least_key_.begin(), least_key_.end(), least) - least_key_.begin();
  const Id row = least == no_key ? last_added_ : row_in_[at(least_slot_[static_cast<std::size_t>(first)])];
  if (hidden) set_least(b, of_tabu);
  return row;
}

WeightingSearch::Id WeightingSearch::best_gain(Id column) {
  // The greatest gain, then the earliest move, then the first.
  const auto rows = columns_.full(at(column)).first(columns_.length(at(column)));
  std::int64_t most = -1;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const std::size_t row = at(rows[k]);
    const std::int64_t rank = (gains_[row].at(tick_) << 32) - moved_[row];
    ranks_[k] = rows[k] == last_dropped_ ? -1 : rank;
    most = -lesser(-most, -ranks_[k]);
  }
  if (most < 0) return last_dropped_;
  std::size_t best = 0;
  while (ranks_[best] != most) ++best;
  return rows[best];
}

void WeightingSearch::weigh_uncovered(Lookout& look) {
  weight_sum_ += static_cast<std::int64_t>(uncovered_.size());
  if (++tick_ == last_tick_) restart_ticks(look);
  if (weight_sum_ >= weight_limit_) halve_weights(look);
}

void WeightingSearch::restart_ticks(Lookout& look) {
  for (const Id c : uncovered_) {
    look(columns_.length(at(c)));
    State& column = states_[at(c)];
    change_gains(c, -Gain(column.weight));
    column.weight += tick_;
    change_gains(c, Gain(column.weight));
  }
  tick_ = 0;
}

void WeightingSearch::halve_weights(Lookout& look) {
  restart_ticks(look);
  rest_is_known_ = false;
  weight_sum_ = 0;
  std::fill(gains_.begin(), gains_.end(), Gain());
  for (std::int64_t& key : keys_) {
    if (key != no_key) key &= loss_unit - 1;
  }
  for (std::size_t c = 0; c < states_.size(); ++c) {
    State& column = states_[c];
    column.weight = (column.weight + 1) / 2;
    weight_sum_ += column.weight;
    if (keepers_[c].times() == 0) {
      look(columns_.length(c));
      change_gains(static_cast<Id>(c), Gain(column.weight));
    } else if (keepers_[c].times() == 1) {
      keys_[at(keepers_[c].slot())] += column.weight * loss_unit;
    }
  }
  for (std::size_t g = 0; g < group_key_.size(); ++g) group_key_[g] = least_of_8(&keys_[g * group]);
  for (std::size_t b = 0; b < least_key_.size(); ++b) set_least(b, least_of_block(b));
}

std::size_t WeightingSearch::random_below(std::size_t n) {
  // splitmix64
  std::uint64_t z = random_ += 0x9e3779b97f4a7c15u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return static_cast<std::size_t>(((z ^ (z >> 31)) >> 32) * n >> 32);
}

void WeightingSearch::run(std::int64_t steps, Monitor& monitor) {
  Lookout look(monitor);
  for (std::int64_t k = 0; k < steps; ++k) {
    while (uncovered_.empty()) {
      if (size_ < best_.size()) {
        best_.clear();
        for (const Id row : row_in_) {
          if (row >= 0) best_.push_back(number_[at(row)]);
        }
        std::sort(best_.begin(), best_.end());
      }
      if (proven()) return;
      last_added_ = -1;
      drop(least_loss(), look);
    }
    ++step_;
    const Id dropped = least_loss();
    drop(dropped, look);
    last_dropped_ = dropped;
    const Id added = best_gain(uncovered_[random_below(uncovered_.size())]);
    add(added, look);
    last_added_ = added;
    weigh_uncovered(look);
    look(256);
  }
}

}  // namespace ballflow::geometry
