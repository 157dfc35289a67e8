#include "planar/disc_poles.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"
#include "exact/circumcenter.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_2;
struct FaceInfo {
  std::int32_t id = -1;
  std::uint8_t piece = 0;  // bit i: the edge opposite vertex i is on the boundary of the polygon
  std::uint8_t seen = 0, inside = 0;
};
using Structure =
    CGAL::Triangulation_data_structure_2<CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>,
                                         CGAL::Triangulation_face_base_with_info_2<FaceInfo, Kernel>>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure>;
using Face = Delaunay::Face_handle;
using Vertex = Delaunay::Vertex_handle;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }
Point exact(Vec2 p) { return {p.x, p.y}; }

/// The samples as closed chains that grow, and their triangulation.
class Samples {
 public:
  Samples(const Polygon2& polygon, double spacing, Monitor& monitor) : look_(monitor) {
    double total = 0;
    for (std::size_t r = 0; r < polygon.rings(); ++r) {
      const auto ring = polygon.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i)
        total += std::ceil(distance(ring[i], ring[(i + 1) % ring.size()]) / spacing);
    }
    if (!(total <= 0x1p30)) {
      throw InputError("the spacing asks for " + std::to_string(total) + " samples", "take a larger spacing");
    }
    for (std::size_t r = 0; r < polygon.rings(); ++r) {
      const auto ring = polygon.ring(r);
      const auto first = static_cast<std::int32_t>(points.size());
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        const double pieces = std::max(1.0, std::ceil(distance(a, b) / spacing));
        add(a, true);
        for (double k = 1; k < pieces; ++k) add(a + (k / pieces) * (b - a), false);
      }
      next.back() = first;
    }
    std::vector<std::pair<Point, std::int32_t>> all;
    all.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      all.emplace_back(exact(points[i]), static_cast<std::int32_t>(i));
    triangulation.insert(all.begin(), all.end());
    vertices.resize(points.size());
    for (const Vertex v : triangulation.finite_vertex_handles()) vertices[at(v->info())] = v;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (vertices[i] == Vertex()) refuse(points[i]);
    }
  }

  /// Halves pieces until none has a sample strictly inside the circle over it.
  std::int64_t split(Monitor& monitor) {
    const std::size_t before = points.size();
    std::vector<std::int32_t> pieces(points.size());
    std::iota(pieces.begin(), pieces.end(), 0);
    while (!pieces.empty()) {
      monitor.step(0.5);
      std::vector<std::int32_t> bad;
      for (const std::int32_t i : pieces) {
        look_(64);
        if (encroached(i)) bad.push_back(i);
      }
      for (const std::int32_t i : bad) {
        look_(256);
        halve(i);
      }
      if (bad.empty()) break;
      if (points.size() > (std::size_t{1} << 30)) {
        throw InputError("more than 2^30 samples are needed between near edges", "simplify the polygon");
      }
      pieces.resize(points.size());  // a new sample may lie in the circle of any piece
      std::iota(pieces.begin(), pieces.end(), 0);
    }
    return static_cast<std::int64_t>(points.size() - before);
  }

  std::vector<Vec2> points;
  std::vector<std::int32_t> next;  // along the ring
  std::vector<Vertex> vertices;    // of the triangulation
  Delaunay triangulation;

  Delaunay::Edge edge(std::int32_t i) const {
    Face face;
    int k = 0;
    triangulation.is_edge(vertices[at(i)], vertices[at(next[at(i)])], face, k);
    return {face, k};
  }

 private:
  void add(Vec2 p, bool corner) {
    points.push_back(p);
    corner_.push_back(corner);
    next.push_back(index_of(points.size(), "samples"));
  }

  [[noreturn]] static void refuse(Vec2 p) {
    throw InputError("near (" + std::to_string(p.x) + ", " + std::to_string(p.y) +
                         ") samples would be closer than coordinates can tell",
                     "take a larger spacing, move near edges apart, or move the polygon to the origin");
  }

  bool encroached(std::int32_t i) const {
    const Vertex v = vertices[at(i)], w = vertices[at(next[at(i)])];
    Face face;
    int k = 0;
    if (!triangulation.is_edge(v, w, face, k)) return true;
    for (const auto& [f, j] : {Delaunay::Edge(face, k), triangulation.mirror_edge({face, k})}) {
      const Vertex opposite = f->vertex(j);
      if (triangulation.is_infinite(opposite)) continue;
      if (CGAL::angle(v->point(), opposite->point(), w->point()) == CGAL::OBTUSE) return true;
    }
    return false;
  }

  void halve(std::int32_t i) {
    const std::int32_t j = next[at(i)];
    const Vec2 a = points[at(i)], b = points[at(j)];
    double share = 0.5;
    if (corner_[at(i)] != corner_[at(j)]) {
      // The power of two between a third and two thirds of the length, from the corner.
      const double whole = distance(a, b);
      int exponent = 0;
      const double mantissa = std::frexp(whole, &exponent);  // whole = mantissa 2^exponent, in [1/2, 1)
      share = (mantissa < 0.75 ? 0.25 : 0.5) / mantissa;
      if (!corner_[at(i)]) share = 1 - share;
    }
    const Vec2 p = a + share * (b - a);
    if (p == a || p == b) refuse(a);
    const std::size_t before = triangulation.number_of_vertices();
    const Vertex v = triangulation.insert(exact(p), vertices[at(i)]->face());
    if (triangulation.number_of_vertices() == before) refuse(p);
    const auto id = index_of(points.size(), "samples");
    v->info() = id;
    vertices.push_back(v);
    points.push_back(p);
    corner_.push_back(false);
    next.push_back(j);
    next[at(i)] = id;
  }

  std::vector<std::uint8_t> corner_;  // of the polygon
  Lookout look_;
};

/// Inside of every face, by the pieces that are crossed on the way from infinity.
void tell_sides(Samples& samples) {
  Delaunay& t = samples.triangulation;
  for (std::size_t i = 0; i < samples.points.size(); ++i) {
    const Delaunay::Edge edge = samples.edge(static_cast<std::int32_t>(i));
    for (const auto& [f, k] : {edge, t.mirror_edge(edge)})
      f->info().piece |= static_cast<std::uint8_t>(1 << k);
  }
  std::vector<Face> open{t.infinite_face()};
  open[0]->info().seen = 1;
  while (!open.empty()) {
    const Face face = open.back();
    open.pop_back();
    for (int k = 0; k < 3; ++k) {
      const Face other = face->neighbor(k);
      if (other->info().seen != 0) continue;
      other->info().seen = 1;
      other->info().inside = face->info().inside ^ static_cast<std::uint8_t>(face->info().piece >> k & 1);
      open.push_back(other);
    }
  }
}

/// A Voronoi vertex: the center of one triangle's circle, or of several with the same circle.
struct Place {
  std::vector<std::int32_t> samples;  // ascending
  bool inside = false;
};

std::vector<Place> places_of(const Samples& samples, const std::vector<std::int32_t>& rank,
                             Monitor& monitor) {
  const Delaunay& t = samples.triangulation;
  Lookout look(monitor);
  std::vector<Face> faces;
  for (const Face face : t.finite_face_handles()) {
    face->info().id = index_of(faces.size(), "triangles");
    faces.push_back(face);
  }
  DisjointSets sets(faces.size());
  for (const Face face : faces) {
    look(64);
    for (int k = 0; k < 3; ++k) {
      const Face other = face->neighbor(k);
      if (t.is_infinite(other) || other->info().id < face->info().id) continue;
      if (t.side_of_oriented_circle(face, t.mirror_vertex(face, k)->point()) == CGAL::ON_ORIENTED_BOUNDARY)
        sets.join(face->info().id, other->info().id);
    }
  }
  std::vector<Place> places(faces.size());
  for (const Face face : faces) {
    Place& place = places[at(sets.root(face->info().id))];
    for (int k = 0; k < 3; ++k) place.samples.push_back(rank[at(face->vertex(k)->info())]);
    place.inside = place.inside || face->info().inside != 0;
  }
  std::erase_if(places, [](const Place& place) { return place.samples.empty(); });
  for (Place& place : places) {
    look(64);
    std::sort(place.samples.begin(), place.samples.end());
    place.samples.erase(std::unique(place.samples.begin(), place.samples.end()), place.samples.end());
  }
  std::sort(places.begin(), places.end(), [&look](const Place& a, const Place& b) {
    look(1);
    return a.samples < b.samples;
  });
  return places;
}

/// Keeps those places that are, among those on their side, the farthest of some sample.
void keep_poles(std::vector<Place>& places, const std::vector<double>& radii, std::size_t samples) {
  std::vector<std::array<std::size_t, 2>> farthest(samples, {places.size(), places.size()});
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (const std::int32_t s : places[i].samples) {
      std::size_t& best = farthest[at(s)][places[i].inside];
      if (best == places.size() || radii[i] > radii[best]) best = i;
    }
  }
  std::vector<std::uint8_t> kept(places.size());
  for (const auto& both : farthest) {
    for (const std::size_t i : both) {
      if (i < places.size()) kept[i] = 1;
    }
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (kept[i] == 0) places[i].samples.clear();
  }
}

}  // namespace

DiscPoles disc_poles(const Polygon2& polygon, const DiscPolesOptions& options, Monitor& monitor) {
  if (const std::string broken = broken_invariant(polygon); !broken.empty())
    throw InputError("the polygon is damaged: " + broken, "read it again");
  if (polygon.components() == 0) throw InputError("the polygon has no components", "connect one that has");
  // Written so that nan fails.
  if (!(options.spacing >= 1e-4 && options.spacing <= 100)) {
    throw InputError("spacing is " + std::to_string(options.spacing) + " %", "take one from 0.0001 to 100");
  }
  const double size = bounding_box(polygon).longest_edge();
  if (!(size >= 1e-90 && size <= 1e90)) {
    throw InputError("the longest edge of the bounding box is " + std::to_string(size),
                     "scale the polygon to a size from 1e-90 to 1e90");
  }
  Samples samples(polygon, options.spacing / 100 * size, monitor);
  DiscPoles result;
  result.splits = samples.split(monitor);
  tell_sides(samples);

  // Samples along the rings.
  const std::size_t n = samples.points.size();
  std::vector<std::int32_t> rank(n, -1);
  std::vector<Vec2> ordered;
  for (std::size_t first = 0; first < n; ++first) {
    for (auto i = static_cast<std::int32_t>(first); rank[at(i)] < 0; i = samples.next[at(i)]) {
      rank[at(i)] = static_cast<std::int32_t>(ordered.size());
      ordered.push_back(samples.points[at(i)]);
    }
  }
  std::vector<Place> places = places_of(samples, rank, monitor);
  std::vector<Vec2> centers(places.size());
  std::vector<double> radii(places.size());
  Lookout look(monitor);
  for (std::size_t i = 0; i < places.size(); ++i) {
    look(256);
    const std::vector<std::int32_t>& s = places[i].samples;
    // Far from each other, so that little is rounded.
    centers[i] = circumcenter(
        std::array{ordered[at(s[0])], ordered[at(s[s.size() / 3])], ordered[at(s[2 * s.size() / 3])]});
    for (const std::int32_t sample : s)
      radii[i] = std::max(radii[i], distance(centers[i], ordered[at(sample)]));
  }
  if (options.vertices == DiscVertices::poles) keep_poles(places, radii, n);

  for (const bool inside : {true, false}) {
    std::vector<Vec3> places_in_space;
    std::vector<double> sizes;
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int32_t> defining;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i].inside != inside || places[i].samples.empty()) continue;
      // Outside, circles through samples that are nearly on one line may leave the range of doubles.
      if (!is_finite(centers[i]) || !(radii[i] <= 1e100)) continue;
      places_in_space.push_back(in_space(centers[i]));
      sizes.push_back(radii[i]);
      defining.insert(defining.end(), places[i].samples.begin(), places[i].samples.end());
      offsets.push_back(static_cast<std::int64_t>(defining.size()));
    }
    (inside ? result.inner : result.outer) = {std::move(places_in_space), std::move(sizes),
                                              std::move(offsets), std::move(defining)};
  }
  std::vector<Vec3> in_plane;
  in_plane.reserve(n);
  for (const Vec2 p : ordered) in_plane.push_back(in_space(p));
  result.points.points = std::move(in_plane);
  return result;
}

}  // namespace ballflow::geometry
