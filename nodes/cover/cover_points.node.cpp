#include "cover/cover_points.hpp"

#include <ballflow/sdk.hpp>
#include <string>
#include <utility>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct CoverPointsNode {
  struct Options {
    Demand cover = Demand::automatic;
  };
  In<PointSet> points;
  In<TriangleMesh> surface;
  In<Balls> balls;
  Out<PointSet> covered;
  Out<TriangleMesh> patches;
  Options options;

  static void declare(NodeDecl<CoverPointsNode>& d) {
    d.id("CoverPoints", 1).summary("Say what the balls have to cover: the samples, or more of the surface.");
    d.doc(
        "What is covered need not be what was sampled. Where walls are thin a ball reaches few samples, and "
        "balls that cover all samples leave holes between them: some a repair of the topology closes, but a "
        "tenth of the surface may stay outside. The centres of the surface's triangles, and of its edges, "
        "are "
        "points that close them from the start, for up to a quarter more balls; thick shapes need more balls "
        "for nothing. Whole triangles (patches) are a surface and not points: "
        "a union that covers them contains the triangulation, which takes several times as many balls.");
    d.avoid_when("covers are to be compared with the thesis or with other programs: they cover the samples.");
    d.cites("kornberger2010", "3.6.1, the samples");
    d.input("points", &CoverPointsNode::points).doc("the samples");
    d.input("surface", &CoverPointsNode::surface)
        .optional()
        .doc("a triangulation of them, from Refine; without triangles only samples can be covered");
    d.input("balls", &CoverPointsNode::balls)
        .optional()
        .doc("the inner balls of the samples, which say how thick the solid is (cover = auto)");
    d.output("points", &CoverPointsNode::covered).doc("the samples, then the centres");
    d.output("patches", &CoverPointsNode::patches)
        .doc("the triangles to be covered whole (cover = patches), or none");
    d.choice("cover", &CoverPointsNode::options, &Options::cover,
             {{Demand::automatic, "auto",
               "samples where the largest ball through half of them is at least 1.5 times as large as the "
               "triangles there have long edges, facets from 1 on, edges where walls are still thinner"},
              {Demand::samples, "samples", "the samples"},
              {Demand::facets, "facets", "the samples and the centres of triangles"},
              {Demand::edges, "edges", "the samples and the centres of triangles and edges"},
              {Demand::patches, "patches", "whole triangles, each by one ball"}})
        .doc("what has to be covered");
    d.memory(std::uint64_t{1} << 20, 6);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    CoverPoints result =
        cover_points(*points, surface ? *surface : TriangleMesh{}, options.cover, balls ? *balls : Balls{});
    if (options.cover == Demand::automatic && result.demand != Demand::samples) {
      monitor.note(std::string("walls are thin: covering samples, facets") +
                   (result.demand == Demand::edges ? " and edges" : ""));
    }
    covered = std::move(result.points);
    patches = std::move(result.patches);
  }
};

}  // namespace

const bf_node* cover_points_entry() { return node_entry<CoverPointsNode>(); }

}  // namespace ballflow::nodes
