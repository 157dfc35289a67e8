#include "cover/certificate.hpp"

#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <utility>

#include "cover/residual.hpp"

namespace ballflow::geometry {
namespace {

PricedGroups settled_groups(const CoverState& state) {
  PricedGroups groups;
  for (std::size_t i = 0; i < state.certificate_samples.size(); ++i) {
    const std::int32_t group = state.certificate_groups[i];
    if (group >= state.settled_groups) break;
    if (group != static_cast<std::int32_t>(groups.ends.size())) groups.close();
    groups.add(state.certificate_samples[i], state.certificate_prices[i]);
  }
  groups.close();
  return groups;
}

void append(PricedGroups& groups, const PricedGroups& more) {
  const std::size_t before = groups.samples.size();
  groups.samples.insert(groups.samples.end(), more.samples.begin(), more.samples.end());
  groups.prices.insert(groups.prices.end(), more.prices.begin(), more.prices.end());
  for (const std::size_t end : more.ends) groups.ends.push_back(before + end);
}

void put(CoverState& state, PricedGroups groups, std::size_t settled) {
  std::vector<std::int32_t> numbers;
  numbers.reserve(groups.samples.size());
  for (std::size_t g = 0; g < groups.ends.size(); ++g) {
    numbers.resize(groups.ends[g], static_cast<std::int32_t>(g));
  }
  state.certificate_samples = std::move(groups.samples);
  state.certificate_prices = std::move(groups.prices);
  state.certificate_groups = std::move(numbers);
  state.settled_groups = static_cast<std::int64_t>(settled);
}

}  // namespace

void PricedGroups::add(std::int32_t sample, std::int64_t price) {
  if (price == 0) return;
  samples.push_back(sample);
  prices.push_back(static_cast<std::int32_t>(price));
}

void PricedGroups::close() {
  if (samples.size() > (ends.empty() ? 0 : ends.back())) ends.push_back(samples.size());
}

std::int64_t PricedGroups::bound() const {
  std::int64_t bound = 0;
  std::size_t i = 0;
  for (const std::size_t end : ends) {
    std::int64_t sum = 0;
    for (; i < end; ++i) sum += prices[i];
    bound += (sum + price_unit - 1) / price_unit;
  }
  return bound;
}

PricedGroups priced_groups(const CoverState& state, const std::vector<std::int32_t>& price,
                           Monitor& monitor) {
  const std::size_t columns = state.cols();
  std::vector<std::int32_t> rank(columns), parent(columns);
  std::iota(parent.begin(), parent.end(), 0);
  boost::disjoint_sets sets(rank.data(), parent.data());
  Lookout look(monitor);
  for (std::size_t i = 0; i < state.rows(); ++i) {
    look(state.row(i).size());
    std::int32_t first = -1;
    for (const std::int32_t c : state.row(i)) {
      if (price[static_cast<std::size_t>(c)] == 0) continue;
      if (first < 0) {
        first = c;
      } else {
        sets.union_set(first, c);
      }
    }
  }
  // Groups in the order of their first columns.
  std::vector<std::vector<std::int32_t>> members;
  std::vector<std::int32_t> number(columns, -1);
  for (std::size_t c = 0; c < columns; ++c) {
    if (price[c] == 0) continue;
    std::int32_t& group = number[static_cast<std::size_t>(sets.find_set(static_cast<std::int32_t>(c)))];
    if (group < 0) {
      group = static_cast<std::int32_t>(members.size());
      members.emplace_back();
    }
    members[static_cast<std::size_t>(group)].push_back(static_cast<std::int32_t>(c));
  }
  PricedGroups groups;
  for (const auto& group : members) {
    for (const std::int32_t c : group) {
      groups.add(state.column_ids[static_cast<std::size_t>(c)], price[static_cast<std::size_t>(c)]);
    }
    groups.close();
  }
  return groups;
}

void settle(CoverState& state, const PricedGroups& groups) {
  if (groups.ends.empty() || state.left_out > 0) return;
  PricedGroups all = settled_groups(state);
  append(all, groups);
  const std::int64_t bound = all.bound();
  if (bound < state.certified_bound()) return;
  const std::size_t settled = all.ends.size();
  put(state, std::move(all), settled);
  raise_lower_bound(state, bound, BoundHow::certified);
}

void prove(CoverState& state, const PricedGroups& groups) {
  if (state.left_out > 0) return;
  PricedGroups all = settled_groups(state);
  const std::size_t settled = all.ends.size();
  append(all, groups);
  const std::int64_t bound = all.bound();
  if (bound > state.certified_bound()) put(state, std::move(all), settled);
  raise_lower_bound(state, bound, BoundHow::certified);
  // More than the certificate when a solver's optimum exceeds the prices of its component.
  raise_lower_bound(state, optimal_choices(state) + groups.bound(), BoundHow::solver);
}

}  // namespace ballflow::geometry
