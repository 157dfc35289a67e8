// The family "axis": the medial axis of a union of balls.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* medial_axis_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("axis", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::medial_axis_entry(),
                }),
                ballflow::type_entries<>())
