#include "types/simplicial_complex.hpp"

#include <string>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::SimplicialComplex>::declare(TypeDecl<geometry::SimplicialComplex>& d) {
  using T = geometry::SimplicialComplex;
  d.id("SimplicialComplex", 1)
      .doc("The weighted zero alpha-shape of balls: the dual complex of their union.");
  d.array("centers", &T::centers).length("n").doc("centres of the balls, model units");
  d.array("weights", &T::weights).length("n").doc("squared radii, delta included");
  d.array("vertices", &T::vertices).length("v").doc("balls that are vertices of the complex");
  d.array("edges", &T::edges).length("e").doc("pairs of balls, ascending");
  d.array("triangles", &T::triangles).length("t").doc("triples of balls, ascending");
  d.array("tetrahedra", &T::tetrahedra).length("c").doc("quadruples of balls, ascending");
  d.array("vertex_classes", &T::vertex_classes).length("v").doc("0 interior, 1 regular, 2 singular");
  d.array("edge_classes", &T::edge_classes).length("e").doc("0 interior, 1 regular, 2 singular");
  d.array("triangle_classes", &T::triangle_classes).length("t").doc("0 interior, 1 regular, 2 singular");
  d.scalar("delta", &T::delta).doc("added to every squared radius before anything was decided");
  d.scalar("betti", &T::betti).doc("components, tunnels, cavities of the union");
  d.summary("vertices", "number").summary("edges", "number").summary("triangles", "number");
  d.summary("tetrahedra", "number").summary("singular_vertices", "isolated balls");
  d.summary("singular_edges", "edges in no triangle")
      .summary("singular_triangles", "triangles in no tetrahedron");
  d.summary("interior_vertices", "number")
      .summary("interior_edges", "number")
      .summary("interior_triangles", "number");
  d.summary("regular_vertices", "number")
      .summary("regular_edges", "number")
      .summary("regular_triangles", "number");
  d.summary("delta", "squared model units");
  d.summary("euler_characteristic", "vertices - edges + triangles - tetrahedra");
  d.summary("betti", "[components, tunnels, cavities] of the union");
  d.summarize([](const T& v) {
    Summary s{{"vertices", v.vertices.size()},
              {"edges", v.edges.size()},
              {"triangles", v.triangles.size()},
              {"tetrahedra", v.tetrahedra.size()}};
    const auto classes = [&s](const char* what, const geometry::Array<std::uint8_t>& values) {
      std::int64_t count[3] = {0, 0, 0};
      for (const std::uint8_t c : values) ++count[c < 3 ? c : 1];
      s[std::string("singular_") + what] = count[2];
      s[std::string("regular_") + what] = count[1];
      s[std::string("interior_") + what] = count[0];
    };
    classes("vertices", v.vertex_classes);
    classes("edges", v.edge_classes);
    classes("triangles", v.triangle_classes);
    s["delta"] = v.delta;
    s["euler_characteristic"] = v.euler_characteristic();
    s["betti"] = v.betti;
    return s;
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
