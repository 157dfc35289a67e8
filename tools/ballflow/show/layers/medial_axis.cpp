// MedialAxis: its polygons as fans of triangles, the edges that bound none, isolated vertices, seams.
#include <algorithm>
#include <cstdint>
#include <string>

#include "show/layer_table.hpp"
#include "show/layers/attributes.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::show {
namespace {

using geometry::MedialAxis;

constexpr std::size_t sheet_colours = 8;

/// A colour for every sheet: sheets that meet at a seam differ, as far as there are colours. Of those that
/// are left, the one with the fewest polygons is taken.
std::vector<std::uint8_t> colours_of_sheets(const MedialAxis& axis) {
  using Edge = std::array<std::int32_t, 2>;
  std::vector<std::vector<std::int32_t>> at_seam(axis.seams.size());
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto corners = axis.polygon(i);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto [a, b] = std::minmax(corners[k], corners[(k + 1) % corners.size()]);
      const auto seam = std::lower_bound(axis.seams.begin(), axis.seams.end(), Edge{a, b});
      if (seam == axis.seams.end() || *seam != Edge{a, b}) continue;
      at_seam[static_cast<std::size_t>(seam - axis.seams.begin())].push_back(axis.polygon_sheets[i]);
    }
  }
  std::vector<std::vector<std::int32_t>> lower(axis.sheet_orientable.size());  // sheets met, of lower number
  for (const auto& sheets : at_seam) {
    for (const std::int32_t a : sheets) {
      for (const std::int32_t b : sheets) {
        if (a < b) lower[static_cast<std::size_t>(b)].push_back(a);
      }
    }
  }
  std::vector<std::size_t> size(lower.size(), 0);
  for (const std::int32_t sheet : axis.polygon_sheets) ++size[static_cast<std::size_t>(sheet)];
  std::vector<std::uint8_t> colours(lower.size(), 0);
  std::array<std::size_t, sheet_colours> used{};  // polygons of each colour
  for (std::size_t sheet = 0; sheet < lower.size(); ++sheet) {
    std::array<bool, sheet_colours> taken{};
    for (const std::int32_t other : lower[sheet]) taken[colours[static_cast<std::size_t>(other)]] = true;
    std::size_t best = 0;
    for (std::size_t k = 1; k < sheet_colours; ++k) {
      if (taken[k] != taken[best] ? taken[best] : used[k] < used[best]) best = k;
    }
    colours[sheet] = static_cast<std::uint8_t>(best);
    used[best] += size[sheet];
  }
  return colours;
}

std::vector<Layer> layers_of_medial_axis(const Artifact& artifact) {
  const auto axis = typed<MedialAxis>(artifact);
  std::vector<bool> used(axis.vertices.size(), false);
  const auto use = [&used](std::int32_t v) {
    used[static_cast<std::size_t>(v)] = true;
    return static_cast<std::uint32_t>(v);
  };

  Layer sheets;
  sheets.name = "medial axis";
  sheets.shape = Shape::triangles;
  sheets.vertices = axis.vertices;
  std::vector<std::uint8_t> kinds, colours;
  const std::vector<std::uint8_t> colour = colours_of_sheets(axis);
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto corners = axis.polygon(i);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      sheets.triangles.push_back({use(corners[0]), use(corners[k - 1]), use(corners[k])});
      kinds.push_back(axis.polygon_kinds[i]);
      colours.push_back(colour[static_cast<std::size_t>(axis.polygon_sheets[i])]);
    }
  }
  sheets.attributes = {radius_attribute(axis.radii.span()),
                       category_attribute("kind", {"alpha-shape", "Voronoi facet", "wall"}, false, kinds),
                       category_attribute("sheet", {"a", "b", "c", "d", "e", "f", "g", "h"}, false, colours)};
  sheets.colour_by = "radius";

  Layer edges;
  edges.name = "medial axis edges";
  edges.shape = Shape::segments;
  edges.vertices = axis.vertices;
  for (const auto& [a, b] : axis.edges) edges.segments.push_back({use(a), use(b)});
  edges.attributes = {radius_attribute(axis.radii.span())};
  edges.colour_by = "radius";

  std::vector<geometry::Vec3> isolated;
  std::vector<double> radii;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) continue;
    isolated.push_back(axis.vertices[v]);
    radii.push_back(axis.radii[v]);
  }
  Layer points;
  points.name = "medial axis points";
  points.vertices = std::move(isolated);
  points.attributes = {radius_attribute(radii)};
  points.colour_by = "radius";

  Layer seams;
  seams.name = "medial axis seams";
  seams.shape = Shape::segments;
  seams.vertices = axis.vertices;
  for (const auto& [a, b] : axis.seams)
    seams.segments.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  seams.attributes = {radius_attribute(axis.radii.span()),
                      {"degree", "polygons", {}, false, {axis.seam_degrees.begin(), axis.seam_degrees.end()}},
                      {"curve", "", {}, false, {axis.seam_curves.begin(), axis.seam_curves.end()}}};
  seams.colour_by = "degree";
  seams.visible = false;
  return {sheets, edges, points, seams};
}

}  // namespace

TypeLayers medial_axis_layers() { return {"MedialAxis", layers_of_medial_axis}; }

}  // namespace ballflow::show
