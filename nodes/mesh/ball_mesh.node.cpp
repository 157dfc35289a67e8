#include "mesh/ball_mesh.hpp"

#include <ballflow/sdk.hpp>
#include <string>
#include <utility>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::BallMeshMethod;
using geometry::BallMeshOptions;

struct BallMesh {
  In<geometry::Balls> balls;
  Out<geometry::TriangleMesh> mesh;
  Out<geometry::MeshReport> report;
  BallMeshOptions options;

  static void declare(NodeDecl<BallMesh>& d) {
    d.id("BallMesh", 3).summary("A closed triangle mesh of the boundary of a union of balls.");
    d.doc(
        "The mesh is a closed manifold whose faces look outwards, with one component for every component and "
        "every "
        "cavity of the union, for any balls: none, nested, equal, disjoint, tiny, touching ones, and polar "
        "balls as "
        "they come. The vertices lie on the boundary, no point of the mesh is farther from it than was asked "
        "for. It "
        "does not depend on the order of the balls. Balls that touch are joined. Refuses a single point.");
    d.avoid_when("the surface that the balls stand for is at hand and good: the union is only near it.");
    d.cites("kornberger2010", "2.8")
        .cites("lindstrom1998", "keep_faces")
        .cites("edelsbrunner1999", "skin")
        .cites("edelsbrunner1995", "the union of balls and its dual shape");
    d.library("CGAL", geometry::cgal_version());
    d.memory(std::uint64_t{64} << 20, 256);
    d.input("balls", &BallMesh::balls).doc("n closed balls, model units");
    d.output("mesh", &BallMesh::mesh).doc("the boundary of their union");
    d.output("report", &BallMesh::report).doc("how it was made, distance, topology, self-intersections");
    d.choice("method", &BallMesh::options, &BallMeshOptions::method,
             {{BallMeshMethod::exact, "exact",
               "from the power diagram: few triangles, the topology decided exactly. Where rounding would "
               "decide, "
               "radii change by at most 1e-6 of the longest edge; where that does not help there is a grid"},
              {BallMeshMethod::grid, "grid",
               "tetrahedra on the cells of a grid, refined until distance and topology are right or two "
               "rounds bring "
               "nothing, with vertices in the bottoms of notches: ten times the triangles, of which few "
               "cross"},
              {BallMeshMethod::skin, "skin",
               "the skin surface around the balls (CGAL), smooth where spheres meet, for comparison: it "
               "contains the balls, its "
               "topology is that of balls larger by 1 / sqrt(shrink), and `error` does not steer it"}})
        .doc("how the mesh is made");
    d.param("error", &BallMesh::options, &BallMeshOptions::error)
        .unit("% of the longest bounding-box edge")
        .at_least(1e-4)
        .at_most(100)
        .doc("how far the mesh may be from the boundary of the union");
    d.param("keep_faces", &BallMesh::options, &BallMeshOptions::keep_faces)
        .unit("% of the triangles")
        .above(0)
        .at_most(100)
        .doc(
            "how many are left by collapsing edges (CGAL, Lindstrom and Turk); the mesh stays a closed "
            "manifold of the "
            "same topology, its distance from the union is measured again and may be above `error`");
    d.param("most_faces", &BallMesh::options, &BallMeshOptions::most_faces)
        .unit("1")
        .at_least(1)
        .at_most(1'000'000'000)
        .doc("a mesh of more faces is refused");
    d.param("self_intersections", &BallMesh::options, &BallMeshOptions::self_intersections)
        .doc("count the pairs of triangles that cross; takes about as long as the mesh");
    d.param("refine_notches", &BallMesh::options, &BallMeshOptions::refine_notches)
        .doc(
            "method grid: refine where vertices in the bottoms of notches do not bring these within the "
            "error; "
            "otherwise the report says how far they are");
    d.param("shrink", &BallMesh::options, &BallMeshOptions::shrink)
        .unit("1")
        .at_least(0.05)
        .at_most(0.95)
        .doc("method skin: towards 1 the boundary of the union, the less the more notches and gaps it fills");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::BallMesh made = geometry::ball_mesh(*balls, options, monitor);
    if (const std::string differs = geometry::what_differs(made.report); !differs.empty())
      monitor.warn(differs);
    mesh = std::move(made.mesh);
    report = made.report;
  }
};

}  // namespace

const bf_node* ball_mesh_entry() { return node_entry<BallMesh>(); }

}  // namespace ballflow::nodes
