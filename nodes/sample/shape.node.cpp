#include <ballflow/sdk.hpp>

#include "sample/generate.hpp"
#include "types/artifact_types.hpp"

namespace ballflow::nodes {

using geometry::ShapeOptions;

struct Shape {
  Out<geometry::PointSet> points;
  Out<geometry::TriangleMesh> mesh;
  ShapeOptions options;

  static void declare(NodeDecl<Shape>& d) {
    d.id("Shape", 1).summary("Makes a model from a formula, smooth or sharp, of known genus.");
    d.doc(
        "The mesh is closed, manifold, outward oriented and connected; the vertices of the smooth shapes lie "
        "on the surface up "
        "to rounding and are evenly spaced. The models of Kornberger 2010 that were never published have "
        "stand-ins of the "
        "same names and sizes. Refuses sizes out of range and fewer vertices than the features of the shape "
        "need.");
    d.avoid_when("the model is in a file: use Sample");
    d.cites("kornberger2010", "3.9, 4.9 and 5.4").cites("gibson1998", "2");
    d.memory(std::uint64_t{256} << 20, 0);
    d.output("points", &Shape::points).doc("the vertices of the mesh");
    d.output("mesh", &Shape::mesh).doc("the surface");
    std::vector<NodeDecl<Shape>::Choice<geometry::Shape>> choices;
    for (const geometry::ShapeInfo& info : geometry::shapes())
      choices.push_back({info.shape, info.name, info.doc});
    d.choice("shape", &Shape::options, &ShapeOptions::shape, std::move(choices))
        .doc("which model; says what R and r are");
    d.param("n", &Shape::options, &ShapeOptions::n)
        .unit("vertices")
        .at_least(0)
        .at_most(5e6)
        .doc("about how many vertices; 0 takes the number of the thesis' model or 10000 to 40000");
    d.param("R", &Shape::options, &ShapeOptions::R)
        .unit("model units")
        .at_least(0)
        .doc("the large size of the shape; 0 takes 1");
    d.param("r", &Shape::options, &ShapeOptions::r)
        .unit("model units")
        .at_least(0)
        .doc("the small size of the shape; 0 takes the shape's own proportion to R");
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::TriangleMesh model = geometry::generate(options, monitor);
    points = geometry::PointSet{model.vertices, {}};
    mesh = std::move(model);
  }
};

const bf_node* shape_entry() { return node_entry<Shape>(); }

}  // namespace ballflow::nodes
