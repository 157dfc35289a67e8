// How the files of this folder offer formats to export.cpp: one TypeFormats per artifact type.
#pragma once

#include <string_view>
#include <vector>

#include "ballflow/artifact.hpp"
#include "export/output_file.hpp"

namespace ballflow {

struct Format {
  std::string_view name;  // also the extension
  void (*write)(const Artifact&, OutputFile&);
};

struct TypeFormats {
  std::string_view type;
  std::vector<Format> formats;  // the default first
};

TypeFormats point_set_formats();
TypeFormats triangle_mesh_formats();
TypeFormats balls_formats();
TypeFormats pole_set_formats();
TypeFormats cover_state_formats();
TypeFormats simplicial_complex_formats();
TypeFormats medial_axis_formats();

/// What every type can be written as.
std::vector<Format> generic_formats();

}  // namespace ballflow
