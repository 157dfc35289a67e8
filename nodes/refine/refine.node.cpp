#include "refine/refine.hpp"

#include <ballflow/sdk.hpp>
#include <optional>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::RefineOptions;
using geometry::RefineWhen;
using geometry::TopologyStage;

struct Refine {
  In<geometry::TriangleMesh> mesh;
  In<geometry::PointSet> points;
  In<geometry::TopologyTable> topology;
  Out<geometry::PointSet> samples;
  Out<geometry::TriangleMesh> surface;
  Out<geometry::Refinement> report;
  RefineOptions options;

  static void declare(NodeDecl<Refine>& d) {
    d.id("Refine", 3)
        .summary("Choose samples of a closed surface that are dense where its shape asks for it.");
    d.doc(
        "The vertices of a part say little about its shape: a cube has 8, and they make one ball of twice "
        "its "
        "volume. This node starts from corners, sharp edges and some other points, and inserts points of the "
        "surface until no ball through four samples reaches farther than delta to the wrong side of it, or "
        "through a wall or slot that is thin; until the Delaunay cells with their centre inside the solid "
        "have a surface as their boundary, and the topology of the solid; and until the union of all inner "
        "balls has it too. Whether it has is in the report, with the places where walls and slots are "
        "thinner "
        "than the floor allows. It needs the balls of all inner Voronoi vertices (VoronoiPoles, vertices = "
        "all): with poles alone thin walls open. Which side a centre is on is decided exactly. Surfaces that "
        "are not closed, and clouds, have no inside to follow: their points are returned as they are (when = "
        "closed) or refused.");
    d.avoid_when("the vertices of a dense scan are wanted as samples: connect them directly.");
    d.cites("boissonnat2005", "Delaunay refinement of a surface, here of any closed mesh by all its balls");
    d.cites("kornberger2010", "3.4, the balls it is for").library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{64} << 20, 64);
    d.input("mesh", &Refine::mesh).doc("the surface of a solid");
    d.input("points", &Refine::points)
        .optional()
        .doc("samples that are returned where nothing is refined, and kept with keep_points");
    d.input("topology", &Refine::topology)
        .optional()
        .doc("SolidTopology of the mesh; without it the inner cells say what topology the balls should have");
    d.output("points", &Refine::samples).doc("n samples on the surface, pairwise distinct");
    d.output("surface", &Refine::surface)
        .doc(
            "the boundary of the inner Delaunay cells, a triangulation of the samples with the topology that "
            "the report says; without triangles where nothing was refined");
    d.output("report", &Refine::report).doc("what was reached, and where it was not");
    d.choice("when", &Refine::options, &RefineOptions::when,
             {{RefineWhen::closed, "closed", "refine closed surfaces, return the points of others"},
              {RefineWhen::always, "always", "refuse surfaces that are not closed, saying why"},
              {RefineWhen::never, "never", "return the points that come in"}})
        .doc("which surfaces are refined");
    d.param("delta", &Refine::options, &RefineOptions::delta)
        .unit("% of the longest bounding-box edge")
        .above(0)
        .at_most(10)
        .doc(
            "how far a ball may reach to the wrong side of the surface; half of it takes about twice as "
            "many samples on curved surfaces");
    d.param("floor", &Refine::options, &RefineOptions::floor)
        .unit("% of the longest bounding-box edge")
        .above(0)
        .at_most(10)
        .doc(
            "balls that reach less far are let be whatever lies behind: walls and slots far thinner than "
            "this "
            "are left to the topology");
    d.param("lowest_floor", &Refine::options, &RefineOptions::lowest_floor)
        .unit("% of the longest bounding-box edge")
        .at_least(1e-5)
        .at_most(10)
        .doc("where the topology asks for it the floor sinks, to 0.0005 % at first, to this if that fails");
    d.param("wall_fraction", &Refine::options, &RefineOptions::wall_fraction)
        .unit("1")
        .at_least(0.05)
        .at_most(0.5)
        .doc("a ball may reach into this fraction of the wall or slot behind the surface");
    d.param("sharp", &Refine::options, &RefineOptions::sharp)
        .unit("degrees")
        .at_least(1)
        .at_most(180)
        .doc("edges whose triangles turn by more are sampled from the start");
    d.param("keep_points", &Refine::options, &RefineOptions::keep_points)
        .doc("take the points that come in as samples too, before all others");
    d.param("max_samples", &Refine::options, &RefineOptions::max_samples)
        .unit("samples")
        .at_least(1000)
        .at_most(1e8)
        .doc("stop there, and say so");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    std::optional<geometry::Betti> wanted;
    if (topology) {
      const auto row = topology->row(TopologyStage::surface);
      if (row && topology->known(*row)) wanted = topology->betti[*row];
    }
    geometry::Refined result =
        geometry::refine(*mesh, points ? *points : geometry::PointSet{}, wanted, options, monitor);
    if (const std::string words = geometry::what_is_missing(result.report); !words.empty())
      monitor.warn(words);
    samples = std::move(result.points);
    surface = std::move(result.surface);
    report = std::move(result.report);
  }
};

}  // namespace

const bf_node* refine_entry() { return node_entry<Refine>(); }

}  // namespace ballflow::nodes
