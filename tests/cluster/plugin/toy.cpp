// Nodes that do next to nothing, for tens of thousands of them on a cluster. $BALLFLOW_TOY_DIE ends the
// process of the step with that value by exit code 37, as a node library with a bug would. Steps append what
// time it is on their node to a file of its name in $BALLFLOW_TOY_CLOCK. A step that takes memory keeps it
// for $BALLFLOW_TOY_HOLD seconds, so that somebody can see it.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "ballflow/sdk.hpp"

namespace {

struct Count {
  double value = 0;
};

}  // namespace

template <>
struct ballflow::TypeOf<Count> {
  static void declare(TypeDecl<Count>& d) {
    d.id("toy.Count", 1).doc("A number.");
    d.scalar("value", &Count::value).doc("the number");
    d.summary("value", "the number");
    d.summarize([](const Count& count) { return ballflow::Summary{{"value", count.value}}; });
  }
};

namespace {

struct Load {
  ballflow::Out<Count> count;
  double model = 0;
  static void declare(ballflow::NodeDecl<Load>& d) {
    d.id("toy.Load", 1).summary("A number.");
    d.output("count", &Load::count).doc("the number");
    d.param("model", &Load::model).doc("the number");
  }
  void run(ballflow::RunContext&) { count = Count{1000 * model}; }
};

void write_time() {
  const char* const folder = std::getenv("BALLFLOW_TOY_CLOCK");
  const char* const node = std::getenv("SLURMD_NODENAME");
  if (folder == nullptr || node == nullptr) return;
  std::FILE* const file = std::fopen((std::string(folder) + '/' + node).c_str(), "a");
  if (file == nullptr) return;
  std::fprintf(file, "%lld\n", static_cast<long long>(std::time(nullptr)));
  std::fclose(file);
}

struct Step {
  ballflow::In<Count> from;
  ballflow::Out<Count> count;
  double add = 0, seconds = 0, megabytes = 0;
  static void declare(ballflow::NodeDecl<Step>& d) {
    d.id("toy.Step", 1).summary("Adds to a number, and computes in vain for a while.");
    d.input("from", &Step::from).doc("a number");
    d.output("count", &Step::count).doc("the sum");
    d.param("add", &Step::add).doc("what is added");
    d.param("seconds", &Step::seconds).unit("s").at_least(0).doc("processor time that it takes");
    d.param("megabytes", &Step::megabytes).at_least(0).doc("memory that it takes and does not tell of");
  }
  void run(ballflow::RunContext&) {
    const double sum = from->value + add;
    const char* const die = std::getenv("BALLFLOW_TOY_DIE");
    if (die != nullptr && std::strtod(die, nullptr) == sum) {
      std::fprintf(stderr, "toy: %s is one too many\n", die);
      ::_exit(37);
    }
    write_time();
    const std::vector<char> memory(static_cast<std::size_t>(megabytes * 1e6), 1);
    const char* const hold = std::getenv("BALLFLOW_TOY_HOLD");
    if (!memory.empty() && hold != nullptr)
      std::this_thread::sleep_for(std::chrono::duration<double>(std::strtod(hold, nullptr)));
    const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < until) {
    }
    count = Count{sum};
  }
};

struct Sum {
  ballflow::InList<Count> counts;
  ballflow::Out<Count> sum;
  static void declare(ballflow::NodeDecl<Sum>& d) {
    d.id("toy.Sum", 1).summary("Sums.");
    d.input("counts", &Sum::counts).doc("numbers");
    d.output("sum", &Sum::sum).doc("their sum");
  }
  void run(ballflow::RunContext&) {
    double total = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) total += counts[i].value;
    sum = Count{total};
  }
};

}  // namespace

BALLFLOW_PLUGIN("toy", "1", (ballflow::node_entries<Load, Step, Sum>()), (ballflow::type_entries<Count>()))
