// The family "volume": segmented images.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* label_surface_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("volume", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::label_surface_entry(),
                }),
                ballflow::type_entries<>())
