#include "types/balls.hpp"

#include <algorithm>

#include "types/box_summary.hpp"
#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::Balls>::declare(TypeDecl<geometry::Balls>& d) {
  using T = geometry::Balls;
  d.id("Balls", 1).doc("A set of closed balls.");
  d.array("centers", &T::centers).length("n").doc("model units");
  d.array("radii", &T::radii).length("n").doc("model units, >= 0");
  d.array("defining_offsets", &T::defining_offsets)
      .length("n+1")
      .optional()
      .doc("where the samples of a ball begin");
  d.array("defining_samples", &T::defining_samples)
      .length("d")
      .optional()
      .doc("samples each ball passes through");
  d.summary("count", "number of balls").summary("bbox", "bounding box of the union, model units");
  d.summary("min_radius", "model units").summary("max_radius", "model units");
  d.summarize([](const T& v) {
    SummaryValue smallest = nullptr, largest = nullptr;
    if (v.size() != 0) {
      const auto [low, high] = std::minmax_element(v.radii.begin(), v.radii.end());
      smallest = *low;
      largest = *high;
    }
    return Summary{{"count", v.size()},
                   {"bbox", box_summary(geometry::bounding_box(v))},
                   {"min_radius", smallest},
                   {"max_radius", largest}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
