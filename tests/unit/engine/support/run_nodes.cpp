#include "run_nodes.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <memory>
#include <thread>

#include "ballflow/sdk.hpp"
#include "list.hpp"

namespace toy {

struct Numbers {
  List<double> values;
};

void wait_while_holding() {
  for (int tries = 0; holding && tries < 60'000; ++tries)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

}  // namespace toy

template <>
struct ballflow::TypeOf<toy::Numbers> {
  static void declare(TypeDecl<toy::Numbers>& d) {
    d.id("Numbers", 1).doc("A list of numbers.");
    d.array("values", &toy::Numbers::values).length("n").doc("the numbers");
    d.summary("count", "how many").summary("first", "the first number, null when there is none");
    d.summarize([](const toy::Numbers& v) {
      return Summary{{"count", v.values.size()},
                     {"first", v.values.size() == 0 ? SummaryValue() : SummaryValue(v.values.data()[0])}};
    });
    d.check([](const toy::Numbers& v) {
      for (std::size_t i = 0; i < v.values.size(); ++i) {
        if (v.values.data()[i] < 0) return "number " + std::to_string(i) + " is negative";
      }
      return std::string();
    });
  }
};

namespace toy {

using namespace ballflow;

struct Source {
  Out<Numbers> numbers;
  double value = 1;
  std::int64_t count = 3;
  static void declare(NodeDecl<Source>& d) {
    d.id("Source", 1).summary("Equal numbers.");
    d.output("numbers", &Source::numbers).doc("the numbers");
    d.param("value", &Source::value).doc("the number");
    d.param("count", &Source::count).at_least(0).doc("how many");
  }
  void run(RunContext&) {
    ++counters.source;
    numbers = Numbers{std::vector<double>(static_cast<std::size_t>(count), value)};
  }
};

struct Add {
  In<Numbers> a, b;
  Out<Numbers> sum;
  static void declare(NodeDecl<Add>& d) {
    d.id("Add", 1).summary("Sums element by element.");
    d.input("a", &Add::a).doc("first");
    d.input("b", &Add::b).optional().doc("second, or nothing");
    d.output("sum", &Add::sum).doc("the sums");
  }
  void run(RunContext& context) {
    ++counters.add;
    std::vector<double> v(a->values.data(), a->values.data() + a->values.size());
    if (b) {
      for (std::size_t i = 0; i < v.size(); ++i) v[i] += b->values.data()[i];
    } else {
      context.warn("nothing to add");
    }
    sum = Numbers{std::move(v)};
  }
};

struct Round {
  In<Numbers> numbers;
  Out<Numbers> rounded;
  static void declare(NodeDecl<Round>& d) {
    d.id("Round", 1).summary("Rounds down.");
    d.input("numbers", &Round::numbers).doc("any");
    d.output("rounded", &Round::rounded).doc("whole numbers");
  }
  void run(RunContext&) {
    ++counters.round;
    std::vector<double> v(numbers->values.data(), numbers->values.data() + numbers->values.size());
    for (double& x : v) x = std::floor(x);
    rounded = Numbers{std::move(v)};
  }
};

struct Slow {
  In<Numbers> numbers;
  Out<Numbers> same;
  double seconds = 30;
  static void declare(NodeDecl<Slow>& d) {
    d.id("Slow", 1).summary("Waits.");
    d.input("numbers", &Slow::numbers).doc("any");
    d.output("numbers", &Slow::same).doc("the same");
    d.param("seconds", &Slow::seconds).unit("s").at_least(0).doc("how long");
  }
  void run(RunContext& context) {
    ++counters.slow;
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    while (std::chrono::steady_clock::now() < end) {
      context.check_cancelled();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    wait_while_holding();
    same = *numbers;
  }
};

struct Fail {
  In<Numbers> numbers;
  Out<Numbers> nothing;
  static void declare(NodeDecl<Fail>& d) {
    d.id("Fail", 1).summary("Fails.");
    d.input("numbers", &Fail::numbers).doc("any");
    d.output("numbers", &Fail::nothing).doc("never");
  }
  void run(RunContext&) {
    ++counters.fail;
    throw NodeError("number 7 is odd", "use even numbers");
  }
};

/// One more, with a warning of its own each time.
struct Step {
  In<Numbers> numbers;
  Out<Numbers> next;
  double by = 1;
  double fail_at = -1;
  static void declare(NodeDecl<Step>& d) {
    d.id("Step", 1).summary("Counts.");
    d.input("numbers", &Step::numbers).doc("any");
    d.output("numbers", &Step::next).doc("all of them greater");
    d.param("by", &Step::by).doc("how much greater");
    d.param("fail_at", &Step::fail_at).doc("fails where the first number is this");
  }
  void run(RunContext& context) {
    granted = context.memory_bytes();
    std::vector<double> v(numbers->values.data(), numbers->values.data() + numbers->values.size());
    if (!v.empty() && v[0] == fail_at) throw NodeError("cannot count on", "start at another number");
    for (double& x : v) x += by;
    if (!v.empty()) context.warn("reached " + std::to_string(static_cast<int>(v[0])));
    next = Numbers{std::move(v)};
  }
};

/// Breaks the promise of determinism: another result at every execution.
struct Noisy {
  Out<Numbers> numbers;
  static void declare(NodeDecl<Noisy>& d) {
    d.id("Noisy", 1).summary("Counts its executions.");
    d.output("numbers", &Noisy::numbers).doc("the count");
  }
  void run(RunContext&) {
    const int count = steady_noise ? counters.noisy.load() : ++counters.noisy;
    numbers = Numbers{std::vector<double>{static_cast<double>(count)}};
  }
};

/// Breaks it in the usual way: the result depends on the number of threads.
struct Threads {
  Out<Numbers> numbers;
  static void declare(NodeDecl<Threads>& d) {
    d.id("Threads", 1).summary("Counts the threads it may use.");
    d.output("numbers", &Threads::numbers).doc("the count");
  }
  void run(RunContext&) {
    const auto threads = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    numbers = Numbers{std::vector<double>{static_cast<double>(threads)}};
  }
};

/// Keeps several threads busy, and says for how long by their own clocks.
struct Busy {
  Out<Numbers> numbers;
  static void declare(NodeDecl<Busy>& d) {
    d.id("Busy", 1).summary("Takes 40 ms of CPU time, in four parts.");
    d.output("numbers", &Busy::numbers).doc("4 x seconds");
  }
  void run(RunContext&) {
    const auto now = [] {
      timespec t{};
      clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
      return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
    };
    std::vector<double> seconds(4);
    tbb::parallel_for(std::size_t{0}, seconds.size(), [&](std::size_t i) {
      const double start = now();
      while ((seconds[i] = now() - start) < 0.01) {
      }
    });
    numbers = Numbers{std::move(seconds)};
  }
};

/// Hands over what its type forbids.
struct Negative {
  Out<Numbers> numbers;
  static void declare(NodeDecl<Negative>& d) {
    d.id("Negative", 1).summary("Breaks an invariant.");
    d.output("numbers", &Negative::numbers).doc("a negative number");
  }
  void run(RunContext&) { numbers = Numbers{std::vector<double>{1, -1}}; }
};

struct Heavy {
  Out<Numbers> numbers;
  double value = 1;
  static void declare(NodeDecl<Heavy>& d) {
    d.id("Heavy", 1).summary("Says that it needs 60 bytes.");
    d.memory(60, 0);
    d.output("numbers", &Heavy::numbers).doc("a number");
    d.param("value", &Heavy::value).doc("the number");
  }
  void run(RunContext& context) {
    granted = context.memory_bytes();
    ++counters.heavy;
    const int now = ++counters.heavy_now;
    int most = counters.heavy_most;
    while (most < now && !counters.heavy_most.compare_exchange_weak(most, now)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    wait_while_holding();
    --counters.heavy_now;
    numbers = Numbers{std::vector<double>{value}};
  }
};

/// Gives the number in a file; the file is written to before it is read when `before_reading` is set.
struct FromFile {
  Out<Numbers> numbers;
  std::string file;
  static void declare(NodeDecl<FromFile>& d) {
    d.id("FromFile", 1).summary("Reads a number.");
    d.output("numbers", &FromFile::numbers).doc("the number");
    d.param("file", &FromFile::file).file().doc("a file with a number");
  }
  void run(RunContext&) {
    if (before_reading) before_reading(file);
    double value = 0;
    std::ifstream(file) >> value;
    numbers = Numbers{std::vector<double>{value}};
  }
};

/// The sum of the numbers in the files that a file names, one a line, relative to it.
struct Total {
  Out<Numbers> numbers;
  std::string file;
  double scale = 1;
  static void declare(NodeDecl<Total>& d) {
    d.id("Total", 1).summary("Adds up numbers in files.");
    d.reads_named_files<&Total::named>();
    d.output("numbers", &Total::numbers).doc("the sum");
    d.param("file", &Total::file).file().doc("a file with names of files");
    d.param("scale", &Total::scale).doc("factor; no file is read when it is 0");
  }
  std::vector<NamedFile> named() const {
    std::vector<NamedFile> files;
    std::ifstream list(file);
    for (std::string name; scale != 0 && std::getline(list, name);) {
      if (name == "throw") throw std::runtime_error("on purpose");
      const std::string path = file.substr(0, file.rfind('/') + 1) + name;
      files.push_back({name, std::ifstream(path) ? path : ""});
    }
    return files;
  }
  void run(RunContext&) {
    if (before_reading) before_reading(file);
    double sum = 0;
    for (const NamedFile& one : named()) {
      if (one.path.empty()) throw NodeError("there is no file " + one.name, "put it there");
      double value = 0;
      std::ifstream(one.path) >> value;
      sum += scale * value;
    }
    numbers = Numbers{std::vector<double>{sum}};
  }
};

/// Says nonsense: a progress that is no number, a warning that is no text.
struct Babble {
  Out<Numbers> numbers;
  static void declare(NodeDecl<Babble>& d) {
    d.id("Babble", 1).summary("Reports nonsense.");
    d.output("numbers", &Babble::numbers).doc("a number");
  }
  void run(RunContext& context) {
    context.progress(std::numeric_limits<double>::quiet_NaN());
    context.warn("caf\xe9 \033[2J");
    numbers = Numbers{std::vector<double>{1}};
  }
};

/// Puts lists one behind the other.
struct Concat {
  InList<Numbers> lists;
  In<Numbers> last;
  Out<Numbers> all;
  static void declare(NodeDecl<Concat>& d) {
    d.id("Concat", 1).summary("Puts lists one behind the other.");
    d.input("lists", &Concat::lists).doc("in this order");
    d.input("last", &Concat::last).optional().doc("behind them");
    d.output("all", &Concat::all).doc("all numbers");
  }
  void run(RunContext&) {
    std::vector<double> v;
    for (const Numbers& list : lists)
      v.insert(v.end(), list.values.data(), list.values.data() + list.values.size());
    if (last) v.insert(v.end(), last->values.data(), last->values.data() + last->values.size());
    all = Numbers{std::move(v)};
  }
};

const bf_plugin& plugin() {
  static const bf_plugin* const plugin = detail::keep_plugin(
      "toy", "1",
      [] {
        return node_entries<Source, Add, Round, Slow, Fail, Step, Noisy, Threads, Busy, Negative, Heavy,
                            FromFile, Babble, Concat, Total>();
      },
      [] { return type_entries<Numbers>(); });
  return *plugin;
}

}  // namespace toy
