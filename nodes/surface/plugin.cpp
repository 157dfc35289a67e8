// The family "surface": from clouds of points to closed surfaces.
#include <ballflow/sdk/library.hpp>

namespace ballflow::nodes {
const bf_node* assess_noise_entry();
const bf_node* assign_samples_entry();
const bf_node* denoise_entry();
const bf_node* restore_samples_entry();
const bf_node* surface_balls_entry();
const bf_node* surface_mesh_entry();
}  // namespace ballflow::nodes

BALLFLOW_PLUGIN("surface", "0.1.0",
                (std::vector<const bf_node*>{
                    ballflow::nodes::assess_noise_entry(), ballflow::nodes::assign_samples_entry(),
                    ballflow::nodes::denoise_entry(), ballflow::nodes::restore_samples_entry(),
                    ballflow::nodes::surface_balls_entry(), ballflow::nodes::surface_mesh_entry()}),
                ballflow::type_entries<>())
