// The family "mesh": surfaces as triangles.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* ball_mesh_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("mesh", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::ball_mesh_entry(),
                }),
                ballflow::type_entries<>())
