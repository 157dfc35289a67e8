// How the files of layers/ offer the layers of a type to scene.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "ballflow/artifact.hpp"
#include "show/scene.hpp"

namespace ballflow::show {

struct TypeLayers {
  std::string_view type;
  std::vector<Layer> (*layers)(const Artifact&);
};

TypeLayers point_set_layers();
TypeLayers triangle_mesh_layers();
TypeLayers balls_layers();
TypeLayers pole_set_layers();
TypeLayers local_feature_size_layers();
TypeLayers growth_layers();
TypeLayers simplicial_complex_layers();
TypeLayers medial_axis_layers();
TypeLayers refinement_layers();
TypeLayers enclosure_layers();
TypeLayers robot_layers();
TypeLayers robot_spheres_layers();
TypeLayers sample_assignment_layers();
TypeLayers surface_report_layers();
TypeLayers polygon2_layers();
TypeLayers disc_outline_layers();
TypeLayers ball_distance_layers();
TypeLayers path_layers();
TypeLayers matched_balls_layers();
TypeLayers way_layers();
TypeLayers shape_prior_layers();
TypeLayers shape_fit_layers();
TypeLayers ellipsoids_layers();

}  // namespace ballflow::show
