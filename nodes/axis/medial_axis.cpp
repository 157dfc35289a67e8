// Why the result has the homotopy type of the union. Let T_w be the triangle of the boundary of R that names
// w in W. For a point x = sum l_i c_i of a simplex of K and any p, |x - p|^2 = sum l_i |c_i - p|^2 -
// const(x), and |c_i - w| >= r_i with equality on the spheres through w. Hence T_w lies in V(w), simplices
// without w on all their spheres do not lie nearer to w, and a segment from a point of V(w) in R to w leaves
// R exactly once, through T_w. So R falls into the convex polytopes P_w = {x in V(w) on the inner side of
// T_w}; T_w is the only facet of P_w on the boundary of R. Pushing every P_w from T_w onto its other facets
// is a deformation of R onto R intersected with V. Where one w has several triangles the segments leave
// through one of them, and the same push works.
//
// The facets of P_w other than T_w are pieces of Voronoi facets V(w) * V(w'); a Voronoi facet is cut by the
// boundary of R along edges ij that triangles of w and w' share, so that every cut point is a ball centre. It
// therefore suffices to know which Voronoi vertices lie in R, and no intersection is ever computed. The
// centre of a ball lies on every Voronoi edge whose three sites are on its sphere, for no site is nearer to
// it. All W on one ball are cospherical: their Delaunay cells all have the ball's centre as circumcentre.
// This is decided by names, never by coordinates, so that rounding cannot tear the centre apart.
//
// All this is true of exact points. In doubles it fails where points of W lie closer than they are rounded,
// or the plane of T_w passes closer to a Voronoi vertex: then it is done with exact decisions, of balls
// without ties.
#include "axis/medial_axis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "axis/grown_sites.hpp"
#include "axis/tidy_pieces.hpp"
#include "axis/voronoi_facets.hpp"
#include "axis/voronoi_places.hpp"
#include "homology/axis_betti.hpp"
#include "power/grown_balls.hpp"
#include "power/power_diagram.hpp"
#include "power/union_vertices.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The longest edge of the bounding box of the union.
double size_of(const SimplicialComplex& complex) {
  Box box;
  for (const std::int32_t b : complex.vertices) {
    const Vec3 c = complex.centers[at(b)];
    const double r = std::sqrt(std::max(0.0, complex.weights[at(b)]));
    box.add(c - Vec3{r, r, r});
    box.add(c + Vec3{r, r, r});
  }
  return box.longest_edge();
}

/// Puts an axis together from a complex and the places of its Voronoi vertices.
class Axis {
 public:
  /// Keeps references. `places` is null without tetrahedra.
  Axis(const SimplicialComplex& complex, const VoronoiPlaces* places, Monitor& monitor)
      : complex_(complex), places_(places), monitor_(monitor), look_(monitor) {}

  /// None where a cell of a boundary vertex is not closed (see cells_are_closed). With `same`, what rounding
  /// alone has made, corners no farther apart among it, is taken away.
  std::optional<MedialAxis> run(double same = 0) {
    if (places_ != nullptr) {
      PartMonitor facets(monitor_, 0.7, 0.9);
      pieces_ = voronoi_facets(complex_, *places_, facets);
      if (!cells_are_closed(complex_, places_->sites(), pieces_, monitor_)) return std::nullopt;
    }
    add_singular_part();
    if (same > 0) tidy(same);
    return finish();
  }

 private:
  void add_singular_part();
  void tidy(double same);
  MedialAxis finish();
  Vec3 position(std::int32_t name) const {
    const auto balls = static_cast<std::int32_t>(complex_.centers.size());
    return name < balls ? complex_.centers[at(name)] : places_->position(name - balls);
  }

  const SimplicialComplex& complex_;
  const VoronoiPlaces* places_;
  Monitor& monitor_;
  Lookout look_;
  std::vector<AxisPiece> pieces_;
  std::vector<std::array<std::int32_t, 2>> edges_;
  std::vector<std::int32_t> isolated_;
};

void Axis::add_singular_part() {
  std::vector<bool> has_triangle(complex_.edges.size(), false), has_edge(complex_.centers.size(), false);
  std::vector<bool> has_tetrahedron(complex_.triangles.size(), false);
  const auto skip = []<std::size_t N>(const std::array<std::int32_t, N>& simplex, std::size_t left_out) {
    std::array<std::int32_t, N - 1> face{};
    for (std::size_t k = 0, m = 0; k < N; ++k) {
      if (k != left_out) face[m++] = simplex[k];
    }
    return face;
  };
  const auto index = [](const auto& all, const auto& simplex) {
    return static_cast<std::size_t>(std::lower_bound(all.begin(), all.end(), simplex) - all.begin());
  };
  for (const auto& t : complex_.tetrahedra) {
    look_(256);  // searches
    for (std::size_t k = 0; k < 4; ++k) has_tetrahedron[index(complex_.triangles, skip(t, k))] = true;
  }
  for (std::size_t i = 0; i < complex_.triangles.size(); ++i) {
    look_(256);
    const auto& t = complex_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) has_triangle[index(complex_.edges, skip(t, k))] = true;
    if (!has_tetrahedron[i]) pieces_.push_back({{t[0], t[1], t[2]}, AxisKind::singular});
  }
  for (std::size_t i = 0; i < complex_.edges.size(); ++i) {
    look_(8);
    for (const std::int32_t b : complex_.edges[i]) has_edge[at(b)] = true;
    if (!has_triangle[i]) edges_.push_back(complex_.edges[i]);
  }
  for (const std::int32_t b : complex_.vertices) {
    if (!has_edge[at(b)]) isolated_.push_back(b);
  }
}

void Axis::tidy(double same) {
  TidyOptions options;
  options.balls = static_cast<std::int32_t>(complex_.centers.size());
  options.same = [this, same](std::int32_t a, std::int32_t b) {
    return distance(position(a), position(b)) <= same;
  };
  tidy_pieces(pieces_, edges_, options, monitor_);
}

/// Numbers the vertices in the order of their names and the polygons in the order of their corners.
MedialAxis Axis::finish() {
  std::vector<std::int32_t> index(
      complex_.centers.size() + (places_ != nullptr ? places_->cells().size() : 0), -1);
  for (const AxisPiece& piece : pieces_) {
    look_(64);
    for (const std::int32_t name : piece.corners) index[at(name)] = 0;
  }
  for (const auto& edge : edges_) {
    for (const std::int32_t name : edge) index[at(name)] = 0;
  }
  for (const std::int32_t name : isolated_) index[at(name)] = 0;
  std::vector<Vec3> vertices;
  std::vector<double> radii;
  for (std::size_t name = 0; name < index.size(); ++name) {
    look_(64);
    if (index[name] < 0) continue;
    index[name] = static_cast<std::int32_t>(vertices.size());
    if (name < complex_.centers.size()) {
      vertices.push_back(complex_.centers[name]);
      radii.push_back(std::sqrt(std::max(0.0, complex_.weights[name])));
    } else {
      const auto cell = static_cast<std::int32_t>(name - complex_.centers.size());
      const auto& sites = places_->sites();
      const auto& corners = places_->cells()[at(cell)].corners;
      const Vec3 position = places_->position(cell);
      vertices.push_back(position);
      Vec3 site = sites.points[at(corners[0])];
      for (const std::int32_t w : corners) site = std::min(site, sites.points[at(w)], before);
      radii.push_back(distance(position, site));
    }
  }
  for (AxisPiece& piece : pieces_) {
    look_(64);
    std::vector<std::int32_t>& p = piece.corners;
    for (std::int32_t& corner : p) corner = index[at(corner)];
    std::rotate(p.begin(), std::min_element(p.begin(), p.end()), p.end());
    if (p.back() < p[1]) std::reverse(p.begin() + 1, p.end());
  }
  monitor_.step(0.93);
  std::sort(pieces_.begin(), pieces_.end(), [this](const AxisPiece& a, const AxisPiece& b) {
    look_(32);
    return a.corners != b.corners ? a.corners < b.corners : a.kind < b.kind;
  });
  monitor_.step(0.96);
  for (auto& edge : edges_) edge = {index[at(edge[0])], index[at(edge[1])]};

  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> corners;
  std::vector<std::uint8_t> kinds;
  for (const AxisPiece& piece : pieces_) {
    look_(64);
    corners.insert(corners.end(), piece.corners.begin(), piece.corners.end());
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
    kinds.push_back(static_cast<std::uint8_t>(piece.kind));
  }
  MedialAxis axis;
  axis.vertices = std::move(vertices);
  axis.radii = std::move(radii);
  axis.edges = std::move(edges_);
  axis.polygon_offsets = std::move(offsets);
  axis.polygon_vertices = std::move(corners);
  axis.polygon_kinds = std::move(kinds);
  return with_sheets(std::move(axis), monitor_);
}

/// The axis from boundary vertices in doubles; none where a cell is not closed. `diagram`: null where it is
/// not known.
std::optional<MedialAxis> rounded_axis(const SimplicialComplex& complex, const PowerDiagram* diagram,
                                       Monitor& monitor) {
  if (complex.tetrahedra.empty()) return Axis(complex, nullptr, monitor).run();
  const double size = size_of(complex);
  PartMonitor first(monitor, 0, 0.1), second(monitor, 0.1, 0.7);
  const auto named =
      diagram != nullptr ? exposed_sides(complex, *diagram, first) : exposed_sides(complex, first);
  const RoundedPlaces places(complex, union_vertices(complex, named, std::ldexp(size, -40), first), size,
                             second);
  return Axis(complex, &places, monitor).run();
}

/// The axis without a rounded decision, of balls that grew by less than any feature; slower.
MedialAxis grown_axis(const SimplicialComplex& complex, Monitor& monitor) {
  const GrownBalls balls(complex.centers.span(), complex.weights.span());
  const double size = size_of(complex);
  PartMonitor first(monitor, 0, 0.2), second(monitor, 0.2, 0.3);
  const SimplicialComplex grown = grown_complex(balls, first);
  if (grown.tetrahedra.empty()) return *Axis(grown, nullptr, monitor).run();
  const GrownSites sites(grown, balls, second);
  const GrownPlaces places(grown, sites, size, monitor);
  std::optional<MedialAxis> axis = Axis(grown, &places, monitor).run(std::ldexp(size, -36));
  if (!axis)
    throw std::logic_error("the cells of the medial axis are not closed although every decision was exact");
  return *std::move(axis);
}

MedialAxis checked_axis(const SimplicialComplex& complex, const PowerDiagram* diagram,
                        const MedialAxisOptions& options, Monitor& monitor) {
  std::optional<MedialAxis> axis;
  Betti found{};
  if (!options.exact || complex.tetrahedra.empty()) {
    axis = rounded_axis(complex, diagram, monitor);
    if (axis) found = axis_betti(*axis, monitor);
  }
  if (!axis || (found != complex.betti && !complex.tetrahedra.empty())) {
    if (!options.exact) monitor.note("rounding hides the structure of the axis: again with exact decisions");
    axis = grown_axis(complex, monitor);
    found = axis_betti(*axis, monitor);
  }
  if (found != complex.betti) {
    const std::string cause =
        "the axis has " + describe(found) + ", but the union has " + describe(complex.betti);
    const std::string hint =
        "the alpha-shape is not that of its balls, whose axis this is: make it from the balls (node "
        "AlphaShape)";
    if (options.on_mismatch == AxisMismatch::error) throw InputError(cause, hint);
    monitor.warn(cause + "; " + hint);
  }
  monitor.step(1);
  return *std::move(axis);
}

}  // namespace

MedialAxis medial_axis(const SimplicialComplex& complex, const MedialAxisOptions& options, Monitor& monitor) {
  return checked_axis(complex, nullptr, options, monitor);
}

MedialAxis medial_axis(const SimplicialComplex& complex, const PowerDiagram& diagram,
                       const MedialAxisOptions& options, Monitor& monitor) {
  check_diagram_of(diagram, complex);
  return checked_axis(complex, &diagram, options, monitor);
}

}  // namespace ballflow::geometry
