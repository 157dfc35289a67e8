#include "cover/weighting_search.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ballflow::geometry {
namespace {

constexpr std::int64_t no_key = std::numeric_limits<std::int64_t>::max();
constexpr std::size_t block = 64;  // slots; for covers of 1000 to 10 000 rows
constexpr std::size_t group = 8;   // slots; a block is looked through by its groups

constexpr std::int64_t loss_unit = std::int64_t{1} << 32;  // of a key

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

WeightingSearch::WeightingSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound,
                                 std::uint64_t seed, Monitor& monitor, std::int64_t weight_limit)
    : part_(std::move(part)),
      bound_(bound),
      random_(seed),
      weight_limit_(weight_limit),
      gains_(part_.rows.size()),
      moved_(part_.rows.size()),
      keepers_(part_.columns.size()),
      columns_(part_.columns.size()),
      slot_of_(part_.rows.size(), -1),
      row_in_(cover.size(), -1),
      keys_((cover.size() + block - 1) / block * block, no_key),
      group_key_(keys_.size() / group, no_key),
      least_key_(keys_.size() / block, no_key),
      least_slot_(least_key_.size(), -1),
      best_(cover) {
  weight_sum_ = static_cast<std::int64_t>(columns_.size());
  last_tick_ = static_cast<std::int32_t>(most_weight / std::max<std::int64_t>(weight_sum_, 1));
  uncovered_.reserve(columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    columns_[c].place = static_cast<Id>(c);
    uncovered_.push_back(static_cast<Id>(c));
  }
  for (std::size_t i = 0; i < gains_.size(); ++i) {
    for (std::size_t k = 0; k < part_.rows.degree(i); ++k) gains_[i] += Gain(1);
  }
  for (std::size_t s = cover.size(); s > 0; --s) free_.push_back(static_cast<Id>(s - 1));
  std::sort(best_.begin(), best_.end());
  Lookout look(monitor);
  for (const Id row : best_) add(row, look);
}

/// Without jumps that depend on the keys.
std::int64_t WeightingSearch::least_of_group(std::size_t g) const {
  const std::int64_t* k = keys_.data() + g * group;
  const std::int64_t a = std::min(k[0], k[1]), b = std::min(k[2], k[3]), c = std::min(k[4], k[5]),
                     d = std::min(k[6], k[7]);
  return std::min(std::min(a, b), std::min(c, d));
}

void WeightingSearch::set_key(Id slot, std::int64_t key) {
  const std::int64_t before = std::exchange(keys_[at(slot)], key);
  std::int64_t& least = group_key_[at(slot) / group];
  if (key <= least) {
    least = key;
  } else if (before == least) {
    least = least_of_group(at(slot) / group);
  }
}

void WeightingSearch::change_loss(Id slot, std::int32_t by) {
  const std::int64_t key = keys_[at(slot)] + by * loss_unit;
  set_key(slot, key);
  const std::size_t b = at(slot) / block;
  if (key < least_key_[b]) {
    least_key_[b] = key;
    least_slot_[b] = slot;
  } else if (slot == least_slot_[b]) {
    find_least(b, -1);
  }
}

/// The first of the least keys of a block, but for that of `except`.
void WeightingSearch::find_least(std::size_t b, Id except) {
  const std::int64_t hidden = except < 0 ? no_key : keys_[at(except)];
  if (except >= 0) set_key(except, no_key);
  constexpr std::size_t groups = block / group;
  const std::int64_t* k = group_key_.data() + b * groups;
  const std::int64_t least = std::min(std::min(std::min(k[0], k[1]), std::min(k[2], k[3])),
                                      std::min(std::min(k[4], k[5]), std::min(k[6], k[7])));
  std::size_t g = 0;
  while (k[g] != least) ++g;
  std::size_t slot = b * block + g * group;
  while (keys_[slot] != least) ++slot;
  least_key_[b] = least;
  least_slot_[b] = static_cast<Id>(slot);
  if (except >= 0) set_key(except, hidden);
}

void WeightingSearch::add(Id row, Lookout& look) {
  const Id slot = free_.back();
  free_.pop_back();
  std::int32_t loss = 0;
  for (const Id c : part_.rows[at(row)]) {
    Keepers& keepers = keepers_[at(c)];
    if (++keepers.times == 1) {
      Column& column = columns_[at(c)];
      look(part_.columns.degree(at(c)));
      for (const Id other : part_.columns[at(c)]) gains_[at(other)] -= Gain(column.weight);
      column.weight += tick_;
      loss += column.weight;
      const Id last = uncovered_.back();
      uncovered_[at(column.place)] = last;
      columns_[at(last)].place = column.place;
      uncovered_.pop_back();
    } else if (keepers.times == 2) {
      change_loss(keepers.slots, -columns_[at(c)].weight);
    }
    keepers.slots ^= slot;
  }
  moved_[at(row)] = step_;
  slot_of_[at(row)] = slot;
  row_in_[at(slot)] = row;
  set_key(slot, loss * loss_unit + step_);
  const std::size_t b = at(slot) / block;
  if (keys_[at(slot)] < least_key_[b]) {
    least_key_[b] = keys_[at(slot)];
    least_slot_[b] = slot;
  }
  ++size_;
}

void WeightingSearch::drop(Id row, Lookout& look) {
  const Id slot = slot_of_[at(row)];
  slot_of_[at(row)] = -1;
  row_in_[at(slot)] = -1;
  set_key(slot, no_key);
  free_.push_back(slot);
  if (least_slot_[at(slot) / block] == slot) find_least(at(slot) / block, -1);
  --size_;
  moved_[at(row)] = step_;
  for (const Id c : part_.rows[at(row)]) {
    Keepers& keepers = keepers_[at(c)];
    keepers.slots ^= slot;
    if (--keepers.times == 0) {
      Column& column = columns_[at(c)];
      look(part_.columns.degree(at(c)));
      column.weight -= tick_;
      for (const Id other : part_.columns[at(c)]) gains_[at(other)] += Gain(column.weight);
      column.place = static_cast<Id>(uncovered_.size());
      uncovered_.push_back(c);
    } else if (keepers.times == 1) {
      change_loss(keepers.slots, columns_[at(c)].weight);
    }
  }
}

WeightingSearch::Id WeightingSearch::least_loss() {
  // The tabu row hides from its block while the others are compared.
  const Id tabu = last_added_ < 0 ? -1 : slot_of_[at(last_added_)];
  const std::size_t tabu_block = tabu < 0 ? least_key_.size() : at(tabu) / block;
  const bool hidden = tabu >= 0 && least_slot_[tabu_block] == tabu;
  const std::int64_t tabu_key = hidden ? least_key_[tabu_block] : no_key;
  if (hidden) find_least(tabu_block, tabu);
  const auto least = std::min_element(least_key_.begin(), least_key_.end()) - least_key_.begin();
  const bool none = least_key_[static_cast<std::size_t>(least)] == no_key;
  const Id row = none ? last_added_ : row_in_[at(least_slot_[static_cast<std::size_t>(least)])];
  if (hidden) {
    least_key_[tabu_block] = tabu_key;
    least_slot_[tabu_block] = tabu;
  }
  return row;
}

WeightingSearch::Id WeightingSearch::best_gain(Id column) const {
  Id best = -1;
  std::int64_t best_gain = -1;
  for (const Id row : part_.columns[at(column)]) {
    if (row == last_dropped_) continue;
    const std::int64_t gain = gains_[at(row)].at(tick_);
    if (gain > best_gain || (gain == best_gain && moved_[at(row)] < moved_[at(best)])) {
      best = row;
      best_gain = gain;
    }
  }
  return best < 0 ? last_dropped_ : best;
}

void WeightingSearch::weigh_uncovered(Lookout& look) {
  weight_sum_ += static_cast<std::int64_t>(uncovered_.size());
  if (++tick_ == last_tick_) restart_ticks(look);
  if (weight_sum_ >= weight_limit_) halve_weights(look);
}

void WeightingSearch::restart_ticks(Lookout& look) {
  for (const Id c : uncovered_) {
    look(part_.columns.degree(at(c)));
    Column& column = columns_[at(c)];
    for (const Id row : part_.columns[at(c)]) gains_[at(row)] -= Gain(column.weight);
    column.weight += tick_;
    for (const Id row : part_.columns[at(c)]) gains_[at(row)] += Gain(column.weight);
  }
  tick_ = 0;
}

void WeightingSearch::halve_weights(Lookout& look) {
  restart_ticks(look);
  weight_sum_ = 0;
  std::fill(gains_.begin(), gains_.end(), Gain());
  for (std::int64_t& key : keys_) {
    if (key != no_key) key &= loss_unit - 1;
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    Column& column = columns_[c];
    column.weight = (column.weight + 1) / 2;
    weight_sum_ += column.weight;
    if (keepers_[c].times == 0) {
      look(part_.columns.degree(c));
      for (const Id row : part_.columns[c]) gains_[at(row)] += Gain(column.weight);
    } else if (keepers_[c].times == 1) {
      keys_[at(keepers_[c].slots)] += column.weight * loss_unit;
    }
  }
  for (std::size_t g = 0; g < group_key_.size(); ++g) group_key_[g] = least_of_group(g);
  for (std::size_t b = 0; b < least_key_.size(); ++b) find_least(b, -1);
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
        std::copy_if(row_in_.begin(), row_in_.end(), std::back_inserter(best_),
                     [](Id row) { return row >= 0; });
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
    look(part_.rows.degree(at(dropped)) + part_.rows.degree(at(added)) + 256);
  }
}

}  // namespace ballflow::geometry
