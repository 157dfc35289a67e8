#include "show/outside.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace ballflow::show {
namespace {

using geometry::Vec3;
using Corners = std::array<Vec3, 3>;

class Splitter {
 public:
  Splitter(const Layer& balls, double fineness) : balls_(balls), squared_fineness_(fineness * fineness) {}

  /// `near`: balls that the triangle may meet.
  void split(const Corners& t, const std::vector<std::size_t>& near) {
    const Vec3 middle = (1.0 / 3) * (t[0] + t[1] + t[2]);
    double reach = 0;
    for (const Vec3& corner : t) reach = std::max(reach, geometry::distance(corner, middle));
    std::vector<std::size_t> met;
    for (const std::size_t i : near) {
      const Vec3 center = balls_.vertices[i];
      const double r = balls_.radii[i];
      if (std::all_of(t.begin(), t.end(), [&](Vec3 p) { return geometry::distance(p, center) <= r; }))
        return add(t, true);
      if (geometry::distance(middle, center) <= r + reach) met.push_back(i);
    }
    if (met.empty()) return add(t, false);
    std::size_t longest = 0;
    std::array<double, 3> squares{};
    for (std::size_t k = 0; k < 3; ++k) squares[k] = geometry::squared_distance(t[k], t[(k + 1) % 3]);
    for (std::size_t k = 1; k < 3; ++k) longest = squares[k] > squares[longest] ? k : longest;
    if (squares[longest] <= squared_fineness_) {
      return add(t, std::any_of(met.begin(), met.end(), [&](std::size_t i) {
                   return geometry::distance(middle, balls_.vertices[i]) <= balls_.radii[i];
                 }));
    }
    const Vec3 a = t[longest], b = t[(longest + 1) % 3], c = t[(longest + 2) % 3], half = 0.5 * (a + b);
    split({a, half, c}, met);
    split({half, b, c}, met);
  }

  std::array<std::vector<Corners>, 2> parts;  // in no ball, in balls

 private:
  void add(const Corners& t, bool inside) { parts[inside ? 1 : 0].push_back(t); }

  const Layer& balls_;
  double squared_fineness_;
};

Layer layer_of_parts(const std::string& name, const std::vector<Corners>& parts) {
  Layer layer;
  layer.name = name;
  layer.shape = Shape::triangles;
  std::vector<Vec3> vertices;
  for (const Corners& part : parts) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), part.begin(), part.end());
    layer.triangles.push_back({first, first + 1, first + 2});
  }
  layer.vertices = std::move(vertices);
  return layer;
}

}  // namespace

SplitSurface split_by_balls(const Layer& surface, const Layer& balls, double fineness) {
  const bool framed = !surface.frames.empty() && !balls.frames.empty();
  std::map<std::uint32_t, std::vector<std::size_t>> by_frame;
  for (std::size_t i = 0; i < balls.vertices.size(); ++i) by_frame[framed ? balls.frames[i] : 0].push_back(i);
  const double least = 1e-3 * geometry::bounding_box(surface.vertices.span()).longest_edge();
  Splitter splitter(balls, std::max(fineness, least));
  for (const auto& [a, b, c] : surface.triangles) {
    splitter.split({surface.vertices[a], surface.vertices[b], surface.vertices[c]},
                   by_frame[framed ? surface.frames[a] : 0]);
  }
  return {layer_of_parts("mesh", splitter.parts[1]), layer_of_parts("not covered", splitter.parts[0])};
}

}  // namespace ballflow::show
