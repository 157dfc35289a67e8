// Way: the polyline by its clearance, and its ends.
#include "types/way.hpp"

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/motion_types.hpp"

namespace ballflow::show {
namespace {

std::vector<Layer> layers_of_way(const Artifact& artifact) {
  const auto way = typed<geometry::Way>(artifact);
  Layer line, ends;
  line.name = "way";
  line.shape = Shape::segments;
  line.vertices = way.points;
  for (std::uint32_t i = 1; i < way.points.size(); ++i) line.segments.push_back({i - 1, i});
  line.attributes = {{"clearance", "model units", {}, true, {way.clearances.begin(), way.clearances.end()}}};
  line.colour_by = "clearance";
  ends.name = "start and goal";
  ends.vertices = {way.start, way.goal};
  const std::vector<std::uint8_t> which{0, 1};
  ends.attributes = {category_attribute("end", {"start", "goal"}, true, which)};
  ends.colour_by = "end";
  return {std::move(line), std::move(ends)};
}

}  // namespace

TypeLayers way_layers() { return {"Way", layers_of_way}; }

}  // namespace ballflow::show
