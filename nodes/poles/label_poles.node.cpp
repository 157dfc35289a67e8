#include "poles/label_poles.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using geometry::LabelMethod;
using geometry::LabelPolesOptions;
using geometry::OuterBalls;
using geometry::Vertices;

struct LabelPoles {
  In<geometry::PoleSet> poles;
  In<geometry::TriangleMesh> mesh;
  Out<geometry::PoleSet> labelled;
  Out<geometry::Balls> inner, outer;
  LabelPolesOptions options;

  static void declare(NodeDecl<LabelPoles>& d) {
    d.id("LabelPoles", 3);
    d.summary("Tell inner from outer poles: the discrete medial axis transform of a solid.");
    d.doc(
        "A pole is inner when the winding number of the mesh around it exceeds 1/2. For closed meshes it is "
        "an integer, counted with exact predicates: right at sharp edges, where the sample is too coarse, "
        "with cavities and with self-intersections. For open meshes it is the generalized winding number. "
        "Triangles that face inconsistent ways are turned over; the mesh may be inside out. Without a mesh, "
        "for clouds of points, labels spread from the unbounded poles, which are outer: two balls through "
        "one "
        "sample share a label where they overlap deeply, and do not where they lie on opposite sides of it, "
        "the most certain pairs first (method angle). That is right for well sampled smooth surfaces; it "
        "fails at sharp edges, at noise as large as the spacing, between sheets closer than the spacing, and "
        "leaks through holes. Where both poles of a sample are on one side, as at sharp edges, the farthest "
        "candidate on the other side becomes its third pole. The summary of `poles` adds method, uncertain "
        "(winding number from 1/4 to 3/4, or exactly on the surface; for angle, evidence against the label "
        "at least half as strong as that for it), unlabelled (angle: nothing is known) and "
        "turned_triangles. Refuses open surfaces that have no inside that could be told (a sheet; method "
        "auto), mesh and "
        "winding without triangles, and a surface with no pole inside, "
        "such as an open sheet.");
    d.avoid_when("the mesh is not the surface that was sampled, or has large holes: see `uncertain`.");
    d.cites("kornberger2010", "3.4").cites("aichholzer2007", "labels from a mesh");
    d.cites("amentakolluri2000", "labels without a mesh");
    d.cites("jacobson2013", "generalized winding number").cites("barill2018", "hierarchical evaluation");
    d.memory(1 << 20, 2.5);
    d.input("poles", &LabelPoles::poles).doc("poles of a sample, labelled or not");
    d.input("mesh", &LabelPoles::mesh)
        .optional()
        .doc("triangles of the surface that was sampled, in the same coordinates; not for method angle");
    d.output("poles", &LabelPoles::labelled)
        .doc("the poles, labelled, with third poles; with vertices = poles without the other candidates");
    d.output("inner", &LabelPoles::inner)
        .doc("balls of the inner vertices with the samples they pass through");
    d.output("outer", &LabelPoles::outer)
        .doc("balls of the outer vertices, those of unbounded poles included or not");
    d.choice("method", &LabelPoles::options, &LabelPolesOptions::method,
             {{LabelMethod::automatic, name(LabelMethod::automatic),
               "mesh when the mesh is closed, angle without triangles, else winding, with a warning"},
              {LabelMethod::mesh, name(LabelMethod::mesh),
               "exact, for closed meshes; refuses others and says why"},
              {LabelMethod::winding, name(LabelMethod::winding),
               "generalized winding number; the same as mesh for closed meshes"},
              {LabelMethod::angle, name(LabelMethod::angle),
               "from the polar balls alone, for clouds without a mesh"}})
        .doc("how inside and outside are told apart");
    d.choice("outer", &LabelPoles::options, &LabelPolesOptions::outer,
             {{OuterBalls::all, "all", "balls of unbounded poles too; they end at far-away points"},
              {OuterBalls::bounded, "bounded",
               "only balls that samples bound, for the medial axis of the outside"}})
        .doc("which balls the output outer has");
    d.choice("vertices", &LabelPoles::options, &LabelPolesOptions::vertices,
             {{Vertices::automatic, "auto", "all with a closed mesh, else poles"},
              {Vertices::poles, "poles", "the poles of samples only (thesis, 3.4)"},
              {Vertices::all, "all", "every Voronoi vertex that VoronoiPoles listed; method angle: poles"}})
        .doc("which Voronoi vertices become balls");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::LabelledPoles result =
        geometry::label_poles(*poles, mesh ? *mesh : geometry::TriangleMesh{}, options, monitor);
    labelled.summary("method", name(result.method));
    labelled.summary("uncertain", result.uncertain);
    if (result.method == LabelMethod::angle) labelled.summary("unlabelled", result.unlabelled);
    labelled.summary("turned_triangles", result.turned_triangles);
    labelled = std::move(result.poles);
    inner = std::move(result.inner);
    outer = std::move(result.outer);
  }
};

}  // namespace

const bf_node* label_poles_entry() { return node_entry<LabelPoles>(); }

}  // namespace ballflow::nodes
