// The layers of show/scene.hpp as glTF: one node per layer that is visible at first.
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "export/formats.hpp"
#include "export/formats/gltf_buffer.hpp"
#include "show/palette.hpp"
#include "show/scene.hpp"

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

struct Sphere {
  std::vector<Vec3> vertices;  // of length 1: their own normals
  std::vector<std::uint32_t> triangles;
};

/// An icosahedron whose triangles are cut into four `rounds` times.
Sphere icosphere(int rounds) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  Sphere sphere;
  const auto add = [&sphere](Vec3 v) {
    sphere.vertices.push_back((1 / geometry::length(v)) * v);
    return static_cast<std::uint32_t>(sphere.vertices.size() - 1);
  };
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      add({0, a, b});
      add({a, b, 0});
      add({b, 0, a});
    }
  }
  // Three vertices are a triangle when they are neighbours: at the distance of an edge, the shortest there
  // is.
  const double edge = 1.1;  // is 1.051, the next distance is 1.701
  const auto near = [&sphere, edge](std::uint32_t a, std::uint32_t b) {
    return geometry::distance(sphere.vertices[a], sphere.vertices[b]) < edge;
  };
  for (std::uint32_t a = 0; a < 12; ++a) {
    for (std::uint32_t b = a + 1; b < 12; ++b) {
      for (std::uint32_t c = b + 1; c < 12; ++c) {
        if (!near(a, b) || !near(b, c) || !near(a, c)) continue;
        const Vec3 p = sphere.vertices[a], q = sphere.vertices[b], r = sphere.vertices[c];
        const bool outward = geometry::dot(geometry::cross(q - p, r - p), p) > 0;
        sphere.triangles.insert(sphere.triangles.end(), {a, outward ? b : c, outward ? c : b});
      }
    }
  }
  for (; rounds > 0; --rounds) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), 0);
      if (is_new) at->second = add(sphere.vertices[a] + sphere.vertices[b]);
      return at->second;
    };
    std::vector<std::uint32_t> finer;
    for (std::size_t i = 0; i < sphere.triangles.size(); i += 3) {
      const std::uint32_t a = sphere.triangles[i], b = sphere.triangles[i + 1], c = sphere.triangles[i + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    sphere.triangles = std::move(finer);
  }
  return sphere;
}

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

  /// A node per ball; balls of one colour share a mesh, and all meshes share the vertices of one sphere.
  Json ball_nodes(const Layer& layer) {
    const Sphere sphere = icosphere(layer.elements() <= most_fine_balls ? 2 : 1);
    const std::size_t positions = buffer_.positions(sphere.vertices),
                      normals = buffer_.normals(sphere.vertices);
    const std::size_t indices = buffer_.indices(sphere.triangles);
    const auto colours = vertex_colours(layer);
    std::map<std::string, std::size_t> mesh_of;
    Json children = Json::array();
    for (std::size_t i = 0; i < layer.vertices.size(); ++i) {
      const Colour colour = colours ? (*colours)[i] : show::plain(layer);
      const auto [at, is_new] = mesh_of.try_emplace(show::hex(colour), 0);
      if (is_new) {
        at->second = mesh("ball", {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}},
                                   {"indices", indices},
                                   {"material", material(colour, layer.opacity)}});
      }
      const Vec3 c = layer.vertices[i];
      const double r = layer.radii[i];
      children.push_back(
          push(nodes_, {{"mesh", at->second}, {"translation", {c.x, c.y, c.z}}, {"scale", {r, r, r}}}));
    }
    return children;
  }

  const std::vector<Layer>& layers_;
  GltfBuffer buffer_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(), roots_ = Json::array();
  std::map<std::pair<std::string, double>, std::size_t> known_materials_;
};

}  // namespace

void write_glb(const Artifact& artifact, OutputFile& out) {
  std::vector<Layer> layers = show::layers_of(artifact);
  std::erase_if(layers, [](const Layer& layer) { return !layer.visible; });
  Scene scene(layers);
  for (const Layer& layer : layers) scene.add(layer);
  scene.write(out);
}

}  // namespace ballflow
