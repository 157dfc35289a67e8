#include "types/bisection.hpp"

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::Bisection>::declare(TypeDecl<geometry::Bisection>& d) {
  using T = geometry::Bisection;
  d.id("Bisection", 2)
      .doc("A search for a growth with which few enough balls cover a sample, or the error is allowed.");
  d.scalar("value", &T::value).doc("to be tried next; once done, the answer");
  d.scalar("too_small", &T::too_small).doc("largest value known to need too many balls; -1 for none");
  d.scalar("large_enough", &T::large_enough).doc("smallest value known to need few enough; -1 for none");
  d.scalar("balls", &T::balls).doc("what large_enough needs; -1 while unknown");
  d.scalar("balls_before", &T::balls_before).doc("what too_small needs; -1 while unknown");
  d.scalar("within", &T::within).doc("largest value known to have an error that is allowed; -1 for none");
  d.scalar("beyond", &T::beyond).doc("smallest value known to have a larger error; -1 for none");
  d.scalar("error", &T::error).doc("of `within`, model units; -1 while unknown");
  d.scalar("error_before", &T::error_before).doc("of `beyond`, model units; -1 while unknown");
  d.scalar("tried", &T::tried).doc("values that were tried");
  d.scalar("done", &T::done).doc("1 at the end");
  d.summary("value", "to be tried next; once done, the answer").summary("done", "1 at the end");
  d.summary("balls", "what the smallest sufficient value needs; null while there is none");
  d.summary("balls_before", "what the largest insufficient value needs; null while there is none");
  d.summary("error",
            "of the largest value with an error that is allowed, model units; null while there is none");
  d.summary("tried", "values that were tried");
  d.summarize([](const T& v) {
    const auto known = [](std::int64_t n) { return n < 0 ? SummaryValue(nullptr) : SummaryValue(n); };
    return Summary{{"value", v.value},
                   {"done", v.done},
                   {"balls", known(v.balls)},
                   {"balls_before", known(v.balls_before)},
                   {"error", v.error < 0 ? SummaryValue(nullptr) : SummaryValue(v.error)},
                   {"tried", v.tried}};
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
