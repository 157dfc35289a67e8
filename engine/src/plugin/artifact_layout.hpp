// The file of an artifact as bytes: its header is written and read here. The grammar is in
// ballflow/artifact.hpp.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/error.hpp"

namespace ballflow {

/// What a file says. The arrays view its memory, in the order of the file.
struct ArtifactLayout {
  std::string type, summary;
  int version = 0;
  std::vector<NamedArray> arrays;
  std::string header;  // the file up to the data
};

/// The file up to the data, for arrays in any order; sorts them into the order of the file. Throws Error
/// (`code`) when a name is not unique, a size overflows or a limit is passed.
std::string make_header(const std::string& type, int version, const std::string& summary,
                        std::vector<NamedArray>& arrays, ExitCode code);

/// Any byte string may be given: throws BadArtifact that says what is wrong with it.
ArtifactLayout read_layout(std::span<const std::byte> file);

}  // namespace ballflow
