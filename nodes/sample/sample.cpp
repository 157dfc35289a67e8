#include "sample/sample.hpp"

#include <string_view>
#include <utility>
#include <vector>

#include "exact/affine_span.hpp"
#include "sample/generate.hpp"

namespace ballflow::geometry {

MeshFile sample(const SampleOptions& options, std::uint64_t seed, Monitor& monitor) {
  constexpr std::string_view scheme = "shape:";
  MeshFile model;
  ReadOptions reading;
  reading.scale = parse_scale(options.scale);
  reading.weld = parse_tolerance(options.weld);
  reading.strays = options.strays;
  if (options.file.starts_with(scheme)) {
    model.mesh = generate(parse_shape(std::string_view(options.file).substr(scheme.size())), monitor);
    if (reading.scale != 1) {
      std::vector<Vec3> scaled(model.mesh.vertices.begin(), model.mesh.vertices.end());
      for (Vec3& p : scaled) p = reading.scale * p;
      model.mesh.vertices = std::move(scaled);
    }
    model.points.points = model.mesh.vertices;
  } else {
    model = read_mesh_file(options.file, reading, monitor);
  }
  if (options.mode == SampleMode::surface) {
    model.points = sample_surface(model.mesh, {options.spread, options.count, seed}, monitor);
    require_space_filling(model.points.points.span());
  }
  return model;
}

}  // namespace ballflow::geometry
