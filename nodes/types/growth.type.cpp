#include "types/growth.hpp"

#include <algorithm>
#include <array>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::Growth>::declare(TypeDecl<geometry::Growth>& d) {
  using T = geometry::Growth;
  using geometry::GrowthStop;
  d.id("Growth", 1).doc("How far balls have grown, and what stopped each of them.");
  d.array("centers", &T::centers).length("n").doc("centres of the balls, model units");
  d.array("radii", &T::radii).length("n").doc("radii before, model units");
  d.array("grown_radii", &T::grown_radii).length("n").doc("radii after, model units");
  d.array("limits", &T::limits).length("n").doc("largest radius allowed whatever is asked for, or infinity");
  d.array("stops", &T::stops)
      .length("n")
      .doc("0 grown as far as asked for, 1 pole bound, 2 critical Gabriel point, 3 neighbour");
  d.scalar("betti_before", &T::betti_before).doc("components, tunnels, cavities of the union; -1 if unknown");
  d.scalar("betti_after", &T::betti_after).doc("those of the grown union");
  d.summary("balls", "number of balls").summary("stopped", "balls smaller than asked for");
  d.summary("stopped_by_poles", "they might reach the outer medial axis (Lemma 3.4)");
  d.summary("stopped_by_gabriel", "they would reach a critical Gabriel point");
  d.summary("stopped_by_neighbour", "a ball near them has stopped, and the topology would change");
  d.summary("mean_growth", "of the radii, model units; null without balls");
  d.summary("max_growth", "of the radii, model units; null without balls");
  d.summary("betti_before", "[components, tunnels, cavities] of the union, null where nobody has looked");
  d.summary("betti_after", "those of the grown union");
  d.summarize([](const T& v) {
    const auto stopped = [&v](GrowthStop by) {
      return std::count(v.stops.begin(), v.stops.end(), static_cast<std::uint8_t>(by));
    };
    SummaryValue mean = nullptr, most = nullptr;
    if (!v.radii.empty()) {
      double sum = 0, largest = 0;
      for (std::size_t i = 0; i < v.radii.size(); ++i) {
        const double growth = v.grown_radii[i] - v.radii[i];
        sum += growth;
        largest = std::max(largest, growth);
      }
      mean = sum / static_cast<double>(v.radii.size());
      most = largest;
    }
    const auto betti = [](const std::array<std::int64_t, 3>& b) {
      return b[0] < 0 ? SummaryValue(nullptr) : SummaryValue(b);
    };
    return Summary{{"balls", v.radii.size()},
                   {"stopped", static_cast<std::int64_t>(v.stops.size()) - stopped(GrowthStop::wish)},
                   {"stopped_by_poles", stopped(GrowthStop::poles)},
                   {"stopped_by_gabriel", stopped(GrowthStop::gabriel)},
                   {"stopped_by_neighbour", stopped(GrowthStop::neighbour)},
                   {"mean_growth", mean},
                   {"max_growth", most},
                   {"betti_before", betti(v.betti_before)},
                   {"betti_after", betti(v.betti_after)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
