#include "types/local_feature_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::LocalFeatureSize>::declare(TypeDecl<geometry::LocalFeatureSize>& d) {
  using T = geometry::LocalFeatureSize;
  d.id("LocalFeatureSize", 4)
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
  d.array("axis_distances", &T::axis_distances)
      .length("n")
      .optional()
      .doc("distance to the discrete medial axis, model units; absent where no axis was given");
  d.scalar("r_at_least", &T::r_at_least).doc("of the mesh, see r_at_most; -1 without a mesh");
  d.scalar("r_at_most", &T::r_at_most)
      .doc(
          "every point of the mesh has a sample within this times its distance to axis or poles; -1 without "
          "a mesh");
  d.scalar("r_at", &T::r_at).doc("the point of the mesh where r_at_least is attained");
  d.scalar("fewer_poles", &T::fewer_poles)
      .doc("1 where D^ is the distance to the nearest of fewer places than all poles: no bound holds then");
  d.summary("count", "number of samples");
  d.summary("min_pole_distance", "smallest D^; null without samples");
  d.summary("max_pole_distance", "largest D^");
  d.summary("discrete_at_least",
            "times D^: lower bound of the distance to the discrete medial axis; null with fewer poles");
  d.summary("at_most", "times D^: upper bound of the local feature size; null with fewer poles");
  d.summary("fewer_poles", "whether D^ leaves out poles, as those of balls that pruning did not keep");
  d.summary("min_axis_distance", "smallest distance to the discrete medial axis; null without an axis");
  d.summary("max_axis_distance", "largest one");
  d.summary("min_axis_by_pole",
            "smallest quotient of the distances to axis and pole: 0.817 or more by Corollary 4.12");
  d.summary("max_axis_by_pole", "largest one: at most 1 where the poles are in the axis");
  d.summary("r_at_least", "the cloud is no r-sample of the mesh for a smaller r; null without a mesh");
  d.summary("r_at_most", "it is one for this r; null without a mesh, or where at_least is 1 or more");
  d.summarize([](const T& v) {
    SummaryValue smallest = nullptr, largest = nullptr;
    if (!v.pole_distances.empty()) {
      const auto [low, high] = std::minmax_element(v.pole_distances.begin(), v.pole_distances.end());
      smallest = *low;
      largest = *high;
    }
    SummaryValue nearest = nullptr, farthest = nullptr, least = nullptr, most = nullptr;
    if (!v.axis_distances.empty()) {
      const auto [low, high] = std::minmax_element(v.axis_distances.begin(), v.axis_distances.end());
      nearest = *low;
      farthest = *high;
      double smallest_quotient = std::numeric_limits<double>::infinity(), largest_quotient = 0;
      for (std::size_t i = 0; i < v.axis_distances.size(); ++i) {
        const double quotient = v.axis_distances[i] / v.pole_distances[i];
        smallest_quotient = std::min(smallest_quotient, quotient);
        largest_quotient = std::max(largest_quotient, quotient);
      }
      least = smallest_quotient;
      most = largest_quotient;
    }
    const auto known = [](double r) {
      return r >= 0 && std::isfinite(r) ? SummaryValue(r) : SummaryValue(nullptr);
    };
    const auto bound = [&](double times) {
      return v.fewer_poles == 0 ? SummaryValue(times) : SummaryValue(nullptr);
    };
    return Summary{{"count", v.points.size()},          {"min_pole_distance", smallest},
                   {"max_pole_distance", largest},      {"discrete_at_least", bound(T::discrete_at_least)},
                   {"at_most", bound(T::at_most)},      {"fewer_poles", v.fewer_poles != 0},
                   {"min_axis_distance", nearest},      {"max_axis_distance", farthest},
                   {"min_axis_by_pole", least},         {"max_axis_by_pole", most},
                   {"r_at_least", known(v.r_at_least)}, {"r_at_most", known(v.r_at_most)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
