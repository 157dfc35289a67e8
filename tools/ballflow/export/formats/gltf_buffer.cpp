#include "export/formats/gltf_buffer.hpp"

#include <algorithm>
#include <limits>

#include "export/formats/float32.hpp"

namespace ballflow {
namespace {

// Numbers of the specification of glTF 2.0.
constexpr int unsigned_short = 5123, unsigned_int = 5125, float_type = 5126;
constexpr int array_buffer = 34962, element_array_buffer = 34963;
constexpr std::uint32_t json_chunk = 0x4E4F534A, binary_chunk = 0x004E4942;

void pad(std::string& text, char with) { text.append((4 - text.size() % 4) % 4, with); }

void write_chunk(std::uint32_t kind, const std::string& content, OutputFile& out) {
  out.raw(static_cast<std::uint32_t>(content.size()));
  out.raw(kind);
  out << std::string_view(content);
}

}  // namespace

template <class T>
void GltfBuffer::append(T value) {
  bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::size_t GltfBuffer::add(std::size_t begin, std::size_t count, int component, const char* type, int target,
                            Json more) {
  views_.push_back(
      {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes_.size() - begin}, {"target", target}});
  more.update(
      {{"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
  accessors_.push_back(std::move(more));
  return accessors_.size() - 1;
}

std::size_t GltfBuffer::vectors(std::span<const geometry::Vec3> values, bool bounded) {
  const std::size_t begin = bytes_.size();
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::array<float, 3> lower{infinity, infinity, infinity}, upper{-infinity, -infinity, -infinity};
  for (const geometry::Vec3 v : values) {
    const std::array<float, 3> rounded = {float32(v.x, "glTF"), float32(v.y, "glTF"), float32(v.z, "glTF")};
    for (std::size_t k = 0; k < 3; ++k) {
      append(rounded[k]);
      lower[k] = std::min(lower[k], rounded[k]);
      upper[k] = std::max(upper[k], rounded[k]);
    }
  }
  Json more = Json::object();
  if (bounded) more = {{"min", lower}, {"max", upper}};
  return add(begin, values.size(), float_type, "VEC3", array_buffer, std::move(more));
}

std::size_t GltfBuffer::positions(std::span<const geometry::Vec3> points) { return vectors(points, true); }

std::size_t GltfBuffer::normals(std::span<const geometry::Vec3> unit_vectors) {
  return vectors(unit_vectors, false);
}

std::size_t GltfBuffer::scalars(std::span<const double> values) {
  const std::size_t begin = bytes_.size();
  for (const double value : values) append(float32(value, "glTF"));
  return add(begin, values.size(), float_type, "SCALAR", array_buffer);
}

std::size_t GltfBuffer::colours(std::span<const std::array<std::uint16_t, 4>> rgba) {
  const std::size_t begin = bytes_.size();
  for (const auto& colour : rgba) append(colour);
  return add(begin, rgba.size(), unsigned_short, "VEC4", array_buffer, {{"normalized", true}});
}

std::size_t GltfBuffer::indices(std::span<const std::uint32_t> values) {
  const std::size_t begin = bytes_.size();
  for (const std::uint32_t value : values) append(value);
  return add(begin, values.size(), unsigned_int, "SCALAR", element_array_buffer);
}

void GltfBuffer::write(Json gltf, OutputFile& out) const {
  if (!bytes_.empty()) {
    gltf["accessors"] = accessors_;
    gltf["bufferViews"] = views_;
    gltf["buffers"] = {{{"byteLength", bytes_.size()}}};
  }
  std::string text = gltf.dump();
  pad(text, ' ');
  constexpr std::size_t header = 12, chunk_header = 8;
  const std::size_t size =
      header + chunk_header + text.size() + (bytes_.empty() ? 0 : chunk_header + bytes_.size());
  if (size > std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ExitCode::usage,
                "the glTF file would have " + std::to_string(size) + " bytes, more than 4 GiB",
                "write ply or vtp");
  }
  out << "glTF";
  out.raw(std::uint32_t{2});
  out.raw(static_cast<std::uint32_t>(size));
  write_chunk(json_chunk, text, out);
  if (!bytes_.empty()) write_chunk(binary_chunk, bytes_, out);
}

}  // namespace ballflow
