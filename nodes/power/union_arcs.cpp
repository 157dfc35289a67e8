#include "power/union_arcs.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cstddef>

#include "base/lists.hpp"

namespace ballflow::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// A triangle at an edge ij, i < j.
struct Wing {
  std::int32_t apex = 0, triangle = 0;
  bool odd = false;  // (i, j, apex) is an odd permutation of the ascending triangle
};

class ArcFinder {
 public:
  ArcFinder(const SimplicialComplex& complex, std::span<const ExposedSide> sides)
      : complex_(complex), named_(complex.triangles.size(), {-1, -1}) {
    for (std::size_t s = 0; s < sides.size(); ++s) {
      named_[at(sides[s].triangle)][sides[s].side > 0 ? 1 : 0] = static_cast<std::int32_t>(s);
    }
  }

  std::vector<UnionArc> run(Monitor& monitor) {
    Lists<Wing> wings = lists_of<Wing>(complex_.edges.size(), [&](auto&& put) {
      for (std::size_t t = 0; t < complex_.triangles.size(); ++t) {
        const auto& c = complex_.triangles[t];
        put(edge_index(c[0], c[1]), Wing{c[2], static_cast<std::int32_t>(t), false});
        put(edge_index(c[0], c[2]), Wing{c[1], static_cast<std::int32_t>(t), true});
        put(edge_index(c[1], c[2]), Wing{c[0], static_cast<std::int32_t>(t), false});
      }
    });
    for (std::size_t e = 0; e < complex_.edges.size(); ++e) {
      if (e % 1024 == 0) monitor.step(static_cast<double>(e) / static_cast<double>(complex_.edges.size()));
      if (complex_.edge_classes[e] == static_cast<std::uint8_t>(SimplexClass::interior)) continue;
      add_arcs(static_cast<std::int32_t>(e), wings[e]);
    }
    return std::move(arcs_);
  }

 private:
  std::size_t edge_index(std::int32_t i, std::int32_t j) const {
    const auto found = std::lower_bound(complex_.edges.begin(), complex_.edges.end(), std::array{i, j});
    return static_cast<std::size_t>(found - complex_.edges.begin());
  }

  /// The exposed side of the wing that lies ahead of it (side 1) or behind it (side -1) when it turns around
  /// ij; -1 where a tetrahedron lies there.
  std::int32_t named(const Wing& wing, int side) const {
    const bool positive = (side > 0) != wing.odd;
    return named_[at(wing.triangle)][positive ? 1 : 0];
  }

  void add_arcs(std::int32_t edge, std::span<Wing> wings) {
    if (wings.empty()) {
      arcs_.push_back({.edge = edge});
      return;
    }
    const auto [i, j] = complex_.edges[at(edge)];
    const auto point = [this](std::int32_t ball) {
      const Vec3 p = complex_.centers[at(ball)];
      return Kernel::Point_3(p.x, p.y, p.z);
    };
    // 1 when b is reached from a by less than half a turn around ij, 0 when they are opposite.
    const auto ahead = [&](const Wing& a, const Wing& b) {
      return static_cast<int>(CGAL::orientation(point(i), point(j), point(a.apex), point(b.apex)));
    };
    const Wing reference = wings.front();
    const auto half = [&](const Wing& w) {
      if (w.triangle == reference.triangle) return 0;
      const int turn = ahead(reference, w);
      return turn > 0 ? 1 : turn == 0 ? 2 : 3;
    };
    std::sort(wings.begin(), wings.end(), [&](const Wing& a, const Wing& b) {
      const int ha = half(a), hb = half(b);
      return ha != hb ? ha < hb : ahead(a, b) > 0;
    });
    for (std::size_t k = 0; k < wings.size(); ++k) {
      const Wing &a = wings[k], &b = wings[(k + 1) % wings.size()];
      const std::int32_t from = named(a, 1), to = named(b, -1);
      if (from < 0 || to < 0) continue;  // a tetrahedron lies between them
      const int turn = a.apex == b.apex ? 0 : ahead(a, b);
      arcs_.push_back({edge, from, to, a.apex, b.apex, static_cast<std::int8_t>(turn)});
    }
  }

  const SimplicialComplex& complex_;
  std::vector<std::array<std::int32_t, 2>> named_;  // per triangle, the exposed sides -1 and 1
  std::vector<UnionArc> arcs_;
};

}  // namespace

std::vector<UnionArc> union_arcs(const SimplicialComplex& complex, std::span<const ExposedSide> sides,
                                 Monitor& monitor) {
  return ArcFinder(complex, sides).run(monitor);
}

}  // namespace ballflow::geometry
