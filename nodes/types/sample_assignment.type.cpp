#include <algorithm>
#include <map>

#include "types/surface_types.hpp"

namespace ballflow {

void TypeOf<geometry::SampleAssignment>::declare(TypeDecl<geometry::SampleAssignment>& d) {
  using T = geometry::SampleAssignment;
  d.id("SampleAssignment", 1)
      .doc("Which ball, and which vertex of a surface, every sample belongs to (thesis, 4.5.3).");
  d.array("points", &T::points).length("n").doc("the samples, model units");
  d.array("balls", &T::balls).length("n").doc("the ball to which the sample has the least power");
  d.array("vertices", &T::vertices)
      .length("m")
      .doc("the vertex of the surface that the sample belongs to; none without a surface");
  d.summary("samples", "number of samples");
  d.summary("used", "vertices, or balls without a surface, that some sample belongs to");
  d.summary("largest", "most samples of one of them");
  d.summarize([](const T& v) {
    std::map<std::int32_t, std::int64_t> sizes;
    for (const std::int32_t to : v.vertices.empty() ? v.balls : v.vertices) ++sizes[to];
    std::int64_t largest = 0;
    for (const auto& [to, size] : sizes) largest = std::max(largest, size);
    return Summary{{"samples", v.points.size()}, {"used", sizes.size()}, {"largest", largest}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
