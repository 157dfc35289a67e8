// Nodes that do nothing, so that only the engine is measured.
#include <fstream>
#include <memory>
#include <vector>

#include "ballflow/sdk.hpp"

namespace {

/// The smallest shared array.
struct Values {
  using value_type = double;
  Values() = default;
  explicit Values(std::vector<double> values) {
    const auto kept = std::make_shared<std::vector<double>>(std::move(values));
    first = kept->data();
    count = kept->size();
    owner = kept;
  }
  Values(const double* data, std::size_t size, std::shared_ptr<const void> keeper)
      : first(data), count(size), owner(std::move(keeper)) {}
  const double* data() const { return first; }
  std::size_t size() const { return count; }
  const double* first = nullptr;
  std::size_t count = 0;
  std::shared_ptr<const void> owner;
};

struct Numbers {
  Values values;
};

}  // namespace

template <>
struct ballflow::TypeOf<Numbers> {
  static void declare(TypeDecl<Numbers>& d) {
    d.id("BenchNumbers", 1).doc("Numbers.");
    d.array("values", &Numbers::values).doc("any");
    d.summary("first", "the first number");
    d.summarize([](const Numbers& v) {
      return Summary{{"first", v.values.size() == 0 ? 0.0 : v.values.data()[0]}};
    });
  }
};

namespace {

using namespace ballflow;

struct Start {
  Out<Numbers> numbers;
  std::string file = "none";
  std::int64_t count = 1;
  static void declare(NodeDecl<Start>& d) {
    d.id("BenchStart", 1).summary("Makes numbers.");
    d.output("numbers", &Start::numbers).doc("0, 1, 2, ...");
    d.param("file", &Start::file).file().scheme("none").doc("is only part of the key");
    d.param("count", &Start::count).unit("numbers").at_least(0).doc("how many");
  }
  void run(RunContext&) {
    std::vector<double> values(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
    numbers = Numbers{Values(std::move(values))};
  }
};

/// Gives what it gets. `mark` tells the keys of a chain apart.
struct Pass {
  In<Numbers> in;
  Out<Numbers> out;
  std::int64_t mark = 0;
  static void declare(NodeDecl<Pass>& d) {
    d.id("BenchPass", 1).summary("Does nothing.");
    d.input("numbers", &Pass::in).doc("any");
    d.output("numbers", &Pass::out).doc("the same");
    d.param("mark", &Pass::mark).unit("1").at_least(0).doc("means nothing");
  }
  void run(RunContext&) { out = *in; }
};

struct Count {
  In<Numbers> in;
  Out<Numbers> out;
  static void declare(NodeDecl<Count>& d) {
    d.id("BenchCount", 1).summary("Adds one to the first number.");
    d.input("numbers", &Count::in).doc("at least one");
    d.output("numbers", &Count::out).doc("the first is one more");
  }
  void run(RunContext&) {
    std::vector<double> values(in->values.data(), in->values.data() + in->values.size());
    values.at(0) += 1;
    out = Numbers{Values(std::move(values))};
  }
};

}  // namespace

BALLFLOW_PLUGIN("bench", "1", (node_entries<Start, Pass, Count>()), type_entries<Numbers>())
