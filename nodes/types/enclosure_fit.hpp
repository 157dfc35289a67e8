// How well k balls fit around a solid.
#pragma once

#include <cstdint>
#include <string>

namespace ballflow::geometry {

/// What the loss of a fit is.
enum class FitKind : std::uint8_t {
  outside = 0,           // the volume of the union outside of the solid: balls that hold everything
  uncovered_volume = 1,  // the volume of the solid in no ball
  uncovered_area = 2,    // the area of the surface in no ball
};

struct EnclosureFit {
  std::int64_t wanted = 0;  // balls at most
  std::int64_t balls = 0;   // used
  // Counted on a lattice, cubed model units: to about a percent of the difference.
  double solid = 0;               // volume that the surface winds around; 0 for open sheets
  double outside = 0;             // volume of the union that is not in the solid
  double area = 0;                // of the triangles, squared model units
  double loss = 0;                // what the search made small, by its kind
  std::uint8_t kind = 0;          // FitKind
  std::int64_t filled_voids = 0;  // that the first result had closed off inside, and got a point to cover
};

/// "20 balls, 21.7 % of the volume outside".
std::string describe(const EnclosureFit& fit);

/// Empty when the numbers fit each other, else what is wrong.
std::string broken_invariant(const EnclosureFit& fit);

}  // namespace ballflow::geometry
