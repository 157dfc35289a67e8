#include "types/topology_check.hpp"

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::TopologyCheck>::declare(TypeDecl<geometry::TopologyCheck>& d) {
  using T = geometry::TopologyCheck;
  using geometry::Betti;
  d.id("TopologyCheck", 1)
      .doc("What the inclusion of a union of few balls in that of all of them does to homology over Z/2.");
  d.scalar("kept", &T::kept).doc("number of balls before the repair");
  d.scalar("returned", &T::returned).doc("number of balls that the repair returned");
  d.scalar("whole", &T::whole).doc("components, tunnels, cavities of the union of all balls");
  d.scalar("before", &T::before).doc("those of the balls before the repair");
  d.scalar("before_rank", &T::before_rank).doc("how many of them are independent ones of the whole");
  d.scalar("after", &T::after).doc("those of the balls after the repair");
  d.scalar("after_rank", &T::after_rank).doc("how many of them are independent ones of the whole");
  d.scalar("inclusions", &T::inclusions).doc("how many sets of balls were compared with the whole");
  d.scalar("everything", &T::everything).doc("1 where nothing less than all balls had the right topology");
  d.summary("isomorphism", "the inclusion induces isomorphisms of homology over Z/2 after the repair");
  d.summary("isomorphism_before", "the same before the repair");
  d.summary("words", "what was wrong, and how many balls were returned");
  d.summary("kept", "number of balls before the repair").summary("returned", "balls that were returned");
  d.summary("inclusions", "how many sets of balls were compared with the whole");
  d.summary("everything", "true where nothing less than all balls had the right topology");
  d.summary("whole", "[components, tunnels, cavities] of the union of all balls");
  d.summary("before", "those before the repair").summary("after", "those after the repair");
  d.summary("before_rank", "how many of them are independent ones of the whole");
  d.summary("after_rank", "how many of them are independent ones of the whole");
  d.summarize([](const T& v) {
    return Summary{{"isomorphism", v.inclusion_after().isomorphism()},
                   {"isomorphism_before", v.inclusion_before().isomorphism()},
                   {"words", geometry::describe(v)},
                   {"kept", v.kept},
                   {"returned", v.returned},
                   {"inclusions", v.inclusions},
                   {"everything", v.everything != 0},
                   {"whole", v.whole},
                   {"before", v.before},
                   {"before_rank", v.before_rank},
                   {"after", v.after},
                   {"after_rank", v.after_rank}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
