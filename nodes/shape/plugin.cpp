// The family "shape": what is computed from a union of balls.
#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
const bf_node* alpha_shape_entry();
const bf_node* medial_axis_entry();
const bf_node* compare_entry();
const bf_node* union_measure_entry();
const bf_node* topology_entry();
const bf_node* topology_repair_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("shape", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::alpha_shape_entry(),
                    ballflow::nodes::medial_axis_entry(),
                    ballflow::nodes::compare_entry(),
                    ballflow::nodes::union_measure_entry(),
                    ballflow::nodes::topology_entry(),
                    ballflow::nodes::topology_repair_entry(),
                }),
                (ballflow::type_entries<ballflow::geometry::Balls, ballflow::geometry::SimplicialComplex,
                                        ballflow::geometry::MedialAxis, ballflow::geometry::PointSet,
                                        ballflow::geometry::TriangleMesh, ballflow::geometry::Comparison,
                                        ballflow::geometry::MassProperties, ballflow::geometry::TopologyTable,
                                        ballflow::geometry::TopologyCheck, ballflow::geometry::CoverState>()))
