// How far loops have come, kept for the job that goes on with them.
//
// A loop is one node: its iterations are in no cache, and a job that ends before it would lose all of them.
// So a cancelled loop, as by the signal that comes before a time limit, leaves what its last whole iteration
// gave. The key of that is
//   SHA-256 of "state of a loop\n<key of the loop, hexadecimal>\n<number>\n"
// with 1 for the first job that was cancelled, 2 for the second, ...; the entry is like that of a node: the
// states are its outputs, its manifest is
//   {"node":"state of a loop","loop":"<key>","number":1,"iterations":120}
// Nothing in the upstream changes, so each job adds a number; of those that are there the one with the most
// iterations is taken. Two copies of one job may leave different states under one number: the first one
// stays, and either is right. What is damaged counts as missing.
#pragma once

#include <functional>
#include <optional>

#include "ballflow/executor.hpp"
#include "ballflow/store.hpp"

namespace ballflow {

/// A state, and what it took to get there.
struct KeptLoop {
  LoopState state;
  double seconds = 0, cpu_seconds = 0;
};

class LoopStates {
 public:
  LoopStates(Store& store, const Loop& loop, const Digest& key) : store_(store), loop_(loop), key_(key) {}

  /// The one to go on with; nothing when there is none. `tell` is called with what was found damaged.
  std::optional<KeptLoop> latest(const std::function<void(const std::string&)>& tell);
  /// Leaves a state that has come further than the latest. Throws Error when it cannot be published. Only
  /// after latest().
  void put(const KeptLoop& kept);

 private:
  Store& store_;
  const Loop& loop_;
  const Digest key_;
  std::int64_t next_ = 1;  // the number that is free
};

}  // namespace ballflow
