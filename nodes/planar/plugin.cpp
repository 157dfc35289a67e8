// The family "planar": polygons and discs in the plane.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* read_polygon_entry();
const bf_node* compare_outlines_entry();
const bf_node* disc_poles_entry();
const bf_node* disc_union_outline_entry();
const bf_node* polygon_meshes_entry();
const bf_node* simplify_polygon_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("planar", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::read_polygon_entry(),
                    ballflow::nodes::compare_outlines_entry(),
                    ballflow::nodes::disc_poles_entry(),
                    ballflow::nodes::disc_union_outline_entry(),
                    ballflow::nodes::polygon_meshes_entry(),
                    ballflow::nodes::simplify_polygon_entry(),
                }),
                ballflow::type_entries<>())
