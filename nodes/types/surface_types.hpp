// What nodes of the family "surface" make beside meshes, as types of artifacts: for those who take or show
// them.
#pragma once

#include "types/artifact_types.hpp"
#include "types/noise_report.hpp"
#include "types/sample_assignment.hpp"
#include "types/surface_balls_report.hpp"

namespace ballflow {

template <>
struct TypeOf<geometry::NoiseReport> {
  static void declare(TypeDecl<geometry::NoiseReport>& d);
};

template <>
struct TypeOf<geometry::SampleAssignment> {
  static void declare(TypeDecl<geometry::SampleAssignment>& d);
};

template <>
struct TypeOf<geometry::SurfaceBallsReport> {
  static void declare(TypeDecl<geometry::SurfaceBallsReport>& d);
};

}  // namespace ballflow
