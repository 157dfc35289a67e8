// The family "enclose": balls that contain everything inside a surface, that are contained in it, or in
// between.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* allocate_balls_entry();
const bf_node* ball_count_entry();
const bf_node* enclose_balls_entry();
const bf_node* inside_balls_entry();
const bf_node* one_sided_balls_entry();
const bf_node* protrude_balls_entry();
const bf_node* verify_enclosure_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("enclose", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::allocate_balls_entry(), ballflow::nodes::ball_count_entry(),
                    ballflow::nodes::enclose_balls_entry(), ballflow::nodes::inside_balls_entry(),
                    ballflow::nodes::one_sided_balls_entry(), ballflow::nodes::protrude_balls_entry(),
                    ballflow::nodes::verify_enclosure_entry()}),
                ballflow::type_entries<>())
