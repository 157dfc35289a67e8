// A plugin inside the test: small nodes whose executions are counted. Compiled once, in run_nodes.cpp,
// because each file that instantiates them takes a quarter of a minute.
//
//   Source    value, count -> numbers            Add       a [, b] -> sum
//   Round     numbers -> rounded                 Concat    lists [, last] -> all, a port that takes a list
//   Slow      numbers, seconds -> numbers        Fail      always
//   Step      numbers, by, fail_at -> numbers    Noisy     another result each time
//   Threads   the number of threads              Busy      40 ms of CPU time
//   Negative  an output that its type forbids    Heavy     says that it needs 60 B
//   FromFile  the number in a file               Babble    messages that are no text
//   Total     the sum of the numbers in the files that a file names
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "ballflow/plugin.h"

namespace toy {

struct Counters {
  std::atomic<int> source{0}, add{0}, round{0}, slow{0}, fail{0}, noisy{0}, heavy{0};
  std::atomic<int> heavy_now{0}, heavy_most{0};
};
inline Counters counters;
inline std::atomic<bool> steady_noise{false};  // Noisy gives the same again
inline std::atomic<bool> holding{false};       // Slow and Heavy do not end while it is set, up to a minute
inline std::atomic<std::uint64_t> granted{0};  // what Heavy and Step were told of the memory of the run
/// FromFile calls it with the file before it reads.
inline std::function<void(const std::string&)> before_reading;
inline void reset() {
  counters.source = counters.add = counters.round = counters.slow = counters.fail = counters.noisy =
      counters.heavy = 0;
  counters.heavy_now = counters.heavy_most = 0;
  granted = 0;
  holding = false;
}

/// The nodes above and their type Numbers.
const bf_plugin& plugin();

}  // namespace toy
