#include "mesh/sphere_patch.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_Delaunay_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "mesh/crossings.hpp"
#include "mesh/sphere_geometry.hpp"
#include "power/union_vertices.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<std::int8_t, Kernel,
                                              CGAL::Constrained_Delaunay_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;
using Point = Kernel::Point_2;
using State = SpherePatch::State;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Patch {
 public:
  Patch(const ArcNet& net, std::int32_t ball, const Projection& projection, double error, std::size_t most,
        Monitor& monitor)
      : net_(net), ball_(ball), map_(projection), error_(error), most_(most), monitor_(monitor) {}

  SpherePatch run() {
    SpherePatch result;
    result.state = trace(result);
    if (result.state != State::made) return result;
    if (!refine()) {
      result.state = State::degenerate;
      return result;
    }
    result.inside.assign(points_.begin() + static_cast<std::ptrdiff_t>(ids_.size()), points_.end());
    for (Face f : cdt_.finite_face_handles()) {
      if (f->info() != in) continue;
      // Outwards: counter-clockwise in the plane is clockwise seen from outside.
      Triangle t{};
      for (int k = 0; k < 3; ++k) {
        const std::int32_t v = f->vertex(2 - k)->info();
        t[at(k)] = at(v) < ids_.size() ? ids_[at(v)] : -1 - (v - static_cast<std::int32_t>(ids_.size()));
      }
      result.triangles.push_back(t);
      result.error = std::max(result.error, measure(f).error);
    }
    // An order that does not depend on that of the faces of the triangulation.
    for (Triangle& t : result.triangles) {
      std::rotate(t.begin(), std::max_element(t.begin(), t.end()), t.end());
    }
    std::sort(result.triangles.begin(), result.triangles.end(),
              [](const Triangle& a, const Triangle& b) { return key(a) < key(b); });
    return result;
  }

 private:
  /// Where a point of the sphere is in the plane, and the other way.
  Point plane_point(Vec3 p) const {
    const auto [x, y] = map_.plane(p);
    return {x, y};
  }
  Vec3 sphere_point(const Point& p) const { return map_.sphere(p.x(), p.y()); }

  static constexpr std::int8_t unseen = 0, in = 1, out = 2;

  static Triangle key(Triangle t) {
    std::sort(t.begin(), t.end());
    return t;
  }

  /// What may be inserted because of a triangle, or an edge.
  struct Wish {
    double error = 0;  // infinite where another patch might have the same edge or triangle
    std::array<std::int32_t, 3> corners{};
    Point place;
    Vec3 position;
  };
  struct Measure {
    double error = 0;
    bool steep = false;  // the triangle does not lie below the part of the sphere that it stands for
  };

  Vec3 position(Face f, int k) const { return points_[at(f->vertex(k)->info())]; }

  bool share(std::int32_t u, std::int32_t v) const {
    for (const std::int32_t a : others_[at(u)]) {
      if (a >= 0 && (a == others_[at(v)][0] || a == others_[at(v)][1])) return true;
    }
    return false;
  }
  bool share(std::int32_t u, std::int32_t v, std::int32_t w) const {
    for (const std::int32_t a : others_[at(u)]) {
      if (a >= 0 && (a == others_[at(v)][0] || a == others_[at(v)][1]) &&
          (a == others_[at(w)][0] || a == others_[at(w)][1]))
        return true;
    }
    return false;
  }

  /// Triangulates the chords and tells inside from outside.
  State trace(SpherePatch& result) {
    for (const std::int32_t arc : net_.arcs_of(ball_)) net_.add_chords(ball_, arc, chords_);
    for (const Chord& c : chords_) ids_.push_back(c.from);
    std::sort(ids_.begin(), ids_.end());
    ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
    for (const std::int32_t id : ids_) {
      points_.push_back(net_.points()[at(id)]);
      std::array<std::int32_t, 2> others{-1, -1};
      std::size_t k = 0;
      for (const std::int32_t b : net_.balls_of(id)) {
        if (b >= 0 && b != ball_ && k < 2) others[k++] = b;
      }
      others_.push_back(others);
    }
    std::vector<Vertex> vertices(ids_.size());
    ends_.reserve(chords_.size());
    for (const Chord& c : chords_) ends_.push_back({local(c.from), local(c.to)});
    // Along the arcs, so that each is found from the one before.
    Face hint;
    for (const auto& [from, to] : ends_) {
      for (const std::int32_t v : {from, to}) {
        if (vertices[at(v)] != Vertex()) continue;
        const std::size_t before = cdt_.number_of_vertices();
        vertices[at(v)] = cdt_.insert(plane_point(points_[at(v)]), hint);
        if (cdt_.number_of_vertices() == before) return State::degenerate;
        vertices[at(v)]->info() = v;
        hint = vertices[at(v)]->face();
      }
    }
    if (cdt_.dimension() < 2) return State::degenerate;
    try {
      for (const auto& [from, to] : ends_) cdt_.insert_constraint(vertices[at(from)], vertices[at(to)]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      return cut_crossings(result);
    }
    flood();
    bool wrong = false;
    for (const auto& [from, to] : ends_) {
      Face f;
      int i = 0;
      if (!cdt_.is_edge(vertices[at(from)], vertices[at(to)], f, i) || !cdt_.is_constrained({f, i}))
        return cut_crossings(result);
      // The patch lies left of the chord in the plane.
      if (f->vertex(Triangulation::ccw(i)) != vertices[at(from)]) f = f->neighbor(i);
      const int j = f->index(vertices[at(from)]);
      wrong = wrong || f->info() != in ||
              f->neighbor(Triangulation::cw(j) == f->index(vertices[at(to)]) ? Triangulation::ccw(j)
                                                                             : Triangulation::cw(j))
                      ->info() != out;
    }
    return wrong ? cut_long(result) : State::made;
  }

  std::int32_t local(std::int32_t id) const {
    return static_cast<std::int32_t>(std::lower_bound(ids_.begin(), ids_.end(), id) - ids_.begin());
  }

  /// Names chords that cross, or touch where they have no common end: of each pair the longer one.
  State cut_crossings(SpherePatch& result) {
    std::vector<std::array<double, 2>> plane;
    plane.reserve(points_.size());
    for (const Vec3 p : points_) plane.push_back(map_.plane(p));
    // A few chords that cross are too long. Where most of them do, rounding decides where they are.
    const std::size_t most_pairs = 20 + ends_.size();
    const auto pairs = crossings(plane, ends_, most_pairs, monitor_);
    if (pairs.size() >= most_pairs) return State::degenerate;
    for (const auto& [a, b] : pairs) {
      const double ha = chords_[a].sagitta, hb = chords_[b].sagitta, most = std::max(ha, hb);
      if (ha >= 0.7 * most) result.cut.emplace_back(chords_[a].arc, chords_[a].knot);
      if (hb >= 0.7 * most) result.cut.emplace_back(chords_[b].arc, chords_[b].knot);
    }
    return result.cut.empty() ? State::degenerate : State::crossing;
  }

  /// Names the chords that are farthest from their arcs: a small loop lies behind one of them.
  State cut_long(SpherePatch& result) const {
    double most = 0;
    for (const Chord& c : chords_) most = std::max(most, c.sagitta);
    for (const Chord& c : chords_) {
      if (c.sagitta >= 0.2 * most) result.cut.emplace_back(c.arc, c.knot);
    }
    return State::crossing;
  }

  /// A face is inside when an odd number of chords lies between it and infinity.
  void flood() {
    for (Face f : cdt_.all_face_handles()) f->info() = unseen;
    std::vector<Face> stack{cdt_.infinite_face()};
    stack.back()->info() = out;
    while (!stack.empty()) {
      const Face f = stack.back();
      stack.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face g = f->neighbor(i);
        if (g->info() != unseen) continue;
        const bool turns = cdt_.is_constrained({f, i});
        g->info() = (f->info() == in) != turns ? in : out;
        stack.push_back(g);
      }
    }
  }

  /// The corners of a face in the order of their numbers: what is computed from them then does not depend on
  /// where the triangulation begins, and that of the mirror image is mirrored.
  static std::array<int, 3> in_order(Face f) {
    std::array<int, 3> k{0, 1, 2};
    std::sort(k.begin(), k.end(), [&](int p, int q) { return f->vertex(p)->info() < f->vertex(q)->info(); });
    return k;
  }

  Measure measure(Face f) const {
    const std::array<int, 3> k = in_order(f);
    const Vec3 a = position(f, k[0]), b = position(f, k[1]), c = position(f, k[2]), o = map_.c;
    const bool turned =
        (k[1] - k[0] + 3) % 3 == 1;  // counter-clockwise in the plane is clockwise from outside
    const Vec3 n = turned ? -cross(b - a, c - a) : cross(b - a, c - a);  // outwards
    const double nn = squared_length(n), r = map_.r;
    // The point of the triangle next to the center is that below it, or the middle of the longest edge.
    std::array<double, 3> l{squared_distance(b, c), squared_distance(c, a), squared_distance(a, b)};
    std::sort(l.begin(), l.end());
    const double q = l[0] + l[1] > l[2] ? l[0] * l[1] * l[2] / (4 * nn) : l[2] / 4;
    Measure m{q / (r + std::sqrt(std::max(0.0, r * r - q))), false};
    if (nn > 0 && dot(n, a - o) >= 0.3 * r * std::sqrt(nn)) return m;
    m.steep = true;
    for (const Point& p : places_of(f))  // between them it may be a little more
      m.error = std::max(m.error, 1.1 * distance_to_triangle(sphere_point(p), a, b, c));
    return m;
  }

  /// Planar points in the middle of a face or an edge, with the corners in the order of their numbers.
  static Point middle_in_plane(Face f, int opposite) {
    const Point &a = f->vertex(Triangulation::ccw(opposite))->point(),
                &b = f->vertex(Triangulation::cw(opposite))->point();
    return {(a.x() + b.x()) / 2, (a.y() + b.y()) / 2};
  }
  static Point middle_in_plane(Face f) {
    const std::array<int, 3> k = in_order(f);
    const Point &a = f->vertex(k[0])->point(), &b = f->vertex(k[1])->point(), &c = f->vertex(k[2])->point();
    return {((a.x() + b.x()) + c.x()) / 3, ((a.y() + b.y()) + c.y()) / 3};
  }
  /// The point of a face in the plane next to the origin: on the sphere it is that farthest from the pole,
  /// where the middle of the face may be next to it. Nothing where it is on a chord or a corner.
  std::optional<Point> far_point(Face f) const {
    const Point origin(0, 0);
    std::optional<Point> best;
    double least = std::numeric_limits<double>::infinity();
    bool contained = true;
    for (const int opposite : in_order(f)) {
      const Point &a = f->vertex(Triangulation::ccw(opposite))->point(),
                  &b = f->vertex(Triangulation::cw(opposite))->point();
      contained = contained && CGAL::orientation(a, b, origin) != CGAL::RIGHT_TURN;
      const double x = b.x() - a.x(), y = b.y() - a.y(), l = x * x + y * y;
      const double t = l > 0 ? -(a.x() * x + a.y() * y) / l : 0;
      const bool inner = t > 0.01 && t < 0.99;
      const double px = a.x() + std::clamp(t, 0.0, 1.0) * x, py = a.y() + std::clamp(t, 0.0, 1.0) * y;
      if (px * px + py * py >= least) continue;
      least = px * px + py * py;
      best.reset();
      if (inner && !cdt_.is_constrained({f, opposite})) best = Point(px, py);
    }
    return contained ? origin : best;
  }
  /// Places in a face where the sphere may be far from the triangle, when it does not lie below it.
  std::vector<Point> places_of(Face f) const {
    std::vector<Point> places{middle_in_plane(f)};
    for (const int opposite : in_order(f)) {
      if (!cdt_.is_constrained({f, opposite})) places.push_back(middle_in_plane(f, opposite));
    }
    if (const auto p = far_point(f)) places.push_back(*p);
    return places;
  }

  /// The face in which p can be inserted: no chord and no point is there.
  std::optional<Face> face_of(const Point& p, Face near) const {
    Triangulation::Locate_type type;
    int i = 0;
    const Face f = cdt_.locate(p, type, i, near);
    if (type == Triangulation::FACE || (type == Triangulation::EDGE && !cdt_.is_constrained({f, i})))
      return f;
    return {};
  }

  /// Where a face is too far from the sphere, the point that helps.
  Wish wish_of(Face f, const Measure& measured) const {
    if (measured.steep) {
      Wish best;
      double most = -1;
      for (const Point& p : places_of(f)) {
        const Wish w = wish_at(f, p, measured.error);
        const double d = distance_to(f, w.position);
        if (d <= most) continue;
        most = d;
        best = w;
      }
      return best;
    }
    const std::array<int, 3> k = in_order(f);
    const Vec3 a = position(f, k[0]), b = position(f, k[1]), c = position(f, k[2]);
    Vec3 n = cross(b - a, c - a);
    if (dot(n, a - map_.c) < 0) n = -n;
    const Vec3 top = map_.c + (map_.r / length(n)) * n;
    const Point p = plane_point(top);
    const auto found = face_of(p, f);
    if (found && (*found)->info() == in) return {measured.error, corners(f), p, top};
    int longest = 0;
    double most = 0;
    for (const int i : k) {
      const double l =
          squared_distance(position(f, Triangulation::ccw(i)), position(f, Triangulation::cw(i)));
      if (l > most) {
        most = l;
        longest = i;
      }
    }
    const bool chord = cdt_.is_constrained({f, longest});
    return wish_at(f, chord ? middle_in_plane(f) : middle_in_plane(f, longest), measured.error);
  }
  double distance_to(Face f, Vec3 p) const {
    const std::array<int, 3> k = in_order(f);
    return distance_to_triangle(p, position(f, k[0]), position(f, k[1]), position(f, k[2]));
  }
  Wish wish_at(Face f, const Point& p, double error) const { return {error, corners(f), p, sphere_point(p)}; }
  static Triangle corners(Face f) {
    return key({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
  }

  Vertex insert(const Point& place, Vec3 position, Face face) {
    const Vertex v = cdt_.insert(place, face);
    v->info() = static_cast<std::int32_t>(points_.size());
    points_.push_back(position);
    others_.push_back({-1, -1});
    return v;
  }

  void insert_directions() {
    const double s = 1 / std::sqrt(3.0);
    std::vector<Vec3> directions{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int k = 0; k < 8; ++k)
      directions.push_back({(k & 1) != 0 ? s : -s, (k & 2) != 0 ? s : -s, (k & 4) != 0 ? s : -s});
    std::sort(directions.begin(), directions.end(),
              [&](Vec3 a, Vec3 b) { return before(map_.c + map_.r * a, map_.c + map_.r * b); });
    for (const Vec3 d : directions) {
      const Vec3 p = map_.c + map_.r * d;
      if (dot(d, map_.up) > 0.99) continue;
      const auto found = face_of(plane_point(p), cdt_.infinite_face());
      if (!found || (*found)->info() != in) continue;
      insert(plane_point(p), p, *found);
      flood();
    }
  }

  bool refine() {
    constexpr double always = std::numeric_limits<double>::infinity();
    const double apart = map_.r * error_;  // squared distance of points inserted in one pass
    Lookout look(monitor_);
    std::vector<Wish> wishes;
    std::vector<Vec3> fresh;
    for (bool first = true;; first = false) {
      if (!first) flood();
      wishes.clear();
      bool steep = false;
      for (Face f : cdt_.finite_face_handles()) {
        look(64);
        if (f->info() != in) continue;
        const Triangle t{f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
        bool topological = false;
        for (int i = 0; i < 3; ++i) {
          const int p = Triangulation::ccw(i), q = Triangulation::cw(i);
          if (cdt_.is_constrained({f, i}) || !share(t[at(p)], t[at(q)])) continue;
          topological = true;
          if (t[at(p)] > t[at(q)]) continue;  // once for both faces
          Wish w = wish_at(f, middle_in_plane(f, i), always);
          w.corners = {t[at(p)], t[at(q)], -1};
          wishes.push_back(w);
        }
        const bool shared = !topological && share(t[0], t[1], t[2]);
        if (shared) wishes.push_back(wish_at(f, middle_in_plane(f), always));
        if ((topological || shared) && !first) continue;
        const Measure m = measure(f);
        if (m.error <= error_) continue;
        steep = steep || m.steep;
        if (topological || shared) continue;
        wishes.push_back(wish_of(f, m));
      }
      if (wishes.empty()) return true;
      if (first && steep) {
        insert_directions();
        continue;
      }
      std::sort(wishes.begin(), wishes.end(), [](const Wish& a, const Wish& b) {
        return a.error != b.error ? a.error > b.error : a.corners < b.corners;
      });
      fresh.clear();
      // Faces are only found again from the last vertex: insertions change them.
      Face near;
      for (const Wish& wish : wishes) {
        look(256);
        const bool close = std::any_of(fresh.begin(), fresh.end(),
                                       [&](Vec3 p) { return squared_distance(p, wish.position) < apart; });
        if (close) continue;
        const auto found = face_of(wish.place, near);
        if (!found) continue;
        // Whether it is in the patch was looked at before: points inside of it change no chord.
        near = insert(wish.place, wish.position, *found)->face();
        fresh.push_back(wish.position);
      }
      if (fresh.empty() || points_.size() - ids_.size() > most_) return false;
    }
  }

  const ArcNet& net_;
  const std::int32_t ball_;
  const Projection map_;
  const double error_;
  const std::size_t most_;
  Monitor& monitor_;

  std::vector<Chord> chords_;
  std::vector<std::pair<std::int32_t, std::int32_t>> ends_;  // of chords, local
  std::vector<std::int32_t> ids_;                    // points of the net, ascending: the first local ones
  std::vector<Vec3> points_;                         // local
  std::vector<std::array<std::int32_t, 2>> others_;  // local; the other balls whose spheres have the point
  Triangulation cdt_;
};

}  // namespace

SpherePatch sphere_patch(const ArcNet& net, std::int32_t ball, Vec3 center, double radius, Vec3 pole,
                         double error, std::size_t most, Monitor& monitor) {
  return Patch(net, ball, Projection(center, radius, pole), error, most, monitor).run();
}

}  // namespace ballflow::geometry
