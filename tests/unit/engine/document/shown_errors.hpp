// What is wrong with a graph, as tests compare it.
#pragma once

#include <string>
#include <vector>

#include "ballflow/graph.hpp"

namespace ballflow {

/// A line per error with its place, and its hint below; no carets, no warnings.
inline std::string shown(const std::vector<Diagnostic>& findings) {
  std::string text;
  for (const Diagnostic& d : findings) {
    if (d.severity == Diagnostic::Severity::warning) continue;
    text += d.file + ":" + std::to_string(d.line) + ":" + std::to_string(d.column) + ": " + d.message +
            " (at " + d.pointer + ")\n";
    if (!d.hint.empty()) text += "  " + d.hint + "\n";
  }
  return text;
}

}  // namespace ballflow
