// Lengths in other units, for exports.
#pragma once

#include "ballflow/artifact.hpp"

namespace ballflow {

/// The artifact with all coordinates and radii times `factor`, which is finite and above 0; everything else
/// is shared with it, the summary too. Throws Error (usage) for types that have no lengths, or other
/// quantities besides, and when a length would not be finite.
ArtifactPtr scaled(const ArtifactPtr& artifact, double factor);

}  // namespace ballflow
