// The family "motion": distances of unions of balls, and what moves among them.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* distance_entry();
const bf_node* find_way_entry();
const bf_node* mirror_entry();
const bf_node* path_balls_entry();
const bf_node* subtract_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("motion", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::distance_entry(),
                    ballflow::nodes::find_way_entry(),
                    ballflow::nodes::mirror_entry(),
                    ballflow::nodes::path_balls_entry(),
                    ballflow::nodes::subtract_entry(),
                }),
                ballflow::type_entries<>())
