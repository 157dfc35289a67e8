// From an artifact back to the struct of nodes/types that it was made from.
#pragma once

#include "ballflow/artifact.hpp"
#include "ballflow/artifact_view.hpp"
#include "ballflow/error.hpp"
#include "ballflow/node_decl.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/sdk.hpp"

namespace ballflow {

/// Views the memory of `artifact`: use the result no longer than the artifact lives. The artifact may come
/// from anywhere; throws Error (code store) when it is no valid T.
template <class T>
T typed(const Artifact& artifact) {
  static const TypeDeclaration declaration = [] {
    TypeDeclaration parsed = parse_type_declaration(type_decl<T>().json());
    parsed.entry = type_entries<T>().front();
    return parsed;
  }();
  if (const std::string broken = check_artifact(declaration, artifact); !broken.empty()) {
    throw Error(ExitCode::store, "the artifact " + broken, "compute it again with this version of ballflow");
  }
  return type_decl<T>().read(ArtifactView(artifact).raw());
}

}  // namespace ballflow
