#include "topology/topology.hpp"

#include <optional>
#include <string>
#include <vector>

#include "homology/axis_betti.hpp"

namespace ballflow::geometry {

TopologyTable topology(const TopologyInputs& stages, Monitor& monitor) {
  std::vector<TopologyTable> rows;
  const auto take = [&](TopologyStage stage, const TopologyTable* table) {
    if (table == nullptr) return;
    if (table->size() > 1 || (table->size() == 1 && !table->row(stage))) {
      throw InputError("input " + std::string(name(stage)) + " has rows of other stages",
                       "connect SolidTopology for the surface, and UnionTopology with the stage of the input "
                       "for balls");
    }
    rows.push_back(*table);
  };
  take(TopologyStage::surface, stages.surface);
  take(TopologyStage::inner, stages.inner);
  take(TopologyStage::enlarged, stages.enlarged);
  take(TopologyStage::kept, stages.kept);
  if (stages.complex != nullptr) rows.push_back(one_row(TopologyStage::complex, stages.complex->betti));
  if (stages.axis != nullptr) rows.push_back(one_row(TopologyStage::axis, axis_betti(*stages.axis, monitor)));

  std::vector<std::uint8_t> names;
  std::vector<Betti> betti;
  std::vector<std::int64_t> euler;
  for (const TopologyTable& row : rows) {
    names.insert(names.end(), row.stages.begin(), row.stages.end());
    betti.insert(betti.end(), row.betti.begin(), row.betti.end());
    euler.insert(euler.end(), row.euler.begin(), row.euler.end());
  }
  if (names.empty()) {
    throw InputError(
        "nothing has a topology: no surface with triangles, no balls, no complex, no axis is connected",
        "connect at least one input of the node");
  }
  TopologyTable table{std::move(names), std::move(betti), std::move(euler)};
  std::string text;
  for (const std::string& change : topology_changes(table)) text += (text.empty() ? "" : "; ") + change;
  if (!text.empty()) monitor.warn(text);
  monitor.step(1);
  return table;
}

}  // namespace ballflow::geometry
