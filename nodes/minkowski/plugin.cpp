// The family "minkowski": sums of unions of balls.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* minkowski_sum_entry();
const bf_node* minkowski_sum_2_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("minkowski", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::minkowski_sum_entry(),
                    ballflow::nodes::minkowski_sum_2_entry(),
                }),
                ballflow::type_entries<>())
