#include "ellipsoids/select_ellipsoids.hpp"

#include <ballflow/sdk.hpp>
#include <utility>

#include "types/artifact_types.hpp"
#include "types/ellipsoid_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct SelectEllipsoids {
  In<CoverState> cover;
  In<Ellipsoids> ellipsoids;
  Out<Ellipsoids> selected;

  static void declare(NodeDecl<SelectEllipsoids>& d) {
    d.id("SelectEllipsoids", 1).summary("Take the ellipsoids that a set cover chose.");
    d.doc(
        "The chosen ellipsoids in the order of their indices. Refuses a cover of another number of "
        "ellipsoids, and one that leaves samples to be covered.");
    d.avoid_when("all ellipsoids are wanted: connect them directly.");
    d.cites("kornberger2010", "3.6 and 6.4");
    d.memory(1 << 20, 1.0);
    d.input("cover", &SelectEllipsoids::cover).doc("a finished cover: remaining = 0");
    d.input("ellipsoids", &SelectEllipsoids::ellipsoids).doc("those that the matrix was made of");
    d.output("ellipsoids", &SelectEllipsoids::selected).doc("the chosen ones, ascending by index");
  }
  void run(RunContext&) { selected = select_ellipsoids(*cover, *ellipsoids); }
};

}  // namespace

const bf_node* select_ellipsoids_entry() { return node_entry<SelectEllipsoids>(); }

}  // namespace ballflow::nodes
