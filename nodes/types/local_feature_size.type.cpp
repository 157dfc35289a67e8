#include "types/local_feature_size.hpp"

#include <algorithm>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::LocalFeatureSize>::declare(TypeDecl<geometry::LocalFeatureSize>& d) {
  using T = geometry::LocalFeatureSize;
  d.id("LocalFeatureSize", 2)
      .doc("D^, the distance of every sample to the nearest pole: an estimate of the local feature size.");
  d.array("points", &T::points).length("n").doc("the sample, model units");
  d.array("pole_distances", &T::pole_distances)
      .length("n")
      .doc(
          "D^, model units. For r-samples, r <= 0.08: distance to the discrete medial axis in "
          "[0.817 D^, D^], local feature size at most 1.2802 D^");
  d.array("third_neighbors", &T::third_neighbors)
      .length("n")
      .doc("distance to the third nearest other sample, model units");
  d.summary("count", "number of samples");
  d.summary("min_pole_distance", "smallest D^; null without samples");
  d.summary("max_pole_distance", "largest D^");
  d.summary("discrete_at_least", "times D^: lower bound of the distance to the discrete medial axis");
  d.summary("at_most", "times D^: upper bound of the local feature size");
  d.summarize([](const T& v) {
    SummaryValue smallest = nullptr, largest = nullptr;
    if (!v.pole_distances.empty()) {
      const auto [low, high] = std::minmax_element(v.pole_distances.begin(), v.pole_distances.end());
      smallest = *low;
      largest = *high;
    }
    return Summary{{"count", v.points.size()},
                   {"min_pole_distance", smallest},
                   {"max_pole_distance", largest},
                   {"discrete_at_least", T::discrete_at_least},
                   {"at_most", T::at_most}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
