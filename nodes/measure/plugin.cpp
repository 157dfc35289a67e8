// The family "measure": what a union of balls measures, and how far it is from a surface.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* compare_ellipsoids_entry();
const bf_node* compare_entry();
const bf_node* union_measure_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("measure", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::compare_ellipsoids_entry(),
                    ballflow::nodes::compare_entry(),
                    ballflow::nodes::union_measure_entry(),
                }),
                ballflow::type_entries<>())
