// Sweeps: which variants a graph has, and their DAGs in one.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/expand.hpp"

namespace ballflow {

constexpr std::size_t max_variants = 100'000;

struct Sweep {
  struct Axis {
    std::string name;
    std::vector<Setting> values;
    std::vector<std::string> labels;  // of the values: short, unique, without / [ ] , = and blanks
  };
  using Choice = std::vector<std::uint32_t>;  // a value of every axis

  std::vector<Axis> axes;
  std::vector<Choice> variants;

  std::string name_of(const Choice& choice) const;
};

/// The variants of a graph; none when nothing is swept. What is wrong becomes findings; there is at least
/// one variant even then, so that the rest of the graph can be checked with it.
std::optional<Sweep> plan_sweep(const GraphFile& top, const std::vector<Setting>& sets,
                                const SweepOptions& options, Findings& findings);

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
