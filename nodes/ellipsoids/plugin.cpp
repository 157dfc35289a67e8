// The family "ellipsoids": balls of a stretched object, as ellipsoids of the object.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* apply_scaling_entry();
const bf_node* ellipsoid_matrix_entry();
const bf_node* principal_scaling_entry();
const bf_node* scale_back_entry();
const bf_node* select_ellipsoids_entry();
const bf_node* verify_ellipsoids_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("ellipsoids", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::apply_scaling_entry(),
                    ballflow::nodes::ellipsoid_matrix_entry(),
                    ballflow::nodes::principal_scaling_entry(),
                    ballflow::nodes::scale_back_entry(),
                    ballflow::nodes::select_ellipsoids_entry(),
                    ballflow::nodes::verify_ellipsoids_entry(),
                }),
                ballflow::type_entries<>())
