// Work on many things in parallel, in blocks that do not depend on the number of threads.
#pragma once

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "base/monitor.hpp"

namespace ballflow::geometry {

inline std::size_t blocks_of(std::size_t count, std::size_t block) { return (count + block - 1) / block; }

/// Runs body(b, first, last) for all blocks b of `count` things, [first, last) each, in parallel; the
/// progress goes from `begin` to `end`. What a body writes belongs to its block: merged in the order of
/// blocks, the result is the same for any number of threads. Throws what a body throws, and Cancelled.
template <class Body>
void for_each_block(std::size_t count, std::size_t block, Monitor& monitor, double begin, double end,
                    Body body) {
  std::atomic<std::size_t> done{0};
  const std::size_t blocks = blocks_of(count, block);
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t b) {
    body(b, b * block, std::min(count, (b + 1) * block));
    monitor.step(begin + (end - begin) * static_cast<double>(++done) / static_cast<double>(blocks));
  });
}

}  // namespace ballflow::geometry
