// Nodes that take their time and use no processor: one says how far it has come, the other does not.
#include <chrono>
#include <thread>

#include "ballflow/sdk.hpp"

namespace {

struct Rest {
  double seconds = 0;
};

}  // namespace

template <>
struct ballflow::TypeOf<Rest> {
  static void declare(TypeDecl<Rest>& d) {
    d.id("Rest", 1).doc("A rest.");
    d.scalar("seconds", &Rest::seconds).doc("how long it was");
  }
};

namespace {

struct Nap {
  ballflow::Out<Rest> rest;
  double seconds = 1;
  bool tell = false;
  static void declare(ballflow::NodeDecl<Nap>& d) {
    d.id("Nap", 1).summary("Waits.");
    d.output("rest", &Nap::rest).doc("the rest");
    d.param("seconds", &Nap::seconds).unit("s").at_least(0).doc("how long");
    d.param("tell", &Nap::tell).doc("say how far it has come");
  }
  void run(ballflow::RunContext& context) {
    constexpr int steps = 50;
    for (int i = 0; i < steps; ++i) {
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds / steps));
      if (tell) context.progress(double(i + 1) / steps);
    }
    rest = Rest{seconds};
  }
};

}  // namespace

BALLFLOW_PLUGIN("test", "1", (ballflow::node_entries<Nap>()), (ballflow::type_entries<Rest>()))
