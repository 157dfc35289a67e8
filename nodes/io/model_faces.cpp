#include "io/model_faces.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/first_equal.hpp"
#include "io/triangulate_polygon.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;
using Edge = std::array<Index, 2>;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The polygons of a model with welded corners, no two successive ones equal.
class WeldedPolygons {
 public:
  WeldedPolygons(const RawModel& model, std::span<const Index> first) {
    begins_.reserve(model.polygons.size() + 1);
    begins_.push_back(0);
    for (const RawPolygon& polygon : model.polygons) {
      const Triangle* fan = &model.triangles[at(polygon.first_triangle)];
      add(first[at(fan[0][0])]);
      add(first[at(fan[0][1])]);
      for (Index k = 0; k + 2 < polygon.corners; ++k) add(first[at(fan[k][2])]);
      while (ids_.size() > begins_.back() + 1 && ids_.back() == ids_[begins_.back()]) ids_.pop_back();
      begins_.push_back(ids_.size());
    }
  }

  std::size_t size() const { return begins_.size() - 1; }
  std::span<const Index> operator[](std::size_t i) const {
    return {ids_.data() + begins_[i], ids_.data() + begins_[i + 1]};
  }

  /// For each polygon the first one with the same corners, from whichever on and whichever way round.
  std::vector<Index> first_equal_polygon() const {
    return first_equal(
        size(),
        [this](std::size_t i) {
          std::uint64_t sum = (*this)[i].size();
          for (const Index id : (*this)[i]) sum += mix_hash(0, static_cast<std::uint64_t>(id));
          return mix_hash(0, sum);
        },
        [this](std::size_t a, std::size_t b) { return direction(a, b) != 0; });
  }

  /// 1: polygon b has the corners of a in the same order, from some corner on; -1: in the opposite order.
  int direction(std::size_t a, std::size_t b) const {
    const std::span<const Index> p = (*this)[a], q = (*this)[b];
    const std::size_t n = p.size();
    if (n != q.size()) return 0;
    if (n == 0) return 1;
    // Where a corner is repeated there are several places to begin; more than a few are not looked at.
    int begun = 0;
    for (std::size_t start = 0; start < n && begun < 8; ++start) {
      if (q[start] != p[0]) continue;
      ++begun;
      bool same = true, opposite = true;
      for (std::size_t k = 1; k < n && (same || opposite); ++k) {
        same = same && q[(start + k) % n] == p[k];
        opposite = opposite && q[(start + n - k) % n] == p[k];
      }
      if (same) return 1;
      if (opposite) return -1;
    }
    return 0;
  }

 private:
  void add(Index id) {
    if (ids_.size() == begins_.back() || ids_.back() != id) ids_.push_back(id);
  }
  std::vector<std::size_t> begins_;
  std::vector<Index> ids_;
};

Triangle sorted(Triangle t) {
  if (t[0] > t[1]) std::swap(t[0], t[1]);
  if (t[1] > t[2]) std::swap(t[1], t[2]);
  if (t[0] > t[1]) std::swap(t[0], t[1]);
  return t;
}

std::vector<Index> first_equal_triangle(const std::vector<Triangle>& triangles) {
  return first_equal(
      triangles.size(),
      [&](std::size_t i) {
        const Triangle t = sorted(triangles[i]);
        return mix_hash(
            mix_hash(mix_hash(0, static_cast<std::uint64_t>(t[0])), static_cast<std::uint64_t>(t[1])),
            static_cast<std::uint64_t>(t[2]));
      },
      [&](std::size_t a, std::size_t b) { return sorted(triangles[a]) == sorted(triangles[b]); });
}

std::array<Edge, 3> edges_of(const Triangle& unsorted) {
  const Triangle t = sorted(unsorted);
  return {Edge{t[0], t[1]}, Edge{t[0], t[2]}, Edge{t[1], t[2]}};
}

/// Which of `doubles`, triangles that are there an even number of times, close nothing beside `singles`.
std::vector<bool> closes_nothing(const std::vector<Triangle>& doubles, const std::vector<Triangle>& singles,
                                 std::size_t vertices) {
  struct Side {
    Edge edge;
    Index triangle;
  };
  std::vector<Side> sides;
  std::vector<bool> touched(vertices);
  for (std::size_t d = 0; d < doubles.size(); ++d) {
    for (const Edge& edge : edges_of(doubles[d])) sides.push_back({edge, static_cast<Index>(d)});
    for (const Index v : doubles[d]) touched[at(v)] = true;
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.triangle < b.triangle;
  });
  std::vector<std::size_t> others(sides.size());  // at the first side of each edge: how many singles
  for (const Triangle& t : singles) {
    for (const Edge& edge : edges_of(t)) {
      if (!touched[at(edge[0])] || !touched[at(edge[1])]) continue;
      const auto side = std::lower_bound(sides.begin(), sides.end(), edge,
                                         [](const Side& s, const Edge& e) { return s.edge < e; });
      if (side != sides.end() && side->edge == edge) ++others[static_cast<std::size_t>(side - sides.begin())];
    }
  }
  const auto for_each_edge = [&](auto visit) {
    for (std::size_t i = 0, end = 0; i < sides.size(); i = end) {
      while (end < sides.size() && sides[end].edge == sides[i].edge) ++end;
      visit(std::span<const Side>(sides).subspan(i, end - i), others[i]);
    }
  };
  DisjointSets sheets(doubles.size());
  for_each_edge([&](std::span<const Side> around, std::size_t other) {
    if (other != 0) return;
    for (const Side& side : around) sheets.join(around[0].triangle, side.triangle);
  });
  std::vector<std::int64_t> votes(doubles.size());  // of each sheet to go
  for_each_edge([&](std::span<const Side> around, std::size_t other) {
    if (other == 0) return;
    for (const Side& side : around) votes[at(sheets.root(side.triangle))] += other % 2 == 0 ? 1 : -1;
  });
  std::vector<bool> result(doubles.size());
  for (std::size_t d = 0; d < doubles.size(); ++d) {
    result[d] = votes[at(sheets.root(static_cast<Index>(d)))] > 0;
  }
  return result;
}

}  // namespace

std::vector<Triangle> triangles_of(const RawModel& model, std::span<const Index> first, FaceCounts& counts,
                                   Monitor& monitor) {
  Lookout look(monitor);
  std::vector<Triangle> triangles;
  triangles.reserve(model.triangles.size());
  auto add_until = [&, next = std::size_t{0}](std::size_t end, std::size_t skip) mutable {
    look(end - next);
    for (; next < end; ++next) {
      const Triangle& raw = model.triangles[next];
      const Triangle t{first[at(raw[0])], first[at(raw[1])], first[at(raw[2])]};
      if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) {
        ++counts.degenerate;
      } else {
        triangles.push_back(t);
      }
    }
    next += skip;
  };
  const WeldedPolygons polygons(model, first);
  const std::vector<Index> equal = polygons.first_equal_polygon();
  std::vector<std::size_t> begins, ends;  // of the triangles of each polygon
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const std::span<const Index> corners = polygons[i];
    const auto fan = static_cast<std::size_t>(model.polygons[i].corners) - 2;
    add_until(at(model.polygons[i].first_triangle), fan);
    look(16 * corners.size());
    counts.degenerate += static_cast<std::int64_t>(fan - (corners.size() < 3 ? 0 : corners.size() - 2));
    begins.push_back(triangles.size());
    const std::size_t same = at(equal[i]);
    if (same != i) {
      const bool turned = polygons.direction(same, i) < 0;
      for (std::size_t t = begins[same]; t < ends[same]; ++t) {
        const Triangle copy = triangles[t];
        triangles.push_back(turned ? Triangle{copy[0], copy[2], copy[1]} : copy);
      }
    } else if (corners.size() >= 3) {
      const PolygonTriangulation made = triangulate_polygon(model.vertices, corners, triangles, monitor);
      counts.concave += made.shape == PolygonShape::concave;
      counts.bent += made.shape == PolygonShape::concave && !made.flat;
      counts.crossing += made.shape == PolygonShape::crossing;
    }
    // A corner that is met again makes some triangles of a fan degenerate.
    const auto degenerate =
        std::remove_if(triangles.begin() + static_cast<std::ptrdiff_t>(begins.back()), triangles.end(),
                       [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    counts.degenerate += triangles.end() - degenerate;
    triangles.erase(degenerate, triangles.end());
    ends.push_back(triangles.size());
  }
  add_until(model.triangles.size(), 0);
  return triangles;
}

void drop_repeated(std::vector<Triangle>& triangles, std::size_t vertices, FaceCounts& counts) {
  const std::vector<Index> first = first_equal_triangle(triangles);
  std::vector<Index> times(triangles.size(), 0);
  for (const Index f : first) ++times[at(f)];
  std::vector<Triangle> singles, doubles;
  std::vector<std::size_t> place;  // of doubles in `triangles`
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (times[t] == 0) continue;
    if (times[t] % 2 != 0) {
      singles.push_back(triangles[t]);
    } else {
      doubles.push_back(triangles[t]);
      place.push_back(t);
    }
  }
  if (!doubles.empty()) {
    const std::vector<bool> goes = closes_nothing(doubles, singles, vertices);
    for (std::size_t d = 0; d < doubles.size(); ++d) {
      if (!goes[d]) continue;
      counts.cancelled += times[place[d]];
      times[place[d]] = 0;
    }
  }
  std::vector<Triangle> kept;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (times[t] == 0) continue;
    counts.repeated += times[t] - 1;
    kept.push_back(triangles[t]);
  }
  triangles = std::move(kept);
}

}  // namespace ballflow::geometry
