#include "topology/solid_topology.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "search/self_intersection.hpp"
#include "search/signed_crossings.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

/// The connected components of a closed, oriented surface.
class Shells {
 public:
  Shells(const TriangleMesh& surface, Monitor& monitor) : surface_(surface), look_(monitor) {
    number();
    measure();
    wind(monitor);
  }

  /// The solid of points with a positive winding number.
  Betti betti() const {
    Betti betti{0, 0, 0};
    for (std::size_t i = 0; i < count_; ++i) {
      const std::int64_t outside = around(i);
      const std::int64_t inside = outside + facing_[i];
      if ((outside > 0) == (inside > 0)) continue;  // lies inside the solid, or outside of it, on both sides
      ++betti[inside > 0 ? 0 : 2];
      betti[1] += genus_[i];
    }
    return betti;
  }

 private:
  void number() {
    const std::size_t n = surface_.vertices.size();
    DisjointSets connected(n);
    for (const Triangle& t : surface_.triangles) {
      for (const std::int32_t v : {t[1], t[2]}) connected.join(t[0], v);
    }
    std::vector<std::int32_t> shell(n, -1);
    for (const Triangle& t : surface_.triangles) {
      const auto r = at(connected.root(t[0]));
      if (shell[r] < 0) {
        shell[r] = static_cast<std::int32_t>(count_++);
        corner_.push_back(t[0]);
      }
      shell_.push_back(shell[r]);
    }
    // Euler characteristic of a closed surface: vertices - faces / 2.
    std::vector<std::int64_t> vertices(count_), faces(count_);
    std::vector<bool> seen(n);
    for (std::size_t f = 0; f < shell_.size(); ++f) {
      ++faces[at(shell_[f])];
      for (const std::int32_t v : surface_.triangles[f]) {
        if (!seen[at(v)]) ++vertices[at(shell_[f])];
        seen[at(v)] = true;
      }
    }
    for (std::size_t i = 0; i < count_; ++i) genus_.push_back((2 - vertices[i] + faces[i] / 2) / 2);
  }

  void measure() {
    std::vector<double> volume(count_);
    for (std::size_t f = 0; f < shell_.size(); ++f) {
      const Vec3 origin = surface_.vertices[at(corner_[at(shell_[f])])];
      const Triangle& t = surface_.triangles[f];
      volume[at(shell_[f])] +=
          dot(surface_.vertices[at(t[0])] - origin,
              cross(surface_.vertices[at(t[1])] - origin, surface_.vertices[at(t[2])] - origin));
    }
    double whole = 0;
    for (const double v : volume) whole += v;
    sign_ = whole < 0 ? -1 : 1;
    for (const double v : volume) facing_.push_back(sign_ * v < 0 ? -1 : 1);
  }

  /// How often every shell winds around a corner of every other one.
  void wind(Monitor& monitor) {
    const SignedCrossings crossings(surface_.vertices, surface_.triangles, monitor);
    winding_.assign(count_, {});
    for (std::size_t i = 0; i < count_; ++i) {
      std::vector<std::pair<std::int32_t, std::int64_t>> crossed;
      crossings.for_each_above(surface_.vertices[at(corner_[i])], [&](std::int32_t f, int sign, bool) {
        look_(64);
        if (shell_[at(f)] != static_cast<std::int32_t>(i)) crossed.emplace_back(shell_[at(f)], sign_ * sign);
      });
      std::sort(crossed.begin(), crossed.end());
      for (const auto& [shell, sign] : crossed) {
        if (winding_[i].empty() || winding_[i].back().first != shell) winding_[i].emplace_back(shell, 0);
        winding_[i].back().second += sign;
      }
      std::erase_if(winding_[i], [](const auto& w) { return w.second == 0; });
    }
    // A shell that faces inwards bounds a cavity inside another one, or else faces the wrong way.
    const std::vector<std::int64_t> faced = facing_;
    for (std::size_t i = 0; i < count_; ++i) {
      const bool inside = std::any_of(winding_[i].begin(), winding_[i].end(),
                                      [&](const auto& w) { return faced[at(w.first)] > 0; });
      turned_.push_back(faced[i] < 0 && !inside);
      if (turned_.back()) facing_[i] = 1;
    }
  }

  /// Winding number of all other shells around a corner of shell i.
  std::int64_t around(std::size_t i) const {
    std::int64_t sum = 0;
    for (const auto& [shell, number] : winding_[i]) sum += turned_[at(shell)] ? -number : number;
    return sum;
  }

  const TriangleMesh& surface_;
  Lookout look_;
  std::size_t count_ = 0;
  int sign_ = 1;  // -1 when the surface as a whole is inside out: all shells are turned first
  std::vector<std::int32_t> shell_;   // per triangle
  std::vector<std::int32_t> corner_;  // per shell: one of its vertices
  std::vector<std::int64_t> genus_;
  std::vector<std::int64_t> facing_;  // 1 outwards, -1 inwards
  std::vector<bool> turned_;
  std::vector<std::vector<std::pair<std::int32_t, std::int64_t>>> winding_;
};

}  // namespace

SolidTopology solid_topology(const TriangleMesh& surface, Monitor& monitor) {
  if (surface.triangles.empty()) return {Betti{0, 0, 0}, ""};
  const MeshTopology mesh = mesh_topology(surface);
  monitor.step(0.2);
  if (mesh.boundary_edges > 0) {
    return {std::nullopt,
            "the surface is open (" + std::to_string(mesh.boundary_edges) + " edges with one triangle)"};
  }
  if (!mesh.closed || !mesh.manifold) {
    return {std::nullopt, "the surface is not manifold (" + std::to_string(mesh.nonmanifold_edges) +
                              " edges with more than two triangles, or corners where parts touch)"};
  }
  if (!mesh.oriented) return {std::nullopt, "the triangles of the surface do not face one way"};
  if (const auto pair = self_intersection(surface, monitor)) {
    const auto [a, b] = *pair;
    return {std::nullopt, a == b
                              ? "triangle " + std::to_string(a) + " of the surface has no area"
                              : "the surface intersects itself (triangles " + std::to_string(std::min(a, b)) +
                                    " and " + std::to_string(std::max(a, b)) + ")"};
  }
  monitor.step(0.8);
  return {Shells(surface, monitor).betti(), ""};
}

TopologyTable solid_row(const TriangleMesh& surface, Monitor& monitor) {
  if (surface.triangles.empty()) return {};
  const SolidTopology solid = solid_topology(surface, monitor);
  if (!solid.betti) monitor.warn("the topology of the solid is unknown: " + solid.unknown_because);
  monitor.step(1);
  return one_row(TopologyStage::surface, solid.betti);
}

}  // namespace ballflow::geometry
