// The regular triangulation of weighted points in the plane, which grows point by point and forgets hidden
// ones.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/vec2.hpp"

namespace ballflow::geometry {

/// A disc by its center and squared radius; the power of x to it is |x - center|^2 - weight.
struct PlaneSite {
  Vec2 center;
  double weight = 0;  // >= 0
};

/// -1: clockwise, 0: on one line, 1: counter-clockwise, decided exactly.
int orientation(Vec2 a, Vec2 b, Vec2 c);

/// Beside CGAL's Regular_triangulation_2, which keeps hidden points to bring them back and has to insert a
/// site to tell its neighbours: nothing is ever removed here, so hidden sites are gone, and neighbours()
/// asks without inserting. Every decision is exact for the doubles given. A site whose power cell is empty or
/// has no area is hidden; where cells of more than three sites meet in a point, the triangulation depends on
/// the order of insertion, and nothing else does.
class RegularTriangulation2 {
 public:
  static constexpr std::int32_t infinite = -1, hidden = -1;

  struct Triangle {
    std::array<std::int32_t, 3> vertices;  // counter-clockwise; `infinite` beyond an edge of the convex hull
    std::array<std::int32_t, 3> neighbours;  // opposite the vertices
  };

  /// Begins with three sites whose centers are not on one line, which are vertices 0, 1 and 2.
  RegularTriangulation2(const PlaneSite& a, const PlaneSite& b, const PlaneSite& c);

  /// The vertex of the site, the next number, or `hidden`. Quick when the last one was near.
  std::int32_t insert(const PlaneSite& site);

  /// The vertices that would be neighbours of the site if it were inserted, some of them if there are any;
  /// false when it would be hidden. Also leaves the place for the next insertion.
  bool neighbours(const PlaneSite& site, std::vector<std::int32_t>& found);

  /// A triangle whose closure has the point, or one with the vertex at infinity.
  const Triangle& locate(Vec2 p);

  const PlaneSite& site(std::int32_t vertex) const { return sites_[static_cast<std::size_t>(vertex)]; }
  /// Of all sites that were ever vertices.
  std::size_t size() const { return sites_.size(); }
  /// How many are vertices now.
  std::size_t vertices() const { return triangles_.size() / 2 + 1 - free_.size() / 2; }
  /// Triangles in use, those with the vertex at infinity included, renumbered without gaps. Ends the
  /// triangulation.
  std::vector<Triangle> take_triangles();

 private:
  bool conflicts(std::int32_t triangle, const PlaneSite& site) const;
  std::int32_t walk(Vec2 p);
  bool find_cavity(const PlaneSite& site);
  std::int32_t new_triangle();
  Triangle& at(std::int32_t i) { return triangles_[static_cast<std::size_t>(i)]; }
  const Triangle& at(std::int32_t i) const { return triangles_[static_cast<std::size_t>(i)]; }
  std::int32_t& first_at(std::int32_t vertex) { return first_[static_cast<std::size_t>(vertex + 1)]; }

  struct Side {
    std::int32_t outer;  // the triangle beyond
    std::int32_t a, b;   // counter-clockwise around the cavity
  };
  std::vector<PlaneSite> sites_;
  std::vector<Triangle> triangles_;
  std::vector<std::int32_t> free_, cavity_, first_;
  std::vector<std::uint32_t> seen_;  // of triangles: 2 round where outside, 2 round + 1 where in the cavity
  std::vector<Side> sides_;
  std::uint32_t round_ = 0;
  std::int32_t hint_ = 0;
  bool ordinary_ = true;  // no coordinate beyond 1e60, no weight beyond 1e120: double arithmetic is tried
};

/// The neighbours of every vertex, each once, in no particular order; `infinite` among those of vertices of
/// the convex hull.
class PlaneLinks {
 public:
  PlaneLinks(std::span<const RegularTriangulation2::Triangle> triangles, std::size_t vertices);
  std::span<const std::int32_t> of(std::size_t vertex) const {
    return {neighbours_.data() + begins_[vertex], begins_[vertex + 1] - begins_[vertex]};
  }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::int32_t> neighbours_;
};

}  // namespace ballflow::geometry
