// The memory of a run: what the nodes that run say they need, and what outputs take that somebody still
// needs.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "ballflow/artifact.hpp"

namespace ballflow {

/// Decides which nodes may start: the sum of the claims of running nodes and of the artifacts that are held
/// stays under the budget. Where nothing runs that could free anything, start_one() exceeds it. Functions may
/// be called from several threads.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t bytes) : bytes_(bytes) {}

  /// Whether node `i` may start now; then its claim is taken. Otherwise it waits until end() or
  /// admit_waiting() names it; `waits` is called before that can happen. `claim`: bytes that it will need,
  /// its outputs included. `reads_held`: bytes of held artifacts that it reads. Who reads most starts first,
  /// and who reads nothing that is held, and so only adds to it, does not pass one that does.
  bool start(std::size_t i, std::uint64_t claim, std::uint64_t reads_held,
             const std::function<void()>& waits);
  /// Gives the claim of a node back. Nodes that waited and may start now: their claims are taken.
  std::vector<std::size_t> end(std::size_t i);

  /// An artifact in the memory of this process is kept. Keeping one twice counts once, letting go is due for
  /// each.
  void hold(const ArtifactPtr& artifact);
  /// Somebody else keeps it as well; does nothing for an artifact that is not held.
  void share(const ArtifactPtr& artifact);
  /// Does nothing for an artifact that was never held: one that is mapped from the store costs no memory that
  /// the system could not take back.
  void let_go(const ArtifactPtr& artifact);
  /// Nodes that waited and may start now that artifacts were let go.
  std::vector<std::size_t> admit_waiting();
  /// The first of those that wait, whatever it claims; to be called when nothing runs and nothing else can
  /// start.
  std::vector<std::size_t> start_one();
  std::uint64_t held(const ArtifactPtr& artifact) const;

  /// Claims and held artifacts, in bytes.
  std::uint64_t used() const { return used_.load(std::memory_order_relaxed); }
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Waiting {
    std::uint64_t reads_held;
    std::size_t node;
    std::uint64_t claim;
    bool operator<(const Waiting& other) const {
      return std::tuple(~reads_held, node) < std::tuple(~other.reads_held, other.node);
    }
  };
  bool fits(std::uint64_t claim) const;
  void take(std::size_t i, std::uint64_t claim);
  std::set<Waiting>::iterator take_waiting(std::set<Waiting>::iterator one, std::vector<std::size_t>& taken);
  std::vector<std::size_t> pick();

  const std::uint64_t bytes_;
  mutable std::mutex mutex_;
  std::atomic<std::uint64_t> used_{0};                     // written under mutex_
  std::unordered_map<std::size_t, std::uint64_t> claims_;  // of the nodes that run
  std::unordered_map<const Artifact*, std::size_t> held_;  // how often
  std::set<Waiting> waiting_;
  std::multiset<std::uint64_t> waiting_claims_;  // the least ends a search early
};

}  // namespace ballflow
