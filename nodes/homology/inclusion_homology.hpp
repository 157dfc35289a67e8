// What the inclusion of one union of balls in another does to components, loops and cavities: the maps
// H_k(U*; Z/2) -> H_k(U+; Z/2), k = 0, 1, 2, by their ranks.
//
// Notation: B+ is a set of balls, B* a subset of it, U+ and U* their unions, K+ and K* the dual complexes.
// K* is no part of K+, because power cells change when balls are removed; so homology is compared through
// points and paths that lie in both unions.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/monitor.hpp"
#include "homology/first_homology.hpp"
#include "power/power_walk.hpp"
#include "power/voids.hpp"
#include "types/balls.hpp"
#include "types/power_diagram.hpp"
#include "types/simplicial_complex.hpp"
#include "types/topology_check.hpp"

namespace ballflow::geometry {

/// A union of balls, prepared for being compared with unions of subsets of its balls.
///
/// - H_0: a vertex of K* is followed to the ball of B+ in whose power cell its centre lies.
/// - H_1: an edge ij of K* is the segment between two centres, which lies in U*. The power cells of B+ that
/// it
///   passes through are a path in K+ (PowerWalk). The images of a basis of loops are evaluated by a basis of
///   cocycles of K+.
/// - H_2, by Alexander duality: voids. A point of every void of U+ is located among the voids of U*.
/// Every decision is exact for the doubles that balls are made of. Loops that wind three times around another
/// one are the same over Z/2: that the maps are isomorphisms over the integers as well is not checked.
class UnionOfBalls {
 public:
  /// Any balls that keep their invariants, as for alpha_shape; radii are taken as they are. The monitor is
  /// looked at as long as this object lives.
  UnionOfBalls(const Balls& balls, Monitor& monitor);
  /// The same where the power diagram of the balls is known, and their alpha-shape. The diagram is taken with
  /// the tolerance none.
  UnionOfBalls(const Balls& balls, PowerDiagram diagram, Monitor& monitor);
  UnionOfBalls(const Balls& balls, PowerDiagram diagram, SimplicialComplex complex, Monitor& monitor);

  const Balls& balls() const { return balls_; }
  const SimplicialComplex& complex() const { return *complex_; }
  const FirstHomology& loops() const { return *loops_; }
  /// Made when first asked for.
  const Voids& voids() const;
  const PowerWalk& walk() const;
  /// The vertex of K+ in whose power cell the centre of a ball lies.
  std::int32_t vertex_at(std::int32_t ball) const;

  InclusionHomology inclusion_of(std::span<const std::int32_t> part) const;
  /// inclusion_of(part).isomorphism(), sooner where it is false.
  bool isomorphic_to(std::span<const std::int32_t> part) const;

 private:
  friend class Inclusion;
  Monitor& monitor_;
  Balls balls_;
  std::unique_ptr<const PowerDiagram> diagram_;  // what voids and walks refer to, wherever this object moves
  std::unique_ptr<const SimplicialComplex> complex_;
  std::unique_ptr<FirstHomology> loops_;
  mutable std::unique_ptr<Voids> voids_;
  mutable std::unique_ptr<PowerWalk> walk_;
  mutable std::vector<std::int32_t> vertex_at_;  // per ball, -1 where it was not asked for
};

/// How U*, the union of `ids` (ascending), lies in U+: the maps, with what a repair wants to know.
class Inclusion {
 public:
  Inclusion(const UnionOfBalls& whole, std::span<const std::int32_t> ids);
  /// The same with the union of the balls `ids`, where it is known. Its balls may be smaller than those of
  /// the whole with the same centers: all that counts is that U* lies in U+.
  Inclusion(const UnionOfBalls& whole, std::span<const std::int32_t> ids, UnionOfBalls part);

  const InclusionHomology& homology() const { return homology_; }
  const UnionOfBalls& part() const { return part_; }
  std::int32_t id(std::int32_t part_ball) const { return ids_[static_cast<std::size_t>(part_ball)]; }

  /// From the power cell of U+ at the centre of a ball of the part to that at the centre of a ball that it
  /// meets: the sum of the cocycles on the steps.
  std::vector<std::int32_t> along_edge(std::int32_t u, std::int32_t v) const;

  /// Per component of U*: the component of U+ that it lies in.
  const std::vector<std::int32_t>& component_image() const { return component_image_; }
  /// Per loop of part().loops(): its class in H_1(U+), as cocycles of whole.loops() that are 1 on it.
  const std::vector<std::vector<std::int32_t>>& loop_image() const { return loop_image_; }
  /// Per void of U+: where it lies in the voids of U*. Only the outer one when neither has a cavity.
  const std::vector<Voids::Place>& void_image() const { return void_image_; }

 private:
  std::vector<std::int32_t> image_of(const std::vector<std::int32_t>& loop) const;

  const UnionOfBalls& whole_;
  std::vector<std::int32_t> ids_;
  UnionOfBalls part_;
  std::vector<std::int32_t> component_image_;
  std::vector<std::vector<std::int32_t>> loop_image_;
  std::vector<Voids::Place> void_image_;
  InclusionHomology homology_;
};

}  // namespace ballflow::geometry
