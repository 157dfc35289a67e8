// Spheres in the numbers that other programs state of theirs, and how many spheres do how well.
#pragma once

#include <string>
#include <vector>

#include "report/spheres_page.hpp"

namespace ballflow::report {

/// A heading, a row for each link, and one for the robot: how much of surface and volume is in spheres, how
/// far these stand out at most, the sum of their volumes in volumes of the link. "-" where it is not known.
std::vector<std::vector<std::string>> measures(const SpheresCheck& check);

/// An SVG element: what is outside, or in no sphere, against the number of spheres, a curve for each link.
/// Empty where no link was tried with several numbers.
std::string curves(const SpheresCheck& check);

}  // namespace ballflow::report
