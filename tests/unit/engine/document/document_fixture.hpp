// What the tests of graph documents have in common.
#pragma once

#include <string>
#include <vector>

#include "ballflow/graph.hpp"
#include "toy_nodes.hpp"

namespace ballflow {

inline const Registry& registry() {
  static const Registry toy = test::toy_registry();
  return toy;
}

inline std::vector<std::string> paths(const Dag& dag) {
  std::vector<std::string> result;
  for (const DagNode& node : dag.nodes) result.push_back(node.path);
  return result;
}

}  // namespace ballflow
