#include <cmath>
#include <map>

#include "terminal/event_lines.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

class ChromeTrace final : public Trace {
 public:
  explicit ChromeTrace(const Dag& dag) : dag_(dag) {}

  void on(const Event& event) override {
    switch (event.kind) {
      case Event::Kind::node_waiting:
        end_wait(event);  // for memory, and now for a key
        waiting_[event.node] = {event.time, event.text};
        break;
      case Event::Kind::node_started:
        close(event, "", nullptr);  // a lost artifact is made again, or all nodes run again
        end_wait(event);
        running_[event.node] = {event.time, free_lane()};
        count(event);
        break;
      case Event::Kind::node_message:
        instant(event);
        break;
      case Event::Kind::cache_read:
        slice("read " + event.text, "cache", lane_of(event.node), event.time - event.seconds, event.time,
              {{"bytes", event.bytes}});
        break;
      case Event::Kind::cache_write:
        slice("write " + event.text, "cache", lane_of(event.node), event.time - event.seconds, event.time,
              {{"bytes", event.bytes}});
        break;
      case Event::Kind::node_finished:
        end_wait(event);
        close(event, to_string(event.result->status), event.result);
        count(event);
        break;
      case Event::Kind::run_started:
      case Event::Kind::run_finished:
      case Event::Kind::node_progress:
        break;
    }
  }

  std::string text() const override {
    Json events = Json::array();
    events.push_back(named("process_name", 0, "ballflow run " + dag_.file));
    for (const auto& [lane, name] : lanes_) events.push_back(named("thread_name", lane, name));
    for (const Json& event : events_) events.push_back(event);
    return Json({{"displayTimeUnit", "ms"}, {"traceEvents", std::move(events)}})
               .dump(-1, ' ', false, Json::error_handler_t::replace) +
           "\n";
  }

 private:
  static constexpr int store_lane = 1000, first_wait_lane = 2000;
  struct Slice {
    double start = 0;
    int lane = 0;
  };
  struct Wait {
    double start = 0;
    std::string what;
  };

  static double microseconds(double seconds) { return std::round(seconds * 1e9) / 1e3; }
  static Json named(const char* what, int lane, const std::string& name) {
    return {{"name", what}, {"ph", "M"}, {"pid", 1}, {"tid", lane}, {"args", {{"name", name}}}};
  }

  /// The lowest lane that no open slice is on.
  int free_lane() {
    int lane = 1;
    const auto taken = [&] {
      for (const auto& [node, open] : running_) {
        if (open.lane == lane) return true;
      }
      return false;
    };
    while (taken()) ++lane;
    lanes_.emplace(lane, "lane " + std::to_string(lane));
    return lane;
  }

  int lane_of(std::size_t node) {
    if (const auto found = running_.find(node); found != running_.end()) return found->second.lane;
    lanes_.emplace(store_lane, "cache");
    return store_lane;
  }

  void slice(const std::string& name, const char* category, int lane, double start, double end, Json args) {
    events_.push_back({{"name", name},
                       {"cat", category},
                       {"ph", "X"},
                       {"ts", microseconds(start)},
                       {"dur", microseconds(end) - microseconds(start)},
                       {"pid", 1},
                       {"tid", lane},
                       {"args", std::move(args)}});
  }

  void close(const Event& event, std::string_view status, const NodeResult* result) {
    const auto found = running_.find(event.node);
    if (found == running_.end()) return;
    const DagNode& node = dag_.nodes[event.node];
    Json args = {{"type", node.kind.type()}, {"status", status}};
    if (result != nullptr) {
      args["why"] = result->reason;
      args["cpu_seconds"] = result->cpu_seconds;
      for (const OutputEntry& output : result->outputs)
        args["output " + output.port] = output.digest.hex().substr(0, 16);
    }
    slice(node.path, "node", found->second.lane, found->second.start, event.time, std::move(args));
    running_.erase(found);
  }

  void end_wait(const Event& event) {
    const auto found = waiting_.find(event.node);
    if (found == waiting_.end()) return;
    const int lane = first_wait_lane + static_cast<int>(event.node);  // waits of one node follow each other
    lanes_.emplace(lane, "waits: " + dag_.nodes[event.node].path);
    slice("waits for " + found->second.what, "wait", lane, found->second.start, event.time, Json::object());
    waiting_.erase(found);
  }

  void instant(const Event& event) {
    events_.push_back({{"name", event.text},
                       {"cat", event.warning ? "warning" : "info"},
                       {"ph", "i"},
                       {"s", "t"},
                       {"ts", microseconds(event.time)},
                       {"pid", 1},
                       {"tid", lane_of(event.node)}});
  }

  void count(const Event& event) {
    events_.push_back({{"name", "memory"},
                       {"ph", "C"},
                       {"ts", microseconds(event.time)},
                       {"pid", 1},
                       {"args", {{"estimated", event.memory}, {"resident", resident_bytes()}}}});
  }

  const Dag& dag_;
  std::map<std::size_t, Slice> running_;
  std::map<std::size_t, Wait> waiting_;
  std::map<int, std::string> lanes_;
  std::vector<Json> events_;
};

}  // namespace

std::unique_ptr<Trace> trace(const Dag& dag) { return std::make_unique<ChromeTrace>(dag); }

}  // namespace ballflow::cli
