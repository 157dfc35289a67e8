#include "types/cover_state.hpp"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace ballflow::geometry {
namespace {

std::string entry(const char* array, std::size_t i) {
  return std::string(array) + "[" + std::to_string(i) + "]";
}

/// Empty when `ids` ascends strictly and stays in [0, limit).
std::string broken_ids(const char* name, std::span<const std::int32_t> ids, std::int64_t limit) {
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] < 0 || ids[i] >= limit) {
      return entry(name, i) + " = " + std::to_string(ids[i]) + " is not in [0, " + std::to_string(limit) +
             ")";
    }
    if (i > 0 && ids[i] <= ids[i - 1]) {
      return entry(name, i) + " = " + std::to_string(ids[i]) + " does not ascend";
    }
  }
  return {};
}

std::string broken_matrix(const CoverState& state) {
  if (state.row_offsets.size() != state.rows() + 1) {
    return "row_offsets has " + std::to_string(state.row_offsets.size()) + " entries for " +
           std::to_string(state.rows()) + " rows; one more than rows is expected";
  }
  if (state.row_offsets.front() != 0) return "row_offsets[0] is not 0";
  if (state.row_offsets.back() != static_cast<std::int64_t>(state.nnz())) {
    return "the last of row_offsets is " + std::to_string(state.row_offsets.back()) + ", but columns has " +
           std::to_string(state.nnz()) + " entries";
  }
  for (std::size_t i = 0; i < state.rows(); ++i) {
    if (state.row_offsets[i + 1] < state.row_offsets[i]) return entry("row_offsets", i + 1) + " descends";
  }
  std::vector<bool> met(state.cols());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    std::int32_t last = -1;
    for (const std::int32_t column : state.row(i)) {
      if (column < 0 || static_cast<std::size_t>(column) >= state.cols()) {
        return "row " + std::to_string(i) + " has column " + std::to_string(column) + " of " +
               std::to_string(state.cols());
      }
      if (column <= last)
        return "row " + std::to_string(i) + " does not ascend at column " + std::to_string(column);
      last = column;
      met[static_cast<std::size_t>(column)] = true;
    }
  }
  const auto empty = std::find(met.begin(), met.end(), false);
  if (empty != met.end()) {
    return "column " + std::to_string(empty - met.begin()) +
           " is in no row: a sample that no ball covers belongs in uncovered";
  }
  return {};
}

std::string broken_choices(const CoverState& state) {
  if (state.chosen_how.size() != state.chosen.size()) {
    return "chosen has " + std::to_string(state.chosen.size()) + " entries, chosen_how " +
           std::to_string(state.chosen_how.size());
  }
  // A chosen ball has left the matrix, and is chosen once.
  std::vector<bool> gone(static_cast<std::size_t>(state.balls));
  for (const std::int32_t ball : state.row_ids) gone[static_cast<std::size_t>(ball)] = true;
  for (std::size_t i = 0; i < state.chosen.size(); ++i) {
    const std::int32_t ball = state.chosen[i];
    if (ball < 0 || ball >= state.balls) {
      return entry("chosen", i) + " = " + std::to_string(ball) + " is not in [0, " +
             std::to_string(state.balls) + ")";
    }
    if (gone[static_cast<std::size_t>(ball)]) {
      return entry("chosen", i) + " = " + std::to_string(ball) + " is chosen twice or still a row";
    }
    gone[static_cast<std::size_t>(ball)] = true;
    if (state.chosen_how[i] > static_cast<std::uint8_t>(Choice::returned)) {
      return entry("chosen_how", i) + " = " + std::to_string(state.chosen_how[i]) + " is no Choice";
    }
  }
  return {};
}

std::string broken_certificate(const CoverState& state) {
  const std::size_t listed = state.certificate_samples.size();
  if (state.certificate_prices.size() != listed || state.certificate_groups.size() != listed) {
    return "certificate_samples has " + std::to_string(listed) + " entries, certificate_prices " +
           std::to_string(state.certificate_prices.size()) + ", certificate_groups " +
           std::to_string(state.certificate_groups.size());
  }
  std::vector<bool> met(static_cast<std::size_t>(state.samples));
  std::int32_t group = -1;
  for (std::size_t i = 0; i < listed; ++i) {
    const std::int32_t sample = state.certificate_samples[i], price = state.certificate_prices[i];
    if (sample < 0 || sample >= state.samples) {
      return entry("certificate_samples", i) + " = " + std::to_string(sample) + " is not in [0, " +
             std::to_string(state.samples) + ")";
    }
    if (met[static_cast<std::size_t>(sample)]) {
      return entry("certificate_samples", i) + " = " + std::to_string(sample) + " is listed twice";
    }
    met[static_cast<std::size_t>(sample)] = true;
    if (price < 1 || price > price_unit) {
      return entry("certificate_prices", i) + " = " + std::to_string(price) + " is not in [1, " +
             std::to_string(price_unit) + "]";
    }
    const bool next_group = state.certificate_groups[i] == group + 1;
    if (!next_group && (state.certificate_groups[i] != group || group < 0)) {
      return entry("certificate_groups", i) + " = " + std::to_string(state.certificate_groups[i]) +
             " does not ascend by steps of 1 from 0";
    }
    if (!next_group && sample < state.certificate_samples[i - 1]) {
      return entry("certificate_samples", i) + " = " + std::to_string(sample) +
             " does not ascend in its group";
    }
    group = state.certificate_groups[i];
  }
  if (state.settled_groups < 0 || state.settled_groups > group + 1) {
    return "settled_groups = " + std::to_string(state.settled_groups) + " is not in [0, " +
           std::to_string(group + 1) + "], the number of groups";
  }
  if (state.lower_bound_how == static_cast<std::uint8_t>(BoundHow::certified) &&
      state.lower_bound > state.certified_bound()) {
    return "lower_bound = " + std::to_string(state.lower_bound) +
           " is called certified, but the certificate claims " + std::to_string(state.certified_bound());
  }
  if (listed > 0 && state.certified_bound() > state.lower_bound) {
    return "lower_bound = " + std::to_string(state.lower_bound) + " is less than its certificate claims, " +
           std::to_string(state.certified_bound());
  }
  return {};
}

}  // namespace

std::int64_t CoverState::certified_bound() const {
  std::int64_t bound = 0, sum = 0;
  for (std::size_t i = 0; i < certificate_samples.size(); ++i) {
    sum += certificate_prices[i];
    if (i + 1 < certificate_samples.size() && certificate_groups[i + 1] == certificate_groups[i]) continue;
    bound += (sum + price_unit - 1) / price_unit;
    sum = 0;
  }
  return bound;
}

std::int64_t CoverState::count(Choice how) const {
  return std::count(chosen_how.begin(), chosen_how.end(), static_cast<std::uint8_t>(how));
}

std::optional<std::int64_t> CoverState::upper_bound() const {
  if (remaining() != 0) return std::nullopt;
  return static_cast<std::int64_t>(chosen.size());
}

std::optional<double> CoverState::gap() const {
  const auto upper = upper_bound();
  if (!upper || lower_bound < 0) return std::nullopt;
  if (*upper == lower_bound) return 0.0;
  if (lower_bound == 0) return std::nullopt;
  return static_cast<double>(*upper - lower_bound) / static_cast<double>(lower_bound);
}

std::string broken_invariant(const CoverState& state) {
  constexpr std::int64_t most = std::numeric_limits<std::int32_t>::max();
  if (state.balls < 0 || state.balls > most)
    return "balls = " + std::to_string(state.balls) + " is out of range";
  if (state.samples < 0 || state.samples > most) {
    return "samples = " + std::to_string(state.samples) + " is out of range";
  }
  if (state.left_out < 0 || state.left_out > state.balls) {
    return "left_out = " + std::to_string(state.left_out) + " of " + std::to_string(state.balls) + " balls";
  }
  if (auto broken = broken_ids("row_ids", state.row_ids, state.balls); !broken.empty()) return broken;
  if (auto broken = broken_ids("column_ids", state.column_ids, state.samples); !broken.empty()) return broken;
  if (auto broken = broken_ids("uncovered", state.uncovered, state.samples); !broken.empty()) return broken;
  std::vector<std::int32_t> both;
  std::set_intersection(state.column_ids.begin(), state.column_ids.end(), state.uncovered.begin(),
                        state.uncovered.end(), std::back_inserter(both));
  if (!both.empty()) return "sample " + std::to_string(both.front()) + " is uncovered and in a column";
  if (auto broken = broken_matrix(state); !broken.empty()) return broken;
  if (auto broken = broken_choices(state); !broken.empty()) return broken;
  if (state.lower_bound < -1) return "lower_bound = " + std::to_string(state.lower_bound) + " is below -1";
  const auto upper = state.upper_bound();
  if (upper && state.lower_bound > *upper) {
    return "lower_bound = " + std::to_string(state.lower_bound) + " exceeds the cover found, " +
           std::to_string(*upper) + " balls";
  }
  if (state.lower_bound_how > static_cast<std::uint8_t>(BoundHow::certified)) {
    return "lower_bound_how = " + std::to_string(state.lower_bound_how) + " is no BoundHow";
  }
  if ((state.lower_bound < 0) != (state.lower_bound_how == 0)) {
    return "lower_bound = " + std::to_string(state.lower_bound) +
           " with lower_bound_how = " + std::to_string(state.lower_bound_how) +
           ": a bound has a ground, and no bound has none";
  }
  return broken_certificate(state);
}

}  // namespace ballflow::geometry
