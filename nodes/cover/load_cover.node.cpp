#include "cover/load_cover.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct LoadCover {
  In<PointSet> points;
  Out<CoverState> cover;
  Out<Balls> balls;
  LoadCoverOptions options;

  static void declare(NodeDecl<LoadCover>& d) {
    d.id("LoadCover", 2).summary("Read a set covering instance of the literature.");
    d.doc(
        "Reads OR-Library files (scp and rail), Steiner triple systems, and balls of Coverage Axis, each "
        "also packed with gzip or zstd. Sets become rows, elements become columns. Every set counts 1: other "
        "costs are ignored "
        "with "
        "a warning. Refuses, with the line, numbers out of range, repeated entries, and files that end early "
        "or late.");
    d.avoid_when("balls and samples come from a model: CoverMatrix makes the matrix from them.");
    d.cites("beasley1990", "set covering").cites("fulkerson1974", "2").cites("dou2022", "4");
    d.input("points", &LoadCover::points).optional().doc("samples to be covered by a file of balls");
    d.output("cover", &LoadCover::cover).doc("the instance, nothing chosen yet");
    d.output("balls", &LoadCover::balls).doc("the balls of the rows, dilated; none for files without balls");
    d.param("file", &LoadCover::options, &LoadCoverOptions::file)
        .file()
        .scheme("steiner:")
        .required()
        .doc(
            "an instance; or steiner:N for the lines of the affine space of N = 3, 9, 27, 81, 243 or 729 "
            "points");
    d.choice("format", &LoadCover::options, &LoadCoverOptions::format,
             {{CoverFormat::automatic, "auto", "the one that the file fits"},
              {CoverFormat::scp, "scp", "elements, sets; costs of sets; sets of every element"},
              {CoverFormat::rail, "rail", "elements, sets; cost and elements of every set"},
              {CoverFormat::steiner, "steiner", "points, blocks; the three points of every block"},
              {CoverFormat::balls, "balls", "x y z r a line, also with a v before it, or with commas"}})
        .doc("how the file lists the instance");
    d.param("dilation", &LoadCover::options, &LoadCoverOptions::dilation)
        .unit("model units")
        .at_least(0)
        .doc("added to every radius of a file of balls; 0 keeps the radii");
    d.memory(std::uint64_t{256} << 20, 8.0);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    LoadedCover loaded = load_cover(options, points ? &*points : nullptr, monitor);
    cover = std::move(loaded.cover);
    balls = std::move(loaded.balls);
  }
};

}  // namespace

const bf_node* load_cover_entry() { return node_entry<LoadCover>(); }

}  // namespace ballflow::nodes
