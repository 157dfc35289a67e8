// The search behind local_search, for one component.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/monitor.hpp"
#include "cover/components.hpp"

namespace ballflow::geometry {

class WeightingSearch {
 public:
  static constexpr std::int64_t most_weight = std::int64_t{1} << 30;  // so that sums of weights fit 31 bits

  /// `cover` is any cover of `part` without redundant rows, `bound` no more than the smallest one.
  /// Weights are halved when their sum reaches `weight_limit`, at most most_weight: a low limit lets the
  /// search forget.
  WeightingSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound, std::uint64_t seed,
                  Monitor& monitor, std::int64_t weight_limit = most_weight);

  /// Goes on for `steps` steps, or until the best cover has `bound` rows. Not to be used after Cancelled.
  void run(std::int64_t steps, Monitor& monitor);

  bool proven() const { return static_cast<std::int64_t>(best_.size()) <= bound_; }
  /// The smallest cover met: rows of the part, ascending.
  const std::vector<std::int32_t>& best() const { return best_; }
  const Part& part() const { return part_; }

 private:
  using Id = std::int32_t;

  /// The weight of the uncovered columns that a row covers. Weights of uncovered columns grow by one with
  /// every tick, so that a column changes the gains of its rows only when it is covered or uncovered: the
  /// gain is the sum of the columns' weights at tick 0 (negative ones are usual) and the tick times their
  /// number.
  class Gain {
   public:
    /// What a column contributes that has this weight at tick 0.
    explicit Gain(std::int32_t weight) : bits_((std::int64_t{weight} << 32) + 1) {}
    Gain() = default;
    Gain& operator+=(Gain g) { return bits_ += g.bits_, *this; }
    Gain& operator-=(Gain g) { return bits_ -= g.bits_, *this; }
    std::int64_t at(std::int64_t tick) const { return (bits_ >> 32) + (bits_ & 0xffffffff) * tick; }

   private:
    std::int64_t bits_ = 0;  // the sum in the upper half, the number in the lower
  };
  struct Keepers {
    std::int32_t times = 0;  // how many rows of the cover cover a column
    Id slots = 0;            // exclusive or of their slots: the slot itself while there is one
  };
  struct Column {
    std::int32_t weight = 1;  // while it is uncovered: at tick 0
    Id place = -1;            // in uncovered_
  };

  void add(Id row, Lookout& look);
  void drop(Id row, Lookout& look);
  void change_loss(Id slot, std::int32_t by);
  void set_key(Id slot, std::int64_t key);
  std::int64_t least_of_group(std::size_t group) const;
  void find_least(std::size_t block, Id except);
  Id least_loss();
  Id best_gain(Id column) const;
  void weigh_uncovered(Lookout& look);
  /// Begins again with tick 0, so that sums of weights stay small.
  void restart_ticks(Lookout& look);
  void halve_weights(Lookout& look);
  std::size_t random_below(std::size_t n);

  Part part_;
  std::int64_t bound_;
  std::uint64_t random_;
  std::int32_t step_ = 0;
  std::int32_t tick_ = 0, last_tick_;
  std::int64_t weight_limit_, weight_sum_ = 0;
  Id last_added_ = -1, last_dropped_ = -1;
  std::vector<Gain> gains_;          // of each row; valid while it is outside the cover
  std::vector<std::int32_t> moved_;  // step in which each row was added or dropped last
  std::vector<Keepers>
      keepers_;  // of each column; apart from what few steps need, so that more fit the cache
  std::vector<Column> columns_;
  std::vector<Id> uncovered_;

  // The cover in slots; a slot's key is its row's loss and, in the low bits, when the row was moved last:
  // the least key is dropped. Blocks of slots know their least slot, groups in them their least key.
  std::vector<Id> slot_of_;              // of each row, -1 outside the cover
  std::vector<Id> row_in_;               // of each slot, -1 when it is free
  std::vector<std::int64_t> keys_;       // of each slot, free ones to fill the last block
  std::vector<std::int64_t> group_key_;  // least key of each group
  std::vector<Id> free_;                 // slots
  std::vector<std::int64_t> least_key_;  // of each block
  std::vector<Id> least_slot_;
  std::size_t size_ = 0;
  std::vector<Id> best_;
};

}  // namespace ballflow::geometry
