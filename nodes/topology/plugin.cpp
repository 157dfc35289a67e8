// The family "topology": components, tunnels and cavities, from the surface to the medial axis.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* solid_topology_entry();
const bf_node* topology_entry();
const bf_node* topology_repair_entry();
const bf_node* union_topology_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("topology", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::solid_topology_entry(),
                    ballflow::nodes::topology_entry(),
                    ballflow::nodes::topology_repair_entry(),
                    ballflow::nodes::union_topology_entry(),
                }),
                ballflow::type_entries<>())
