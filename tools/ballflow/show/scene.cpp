#include "show/scene.hpp"

#include <algorithm>
#include <cmath>

#include "ballflow/error.hpp"
#include "show/layer_table.hpp"

namespace ballflow::show {
namespace {

const std::vector<TypeLayers>& table() {
  static const std::vector<TypeLayers> types = {point_set_layers(),
                                                triangle_mesh_layers(),
                                                balls_layers(),
                                                pole_set_layers(),
                                                local_feature_size_layers(),
                                                growth_layers(),
                                                simplicial_complex_layers(),
                                                medial_axis_layers(),
                                                refinement_layers(),
                                                sample_assignment_layers(),
                                                surface_report_layers(),
                                                enclosure_layers(),
                                                robot_layers(),
                                                robot_spheres_layers(),
                                                polygon2_layers(),
                                                disc_outline_layers(),
                                                ball_distance_layers(),
                                                path_layers(),
                                                matched_balls_layers(),
                                                way_layers(),
                                                shape_prior_layers(),
                                                shape_fit_layers(),
                                                ellipsoids_layers()};
  return types;
}

const TypeLayers* find_type(std::string_view type) {
  for (const TypeLayers& entry : table()) {
    if (entry.type == type) return &entry;
  }
  return nullptr;
}

template <std::size_t n>
bool in_range(const std::vector<std::array<std::uint32_t, n>>& simplices, std::size_t vertices) {
  return std::all_of(simplices.begin(), simplices.end(), [vertices](const auto& simplex) {
    return std::all_of(simplex.begin(), simplex.end(), [vertices](std::uint32_t v) { return v < vertices; });
  });
}

}  // namespace

std::string_view to_string(Shape shape) {
  switch (shape) {
    case Shape::points:
      return "points";
    case Shape::balls:
      return "balls";
    case Shape::segments:
      return "segments";
    case Shape::triangles:
      return "triangles";
  }
  return "";
}

std::size_t Layer::elements() const {
  if (shape == Shape::segments) return segments.size();
  if (shape == Shape::triangles) return triangles.size();
  return vertices.size();
}

const Attribute* Layer::find(std::string_view attribute) const {
  for (const Attribute& a : attributes) {
    if (a.name == attribute) return &a;
  }
  return nullptr;
}

bool can_be_shown(std::string_view type) { return find_type(type) != nullptr; }

std::vector<std::string> shown_types() {
  std::vector<std::string> types;
  for (const TypeLayers& entry : table()) types.emplace_back(entry.type);
  return types;
}

std::vector<Layer> layers_of(const Artifact& artifact) {
  const TypeLayers* entry = find_type(artifact.type());
  if (entry == nullptr) {
    std::string all;
    for (const std::string& type : shown_types()) all += (all.empty() ? "" : ", ") + type;
    throw Error(ExitCode::usage, "a " + artifact.type() + " cannot be drawn", "what can be: " + all);
  }
  std::vector<Layer> layers = entry->layers(artifact);
  std::erase_if(layers, [](const Layer& layer) { return layer.elements() == 0; });
  return layers;
}

geometry::Box bounding_box(const std::vector<Layer>& layers) {
  geometry::Box box;
  for (const Layer& layer : layers) {
    for (std::size_t i = 0; i < layer.vertices.size(); ++i) {
      const double r = layer.shape == Shape::balls ? layer.radii[i] : 0;
      box.add(layer.vertices[i] - geometry::Vec3{r, r, r});
      box.add(layer.vertices[i] + geometry::Vec3{r, r, r});
    }
  }
  return box;
}

std::string broken_invariant(const Layer& layer) {
  if (layer.shape == Shape::balls && layer.radii.size() != layer.vertices.size()) {
    return "one radius per ball is missing";
  }
  if (!in_range(layer.segments, layer.vertices.size())) return "a segment names a vertex that is not there";
  if (!in_range(layer.triangles, layer.vertices.size())) return "a triangle names a vertex that is not there";
  for (const Attribute& a : layer.attributes) {
    if (a.values.size() != (a.per_vertex ? layer.vertices.size() : layer.elements())) {
      return "the attribute " + a.name + " has a wrong number of values";
    }
    for (const double value : a.values) {
      if (!std::isfinite(value)) return "the attribute " + a.name + " has a value that is not finite";
      if (!a.categories.empty() && !(value >= 0 && value < static_cast<double>(a.categories.size()))) {
        return "the attribute " + a.name + " has a value outside of its categories";
      }
    }
  }
  if (layer.frames.size() != (layer.chain == nullptr ? 0 : layer.vertices.size()))
    return "the frames of vertices are not one for each";
  if (layer.chain != nullptr) {
    if (std::string why = broken_invariant(*layer.chain); !why.empty()) return why;
    for (const std::uint32_t frame : layer.frames) {
      if (frame >= layer.chain->frames.size()) return "a vertex goes with a frame that is not there";
    }
  }
  if (!layer.colour_by.empty() && layer.find(layer.colour_by) == nullptr) {
    return "there is no attribute " + layer.colour_by + " to colour by";
  }
  return "";
}

}  // namespace ballflow::show
