// A run, or a sweep, as one page: what ran, what came out, and how to run it again.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "ballflow/history.hpp"
#include "ballflow/registry.hpp"
#include "report/picture.hpp"

namespace ballflow::report {

struct ReportInput {
  RunRecord run;
  Manifests manifests;                 // of the run; may be empty
  const Registry* registry = nullptr;  // what nodes are and what they cite
  std::vector<std::string> facts;      // what matters most, in words
  /// What to do about a warning; may be empty, and so may its answers.
  std::function<std::string(const std::string& warning)> remedy;
  std::map<std::string, std::string> words;  // what outputs of the graph are, by their names
  std::vector<Picture> pictures;
  std::size_t pictures_left_out = 0;  // outputs that could be drawn and were not
};

/// One HTML file without scripts; it loads nothing. Everything in it that comes from graphs, reports and
/// plugins is escaped.
std::string report_page(const ReportInput& input);

}  // namespace ballflow::report
