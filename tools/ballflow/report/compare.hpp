// Runs and variants of sweeps side by side, from their reports.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballflow/history.hpp"

namespace ballflow::cli {

/// One row per run, or per variant of a run of a sweep.
struct Comparison {
  struct Column {
    std::string name;
    bool number = false;
  };
  std::vector<Column> columns;
  std::vector<std::vector<nlohmann::json>> rows;  // null: there is no such value
  std::vector<std::string> left_out;  // fields that differ, too, but would make the table too wide
  bool shared = false;                // there are costs that variants share
};

constexpr std::size_t most_fields = 8;  // of a table that nobody asked for particular fields

/// Columns: the run when there are several; parameters (of variants: the axes; of several runs: also the
/// parameters of the graph that differ); fields; the status when it is not ok everywhere; seconds, shared
/// seconds, nodes run, nodes from the cache.
///
/// `fields`: "cover.balls" is a field of the summary of an output of the graph, "prune.cover.balls" of an
/// output of a subgraph, "dmt.poles.poles.count" of a port of a node, "enlarge.epsilon" a parameter of a
/// node. A name of an output or port alone stands for all its fields, "all" for those of all outputs. Without
/// fields: those of the outputs that differ between the rows. Throws Error (code usage) when no row has a
/// field.
Comparison compare(const std::vector<RunRecord>& runs, const std::vector<std::string>& fields);

/// "text" (aligned), "csv" (RFC 4180), "md", "json" (a list of objects).
std::string render(const Comparison& comparison, std::string_view format);

}  // namespace ballflow::cli
