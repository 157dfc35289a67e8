#include "types/sample_assignment.hpp"

namespace ballflow::geometry {

std::string broken_invariant(const SampleAssignment& assignment) {
  const std::size_t n = assignment.points.size();
  if (assignment.balls.size() != n)
    return std::to_string(n) + " points but " + std::to_string(assignment.balls.size()) + " balls";
  if (!assignment.vertices.empty() && assignment.vertices.size() != n)
    return std::to_string(n) + " points but " + std::to_string(assignment.vertices.size()) + " vertices";
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(assignment.points[i])) return "point " + std::to_string(i) + " is not finite";
    if (assignment.balls[i] < 0 || (!assignment.vertices.empty() && assignment.vertices[i] < 0))
      return "point " + std::to_string(i) + " belongs to nothing";
  }
  return {};
}

}  // namespace ballflow::geometry
