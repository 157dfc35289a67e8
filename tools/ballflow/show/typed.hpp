// From an artifact back to the struct of nodes/types that it was made from.
#pragma once

#include <algorithm>
#include <vector>

#include "ballflow/artifact.hpp"
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
    TypeDeclaration parsed = parse_type_declaration(type_decl<T>().json().dump());
    parsed.entry = type_entries<T>().front();
    return parsed;
  }();
  if (const std::string broken = check_artifact(declaration, artifact); !broken.empty()) {
    throw Error(ExitCode::store, "the artifact " + broken, "compute it again with this version of ballflow");
  }
  std::vector<bf_array> arrays;
  for (const NamedArray& array : artifact.arrays()) {
    bf_array raw{};
    raw.name = detail::bytes(array.name);
    raw.dtype = array.dtype;
    raw.rank = static_cast<std::uint32_t>(array.shape.size());
    std::copy(array.shape.begin(), array.shape.end(), raw.shape);
    raw.data = array.data;
    arrays.push_back(raw);
  }
  bf_artifact raw{};
  raw.arrays = arrays.data();
  raw.array_count = arrays.size();
  raw.retain = [](void*) {};
  raw.release = [](void*) {};
  return type_decl<T>().read(raw);
}

}  // namespace ballflow
