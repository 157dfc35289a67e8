#include "search/local_feature_size.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

struct LocalFeatureSize {
  In<geometry::PointSet> points;
  In<geometry::PoleSet> poles;
  Out<geometry::LocalFeatureSize> size;

  static void declare(NodeDecl<LocalFeatureSize>& d) {
    d.id("LocalFeatureSize", 2).summary("Estimate at every sample how far the medial axis is.");
    d.doc(
        "D^ of every sample: the distance to the nearest pole of all samples, inner or outer. For an "
        "r-sample "
        "with r <= 0.08 the distance to the discrete medial axis is from 0.817 D^ to D^, and the local "
        "feature size is at most 1.2802 D^. Labels do not matter. Refuses poles of another number of "
        "samples.");
    d.avoid_when("the sample is noisy or has sharp edges: D^ is then about the noise or 0 at the edge.");
    d.cites("kornberger2010", "Lemma 4.8 and Corollary 4.12");
    d.memory(1 << 20, 2.0);
    d.input("points", &LocalFeatureSize::points).doc("the sample, n points");
    d.input("poles", &LocalFeatureSize::poles).doc("its poles, labelled or not");
    d.output("size", &LocalFeatureSize::size)
        .doc("D^ of the n samples, same order, and the distance to their third neighbours");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    size = geometry::local_feature_size(*points, *poles, monitor);
  }
};

}  // namespace

const bf_node* local_feature_size_entry() { return node_entry<LocalFeatureSize>(); }

}  // namespace ballflow::nodes
