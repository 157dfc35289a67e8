#include "cover/greedy.hpp"

#include <ballflow/sdk.hpp>

#include "types/artifact_types.hpp"

namespace ballflow::nodes {
namespace {

using namespace geometry;

struct Greedy {
  In<CoverState> cover;
  Out<CoverState> covered;
  GreedyOptions options;

  static void declare(NodeDecl<Greedy>& d) {
    d.id("Greedy", 1).summary("Choose the ball that covers most of what is left.");
    d.doc(
        "Ties go to the ball of lowest index. Each pick may cost one ball more than the optimum; the lower "
        "bound "
        "of the result accounts for the picks (Lemma 3.7).");
    d.avoid_when("few balls matter more than time: reduce first, and improve the result by local search.");
    d.cites("kornberger2010", "3.6.3, Listing 3.1 and Lemma 3.7");
    d.input("cover", &Greedy::cover).doc("any state of a set covering computation");
    d.output("cover", &Greedy::covered).doc("the same instance with the picks chosen");
    d.choice("mode", &Greedy::options, &GreedyOptions::mode,
             {{GreedyMode::until_covered, "until_covered", "until every sample is covered"},
              {GreedyMode::one_per_component, "one_per_component",
               "one longest row of every connected component, once: the step of the hybrid loop"},
              {GreedyMode::all, "all", "every ball is kept: nothing is pruned"}})
        .doc("how many balls are chosen");
    d.param("remove_redundant", &Greedy::options, &GreedyOptions::remove_redundant)
        .doc("drop picks whose samples the other picks cover; mode until_covered only");
    d.memory(1 << 20, 1.5);
  }

  void run(RunContext& context) {
    ContextMonitor monitor(context);
    covered = greedy(*cover, options, monitor);
  }
};

}  // namespace

const bf_node* greedy_entry() { return node_entry<Greedy>(); }

}  // namespace ballflow::nodes
