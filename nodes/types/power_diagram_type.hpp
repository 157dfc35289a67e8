// PowerDiagram as a type of artifacts: for the adapters that take or make one.
#pragma once

#include "types/artifact_types.hpp"
#include "types/power_diagram.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::PowerDiagram> {
  static void declare(TypeDecl<geometry::PowerDiagram>& d);
};

}  // namespace ballflow
