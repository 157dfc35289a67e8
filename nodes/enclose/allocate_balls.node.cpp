#include "enclose/allocate_balls.hpp"

#include <ballflow/sdk.hpp>
#include <charconv>
#include <string>
#include <string_view>
#include <vector>

#include "types/artifact_types.hpp"
#include "types/enclosure_fit_type.hpp"

namespace ballflow::nodes {
namespace {

using geometry::AllocateBallsOptions;

/// Numbers with commas between them; an empty text is none.
template <class T>
std::vector<T> numbers(const std::string& text, const char* name) {
  std::vector<T> result;
  std::string_view rest = text;
  while (!rest.empty()) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    T value{};
    const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), value);
    if (error != std::errc() || end != entry.data() + entry.size() || !(value >= 0)) {
      throw geometry::InputError(
          std::string(name) + " has \"" + std::string(entry) + "\", which is no number from 0 on",
          "write numbers with commas between them, one for each object: 1,2.5,1");
    }
    result.push_back(value);
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
  }
  return result;
}

struct AllocateBalls {
  InList<geometry::EnclosureFit> fits;
  Out<geometry::BallCounts> counts;
  AllocateBallsOptions options;
  std::string weights, fixed;

  static void declare(NodeDecl<AllocateBalls>& d) {
    d.id("AllocateBalls", 2)
        .summary("Hand out a number of balls to several objects, so that together they waste little volume.");
    d.doc(
        "Of all ways to hand them out one with the least volume outside. That volume is known from fits with "
        "a few numbers "
        "of balls for each object; between them it is taken for linear in 1 / sqrt(k), beyond the last one "
        "for proportional to that, or for constant where that did not use all its balls: what no object can "
        "use is not handed out. Small objects "
        "get few balls then, and a large part of their volume outside: minimum and weights help them.");
    d.avoid_when("there is one object.");
    d.cites("bellman1957", "one object after another, with every number of balls");
    d.memory(1 << 20, 1);
    d.input("fits", &AllocateBalls::fits)
        .doc(
            "fits of the first object, with more and more balls wanted, then those of the next one: an "
            "object begins where no more are wanted than before");
    d.output("counts", &AllocateBalls::counts).doc("balls of each object, in the order of the fits");
    d.param("balls", &AllocateBalls::options, &AllocateBallsOptions::balls)
        .unit("balls")
        .at_least(1)
        .at_most(1000000)
        .doc("of all objects together");
    d.param("minimum", &AllocateBalls::options, &AllocateBallsOptions::minimum)
        .unit("balls")
        .at_least(1)
        .at_most(5000)
        .doc("at least so many for each object");
    d.param("weights", &AllocateBalls::weights)
        .doc("how much the volume of each object counts, in their order: 1,2.5,1; empty: all the same");
    d.param("fixed", &AllocateBalls::fixed)
        .doc("as many balls for each object, 0 where they are to be found: 24,0,8; empty: none is fixed");
  }
  void run(RunContext&) {
    AllocateBallsOptions wanted = options;
    wanted.weights = numbers<double>(weights, "weights");
    wanted.fixed = numbers<std::int64_t>(fixed, "fixed");
    const std::vector<geometry::EnclosureFit> all(fits.begin(), fits.end());
    counts = geometry::allocate_balls(all, wanted);
  }
};

struct BallCount {
  In<geometry::BallCounts> counts;
  Out<geometry::BallCounts> count;
  std::int64_t object = 0;

  static void declare(NodeDecl<BallCount>& d) {
    d.id("BallCount", 1).summary("The number of balls of one object.");
    d.doc(
        "So that what one object gets depends on its own number only, and stays in the cache when others "
        "change.");
    d.cites("bellman1957", "where the counts come from");
    d.avoid_when("a number is known beforehand: the parameter balls of EncloseBalls.");
    d.memory(1 << 16, 1);
    d.input("counts", &BallCount::counts).doc("of several objects");
    d.output("count", &BallCount::count).doc("of one");
    d.param("object", &BallCount::object)
        .unit("number")
        .at_least(0)
        .at_most(1000000)
        .doc("which one, from 0 on");
  }
  void run(RunContext&) { count = geometry::count_of(*counts, object); }
};

}  // namespace

const bf_node* allocate_balls_entry() { return node_entry<AllocateBalls>(); }
const bf_node* ball_count_entry() { return node_entry<BallCount>(); }

}  // namespace ballflow::nodes
