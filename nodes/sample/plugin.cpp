// The family "sample": models, samples and balls from files and formulas.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* load_balls_entry();
const bf_node* sample_entry();
const bf_node* sample_mesh_entry();
const bf_node* shape_entry();
const bf_node* wrap_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("sample", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::load_balls_entry(),
                    ballflow::nodes::sample_entry(),
                    ballflow::nodes::sample_mesh_entry(),
                    ballflow::nodes::shape_entry(),
                    ballflow::nodes::wrap_entry(),
                }),
                ballflow::type_entries<>())
