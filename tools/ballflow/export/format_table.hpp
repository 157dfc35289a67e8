// How the files of this folder offer formats to export.cpp: one TypeFormats per artifact type. A new type is
// one file with a poly_data() and a line here and in export.cpp; a new format is one file in formats/, a line
// in formats.hpp, and its name in the types that have it.
#pragma once

#include <string_view>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/output_file.hpp"
#include "export/formats.hpp"
#include "show/typed.hpp"

namespace ballflow {

struct Format {
  std::string_view name;
  void (*write)(const Artifact&, OutputFile&);
  std::string_view extension = {};  // where it is not the name
};

struct TypeFormats {
  std::string_view type;
  std::vector<Format> formats;  // the default first
};

/// `write` applied to what `convert`, a function that takes a T, makes of the artifact.
template <class T, PolyData (*convert)(const T&), void (*write)(const PolyData&, OutputFile&)>
Format format(std::string_view name) {
  return {
      name, [](const Artifact& artifact, OutputFile& out) { write(convert(typed<T>(artifact)), out); }, {}};
}

TypeFormats point_set_formats();
TypeFormats triangle_mesh_formats();
TypeFormats balls_formats();
TypeFormats pole_set_formats();
TypeFormats local_feature_size_formats();
TypeFormats growth_formats();
TypeFormats cover_state_formats();
TypeFormats simplicial_complex_formats();
TypeFormats medial_axis_formats();
TypeFormats topology_table_formats();
TypeFormats sample_assignment_formats();
TypeFormats surface_report_formats();
TypeFormats robot_formats();
TypeFormats robot_spheres_formats();
TypeFormats polygon2_formats();
TypeFormats disc_outline_formats();
TypeFormats ball_distance_formats();
TypeFormats path_formats();
TypeFormats matched_balls_formats();
TypeFormats way_formats();
TypeFormats shape_prior_formats();
TypeFormats shape_fit_formats();
TypeFormats ellipsoids_formats();

/// What every type can be written as.
std::vector<Format> generic_formats();

}  // namespace ballflow
