// The sample S of a surface, from a file or a formula.
#pragma once

#include <cstdint>
#include <string>

#include "io/read_mesh.hpp"
#include "sample/surface_sample.hpp"

namespace ballflow::geometry {

enum class SampleMode { vertices, surface };

struct SampleOptions {
  std::string file;         // a path, or "shape:" and the name of a shape ("shape:torus?R=1&r=0.3&n=20000")
  std::string scale = "1";  // a factor, or the unit of the file, which becomes metres: see parse_scale
  std::string weld = "0";   // of vertices of a file: see parse_tolerance
  StrayPolicy strays = StrayPolicy::keep;  // of a file
  SampleMode mode = SampleMode::vertices;
  Spread spread = Spread::poisson;  // mode surface only
  std::int64_t count = 10000;       // mode surface only
};

/// The model of read_mesh_file, or of generate and scaled; in mode surface its points are those of
/// sample_surface. Throws InputError as these do, and when the points do not fill space.
MeshFile sample(const SampleOptions& options, std::uint64_t seed, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
