// The binary part of a glTF file, and the views and accessors that describe it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ballflow/node_decl.hpp"
#include "ballflow/output_file.hpp"
#include "base/vec3.hpp"

namespace ballflow {

/// Every function returns the number of the new accessor. Throws Error (usage) when a number does not fit a
/// float, or the file grows beyond the 4 GiB of the format.
class GltfBuffer {
 public:
  std::size_t positions(std::span<const geometry::Vec3> points);
  std::size_t normals(std::span<const geometry::Vec3> unit_vectors);
  std::size_t scalars(std::span<const double> values);
  /// Linear red, green, blue and alpha; 65535 is 1.
  std::size_t colours(std::span<const std::array<std::uint16_t, 4>> rgba);
  std::size_t indices(std::span<const std::uint32_t> values);

  /// Writes `gltf`, completed by accessors, views and the buffer, as a .glb file.
  void write(Json gltf, OutputFile& out) const;

 private:
  std::size_t vectors(std::span<const geometry::Vec3> values, bool bounded);
  template <class T>
  void append(T value);
  std::size_t add(std::size_t begin, std::size_t count, int component, const char* type, int target,
                  Json more = Json::object());

  std::string bytes_;
  Json views_ = Json::array(), accessors_ = Json::array();
};

}  // namespace ballflow
