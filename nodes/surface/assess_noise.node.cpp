#include "surface/assess_noise.hpp"

#include <ballflow/sdk.hpp>

#include "types/surface_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AssessNoiseOptions;

struct AssessNoise {
  In<geometry::PointSet> points;
  In<geometry::PoleSet> poles;
  In<geometry::LocalFeatureSize> size;
  In<geometry::NoiseReport> before;
  Out<geometry::NoiseReport> report;
  AssessNoiseOptions options;

  static void declare(NodeDecl<AssessNoise>& d) {
    d.id("AssessNoise", 2).summary("Decide whether a cloud is to be denoised, and with how many neighbours.");
    d.doc(
        "Noise as large as the spacing makes poles uncertain, and so do sharp edges and thin sheets. Where "
        "fewer than `suspect` of the poles are, nothing is done. Else the distances of neighbours from "
        "quadrics tell noise, which all samples have, from edges, which leave smooth patches without any. "
        "Noisy samples are denoised with `neighbors`, then with twice as many, until fewer than `certain` of "
        "the poles are uncertain; where more neighbours leave more uncertain, with those before. Where the "
        "first "
        "number is enough and twice as many lie within D^, by the median, as in dense clouds, twice as many "
        "are "
        "taken unless poles are uncertain then. In a loop with Denoise: the summary field `done` "
        "ends it. Refuses poles that were not labelled by angles, and poles and sizes of other samples.");
    d.avoid_when("there are normals or a mesh: labels then do not depend on noise.");
    d.cites("amentakolluri2000", "labels by angles, which say how certain they are")
        .cites("kornberger2010", "4.9.3: noise makes D^ small");
    d.memory(1 << 20, 3.0);
    d.input("points", &AssessNoise::points).doc("the samples as they are now");
    d.input("poles", &AssessNoise::poles).doc("their poles, labelled by method angle");
    d.input("size", &AssessNoise::size).doc("their D^ and third neighbours");
    d.input("before", &AssessNoise::before)
        .optional()
        .doc("what was said before the samples were denoised; absent for the cloud as it came");
    d.output("report", &AssessNoise::report).doc("the verdict, and the number of neighbours to try next");
    d.param("act", &AssessNoise::options, &AssessNoiseOptions::act).doc("false: look, but ask for nothing");
    d.param("suspect", &AssessNoise::options, &AssessNoiseOptions::suspect)
        .unit("share of the poles")
        .at_least(0)
        .at_most(1)
        .doc("with fewer uncertain poles the cloud is clean");
    d.param("level", &AssessNoise::options, &AssessNoiseOptions::level)
        .unit("times the distance to the third neighbour")
        .at_least(0)
        .at_most(10)
        .doc("where the tenth percentile of the noise is below it there are edges, and no noise");
    d.param("certain", &AssessNoise::options, &AssessNoiseOptions::certain)
        .unit("share of the poles")
        .at_least(0)
        .at_most(1)
        .doc("fewer uncertain poles are good enough");
    d.param("neighbors", &AssessNoise::options, &AssessNoiseOptions::neighbors)
        .unit("samples")
        .at_least(8)
        .at_most(1000)
        .doc("the first number of neighbours to try");
    d.param("most_neighbors", &AssessNoise::options, &AssessNoiseOptions::most_neighbors)
        .unit("samples")
        .at_least(8)
        .at_most(1000)
        .doc("no more are tried");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    if (!before && !points->normals.empty()) context.warn("the cloud has normals; they are not used");
    report = geometry::assess_noise(*points, *poles, *size, before ? &*before : nullptr, options, monitor);
  }
};

}  // namespace

const bf_node* assess_noise_entry() { return node_entry<AssessNoise>(); }

}  // namespace ballflow::nodes
