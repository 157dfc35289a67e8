#include "types/ellipsoids.hpp"

#include <algorithm>

#include "types/box_summary.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow {

void TypeOf<geometry::Ellipsoids>::declare(TypeDecl<geometry::Ellipsoids>& d) {
  using T = geometry::Ellipsoids;
  d.id("Ellipsoids", 1).doc("A set of closed ellipsoids, each with three half-axes and a rotation.");
  d.array("centers", &T::centers).length("n").doc("model units");
  d.array("radii", &T::radii)
      .length("n")
      .doc("half-axes along the three axes of the rotation, model units, > 0");
  d.array("rotations", &T::rotations)
      .length("n")
      .doc("unit quaternions w x y z, w >= 0: from the axes of the coordinates to those of the ellipsoid");
  d.summary("count", "number of ellipsoids").summary("bbox", "bounding box of the union, model units");
  d.summary("min_radius", "the shortest half-axis of all, model units");
  d.summary("max_radius", "the longest half-axis of all, model units");
  d.summary("max_ratio", "the longest half-axis over the shortest of one ellipsoid, the largest of all");
  d.summarize([](const T& v) {
    SummaryValue smallest = nullptr, largest = nullptr, ratio = nullptr;
    double low = 0, high = 0, slender = 0;
    for (std::size_t i = 0; i < v.size(); ++i) {
      const geometry::Vec3 r = v.radii[i];
      const auto [least, most] = std::minmax({r.x, r.y, r.z});
      low = i == 0 ? least : std::min(low, least);
      high = std::max(high, most);
      slender = std::max(slender, most / least);
    }
    if (v.size() != 0) {
      smallest = low;
      largest = high;
      ratio = slender;
    }
    return Summary{{"count", v.size()},
                   {"bbox", box_summary(geometry::bounding_box(v))},
                   {"min_radius", smallest},
                   {"max_radius", largest},
                   {"max_ratio", ratio}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
