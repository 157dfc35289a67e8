// SampleAssignment: the samples with the number of their vertex, or of their ball where there is no surface.
#include "export/format_table.hpp"
#include "types/surface_types.hpp"

namespace ballflow {
namespace {

using geometry::SampleAssignment;

PolyData poly_data(const SampleAssignment& assignment) {
  PolyData data;
  data.points = assignment.points;
  if (assignment.vertices.empty()) {
    data.point_numbers = {"ball", assignment.balls};
  } else {
    data.point_numbers = {"vertex", assignment.vertices};
  }
  data.dot_every_point();
  return data;
}

}  // namespace

TypeFormats sample_assignment_formats() {
  return {"SampleAssignment",
          {format<SampleAssignment, poly_data, write_csv>("csv"),
           format<SampleAssignment, poly_data, write_ply>("ply"),
           format<SampleAssignment, poly_data, write_vtp>("vtp"),
           {"glb", write_glb}}};
}

}  // namespace ballflow
