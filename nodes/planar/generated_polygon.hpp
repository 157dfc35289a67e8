// Polygons from formulas, from arithmetic alone, so that every machine makes the same bytes.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "planar/ring_nesting.hpp"

namespace ballflow::geometry {

struct PolygonInfo {
  const char* name;
  const char* doc;  // what n, R and r are
  std::int64_t n;   // its own number
  std::int64_t fewest;
  double r_per_R;  // its own small size, in units of R
  std::vector<RawRing> (*rings)(std::int64_t n, double R, double r);
};

std::span<const PolygonInfo> generated_polygons();

/// "star", "star?n=7&R=2&r=0.8": the rings of a generated polygon. R is 1 where it is not given, r in
/// proportion to it, 0 < r < R. sqroot and euro stand for the models of the same names in Kornberger 2010,
/// which were never published. Throws InputError for unknown names and parameters, listing those there are,
/// and for sizes out of range.
std::vector<RawRing> generated_rings(std::string_view text);

}  // namespace ballflow::geometry
