#include "surface/surface_mesh.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::SurfaceMeshOptions;

struct SurfaceMesh {
  In<geometry::PowerDiagram> diagram;
  In<geometry::PoleSet> poles;
  In<geometry::PointSet> points;
  Out<geometry::TriangleMesh> mesh;
  Out<geometry::SurfaceReport> report;
  SurfaceMeshOptions options;

  static void declare(NodeDecl<SurfaceMesh>& d) {
    d.id("SurfaceMesh", 3).summary("A closed surface through the kept samples of a cloud of points.");
    d.doc(
        "The triangles of the zero alpha-shape of surface balls have holes and edges of many triangles on "
        "real clouds. "
        "This node tells the cells of the regular triangulation inside from outside: poles vote in the cells "
        "where they "
        "lie, cells that hang together through gaps of the alpha-shape have one label, and where votes "
        "disagree, "
        "because the alpha-shape leaks, they are cut apart where that takes the least area (a minimum cut). "
        "The "
        "surface between inside and outside is closed, oriented and a 2-manifold, whatever the alpha-shape "
        "was; its "
        "vertices are samples, unmoved. Refuses clouds that do not look like the surface of a solid, with "
        "the reason: "
        "open scans, parts with sharp edges, sheets thinner than the spacing. With open = true holes stay "
        "open: what closes gaps wider than the balls around them is taken out again, and the surface has "
        "boundary loops. Scans of one side whose poles do not tell an inside are refused all the same.");
    d.avoid_when(
        "the cloud is clean and dense and every sample should be a vertex: CGAL's advancing front is as "
        "good.");
    d.cites("kornberger2010", "4.5.3")
        .cites("kolluri2004", "labels of cells by a cut")
        .cites("boykov2004", "how it is found");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{64} << 20, 12);
    d.input("diagram", &SurfaceMesh::diagram).doc("the power diagram of the kept surface balls");
    d.input("poles", &SurfaceMesh::poles).doc("labelled poles of all samples");
    d.input("points", &SurfaceMesh::points).doc("all samples");
    d.output("mesh", &SurfaceMesh::mesh).doc("an oriented 2-manifold, closed but with open = true");
    d.output("report", &SurfaceMesh::report)
        .doc("genus, what was filled, what the poles say against it, and what it passes by");
    d.param("most_overruled", &SurfaceMesh::options, &SurfaceMeshOptions::most_overruled)
        .unit("share of the votes")
        .at_least(0)
        .at_most(1)
        .doc("a surface that contradicts more of what the poles say is refused");
    d.param("most_filled", &SurfaceMesh::options, &SurfaceMeshOptions::most_filled)
        .unit("share of the area")
        .at_least(0)
        .at_most(1)
        .doc("a closed surface that closes more gaps between balls is refused");
    d.param("most_holes", &SurfaceMesh::options, &SurfaceMeshOptions::most_holes)
        .unit("share of the area")
        .at_least(0)
        .at_most(1)
        .doc("a closed surface that closes more holes is refused");
    d.param("hole", &SurfaceMesh::options, &SurfaceMeshOptions::hole)
        .unit("times the balls around, and the distance to the third neighbour")
        .at_least(0)
        .at_most(1000)
        .doc("a gap that is larger is a hole");
    d.param("open", &SurfaceMesh::options, &SurfaceMeshOptions::open)
        .doc("leave holes open: a surface with boundary loops, of which no gap is refused");
    d.param("smallest_hole", &SurfaceMesh::options, &SurfaceMeshOptions::smallest_hole)
        .unit("share of the area")
        .at_least(0)
        .at_most(1)
        .doc("open: smaller holes are closed all the same");
    d.param("most_left_out", &SurfaceMesh::options, &SurfaceMeshOptions::most_left_out)
        .unit("share of the squared radii")
        .at_least(0)
        .at_most(1)
        .doc("a surface that passes by more of the kept balls, farther than their radius, is refused");
    d.param("smallest_component", &SurfaceMesh::options, &SurfaceMeshOptions::smallest_component)
        .unit("share of the area of the largest component")
        .at_least(0)
        .at_most(1)
        .doc("smaller components are left out");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::SurfaceMesh result = geometry::surface_mesh(*diagram, *poles, *points, options, monitor);
    mesh = std::move(result.mesh);
    report = std::move(result.report);
  }
};

}  // namespace

const bf_node* surface_mesh_entry() { return node_entry<SurfaceMesh>(); }

}  // namespace ballflow::nodes
