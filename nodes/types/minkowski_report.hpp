// What the Minkowski sum of two sets of balls came to.
#pragma once

#include <cstdint>
#include <string>

#include "base/vec3.hpp"
#include "types/comparison.hpp"

namespace ballflow::geometry {

/// How the sums of pairs of balls were rounded.
enum class SumsRounded : std::uint8_t {
  to_nearest,
  inwards,   // a ball lies in the exact sum of its pair
  outwards,  // a ball contains it
};

/// What is known of the balls of one side and its solid: that they enclose it, or that they lie inside.
enum class SideProof : std::uint8_t {
  unknown,  // nothing was looked at, or there is no solid
  proven,
  refuted,  // or not proven where it was tried
  itself,   // the solid is the union of the balls
};

struct MinkowskiReport {
  std::int64_t pairs = 0;  // |A| * |B|
  std::int64_t survivors =
      0;  // sums that had to be triangulated; algorithm memory: that were still vertices at the end
  std::int64_t count = 0;  // balls of the result: the sums that contribute, or the smallest part of them
  std::int64_t contributing = 0;  // sums that contribute
  // Those of an inclusion-minimal part of them with the same union; -1: nobody asked.
  std::int64_t minimal = -1;
  // Contributing sums with a piece of their sphere, for radius 0 their point, on the boundary of the union.
  std::int64_t touching_boundary = 0;
  Vec3 lower, upper;  // of the bounding box of the union, model units; 0 for no balls

  // No point of the surface of A + B is farther than this from the union, where A and B are the solids that
  // the balls stand for; negative: unknown. Model units.
  double error_bound = -1;
  // ComparedWith: what the balls of a and of b were compared with. A solid that was compared with nothing is
  // the union of its balls.
  std::uint8_t a_compared_with = 0, b_compared_with = 0;

  // No point of the union is farther than this from A + B; negative: unknown. Model units.
  double excess_bound = -1;
  std::uint8_t rounded = 0;                     // SumsRounded
  std::uint8_t a_encloses = 0, b_encloses = 0;  // SideProof: a solid lies in its balls
  std::uint8_t a_inside = 0, b_inside = 0;      // SideProof: no ball reaches out of its solid

  /// The union contains A + B: proven.
  bool contains() const;
  /// The union lies inside A + B: proven.
  bool inside() const;
};

/// Which of both is proven, and how; empty where nothing is.
std::string proven_statement(const MinkowskiReport& report);

/// Why neither is proven; empty where one is.
std::string why_not_one_sided(const MinkowskiReport& report);

/// Why there is no error bound; empty when there is one. A bound needs a comparison, and every comparison
/// must be with a closed mesh: points and open meshes are no boundary of a solid.
std::string why_unbounded(ComparedWith a, ComparedWith b);

/// Empty when the numbers can be true, else what is wrong.
std::string broken_invariant(const MinkowskiReport& report);

}  // namespace ballflow::geometry
