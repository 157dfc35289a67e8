#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
const bf_node* load_balls_entry();
const bf_node* sample_entry();
const bf_node* shape_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("sample", "0.1.0",
                (std::vector<const bf_node*>{ballflow::nodes::load_balls_entry(),
                                             ballflow::nodes::sample_entry(),
                                             ballflow::nodes::shape_entry()}),
                (ballflow::type_entries<ballflow::geometry::PointSet, ballflow::geometry::TriangleMesh,
                                        ballflow::geometry::Balls, ballflow::geometry::MedialAxis>()))
