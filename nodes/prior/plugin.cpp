// The family "prior": shapes of one kind, laid on each other and matched ball by ball, what they have in
// common, and what follows from that for a part of another one.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* align_entry();
const bf_node* choose_template_entry();
const bf_node* match_entry();
const bf_node* shape_fit_entry();
const bf_node* shape_instance_entry();
const bf_node* shape_mesh_entry();
const bf_node* shape_prior_entry();
const bf_node* split_components_entry();
const bf_node* template_balls_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("prior", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::align_entry(),
                    ballflow::nodes::choose_template_entry(),
                    ballflow::nodes::match_entry(),
                    ballflow::nodes::shape_fit_entry(),
                    ballflow::nodes::shape_instance_entry(),
                    ballflow::nodes::shape_mesh_entry(),
                    ballflow::nodes::shape_prior_entry(),
                    ballflow::nodes::split_components_entry(),
                    ballflow::nodes::template_balls_entry(),
                }),
                ballflow::type_entries<>())
