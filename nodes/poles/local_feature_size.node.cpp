#include "search/local_feature_size.hpp"

#include <ballflow/sdk.hpp>
#include <functional>
#include <utility>
#include <vector>

#include "search/axis_distance.hpp"
#include "search/sampling_ratio.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct LocalFeatureSize {
  In<geometry::PointSet> points;
  In<geometry::PoleSet> poles;
  InList<geometry::Balls> balls;
  InList<geometry::MedialAxis> axes;
  In<geometry::TriangleMesh> mesh;
  Out<geometry::LocalFeatureSize> size;

  static void declare(NodeDecl<LocalFeatureSize>& d) {
    d.id("LocalFeatureSize", 4).summary("Estimate at every sample how far the medial axis is.");
    d.doc(
        "D^ of every sample: the distance to the nearest pole of all samples, inner or outer. For an "
        "r-sample "
        "with r <= 0.08 the distance to the discrete medial axis is from 0.817 D^ to D^, and the local "
        "feature size is at most 1.2802 D^. Labels do not matter. With medial axes it also gives the "
        "distance to "
        "them, computed and not sampled: with those of the inner and of the outer polar balls the discrete "
        "local "
        "feature size of Definition 4.1, whose quotient by D^ the summary compares with 0.817. With a mesh "
        "of the "
        "surface it bounds the r for which the points are an r-sample of it (Definition 3.2), with the "
        "distance to "
        "the axes, or D^ without them, in place of the local feature size, which cannot be computed. Refuses "
        "poles "
        "of another number of samples.");
    d.avoid_when("the sample is noisy or has sharp edges: D^ is then about the noise or 0 at the edge.");
    d.cites("kornberger2010", "Definitions 3.2 and 4.1, Lemma 4.8 and Corollary 4.12");
    d.memory(1 << 20, 4.0);
    d.input("points", &LocalFeatureSize::points).doc("the sample, n points");
    d.input("poles", &LocalFeatureSize::poles).doc("its poles, labelled or not");
    d.input("balls", &LocalFeatureSize::balls)
        .optional()
        .doc(
            "polar balls that were kept, inner and outer: D^ is then the distance to the nearest of their "
            "centres, "
            "and the poles do not count; the bounds above hold for all poles only, and the result says that "
            "these "
            "are fewer");
    d.input("axes", &LocalFeatureSize::axes)
        .optional()
        .doc("medial axes (node MedialAxis) of the union of the inner and of that of the outer balls");
    d.input("mesh", &LocalFeatureSize::mesh)
        .optional()
        .doc(
            "the surface that was sampled, in the same coordinates, for r; without triangles as if not "
            "connected");
    d.output("size", &LocalFeatureSize::size)
        .doc(
            "of the n samples, same order, D^, the distances to their third neighbours and to the axes; "
            "bounds of "
            "r");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::PartMonitor measuring(monitor, 0, 0.2), to_axes(monitor, 0.2, 0.4), to_r(monitor, 0.4, 1);
    std::vector<geometry::Vec3> kept;
    for (const geometry::Balls& some : balls)
      kept.insert(kept.end(), some.centers.begin(), some.centers.end());
    const geometry::PoleDistance to_pole =
        balls.empty() ? geometry::PoleDistance(*poles) : geometry::PoleDistance(std::move(kept));
    geometry::LocalFeatureSize result = balls.empty()
                                            ? geometry::local_feature_size(*points, *poles, measuring)
                                            : geometry::local_feature_size(*points, to_pole, measuring);
    std::function<double(geometry::Vec3)> distance = to_pole;
    if (!axes.empty()) {
      const std::vector<geometry::MedialAxis> all(axes.begin(), axes.end());
      const geometry::AxisDistance to_axis(all, to_axes);
      result.axis_distances = geometry::axis_distances(points->points, to_axis, to_axes);
      distance = to_axis;
    }
    if (mesh && !mesh->triangles.empty()) {
      const auto r = geometry::sampling_ratio(points->points, *mesh, distance, to_r);
      result.r_at_least = r.at_least;
      result.r_at_most = r.at_most;
      result.r_at = r.at;
    }
    size = std::move(result);
  }
};

}  // namespace

const bf_node* local_feature_size_entry() { return node_entry<LocalFeatureSize>(); }

}  // namespace ballflow::nodes
