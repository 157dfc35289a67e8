// Artifacts as Python sees them: arrays that share memory with the engine.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/plugin.h"
#include "ballflow/registry.hpp"

namespace ballflow::python {

namespace py = pybind11;

/// What Python holds of an artifact.
struct Handle {
  ArtifactPtr artifact;
};

/// {name: array}, read-only, of the artifact's own memory, which stays as long as an array does.
py::dict arrays_of(const ArtifactPtr& artifact);

/// The artifact of a declared type with these numpy arrays, which are C-contiguous, of the declared dtypes
/// and nobody else's: they are shared, not copied. Throws Error (code plugin) for what the type refuses.
ArtifactPtr artifact_of(const TypeDeclaration& type, const py::dict& arrays);

/// An input of a node, as its run gets it.
ArtifactPtr artifact_of(const bf_artifact& raw);

/// The arrays of an artifact as a node hands them over; the receiver releases each. Names live as long as
/// `artifact` does.
std::vector<bf_array> handed_over(const ArtifactPtr& artifact);

}  // namespace ballflow::python
