#include "io/raw_model.hpp"

#include <limits>

namespace ballflow::geometry {
namespace {

constexpr std::int64_t max_vertices = std::numeric_limits<std::int32_t>::max();
constexpr std::int64_t max_triangles = max_vertices / 3;  // mesh_topology numbers their corners

}  // namespace

void require_room(std::int64_t count, std::size_t bytes_each, std::size_t bytes_left, const char* elements) {
  const std::string promise = "the header promises " + std::to_string(count) + " " + elements;
  if (count < 0) throw InputError(promise, "the file is damaged; write it again");
  const std::size_t room =
      bytes_each == 0 ? std::numeric_limits<std::size_t>::max() : bytes_left / bytes_each;
  if (static_cast<std::size_t>(count) > room) {
    throw InputError(promise + ", but the file ends after at most " + std::to_string(room),
                     "the file is cut off or its header is damaged; fetch or write it again");
  }
}

void add_vertex(RawModel& model, const Vec3& p) {
  if (static_cast<std::int64_t>(model.vertices.size()) >= max_vertices) {
    throw InputError("the file has more than " + std::to_string(max_vertices) + " vertices",
                     "thin it out first");
  }
  model.vertices.push_back(p);
}

void add_polygon(RawModel& model, std::span<const std::int32_t> corners) {
  ++model.faces;
  if (corners.size() < 3) {
    ++model.small_faces;
    return;
  }
  if (static_cast<std::int64_t>(model.triangles.size() + corners.size()) > max_triangles) {
    throw InputError("the file has more than " + std::to_string(max_triangles) + " triangles",
                     "thin it out first");
  }
  if (corners.size() > 3) {
    model.polygons.push_back(
        {static_cast<std::int32_t>(model.triangles.size()), static_cast<std::int32_t>(corners.size())});
  }
  for (std::size_t i = 2; i < corners.size(); ++i)
    model.triangles.push_back({corners[0], corners[i - 1], corners[i]});
}

void refuse_index(const char* element, std::int64_t number, const char* kind, const std::string& index,
                  std::size_t count, const std::string& place) {
  throw InputError(std::string(element) + " " + std::to_string(number) + ": " + kind + " index " + index +
                       " is out of range (" + std::to_string(count) + " " +
                       (std::string_view(kind) == "vertex" ? "vertices" : "normals") + ")" + place,
                   "the file is damaged; write it again or remove the face");
}

}  // namespace ballflow::geometry
