// The layers of show/scene.hpp as glTF: one node per layer that is visible at first.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "export/formats.hpp"
#include "export/formats/gltf_buffer.hpp"
#include "show/icosphere.hpp"
#include "show/layers/ellipsoid_attribute.hpp"
#include "show/palette.hpp"
#include "show/scene.hpp"
#include "show/typed.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow {
namespace {

using geometry::Vec3;
using show::Colour;
using show::Layer;
using show::Shape;

// Blender 3.4 imports so many nodes in 5 seconds of one core, and more of them ever more slowly. It ignores
// EXT_mesh_gpu_instancing, which would be the better way.
constexpr std::size_t most_ball_nodes = 20000;
constexpr std::size_t most_fine_balls = 2000;

constexpr int points_mode = 0, lines_mode = 1, triangles_mode = 4;

/// sRGB to linear: ((c + 0.055) / 1.055)^2.4 above the dark end. The power is the fifth root of the twelfth
/// one, by Newton's method, so that files do not depend on the machine's pow.
double linear(std::uint8_t channel) {
  const double c = channel / 255.0;
  if (c <= 0.04045) return c / 12.92;
  const double x = (c + 0.055) / 1.055;
  const double x3 = x * x * x, x12 = x3 * x3 * x3 * x3;
  double root = 1;
  for (int step = 0; step < 60; ++step) root = (4 * root + x12 / (root * root * root * root)) / 5;
  return root;
}

std::array<double, 3> linear(Colour colour) {
  return {linear(colour.red), linear(colour.green), linear(colour.blue)};
}

std::array<std::uint16_t, 4> linear16(Colour colour) {
  std::array<std::uint16_t, 4> result{0, 0, 0, 65535};
  const auto channels = linear(colour);
  for (std::size_t k = 0; k < 3; ++k)
    result[k] = static_cast<std::uint16_t>(std::lround(channels[k] * 65535));
  return result;
}

/// "radius" becomes "_RADIUS": the underscore marks attributes that glTF does not define.
std::string attribute_name(const std::string& name) {
  std::string result = "_";
  for (const char c : name) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    result += letter ? static_cast<char>(c & ~0x20) : digit ? c : '_';
  }
  return result;
}

class Scene {
 public:
  explicit Scene(const std::vector<Layer>& layers) : layers_(layers) {}

  void add(const Layer& layer) {
    const bool as_nodes = layer.shape == Shape::balls && layer.elements() <= most_ball_nodes;
    Json node = {{"name", layer.name}};
    if (as_nodes) {
      node["children"] = ball_nodes(layer);
    } else {
      node["mesh"] = mesh(layer.name, primitive(layer));
    }
    roots_.push_back(push(nodes_, std::move(node)));
  }

  /// `layer` has a vertex per ellipsoid, and its colour.
  void add(const geometry::Ellipsoids& all, const Layer& layer) {
    Json node = {{"name", layer.name}};
    node["children"] = ball_nodes(layer, "ellipsoid", [&](std::size_t i) {
      const Vec3 c = all.centers[i], r = all.radii[i];
      const geometry::Quaternion q = all.rotations[i];
      return Json{
          {"translation", {c.x, c.y, c.z}}, {"rotation", {q.x, q.y, q.z, q.w}}, {"scale", {r.x, r.y, r.z}}};
    });
    roots_.push_back(push(nodes_, std::move(node)));
  }

  void write(OutputFile& out) const {
    Json gltf = {{"asset", {{"version", "2.0"}, {"generator", "ballflow"}}}, {"scene", 0}};
    gltf["scenes"] = Json::array({roots_.empty() ? Json::object() : Json{{"nodes", roots_}}});
    // glTF knows no empty lists.
    if (!nodes_.empty()) gltf["nodes"] = nodes_;
    if (!meshes_.empty()) gltf["meshes"] = meshes_;
    if (!materials_.empty()) gltf["materials"] = materials_;
    buffer_.write(std::move(gltf), out);
  }

 private:
  static std::size_t push(Json& list, Json value) {
    list.push_back(std::move(value));
    return list.size() - 1;
  }

  std::size_t mesh(const std::string& name, Json primitive) {
    return push(meshes_, {{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
  }

  std::size_t material(Colour colour, double opacity) {
    const auto [at, is_new] = known_materials_.try_emplace({show::hex(colour), opacity}, 0);
    if (is_new) {
      const auto [red, green, blue] = linear(colour);
      Json value = {{"name", show::hex(colour)},
                    {"doubleSided", true},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {red, green, blue, opacity}},
                      {"metallicFactor", 0},
                      {"roughnessFactor", 0.7}}}};
      if (opacity < 1) value["alphaMode"] = "BLEND";
      at->second = push(materials_, std::move(value));
    }
    return at->second;
  }

  /// The colour of every vertex by the attribute that the layer is coloured by; nothing when that has one
  /// value per element, or there is none.
  std::optional<std::vector<Colour>> vertex_colours(const Layer& layer) const {
    const show::Attribute* attribute = layer.find(layer.colour_by);
    if (attribute == nullptr || !attribute->per_vertex) return std::nullopt;
    const show::ValueRange range = show::value_range(layers_, attribute->name);
    std::vector<Colour> colours;
    colours.reserve(attribute->values.size());
    for (const double value : attribute->values) {
      colours.push_back(attribute->categories.empty() ? show::scalar(range.place(value))
                                                      : show::category(static_cast<std::size_t>(value)));
    }
    return colours;
  }

  Json primitive(const Layer& layer) {
    Json attributes = {{"POSITION", buffer_.positions(layer.vertices)}};
    for (const show::Attribute& attribute : layer.attributes) {
      if (attribute.per_vertex) {
        attributes[attribute_name(attribute.name)] = buffer_.scalars(attribute.values);
      }
    }
    constexpr Colour white{255, 255, 255};
    const auto colours = vertex_colours(layer);
    if (colours) {
      std::vector<std::array<std::uint16_t, 4>> rgba(colours->size());
      std::transform(colours->begin(), colours->end(), rgba.begin(), linear16);
      attributes["COLOR_0"] = buffer_.colours(rgba);
    }
    Json result = {{"attributes", std::move(attributes)},
                   {"material", material(colours ? white : show::plain(layer), layer.opacity)}};
    std::vector<std::uint32_t> corners;
    for (const auto& segment : layer.segments) corners.insert(corners.end(), segment.begin(), segment.end());
    for (const auto& t : layer.triangles) corners.insert(corners.end(), t.begin(), t.end());
    if (!corners.empty()) result["indices"] = buffer_.indices(corners);
    result["mode"] = layer.shape == Shape::triangles  ? triangles_mode
                     : layer.shape == Shape::segments ? lines_mode
                                                      : points_mode;
    return result;
  }

  /// A node per ball, with what `place` says of ball i; balls of one colour share a mesh, and all meshes
  /// share the vertices of one sphere.
  template <class Place>
  Json ball_nodes(const Layer& layer, const char* name, const Place& place) {
    const show::Icosphere sphere = show::icosphere(layer.vertices.size() <= most_fine_balls ? 2 : 1);
    std::vector<std::uint32_t> corners;
    for (const auto& t : sphere.triangles) corners.insert(corners.end(), t.begin(), t.end());
    const std::size_t positions = buffer_.positions(sphere.vertices),
                      normals = buffer_.normals(sphere.vertices);
    const std::size_t indices = buffer_.indices(corners);
    const auto colours = vertex_colours(layer);
    std::map<std::string, std::size_t> mesh_of;
    Json children = Json::array();
    for (std::size_t i = 0; i < layer.vertices.size(); ++i) {
      const Colour colour = colours ? (*colours)[i] : show::plain(layer);
      const auto [at, is_new] = mesh_of.try_emplace(show::hex(colour), 0);
      if (is_new) {
        at->second = mesh(name, {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                 {"indices", indices},
                                 {"material", material(colour, layer.opacity)}});
      }
      Json node = place(i);
      node["mesh"] = at->second;
      children.push_back(push(nodes_, std::move(node)));
    }
    return children;
  }
  Json ball_nodes(const Layer& layer) {
    return ball_nodes(layer, "ball", [&](std::size_t i) {
      const Vec3 c = layer.vertices[i];
      const double r = layer.radii[i];
      return Json{{"translation", {c.x, c.y, c.z}}, {"scale", {r, r, r}}};
    });
  }

  const std::vector<Layer>& layers_;
  GltfBuffer buffer_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(), roots_ = Json::array();
  std::map<std::pair<std::string, double>, std::size_t> known_materials_;
};

}  // namespace

namespace {

/// As nodes, where there are not too many: the layer of ellipsoids has triangles.
bool write_ellipsoids(const Artifact& artifact, OutputFile& out) {
  if (artifact.type() != "Ellipsoids") return false;
  const auto all = typed<geometry::Ellipsoids>(artifact);
  if (all.size() == 0 || all.size() > most_ball_nodes) return false;
  Layer layer;
  layer.name = "ellipsoids";
  layer.shape = Shape::points;
  layer.vertices = all.centers;
  layer.attributes = {show::shortest_axis_attribute(all)};
  layer.colour_by = layer.attributes.front().name;
  const std::vector<Layer> layers{layer};
  Scene scene(layers);
  scene.add(all, layer);
  scene.write(out);
  return true;
}

}  // namespace

void write_glb(const Artifact& artifact, OutputFile& out) {
  if (write_ellipsoids(artifact, out)) return;
  std::vector<Layer> layers = show::layers_of(artifact);
  std::erase_if(layers, [](const Layer& layer) { return !layer.visible; });
  Scene scene(layers);
  for (const Layer& layer : layers) scene.add(layer);
  scene.write(out);
}

}  // namespace ballflow
