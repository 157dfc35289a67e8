// Files of models and balls, as artifacts.
#pragma once

#include <string>

#include "ballflow/artifact.hpp"

namespace ballflow::cli {

/// Whether the name is that of a model or of balls: shape:NAME, or a file whose extension says so.
bool is_model(const std::string& name);

/// What such a file or shape holds: Balls or, of ma with edges or triangles, a MedialAxis; a TriangleMesh; or
/// a PointSet. Nothing is kept in the cache. Throws Error (code usage) for what cannot be read, code
/// cancelled after Ctrl-C.
ArtifactPtr artifact_of_model(const std::string& name);

}  // namespace ballflow::cli
