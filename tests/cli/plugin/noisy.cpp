// A node that breaks the promise of determinism: it gives the time.
#include <chrono>

#include "ballflow/sdk.hpp"

namespace {

struct Stamp {
  std::int64_t nanoseconds = 0;
};

}  // namespace

template <>
struct ballflow::TypeOf<Stamp> {
  static void declare(TypeDecl<Stamp>& d) {
    d.id("Stamp", 1).doc("A moment.");
    d.scalar("nanoseconds", &Stamp::nanoseconds).doc("since 1970");
  }
};

namespace {

struct Clock {
  ballflow::Out<Stamp> now;
  static void declare(ballflow::NodeDecl<Clock>& d) {
    d.id("Clock", 1).summary("Gives the time.");
    d.output("now", &Clock::now).doc("the time");
  }
  void run(ballflow::RunContext&) {
    now = Stamp{std::chrono::system_clock::now().time_since_epoch().count()};
  }
};

struct Later {
  ballflow::In<Stamp> a;
  ballflow::Out<Stamp> later;
  std::int64_t by = 1;
  static void declare(ballflow::NodeDecl<Later>& d) {
    d.id("Later", 1).summary("Adds to a time.");
    d.input("time", &Later::a).doc("a time");
    d.output("later", &Later::later).doc("a later one");
    d.param("by", &Later::by).unit("ns").at_least(0).doc("how much later");
  }
  void run(ballflow::RunContext&) { later = Stamp{a->nanoseconds + by}; }
};

}  // namespace

BALLFLOW_PLUGIN("test", "1", (ballflow::node_entries<Clock, Later>()), (ballflow::type_entries<Stamp>()))
