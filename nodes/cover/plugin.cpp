// The family "cover": few balls that cover a sample, and how few any cover needs.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* bisect_entry();
const bf_node* bisect_error_entry();
const bf_node* cover_matrix_entry();
const bf_node* cover_points_entry();
const bf_node* load_cover_entry();
const bf_node* reduce_entry();
const bf_node* ip_solve_entry();
const bf_node* greedy_entry();
const bf_node* lagrangian_bound_entry();
const bf_node* local_search_entry();
const bf_node* share_bound_entry();
const bf_node* verify_cover_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("cover", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::bisect_entry(),
                    ballflow::nodes::bisect_error_entry(),
                    ballflow::nodes::cover_matrix_entry(),
                    ballflow::nodes::cover_points_entry(),
                    ballflow::nodes::load_cover_entry(),
                    ballflow::nodes::reduce_entry(),
                    ballflow::nodes::ip_solve_entry(),
                    ballflow::nodes::greedy_entry(),
                    ballflow::nodes::lagrangian_bound_entry(),
                    ballflow::nodes::local_search_entry(),
                    ballflow::nodes::share_bound_entry(),
                    ballflow::nodes::verify_cover_entry(),
                }),
                ballflow::type_entries<>())
