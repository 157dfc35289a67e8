// The family "robot": robots, their links, and balls for them.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* link_balls_entry();
const bf_node* load_robot_spheres_entry();
const bf_node* read_robot_entry();
const bf_node* robot_link_entry();
const bf_node* robot_spheres_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("robot", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::link_balls_entry(),
                    ballflow::nodes::load_robot_spheres_entry(),
                    ballflow::nodes::read_robot_entry(),
                    ballflow::nodes::robot_link_entry(),
                    ballflow::nodes::robot_spheres_entry(),
                }),
                ballflow::type_entries<>())
