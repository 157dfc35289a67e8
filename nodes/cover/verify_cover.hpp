// Checks from geometry that balls cover samples, whatever produced them.
#pragma once

#include <cstdint>
#include <span>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/cover_check.hpp"
#include "types/cover_state.hpp"
#include "types/point_set.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class OnUncovered : std::uint8_t {
  error,   // InputError that names the first uncovered sample
  report,  // the samples are listed in the result
};

struct VerifyCoverOptions {
  OnUncovered on_uncovered = OnUncovered::error;
};

/// Looks for a ball around every sample by a uniform grid of samples, in parallel. Shares nothing with
/// cover_matrix but the membership predicate, and what that is not asked for: samples that define a ball are
/// in it.
///
/// Samples in `without_candidate` (ascending, in range) are no error, whatever the options say; they are in
/// the result when they are in no ball. verify_uncovered() checks that they have no candidate.
///
/// With `patches`, here and below: its triangles are what has to be covered, as patch_matrix() says, and
/// "sample" is one of them.
///
/// Accepts and refuses the coordinates and defining samples that cover_matrix does.
CoverCheck verify_cover(const Balls& balls, const PointSet& points, const VerifyCoverOptions& options = {},
                        Monitor& monitor = no_monitor(), std::span<const std::int32_t> without_candidate = {},
                        const TriangleMesh& patches = {});

/// Checks from geometry that the samples in `cover.uncovered` lie in none of the candidates.
/// Refused with InputError: one that does lie in a candidate, naming both; indices out of range.
void verify_uncovered(const CoverState& cover, const Balls& candidates, const PointSet& points,
                      Monitor& monitor = no_monitor(), const TriangleMesh& patches = {});

/// Checks the certificate of `cover` (see CoverState) from geometry: conditions (1) to (3) for
/// `candidates`, the balls of the instance, and the samples in `points`. Nothing else of `cover` is believed.
/// Returns the number of balls that every cover by `candidates` needs.
///
/// Refused with InputError: a certificate that is malformed, that is about other numbers of balls and
/// samples, or that breaks a condition, naming the first ball that does; one that lists a sample in no
/// candidate, naming it: no ball would have to pay its price; a lower bound that is called certified and is
/// not.
std::int64_t verify_certificate(const CoverState& cover, const Balls& candidates, const PointSet& points,
                                Monitor& monitor = no_monitor(), const TriangleMesh& patches = {});

}  // namespace ballflow::geometry
