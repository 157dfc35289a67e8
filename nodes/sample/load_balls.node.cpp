#include "io/load_balls.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct LoadBalls {
  Out<Balls> balls;
  Out<MedialAxis> axis;
  LoadBallsOptions options;

  static void declare(NodeDecl<LoadBalls>& d) {
    d.id("LoadBalls", 3).summary("Reads balls, or a medial axis, that another program or an export wrote.");
    d.doc(
        "Reads ma (Q-MAT, MATFP, MATTopo), sph, the leaves of sphere trees (levels and branches first), "
        "lines "
        "of x y z r (also CSV, under column names, with decimal commas, or with a v in front), and PLY with "
        "a "
        "radius or diameter, each also packed with gzip or zstd; the content decides. Coordinates and radii "
        "stay as they are. Leaves out what MATFP marks as deleted. Refuses, with the line, numbers that are "
        "not "
        "finite, negative radii, indices out of range, commas that may separate or be decimal, and files "
        "that "
        "end early or late.");
    d.avoid_when("the balls are to be computed from a model: VoronoiPoles and LabelPoles do that");
    d.cites("li2015", "file format of the authors' program").cites("wang2022", "same");
    d.cites("dou2022", "lists of candidates");
    d.memory(std::uint64_t{256} << 20, 0);
    d.output("balls", &LoadBalls::balls).doc("the balls in the order of the file");
    d.output("axis", &LoadBalls::axis)
        .doc("of ma: the balls as vertices, edges that bound no triangle, triangles; else empty");
    d.param("file", &LoadBalls::options, &LoadBallsOptions::file)
        .file()
        .scheme("balls:")
        .required()
        .doc("a file, or the balls themselves: \"balls:0 0 0 1; 1.5 0 0 1\"");
    d.param("scale", &LoadBalls::options, &LoadBallsOptions::scale)
        .doc(
            "of centres and radii: a factor, or the unit of the lengths in the file, which become metres "
            "(um, mm, "
            "cm, dm, m, km, mil, in, ft, yd)");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    LoadedBalls loaded = load_balls(options, monitor);
    balls = std::move(loaded.balls);
    axis = std::move(loaded.axis);
  }
};

}  // namespace

const bf_node* load_balls_entry() { return node_entry<LoadBalls>(); }

}  // namespace ballflow::nodes
