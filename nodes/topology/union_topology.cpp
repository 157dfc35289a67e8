#include "topology/union_topology.hpp"

#include <string>

#include "power/union_betti.hpp"

namespace ballflow::geometry {
namespace {

void check(TopologyStage stage) {
  if (stage == TopologyStage::inner || stage == TopologyStage::enlarged || stage == TopologyStage::kept)
    return;
  throw InputError("stage " + std::string(name(stage)) + " is no union of balls",
                   "use stage inner, enlarged or kept");
}

}  // namespace

TopologyTable union_row(const Balls& balls, const UnionTopologyOptions& options, Monitor& monitor) {
  check(options.stage);
  const bool polar = options.stage == TopologyStage::inner;
  const Betti betti = union_betti(balls, polar ? AlphaTolerance::polar : AlphaTolerance::none, monitor);
  monitor.step(1);
  return one_row(options.stage, betti);
}

TopologyTable union_row(const PowerDiagram& diagram, const UnionTopologyOptions& options, Monitor& monitor) {
  check(options.stage);
  const Betti betti = union_betti(diagram, monitor);
  monitor.step(1);
  return one_row(options.stage, betti);
}

}  // namespace ballflow::geometry
