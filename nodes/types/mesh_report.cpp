#include "types/mesh_report.hpp"

#include <algorithm>
#include <cmath>

namespace ballflow::geometry {

std::string_view in_words(MeshedBy how) {
  switch (how) {
    case MeshedBy::exact:
      return "exact";
    case MeshedBy::exact_grown:
      return "exact, of changed radii";
    case MeshedBy::skin:
      return "skin surface";
    default:
      return "grid";
  }
}

std::string what_differs(const MeshReport& r) {
  std::string text;
  const auto add = [&text](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  if (r.closed == 0) add("the mesh is not closed");
  if (r.manifold == 0) add("the mesh is not a manifold");
  if (r.oriented == 0) add("the triangles do not all face outwards");
  if (r.components != r.surfaces) {
    add("the mesh has " + std::to_string(r.components) + " components, the boundary of the union " +
        std::to_string(r.surfaces));
  }
  if (r.euler != 2 * r.euler_meshed) {
    add("the Euler characteristic of the mesh is " + std::to_string(r.euler) +
        ", that of the boundary of the union " + std::to_string(2 * r.euler_meshed));
  }
  const bool skin = r.made_by == static_cast<std::uint8_t>(MeshedBy::skin);
  if (skin && r.euler_meshed != r.euler_given) {
    add("the Euler characteristic of the union is " + std::to_string(r.euler_given) +
        ", that of the solid in the skin surface " + std::to_string(r.euler_meshed) +
        ": it closes gaps; a larger `shrink` closes fewer");
  }
  if (!skin && r.euler_meshed != r.euler_given) {
    add("the Euler characteristic of the union is " + std::to_string(r.euler_given) + " and became " +
        std::to_string(r.euler_meshed) + " when radii were changed so that nothing is a tie");
  }
  if (skin) return text;  // it is not made to be near the boundary
  if (r.error > r.error_asked) {
    add("the mesh is " + std::to_string(r.error) + " off, " + std::to_string(r.error_asked) +
        " was asked for");
  }
  if (r.error_back > std::max(r.error_asked, r.error)) {
    add("the bottoms of notches are up to " + std::to_string(r.error_back) + " away from the mesh, " +
        std::to_string(r.error_asked) + " was asked for" +
        (r.faces_before > 0 ? "" : ": refine_notches, or method exact, come nearer"));
  }
  return text;
}

std::string broken_invariant(const MeshReport& r) {
  if (r.made_by > static_cast<std::uint8_t>(MeshedBy::skin)) return "made_by is above 3";
  if (std::min({r.vertices, r.faces, r.components, r.surfaces, r.rounds, r.faces_before}) < 0)
    return "a count is negative";
  if (r.closed > 1 || r.manifold > 1 || r.oriented > 1)
    return "closed, manifold or oriented is neither 0 nor 1";
  if (!std::isfinite(r.growth)) return "growth is not finite";
  for (const double x : {r.error_asked, r.error, r.cell}) {
    if (!(x >= 0 && std::isfinite(x))) return "a length is negative or not finite";
  }
  if (!(r.error_back == -1 || (r.error_back >= 0 && std::isfinite(r.error_back))))
    return "error_back is neither a length nor -1";
  if (r.self_intersections < -1) return "the number of self-intersections is below -1";
  return {};
}

}  // namespace ballflow::geometry
