// The end of a loop: "cover.remaining == 0 or cover.gap < 0.01 and cover.greedy >= 5".
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "ballflow/graph.hpp"

namespace ballflow {

/// What is wrong with a condition, and where in its text.
struct UntilProblem {
  std::size_t at = 0;
  std::string message, hint;
};

/// Reads a condition: comparisons of a field with a number, joined by `and` and `or`; `and` binds first. The
/// outer list is joined by `or`. Checks every comparison with `check`, which reports to `problems`; a syntax
/// error is the last problem.
std::vector<std::vector<Loop::Comparison>> parse_until(
    const std::string& text, std::vector<UntilProblem>& problems,
    const std::function<void(const Loop::Comparison&, std::size_t state_at, std::size_t field_at)>& check);

/// The value of a comparison's field; nothing for null. Throws Error (code node_failed) when the summary has
/// no such field or it is no number.
std::optional<double> summary_number(const Artifact& artifact, const Loop::Comparison& comparison);

/// Whether the condition of `loop` holds for these states.
bool until_holds(const Loop& loop, const std::map<std::string, ArtifactPtr>& states);

}  // namespace ballflow
