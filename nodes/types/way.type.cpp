#include "types/way.hpp"

#include <array>

#include "types/motion_types.hpp"

namespace ballflow {

void TypeOf<geometry::Way>::declare(TypeDecl<geometry::Way>& d) {
  using T = geometry::Way;
  d.id("Way", 1).doc("Whether there is a way between two points around a union of balls, and one.");
  d.scalar("balls", &T::balls).doc("number of balls");
  d.scalar("start", &T::start).doc("where it begins, model units");
  d.scalar("goal", &T::goal).doc("where it ends");
  d.scalar("answer", &T::answer).doc("0 a way, 1 none, 2 start, 3 goal, 4 both in a ball");
  d.scalar("proof", &T::proof)
      .doc("the balls 0 are all there is, 1 contain the forbidden places, 2 lie in them");
  d.scalar("components", &T::components).doc("of what the balls leave of space");
  d.scalar("start_component", &T::start_component).doc("0 the unbounded one, others are voids, -1 in a ball");
  d.scalar("goal_component", &T::goal_component).doc("the same of the goal");
  d.scalar("start_ball", &T::start_ball).doc("the ball that the start is deepest in; -1: none");
  d.scalar("goal_ball", &T::goal_ball).doc("the same of the goal");
  d.array("points", &T::points).length("n").doc("of a polyline that meets no ball, model units; or none");
  d.array("clearances", &T::clearances).length("n").doc("of the points from the nearest ball, model units");
  d.scalar("clearance", &T::clearance).doc("the least of the whole polyline");
  d.summary("answer", "way, none, start inside, goal inside, both inside");
  d.summary("components", "of what the balls leave of space: the unbounded one and voids");
  d.summary("component", "[of the start, of the goal]; 0: the unbounded one, -1: in a ball");
  d.summary("points", "number of points of the way").summary("length", "of the way, model units; null: none");
  d.summary("clearance", "no point of the way is nearer to a ball, model units; null: none");
  d.summary("words", "the answer in words, and what it proves");
  d.summarize([](const T& v) {
    static constexpr std::array<const char*, 5> answers{"way", "none", "start inside", "goal inside",
                                                        "both inside"};
    const bool known = !v.points.empty();
    return Summary{{"answer", answers[v.answer < answers.size() ? v.answer : 0]},
                   {"components", v.components},
                   {"component", std::array<std::int64_t, 2>{v.start_component, v.goal_component}},
                   {"points", static_cast<std::int64_t>(v.points.size())},
                   {"length", known ? SummaryValue(geometry::length(v)) : SummaryValue(nullptr)},
                   {"clearance", known ? SummaryValue(v.clearance) : SummaryValue(nullptr)},
                   {"words", geometry::describe(v)}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
