// k balls that contain a surface and everything inside it, with little volume outside.
#pragma once

#include <cstdint>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/enclosure_fit.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

enum class EncloseEffort {
  low,
  normal,
  high
};  // no rounds of shifts and swaps, two (one beyond 40 balls), eight

struct EncloseBallsOptions {
  std::int64_t balls = 20;
  EncloseEffort effort = EncloseEffort::normal;
  std::int64_t seed = 1;
};

struct EnclosingBalls {
  Balls balls;
  EnclosureFit fit;
};

/// At most `balls` balls whose union is proven (verify_enclosure.hpp) to contain every triangle and
/// everything that the triangles separate from infinity, and wastes as little volume outside as a local
/// search finds. Nothing is asked of the mesh: triangles may be doubled, open, crossing, degenerate, of
/// either orientation, in many pieces.
///
/// The surface is cut into patches, each of which has to lie in one ball. What balls waste is counted by
/// lattice points outside of the solid. From a greedy cover by inner balls, enlarged until k suffice, one
/// step replaces a ball by the one that holds what only it holds and wastes least; others move all balls
/// downhill at once, split balls where places are left, hand patches to neighbours, and remove a ball for a
/// split elsewhere. Patches at the seams are cut smaller at the end. Voids that the balls close off get a
/// point that has to be covered, until there are none.
///
/// - `start`: balls to begin with in place of the greedy cover, at most `balls`.
/// - Fewer balls are returned where more gain nothing.
/// - Runs in one thread; the same bytes on every machine. A mesh and its image under scaling by powers of two
/// give the
///   same.
/// - Throws InputError for inputs that break their invariants, no triangles, more balls at the start than
/// wanted.
EnclosingBalls enclose_balls(const TriangleMesh& mesh, const EncloseBallsOptions& options,
                             Monitor& monitor = no_monitor(), const Balls* start = nullptr);

}  // namespace ballflow::geometry
