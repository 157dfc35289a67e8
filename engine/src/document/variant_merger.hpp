// The DAGs of the variants of a sweep in one.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/sweep.hpp"

namespace ballflow {

/// Puts the DAGs of the variants together.
class VariantMerger {
 public:
  explicit VariantMerger(const Sweep& sweep);
  /// To be called for every variant in turn.
  void add(Dag variant);
  std::size_t nodes() const { return dag_.nodes.size(); }
  Dag finish();

 private:
  struct Shared {
    std::size_t first = 0;     // the first variant that has it
    std::vector<bool> common;  // by axis: its value is the same in all variants that have it
  };

  const Sweep& sweep_;
  Dag dag_;
  std::vector<Shared> shared_;                          // by node
  std::unordered_map<std::string, std::size_t> known_;  // by what a node is
};

}  // namespace ballflow
