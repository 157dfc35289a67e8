#include "inspect/picture.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::inspect {
namespace {

using geometry::Vec3;

constexpr std::size_t most_crossings = 200;

std::vector<double> walls_of(const geometry::Look& look, geometry::Monitor& monitor) {
  if (!look.widths) return {};
  geometry::WidthsOptions options;
  options.places = static_cast<std::int64_t>(look.outwards.triangles.size());
  options.list_walls = true;
  return geometry::widths_of(look.outwards, options, monitor).walls;
}

show::Layer surface(const ModelReport& report, geometry::Monitor& monitor) {
  show::Layer layer = show::layer_of(report.model.mesh);
  layer.opacity = 1;
  layer.smooth = false;
  show::Attribute attribute{"wall", "model units", {}, false, walls_of(report.look, monitor)};
  std::vector<double> walls;
  for (const double wall : attribute.values) {
    if (std::isfinite(wall)) walls.push_back(wall);
  }
  // Triangles of a chain are those of the mesh, in its order, as long as none repeats a corner.
  if (walls.empty() || attribute.values.size() != layer.triangles.size()) return layer;
  // Half of the walls share the colour of the widest: the thin ones are what one looks for.
  const auto middle = walls.begin() + static_cast<std::ptrdiff_t>(walls.size() / 2);
  std::nth_element(walls.begin(), middle, walls.end());
  const double cap = *middle;
  for (double& value : attribute.values) value = std::min(value, cap);
  layer.attributes.push_back(std::move(attribute));
  layer.colour_by = "wall";
  return layer;
}

show::Layer rims(const ModelReport& report) {
  show::Layer layer;
  layer.name = "open edges";
  layer.shape = show::Shape::segments;
  layer.vertices = report.model.mesh.vertices;
  for (const auto& [a, b] : geometry::open_edges(report.model.mesh))
    layer.segments.push_back({static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b)});
  return layer;
}

/// Balls whose colour says what is there.
class Marks {
 public:
  explicit Marks(double radius) : radius_(radius) {}
  void add(const std::string& kind, Vec3 place, double size = 1) {
    if (kinds_.empty() || kinds_.back() != kind) kinds_.push_back(kind);
    places_.push_back(place);
    radii_.push_back(size * radius_);
    values_.push_back(static_cast<double>(kinds_.size() - 1));
  }
  bool empty() const { return places_.empty(); }
  show::Layer layer() const {
    show::Layer layer;
    layer.name = "marks";
    layer.shape = show::Shape::balls;
    layer.vertices = places_;
    layer.radii = radii_;
    layer.attributes.push_back({"mark", "", kinds_, true, values_});
    layer.colour_by = "mark";
    return layer;
  }

 private:
  double radius_;
  std::vector<std::string> kinds_;
  std::vector<Vec3> places_;
  std::vector<double> radii_, values_;
};

}  // namespace

std::vector<show::Layer> layers_of(const ModelReport& report, geometry::Monitor& monitor) {
  const geometry::Look& look = report.look;
  const geometry::TriangleMesh& mesh = report.model.mesh;
  std::vector<show::Layer> layers;
  if (mesh.triangles.empty()) {
    layers.push_back(show::layer_of(report.model.points));
  } else {
    layers.push_back(surface(report, monitor));
    if (look.gaps.open_edges > 0) layers.push_back(rims(report));
  }
  Marks marks(look.box.longest_edge() / 80);
  if (look.widths && look.widths->wall) marks.add("thinnest wall", look.widths->wall->from);
  if (look.widths && look.widths->slot) marks.add("narrowest slot", look.widths->slot->from);
  for (std::size_t i = 0; i < std::min(look.intersections.pairs.size(), most_crossings); ++i) {
    marks.add("crossing", geometry::place_of(mesh, look.intersections.pairs[i]), 0.5);
  }
  for (const std::int32_t i : look.strays.points)
    marks.add("stray point", report.model.points.points[static_cast<std::size_t>(i)]);
  if (!marks.empty()) layers.push_back(marks.layer());
  return layers;
}

}  // namespace ballflow::inspect
