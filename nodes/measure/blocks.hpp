// Work on very many samples: in blocks on all cores, with results in a fixed order, and within a budget.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.hpp"
#include "base/shared_progress.hpp"

namespace ballflow::geometry {

/// Runs body(first, last, result) for the blocks [first, last) of [0, count), and returns their results in
/// order.
template <class Result, class Body>
std::vector<Result> by_blocks(std::size_t count, std::size_t block, Monitor& monitor, const Body& body) {
  const std::size_t blocks = (count + block - 1) / block;
  std::vector<Result> results(blocks);
  SharedProgress progress(monitor, blocks);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    body(b * block, std::min(count, (b + 1) * block), results[b]);
    progress.advance(1);
  });
  return results;
}

/// What all threads together may make of something.
class Budget {
 public:
  Budget(std::int64_t most, std::string what) : most_(most), what_(std::move(what)) {}

  /// Throws InputError once more than the budget is spent.
  void spend(std::int64_t count) {
    if ((spent_ += count) <= most_) return;
    constexpr std::int64_t million = 1'000'000;
    const std::string limit =
        most_ % million == 0 ? std::to_string(most_ / million) + " million" : std::to_string(most_);
    throw InputError("the spacing needs more than " + limit + " " + what_,
                     "set a larger spacing, or compare fewer balls");
  }

 private:
  std::int64_t most_;
  std::string what_;
  std::atomic<std::int64_t> spent_{0};
};

}  // namespace ballflow::geometry
