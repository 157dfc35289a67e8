// The search behind local_search, for one component.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "cover/components.hpp"

namespace ballflow::geometry {

class WeightingSearch {
 public:
  static constexpr std::int64_t most_weight = std::int64_t{1} << 30;  // so that sums of weights fit 31 bits

  /// `cover` is any cover of `part` without redundant rows, `bound` no more than the smallest one.
  /// Weights are halved when their sum reaches `weight_limit`, at most most_weight: a low limit lets the
  /// search forget. `weights` of the columns, at least 1, are those of earlier searches, halved until
  /// their sum is below the limit; empty: all 1.
  WeightingSearch(Part part, const std::vector<std::int32_t>& cover, std::int64_t bound, std::uint64_t seed,
                  Monitor& monitor, std::int64_t weight_limit = most_weight,
                  std::span<const std::int32_t> weights = {});

  /// Goes on for `steps` steps, or until the best cover has `bound` rows. Not to be used after Cancelled.
  void run(std::int64_t steps, Monitor& monitor);

  bool proven() const { return static_cast<std::int64_t>(best_.size()) <= bound_; }
  /// The smallest cover met: rows of the part, ascending.
  const std::vector<std::int32_t>& best() const { return best_; }
  /// Those of the part; its matrix is not kept beside the search's own.
  const std::vector<std::int32_t>& row_ids() const { return row_ids_; }
  const std::vector<std::int32_t>& column_ids() const { return column_ids_; }
  /// The weight of each column.
  std::vector<std::int32_t> weights() const;

 private:
  using Id = std::int32_t;

  /// The lists of a matrix in another order, each filled up to a multiple of 4 with a number that is no row
  /// or column: loops of four steps at once need no other for the rest. Values keep their order.
  class FullLists {
   public:
    FullLists() = default;
    FullLists(const Csr& lists, const std::vector<Id>& rank, const std::vector<Id>& rank_of_value,
              Lookout& look);
    std::span<const Id> full(std::size_t i) const {
      return {values_.data() + begin_[i], values_.data() + begin_[i + 1]};
    }
    /// Without what fills it up.
    std::size_t length(std::size_t i) const { return static_cast<std::size_t>(length_[i]); }

   private:
    std::vector<std::size_t> begin_;
    std::vector<Id> length_, values_;
  };

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
    Gain operator-() const {
      Gain minus;
      minus.bits_ = -bits_;
      return minus;
    }
    std::int64_t at(std::int64_t tick) const { return (bits_ >> 32) + (bits_ & 0xffffffff) * tick; }

   private:
    std::int64_t bits_ = 0;  // the sum in the upper half, the number in the lower
  };
  /// How many rows of the cover cover a column, and the exclusive or of their slots: the slot itself while
  /// there is one.
  class Keepers {
   public:
    explicit Keepers(std::int32_t times = 0) : bits_(times * one) {}
    std::int32_t times() const { return static_cast<std::int32_t>(bits_ >> 32); }
    Id slot() const { return static_cast<Id>(bits_ & 0xffffffff); }
    void add(Id slot) { bits_ = (bits_ + one) ^ slot; }
    void drop(Id slot) { bits_ = (bits_ - one) ^ slot; }

   private:
    static constexpr std::int64_t one = std::int64_t{1} << 32;
    std::int64_t bits_;  // times in the upper half, slots in the lower: they change in one go
  };
  struct State {
    std::int32_t weight = 1;  // while the column is uncovered: at tick 0
    Id place = -1;            // in uncovered_
  };
  struct Change {
    Id column, slot;
  };
  struct Least {
    std::int64_t key;
    Id slot;
  };

  void add(Id row, Lookout& look);
  void drop(Id row, Lookout& look);
  void change_gains(Id column, Gain by);
  void raise_key(Id slot, std::int64_t key);
  void lower_key(Id slot, std::int64_t key);
  /// The first of the least keys of a block.
  Least least_of_block(std::size_t block) const;
  void set_least(std::size_t block, Least least) {
    least_key_[block] = least.key;
    least_slot_[block] = least.slot;
  }
  Id least_loss();
  Id best_gain(Id column);
  void weigh_uncovered(Lookout& look);
  /// Begins again with tick 0, so that sums of weights stay small.
  void restart_ticks(Lookout& look);
  void halve_weights(Lookout& look);
  std::size_t random_below(std::size_t n);

  std::vector<std::int32_t> row_ids_, column_ids_;  // as in the part
  // Rows and columns are numbered by near_order() from here on.
  FullLists rows_, columns_;
  std::vector<Id> number_;          // of each row, in the part
  std::vector<Id> rank_of_column_;  // of each column of the part
  std::int64_t bound_;
  std::uint64_t random_;
  std::int32_t step_ = 0;
  std::int32_t tick_ = 0, last_tick_;
  std::int64_t weight_limit_, weight_sum_ = 0;
  Id last_added_ = -1, last_dropped_ = -1;
  std::vector<Gain> gains_;  // of each row, and what fills up columns; valid while it is outside the cover
  std::vector<std::int32_t> moved_;  // step in which each row was added or dropped last
  std::vector<Keepers> keepers_;     // of each column, and what fills up rows
  std::vector<State> states_;  // of each column; few steps need them, so that more keepers fit the cache
  std::vector<Id> uncovered_;

  // What a row that is added or dropped changes is collected before it is changed, and gains before they are
  // compared: loops without jumps that nobody can foresee.
  std::vector<Change> first_, second_;
  std::vector<std::size_t> stale_;  // blocks
  std::vector<std::int64_t> ranks_;

  // The cover in slots; a slot's key is its row's loss and, in the low bits, when the row was moved last:
  // the least key is dropped. Blocks of slots know their least slot, groups in them their least key.
  std::vector<Id> slot_of_;              // of each row, -1 outside the cover
  std::vector<Id> row_in_;               // of each slot, -1 when it is free
  std::vector<std::int64_t> keys_;       // of each slot, free ones to fill the last block
  std::vector<std::int64_t> group_key_;  // least key of each group
  std::vector<Id> free_;                 // slots
  std::vector<std::int64_t> least_key_;  // of each block
  std::vector<Id> least_slot_;
  Least rest_{};  // of the block of the row that was added last, without that row
  bool rest_is_known_ = false;
  std::size_t size_ = 0;
  std::vector<Id> best_;
};

}  // namespace ballflow::geometry
