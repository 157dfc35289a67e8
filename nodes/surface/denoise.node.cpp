#include "surface/denoise.hpp"

#include <algorithm>
#include <ballflow/sdk.hpp>
#include <utility>

#include "types/surface_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::DenoiseOptions;

struct Denoise {
  In<geometry::PointSet> points;
  In<geometry::NoiseReport> noise;
  Out<geometry::PointSet> moved;
  DenoiseOptions options;

  static void declare(NodeDecl<Denoise>& d) {
    d.id("Denoise", 1).summary("Move noisy samples onto quadrics through their neighbours.");
    d.doc(
        "Every sample moves to the point above it of a quadric fitted to its neighbours, with weights that "
        "fall with the distance, in the frame of their principal axes. Curvature stays. It begins with a "
        "quarter of `neighbors`, at least 16, and takes twice as many as long as they lie about as near the "
        "quadric as the first do: where a sheet is thin, or there is an edge, they do not, and fewer are "
        "used. The number and order of samples stay, normals are left out. The summary of `points` adds "
        "deviation, the median distance of neighbours from their quadric before the last round. Refuses "
        "fewer than 8 neighbours.");
    d.avoid_when(
        "the cloud is clean: details smaller than the neighbourhood, and sharp edges, are smoothed away.");
    d.cites("levin2003", "projection onto local polynomials, here one weighted quadric in one step");
    d.memory(1 << 20, 3.0);
    d.input("points", &Denoise::points).doc("noisy samples");
    d.input("noise", &Denoise::noise)
        .optional()
        .doc("what AssessNoise said: the number of neighbours that it wants next, in place of `neighbors`");
    d.output("points", &Denoise::moved).doc("the same samples, moved, in the same order");
    d.param("neighbors", &Denoise::options, &DenoiseOptions::neighbors)
        .unit("samples")
        .at_least(8)
        .at_most(1000)
        .doc("at most so many neighbours, the sample among them: more for more noise");
    d.param("rounds", &Denoise::options, &DenoiseOptions::rounds)
        .unit("1")
        .at_least(1)
        .at_most(100)
        .doc("how often all samples are moved");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (noise && noise->next > 0) options.neighbors = noise->next;
    geometry::Denoised result = geometry::denoise(*points, options, monitor);
    auto& all = result.deviations;
    if (!all.empty()) {
      const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
      std::nth_element(all.begin(), middle, all.end());
      moved.summary("deviation", *middle);
    }
    moved = std::move(result.points);
  }
};

}  // namespace

const bf_node* denoise_entry() { return node_entry<Denoise>(); }

}  // namespace ballflow::nodes
