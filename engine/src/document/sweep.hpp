// Sweeps: which variants a graph has.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "document/findings.hpp"
#include "document/setting.hpp"

namespace ballflow {

constexpr std::size_t max_variants = 100'000;
constexpr std::size_t longest_variant_name = 200;  // bytes; a file name has at most 255

struct Sweep {
  struct Axis {
    std::string name;
    std::vector<PlacedSetting> values;
    std::vector<std::string> labels;  // of the values: short, unique, without / [ ] , = and blanks
  };
  using Choice = std::vector<std::uint32_t>;  // a value of every axis

  std::vector<Axis> axes;
  std::vector<Choice> variants;

  /// "epsilon=0.1,strategy=greedy"
  std::string name_of(const Choice& choice) const;
  /// "epsilon=0.1", fit for a path of a node and the name of a folder.
  std::string label_of(std::size_t axis, std::uint32_t value) const;
};

/// The variants of a graph; none when nothing is swept. What is wrong becomes findings; there is at least
/// one variant even then, so that the rest of the graph can be checked with it.
std::optional<Sweep> plan_sweep(const GraphFile& top, const std::vector<PlacedSetting>& sets,
                                const SweepOptions& options, Findings& findings);

}  // namespace ballflow
