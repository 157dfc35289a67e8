#include "types/surface_types.hpp"

namespace ballflow {

void TypeOf<geometry::NoiseReport>::declare(TypeDecl<geometry::NoiseReport>& d) {
  using T = geometry::NoiseReport;
  d.id("NoiseReport", 1).doc("How noisy a cloud of points is, and what was done about it.");
  d.scalar("uncertain", &T::uncertain).doc("share of the poles whose label says little");
  d.scalar("coarseness", &T::coarseness)
      .doc("median over the samples of the distance to the third neighbour, times 1 / D^");
  d.scalar("level", &T::level)
      .doc(
          "tenth percentile of the deviation from quadrics, times 1 / distance to the third neighbour; 0 "
          "where it was not asked for");
  d.scalar("neighbors", &T::neighbors).doc("with so many samples were denoised, 0: not");
  d.scalar("next", &T::next).doc("with so many they are to be denoised next, 0: done");
  d.scalar("verdict", &T::verdict)
      .doc("0 clean, 1 sharp edges, 2 noisy, 3 denoised, 4 too noisy, 5 left as it is");
  d.summary("verdict",
            "\"clean\", \"sharp edges\", \"noisy\", \"denoised\", \"too noisy\" or \"left as it is\"");
  d.summary("done", "false while samples are to be denoised with other neighbours");
  d.summary("uncertain", "share of the poles whose label says little");
  d.summary("coarseness", "median distance to the third neighbour, times 1 / D^");
  d.summary("level", "of the noise, times the distance to the third neighbour; 0 where it was not asked for");
  d.summary("neighbors", "with so many samples were denoised; 0: they are as they came");
  d.summarize([](const T& v) {
    return Summary{{"verdict", geometry::name(static_cast<geometry::NoiseVerdict>(v.verdict))},
                   {"done", v.next == 0},
                   {"uncertain", v.uncertain},
                   {"coarseness", v.coarseness},
                   {"level", v.level},
                   {"neighbors", v.neighbors}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
