// Checks from geometry that balls cover samples, whatever produced them.
#pragma once

#include <cstdint>

#include "types/balls.hpp"
#include "types/cover_check.hpp"
#include "types/monitor.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

enum class OnUncovered : std::uint8_t {
  error,   // InputError that names the first uncovered sample
  report,  // the samples are listed in the result
};

struct VerifyCoverOptions {
  OnUncovered on_uncovered = OnUncovered::error;
};

/// Looks for a ball around every sample by a uniform grid of samples. Shares nothing with cover_matrix but
/// the membership predicate, and what that is not asked for: samples that define a ball are in it.
///
/// Accepts and refuses the coordinates and defining samples that cover_matrix does.
CoverCheck verify_cover(const Balls& balls, const PointSet& points, const VerifyCoverOptions& options = {},
                        Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
