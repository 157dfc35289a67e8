#include "show/page/layer_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ballflow::show {
namespace {

using geometry::Vec3;

Json json_of(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

template <std::size_t n>
std::size_t add_indices(const std::vector<std::array<std::uint32_t, n>>& simplices, Blocks& blocks) {
  return blocks.add(std::span<const std::uint32_t>(simplices.empty() ? nullptr : simplices[0].data(),
                                                   n * simplices.size()));
}

std::size_t add_floats(std::span<const double> values, Blocks& blocks) {
  std::vector<float> floats(values.size());
  std::transform(values.begin(), values.end(), floats.begin(),
                 [](double value) { return static_cast<float>(value); });
  return blocks.add(std::span<const float>(floats));
}

bool are_small_integers(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double value) {
    return value >= 0 && value <= std::numeric_limits<std::uint32_t>::max() && value == std::floor(value);
  });
}

Json attribute_json(const Attribute& attribute, Blocks& blocks) {
  Json json = {{"name", attribute.name}, {"per", attribute.per_vertex ? "vertex" : "element"}};
  if (!attribute.unit.empty()) json["unit"] = attribute.unit;
  const std::vector<double>& values = attribute.values;
  if (!attribute.categories.empty()) {
    std::vector<std::size_t> counts(attribute.categories.size());
    for (const double value : values) ++counts[static_cast<std::size_t>(value)];
    json["categories"] = attribute.categories;
    json["counts"] = counts;
  } else if (!values.empty()) {
    const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
    json["min"] = *least;
    json["max"] = *greatest;
  }
  if (!attribute.categories.empty() && attribute.categories.size() <= 256) {
    std::vector<std::uint8_t> bytes(values.size());
    std::transform(values.begin(), values.end(), bytes.begin(),
                   [](double value) { return static_cast<std::uint8_t>(value); });
    json["values"] = blocks.add(std::span<const std::uint8_t>(bytes));
  } else if (are_small_integers(values)) {
    std::vector<std::uint32_t> integers(values.size());
    std::transform(values.begin(), values.end(), integers.begin(),
                   [](double value) { return static_cast<std::uint32_t>(value); });
    json["values"] = blocks.add(std::span<const std::uint32_t>(integers));
  } else {
    json["values"] = add_floats(values, blocks);
  }
  return json;
}

/// The place of a chain in the list of those of the page: layers that move together share one.
std::size_t place_of(Json chain, Json& chains) {
  const auto found = std::find(chains.begin(), chains.end(), chain);
  const auto place = static_cast<std::size_t>(found - chains.begin());
  if (found == chains.end()) chains.push_back(std::move(chain));
  return place;
}

}  // namespace

Json layer_json(const Layer& layer, Blocks& blocks, Json& chains) {
  // The centre does not depend on radii: layers with the same centres share a block.
  const geometry::Box box = bounding_box({layer}), inner = geometry::bounding_box(layer.vertices.span());
  const Vec3 center = inner.empty() ? Vec3{} : 0.5 * (inner.lower + inner.upper);
  std::vector<float> vertices;
  vertices.reserve(3 * layer.vertices.size());
  for (const Vec3 v : layer.vertices) {
    const Vec3 p = v - center;
    for (const double x : {p.x, p.y, p.z}) vertices.push_back(static_cast<float>(x));
  }
  Json json = {{"name", layer.name},
               {"shape", to_string(layer.shape)},
               {"count", layer.elements()},
               {"centre", json_of(center)},
               {"lower", json_of(box.empty() ? center : box.lower)},
               {"upper", json_of(box.empty() ? center : box.upper)},
               {"vertices", blocks.add(std::span<const float>(vertices))}};
  if (layer.shape == Shape::balls) json["radii"] = add_floats(layer.radii, blocks);
  if (layer.shape == Shape::segments) json["segments"] = add_indices(layer.segments, blocks);
  if (layer.shape == Shape::triangles) json["triangles"] = add_indices(layer.triangles, blocks);
  if (layer.chain != nullptr) {
    json["chain"] = place_of(chain_json(*layer.chain), chains);
    json["frames"] = blocks.add(std::span<const std::uint32_t>(layer.frames));
  }
  json["attributes"] = Json::array();
  for (const Attribute& attribute : layer.attributes)
    json["attributes"].push_back(attribute_json(attribute, blocks));
  json["colour_by"] = layer.colour_by;
  json["opacity"] = layer.opacity;
  json["visible"] = layer.visible;
  return json;
}

std::size_t raw_bytes(const std::vector<Layer>& layers) {
  std::size_t bytes = 0;
  for (const Layer& layer : layers) {
    bytes += 12 * layer.vertices.size() + 4 * layer.radii.size() + 8 * layer.segments.size() +
             12 * layer.triangles.size() + 4 * layer.frames.size();
    for (const Attribute& attribute : layer.attributes) bytes += 4 * attribute.values.size();
  }
  return bytes;
}

}  // namespace ballflow::show
