// First homology of a simplicial complex over Z/2: loops that form a basis, and cocycles that tell classes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "homology/binary_system.hpp"
#include "types/simplicial_complex.hpp"

namespace ballflow::geometry {

/// A basis of H_1(K; Z/2) and the dual basis of H^1(K; Z/2): cocycle k is 1 on loop k and 0 on the others.
/// The cocycles vanish on a spanning forest. dimension() is the first Betti number over Z/2, which is that
/// over the integers, since unions of balls in space have no torsion.
class FirstHomology {
 public:
  FirstHomology(const SimplicialComplex& complex, Monitor& monitor);

  std::size_t dimension() const { return cocycles_.dimension(); }

  /// Cocycles that are 1 on the edge uv, ascending. The edge must be in the complex.
  std::span<const std::int32_t> on_edge(std::int32_t u, std::int32_t v) const;
  bool has_edge(std::int32_t u, std::int32_t v) const { return edge(u, v) >= 0; }

  /// Loop k as a closed sequence of vertices, the first not repeated.
  std::vector<std::int32_t> loop(std::size_t k) const;

  /// Numbers of components, 0 .. : of vertex v (a ball that is no vertex has -1).
  std::int32_t component(std::int32_t v) const { return component_[static_cast<std::size_t>(v)]; }
  std::int32_t components() const { return components_; }

  /// The forest: vertices in an order in which parents come first; -1 is the parent of a root.
  const std::vector<std::int32_t>& outwards() const { return outwards_; }
  std::int32_t parent(std::int32_t v) const { return parent_[static_cast<std::size_t>(v)]; }

  /// Vertices joined with u by an edge, ascending.
  std::span<const std::int32_t> around(std::int32_t u) const;

 private:
  struct Skeleton;
  FirstHomology(Skeleton skeleton, const SimplicialComplex& complex, Monitor& monitor);
  std::int64_t edge(std::int32_t u, std::int32_t v) const;  // -1 where there is none

  Array<std::array<std::int32_t, 2>> edges_;
  std::vector<std::size_t> first_edge_;  // per vertex u: edges uv with v > u begin here
  std::vector<std::size_t> begin_;       // per vertex: where its neighbours begin
  std::vector<std::int32_t> neighbors_;
  std::vector<std::int32_t> outwards_;
  std::vector<std::int32_t> parent_;  // in the forest; -1 at roots
  std::vector<std::int32_t> depth_;
  std::vector<std::int32_t> component_;
  std::int32_t components_ = 0;
  BinarySystem cocycles_;
};

}  // namespace ballflow::geometry
