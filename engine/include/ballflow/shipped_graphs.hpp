// The graphs that come with ballflow, which are found by name from any folder: "medial_axis" is
// graphs/medial_axis.json, "experiments/table_3_3" is graphs/experiments/table_3_3.json. Files in other
// folders beside them are parts of these graphs and have no name.
#pragma once

#include <string>
#include <vector>

#include "ballflow/registry.hpp"

namespace ballflow {

struct ShippedGraph {
  std::string name;  // "medial_axis", "experiments/table_3_3"
  std::string doc;   // the "doc" of the graph, on one line
  std::string file;  // its path
};

/// The folder of the graphs that belong to a folder of node libraries: ../../share/ballflow/graphs of it,
/// where both are installed together as in the build folder. Hosts that keep their node libraries elsewhere
/// than programs do (a Python package) give the folder that they give to Registry::load().
std::string shipped_graphs_folder(const std::string& libraries = Registry::default_folder());

/// All of them by name, those of experiments/ last. Throws Error (code store) when the folder cannot be read.
std::vector<ShippedGraph> shipped_graphs(const std::string& folder = shipped_graphs_folder());

/// Their names alone, in the same order, without reading a file; none where there is no folder.
std::vector<std::string> shipped_graph_names(const std::string& folder = shipped_graphs_folder());

/// The file that a user means by `text`, a path or the name of a shipped graph. What is there under this path
/// and is no folder always comes first. A path that leads nowhere ("absent.json", "./absent") is returned as
/// it is: whoever opens it says why it cannot be read. Throws Error (code usage) with the nearest names for
/// what is neither.
std::string find_graph(const std::string& text, const std::string& folder = shipped_graphs_folder());

}  // namespace ballflow
