#include "motion/path_balls.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"
#include "types/motion_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::PathBallsOptions;
using geometry::PathSide;

struct PathBalls {
  Out<geometry::Balls> balls;
  Out<geometry::Path> path;
  PathBallsOptions options;

  static void declare(NodeDecl<PathBalls>& d) {
    d.id("PathBalls", 1).summary("A polyline as balls, so that a Minkowski sum moves something along it.");
    d.doc(
        "Reads points, x y z and perhaps a radius a line, and puts balls around them and between them. Side "
        "outer: "
        "their union contains the path, so that the sum with a tool contains everything that the tool "
        "sweeps: "
        "between two centers at a distance h radii r become sqrt(r^2 + h^2 / 4), half the spacing where the "
        "path "
        "is a line. Side inner: they lie in the path. The path says how far they are off. One point is a "
        "path: the "
        "tool in one place. Points that repeat the one before count once. Refuses a path without points, "
        "numbers "
        "that are not finite, negative radii, and rows that differ in length.");
    d.avoid_when("the tool turns on its way: sums move it without turning.");
    d.cites("kornberger2010", "5.1 and 5.2").cites("edelsbrunner1995", "balls between two balls");
    d.memory(std::uint64_t{64} << 20, 0);
    d.output("balls", &PathBalls::balls).doc("balls along the path, in its order");
    d.output("path", &PathBalls::path).doc("the polyline, and how far the balls are from it");
    d.param("file", &PathBalls::options, &PathBallsOptions::file)
        .file()
        .scheme("path:")
        .required()
        .doc(
            "a file of rows x y z or x y z radius (CSV, blanks, names of columns; also .gz), or the points "
            "themselves: \"path:0 0 0; 1 0 0\"");
    d.param("scale", &PathBalls::options, &PathBallsOptions::scale)
        .doc(
            "of coordinates, radii and width: a factor, or the unit of the lengths in the file, which become "
            "metres "
            "(um, mm, cm, dm, m, km, mil, in, ft, yd)");
    d.param("width", &PathBalls::options, &PathBallsOptions::width)
        .unit("model units before scale")
        .at_least(0)
        .doc("of the path where the file has no radii, twice the radius; 0: a line");
    d.param("spacing", &PathBalls::options, &PathBallsOptions::spacing)
        .doc(
            "centers are no farther apart along the path: a length in model units, or a share of the longest "
            "edge "
            "of its bounding box (\"0.5%\")");
    d.choice("side", &PathBalls::options, &PathBallsOptions::side,
             {{PathSide::outer, "outer", "the balls contain the path"},
              {PathSide::inner, "inner", "the balls lie in the path"}})
        .doc("which side of the path the balls bound it from");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::PathWithBalls made = geometry::path_balls(options, monitor);
    balls = std::move(made.balls);
    path = std::move(made.path);
  }
};

}  // namespace

const bf_node* path_balls_entry() { return node_entry<PathBalls>(); }

}  // namespace ballflow::nodes
