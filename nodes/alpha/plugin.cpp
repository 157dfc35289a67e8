// The family "alpha": the dual complex of a union of balls.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* alpha_shape_entry();
const bf_node* power_diagram_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("alpha", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::alpha_shape_entry(),
                    ballflow::nodes::power_diagram_entry(),
                }),
                ballflow::type_entries<>())
