// The family "balls": from balls to balls.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* enlarge_entry();
const bf_node* minimal_union_entry();
const bf_node* select_balls_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("balls", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::enlarge_entry(),
                    ballflow::nodes::minimal_union_entry(),
                    ballflow::nodes::select_balls_entry(),
                }),
                ballflow::type_entries<>())
