// The family "enclose": balls that contain everything inside a surface.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* verify_enclosure_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("enclose", "0.1.0", (std::vector<const bf_node*>{ballflow::nodes::verify_enclosure_entry()}),
                ballflow::type_entries<>())
