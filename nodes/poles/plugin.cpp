// The family "poles": polar balls of samples.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* voronoi_poles_entry();
const bf_node* label_poles_entry();
const bf_node* local_feature_size_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("poles", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::voronoi_poles_entry(),
                    ballflow::nodes::label_poles_entry(),
                    ballflow::nodes::local_feature_size_entry(),
                }),
                ballflow::type_entries<>())
