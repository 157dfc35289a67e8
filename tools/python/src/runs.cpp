#include "runs.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/report.hpp"

namespace ballflow::python {
namespace {

/// How long a signal may wait.
constexpr std::chrono::milliseconds between_looks{50};

/// An event without what dies with the call.
struct Told {
  Event::Kind kind;
  std::size_t node;
  double fraction, time;
  bool warning;
  std::string text;
  NodeStatus status;
  double seconds;
  std::string cause;
};

/// Keeps events until the thread that has asked for the run takes them.
class Queue final : public EventSink {
 public:
  explicit Queue(bool wanted) : wanted_(wanted) {}

  void on(const Event& event) override {
    if (!wanted_ || event.kind == Event::Kind::cache_read || event.kind == Event::Kind::cache_write) return;
    Told told{
        event.kind, event.node, event.fraction, event.time, event.warning, event.text, NodeStatus::pending,
        0,          {}};
    if (event.result != nullptr) {
      told.status = event.result->status;
      told.seconds = event.result->seconds;
      told.cause = event.result->cause;
    }
    const std::lock_guard lock(mutex_);
    // Of progress the newest counts: a node may tell it thousands of times a second.
    if (told.kind == Event::Kind::node_progress && !events_.empty() && events_.back().kind == told.kind &&
        events_.back().node == told.node) {
      events_.back() = std::move(told);
      return;
    }
    events_.push_back(std::move(told));
    if (told.kind != Event::Kind::node_progress) changed_.notify_one();
  }

  void finish() {
    const std::lock_guard lock(mutex_);
    finished_ = true;
    changed_.notify_one();
  }

  /// Waits a little for something to happen. True when the run has ended and everything was taken.
  bool take(std::vector<Told>& events) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, between_looks, [this] { return finished_ || !events_.empty(); });
    events = std::exchange(events_, {});
    return finished_ && events.empty();
  }

 private:
  const bool wanted_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Told> events_;
  bool finished_ = false;
};

py::dict dict_of(const Told& told, const Dag& dag) {
  py::dict event;
  event["event"] = std::string(to_string(told.kind));
  event["time"] = told.time;
  if (told.kind == Event::Kind::run_started || told.kind == Event::Kind::run_finished) return event;
  event["node"] = dag.nodes[told.node].path;
  event["type"] = dag.nodes[told.node].kind.type();
  if (told.kind == Event::Kind::node_progress) event["fraction"] = told.fraction;
  if (told.kind == Event::Kind::node_message) event["warning"] = told.warning;
  if (!told.text.empty()) event["text"] = told.text;
  if (told.kind == Event::Kind::node_finished) {
    event["status"] = std::string(to_string(told.status));
    event["seconds"] = told.seconds;
    if (!told.cause.empty()) event["cause"] = told.cause;
  }
  return event;
}

std::uint64_t limit_of(Store& store, const std::string& given) {
  const char* const variable = std::getenv("BALLFLOW_CACHE_SIZE");
  const std::string size = !given.empty() ? given : variable != nullptr ? variable : "";
  if (size.empty()) return default_limit(store);
  if (const auto limit = parse_size(size)) return *limit;
  throw Error(ExitCode::usage, "cache_size: \"" + size + "\" is not a size",
              "write it as \"5G\", \"800M\", \"1.5T\", a number of bytes, or \"none\"");
}

RunOptions options_of(const RunSettings& settings, const Dag& dag) {
  RunOptions options;
  options.threads = settings.threads;
  options.seed = settings.seed;
  options.keep_going = settings.keep_going || !dag.variants.empty();
  options.strict = settings.strict;
  if (!settings.memory.empty()) {
    const auto bytes = parse_memory(settings.memory);
    if (!bytes) {
      throw Error(ExitCode::usage, "memory: \"" + settings.memory + "\" is not a size",
                  "write it as \"8G\", \"800M\", a number of bytes, or \"50%\"");
    }
    options.memory_bytes = *bytes;
  }
  for (const std::string& name : settings.until) options.until.merge(nodes_named(dag, name));
  for (const std::string& name : settings.only) options.only.merge(nodes_named(dag, name));
  for (const std::string& name : settings.force) options.force.merge(nodes_named(dag, name));
  return options;
}

}  // namespace

FinishedRun::FinishedRun(std::shared_ptr<const Plan> plan, std::shared_ptr<Store> store,
                         const RunSettings& settings, const std::string& collect_above,
                         const std::string& command, const py::object& progress)
    : plan_(std::move(plan)), store_(std::move(store)), id_(new_run_id(plan_->dag.file)) {
  const Dag& dag = plan_->dag;
  RunOptions options = options_of(settings, dag);
  const std::uint64_t limit = limit_of(*store_, collect_above);
  options.cancel = &cancel_;
  const bool wanted = !progress.is_none();
  auto queue = std::make_unique<Queue>(wanted);
  Queue& events = *queue;
  sink_ = std::move(queue);
  std::exception_ptr failure;  // of the engine, or raised by Python

  {
    py::gil_scoped_release release;
    const Manifests earlier = latest_manifests(*store_, dag.file);
    runner_ = std::make_unique<Runner>(dag, *plan_->registry, store_, std::move(options), events, earlier);
    std::exception_ptr thrown;
    const RunResult* ended = nullptr;
    std::thread worker([&] {
      try {
        ended = &runner_->run();
      } catch (...) {
        thrown = std::current_exception();
      }
      events.finish();
    });
    std::vector<Told> told;
    while (!events.take(told)) {
      const py::gil_scoped_acquire gil;
      if (failure != nullptr) continue;
      try {
        for (const Told& one : told) {
          if (progress(dict_of(one, dag)).is(py::bool_(false))) cancel_ = true;
        }
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      } catch (...) {
        failure = std::current_exception();
        cancel_ = true;
      }
    }
    worker.join();
    if (thrown != nullptr) std::rethrow_exception(thrown);
    const RunResult& result = *ended;
    Json report = run_report(id_, dag, result);
    report["version"] = BALLFLOW_VERSION;
    if (!command.empty()) report["command"] = command;
    report_ = report.dump(-1, ' ', false, Json::error_handler_t::replace);
    recorded_ = save_run(*store_, id_, manifests_of(dag, result), report);
    keep_within(*store_, limit);
    for (std::size_t i = 0; i < dag.nodes.size(); ++i) by_path_.emplace(dag.nodes[i].path, i);
  }
  if (failure != nullptr) std::rethrow_exception(failure);
}

FinishedRun::~FinishedRun() {
  const py::gil_scoped_release release;  // artifacts of Python's own take it when they go
  runner_.reset();
}

ArtifactPtr FinishedRun::artifact(const std::string& path, const std::string& port) {
  const auto found = by_path_.find(path);
  if (found == by_path_.end()) throw Error(ExitCode::usage, "the run has no node \"" + path + "\"");
  const py::gil_scoped_release release;
  return runner_->artifact({found->second, port});
}

}  // namespace ballflow::python
