#include "enclose/verify_enclosure.hpp"

#include <ballflow/sdk.hpp>

#include "exact/cgal_version.hpp"
#include "types/artifact_types.hpp"
#include "types/enclosure_type.hpp"
#include "types/power_diagram_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::OnOpen;
using geometry::VerifyEnclosureOptions;

struct VerifyEnclosure {
  In<geometry::TriangleMesh> mesh, solid;
  In<geometry::Balls> balls;
  In<geometry::PowerDiagram> diagram;
  Out<geometry::Enclosure> enclosure;
  VerifyEnclosureOptions options;

  static void declare(NodeDecl<VerifyEnclosure>& d) {
    d.id("VerifyEnclosure", 5)
        .summary("Prove that balls contain everything inside a surface, or tell what they miss.");
    d.doc(
        "The union of the balls contains every triangle, and everything that the triangles separate from "
        "infinity, "
        "if every triangle lies in it and it leaves no void. Triangles are bisected until every part lies in "
        "one "
        "ball; that and the voids are decided exactly, nothing is sampled. Accepts any mesh: open, doubled, "
        "crossing triangles of either orientation; and balls of any origin. What is not covered is listed "
        "with a "
        "point of each triangle, about which share of the surface it is, and how far away. protrusion bounds "
        "how "
        "far the balls stand out. Refuses meshes without triangles, but with on_open expect: then nothing is "
        "proven.");
    d.avoid_when("samples have to be covered, not the surface between them: VerifyCover.");
    d.cites("edelsbrunner1995", "voids by the dual complex");
    d.library("CGAL", geometry::cgal_version());
    d.memory(1 << 20, 32);
    d.input("mesh", &VerifyEnclosure::mesh).doc("m triangles, model units");
    d.input("balls", &VerifyEnclosure::balls).doc("n closed balls, in the same place and unit");
    d.input("diagram", &VerifyEnclosure::diagram)
        .optional()
        .doc("their power diagram, with tolerance none: they are not triangulated again");
    d.input("solid", &VerifyEnclosure::solid)
        .optional()
        .doc(
            "a closed mesh whose inside counts in place of the mesh's for voids and the protrusion: for "
            "discs "
            "the prism of PolygonMeshes");
    d.output("enclosure", &VerifyEnclosure::enclosure).doc("the verdict, and every place where it fails");
    d.choice("on_open", &VerifyEnclosure::options, &VerifyEnclosureOptions::on_open,
             {{OnOpen::error, "error", "the node fails and names the first place"},
              {OnOpen::report, "report", "the places are listed in the result, and a warning says so"},
              {OnOpen::expect, "expect",
               "the places are listed; balls inside, or of bounded protrusion, have them"}})
        .doc("what it means when not everything is enclosed");
  }
  void run(RunContext& context) {
    ContextMonitor monitor(context);
    geometry::Enclosure found = geometry::verify_enclosure(
        *mesh, *balls, options, monitor, diagram ? &*diagram : nullptr, solid ? &*solid : nullptr);
    if (!found.encloses() && options.on_open != OnOpen::expect)
      monitor.warn("the balls do NOT enclose the surface: " + geometry::describe(found));
    enclosure = std::move(found);
  }
};

}  // namespace

const bf_node* verify_enclosure_entry() { return node_entry<VerifyEnclosure>(); }

}  // namespace ballflow::nodes
