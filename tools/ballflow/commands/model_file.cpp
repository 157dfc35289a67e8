#include "commands/model_file.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "commands/watched.hpp"
#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/load_balls.hpp"
#include "sample/sample.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::cli {
namespace {

constexpr std::string_view shape_scheme = "shape:";

/// An artifact without a node. The arrays are shared, not copied.
template <class T>
ArtifactPtr sealed(const T& value) {
  const TypeDecl<T>& type = type_decl<T>();
  const detail::OutArrays out = type.write(value);
  std::vector<NamedArray> arrays;
  for (const bf_array& a : out.arrays()) {
    arrays.push_back({std::string(detail::view(a.name)), a.dtype, {a.shape, a.shape + a.rank}, a.data});
  }
  const std::shared_ptr<const void> keeper(new detail::OutArrays(out), [](const void* kept) {
    const auto* const released = static_cast<const detail::OutArrays*>(kept);
    for (const bf_array& a : released->arrays()) a.release(a.owner);
    delete released;
  });
  return Artifact::seal(type.type_id(), type.type_version(), std::move(arrays), type.summary_of(value).text(),
                        keeper);
}

ArtifactPtr balls_of(const std::string& name, geometry::Monitor& monitor) {
  geometry::LoadBallsOptions options;
  options.file = name;
  const geometry::LoadedBalls loaded = geometry::load_balls(options, monitor);
  const bool axis = !loaded.axis.edges.empty() || !loaded.axis.polygon_vertices.empty();
  return axis ? sealed(loaded.axis) : sealed(loaded.balls);
}

bool is_file_of_balls(const std::string& name) {
  if (name.starts_with(shape_scheme)) return false;
  const geometry::FileContent content =
      geometry::read_file_content(name, geometry::ReadOptions().max_unpacked_bytes);
  return geometry::holds_balls(name, content.view());
}

}  // namespace

bool is_model(const std::string& name) {
  return name.starts_with(shape_scheme) || geometry::is_model_name(name);
}

ArtifactPtr artifact_of_model(const std::string& name) {
  ArtifactPtr artifact;
  watched("nothing was read", [&](geometry::Monitor& monitor) {
    if (is_file_of_balls(name)) {
      artifact = balls_of(name, monitor);
      return;
    }
    geometry::SampleOptions options;
    options.file = name;
    const geometry::MeshFile model = geometry::sample(options, 0, monitor);
    artifact = model.mesh.triangles.empty() ? sealed(model.points) : sealed(model.mesh);
  });
  return artifact;
}

}  // namespace ballflow::cli
