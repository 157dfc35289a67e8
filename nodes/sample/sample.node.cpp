#include "sample/sample.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {

using geometry::SampleMode;
using geometry::SampleOptions;
using geometry::Spread;
using geometry::StrayPolicy;

struct Sample {
  Out<geometry::PointSet> points;
  Out<geometry::TriangleMesh> mesh;
  SampleOptions options;

  static void declare(NodeDecl<Sample>& d) {
    d.id("Sample", 3).summary("Reads a model, or makes one, and samples its surface.");
    d.doc(
        "Reads OFF, OBJ, PLY, STL and points as text (XYZ, PTS, PWN, CSV, ASC, also under column names and "
        "with "
        "decimal commas), each also packed with gzip or zstd; content that belies the name of its file is "
        "read "
        "as what it is, with a warning. Welds equal vertices, drops degenerate and repeated faces, also "
        "walls "
        "that are there twice, triangulates polygons inside themselves and, where there are faces, drops "
        "vertices in none, and says how many. Refuses files that are cut off or damaged, coordinates that "
        "are "
        "not finite, indices out of range, commas that may separate or be decimal, and points in one plane.");
    d.avoid_when("the model needs repair first: holes and self-intersections stay as they are");
    d.cites("kornberger2010", "3.4 and 3.9").cites("yuksel2015", "3");
    d.library("CGAL", geometry::cgal_version()).uses_seed();
    d.memory(std::uint64_t{256} << 20, 0);
    d.output("points", &Sample::points).doc("n samples: the vertices of the model, or points on its faces");
    d.output("mesh", &Sample::mesh).doc("the model; no vertices and no triangles for a cloud of points");
    d.param("file", &Sample::options, &SampleOptions::file)
        .file()
        .scheme("shape:")
        .required()
        .doc("a model file, or shape:NAME for a generated one (shape:torus?R=1&r=0.3&n=20000; see Shape)");
    d.param("scale", &Sample::options, &SampleOptions::scale)
        .doc(
            "of all coordinates: a factor, or the unit of the lengths in the file, which become metres (um, "
            "mm, cm, "
            "dm, m, km, mil, in, ft, yd)");
    d.param("weld", &Sample::options, &SampleOptions::weld)
        .doc(
            "vertices of the file this near to each other become one: a length in model units (after "
            "scaling), or a "
            "share of the longest edge of the bounding box (0.01%); 0: only equal ones. A warning names the "
            "tolerance that closes an open mesh whose gaps are small");
    d.choice("strays", &Sample::options, &SampleOptions::strays,
             {{StrayPolicy::keep, "keep", "they stay, and a warning names them"},
              {StrayPolicy::drop, "drop", "they are left out, with a warning"}})
        .doc(
            "the few points of the file (at most a hundredth) that stretch the bounding box tenfold or more, "
            "and no "
            "triangle joins with the others");
    d.choice("mode", &Sample::options, &SampleOptions::mode,
             {{SampleMode::vertices, "vertices", "the vertices of the model, in the order of the file"},
              {SampleMode::surface, "surface", "count points on the faces"}})
        .doc("what becomes a sample");
    d.choice("spread", &Sample::options, &SampleOptions::spread,
             {{Spread::poisson, "poisson", "evenly spaced: five times as many random points, thinned out"},
              {Spread::random, "random", "independent and uniform by area"}})
        .doc("how points lie on the faces; mode surface only");
    d.param("count", &Sample::options, &SampleOptions::count)
        .unit("points")
        .at_least(4)
        .at_most(2e6)
        .doc("number of points; mode surface only");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::MeshFile model = geometry::sample(options, context.seed(), monitor);
    mesh = std::move(model.mesh);
    points = std::move(model.points);
    points.summary("welded", model.welded_vertices);
    points.summary("unused", model.unused_vertices);
    if (model.near_vertices != 0) points.summary("near", model.near_vertices);
    if (model.stray_vertices != 0) points.summary("strays", model.stray_vertices);
    mesh.summary("degenerate_faces", model.degenerate_faces);
    mesh.summary("repeated_faces", model.repeated_faces);
    if (model.cancelled_faces != 0) mesh.summary("cancelled_faces", model.cancelled_faces);
    if (model.concave_faces != 0) mesh.summary("concave_faces", model.concave_faces);
    if (model.crossing_faces != 0) mesh.summary("crossing_faces", model.crossing_faces);
  }
};

const bf_node* sample_entry() { return node_entry<Sample>(); }

}  // namespace ballflow::nodes
