// The family "refine": samples that follow the shape.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* refine_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("refine", "0.1.0", (std::vector<const bf_node*>{ballflow::nodes::refine_entry()}),
                ballflow::type_entries<>())
