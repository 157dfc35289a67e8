#include "terminal/event_lines.hpp"

#include <cstdio>

#include "ballflow/report.hpp"

namespace ballflow::cli {
namespace {

class Lines final : public EventSink {
 public:
  explicit Lines(const Dag& dag) : dag_(dag) {}

  void on(const Event& event) override {
    Json line = {{"time", event.time}, {"event", to_string(event.kind)}};
    const bool of_node = event.kind != Event::Kind::run_started && event.kind != Event::Kind::run_finished;
    if (of_node) line["node"] = dag_.nodes[event.node].path;
    switch (event.kind) {
      case Event::Kind::run_started:
        line["graph"] = dag_.file;
        line["nodes"] = dag_.nodes.size();
        break;
      case Event::Kind::node_waiting:
        line["for"] = event.text;
        break;
      case Event::Kind::node_started:
        line["type"] = dag_.nodes[event.node].kind.type();
        line["memory"] = event.memory;
        break;
      case Event::Kind::node_progress:
        line["fraction"] = event.fraction;
        break;
      case Event::Kind::node_message:
        line["level"] = event.warning ? "warning" : "info";
        line["text"] = event.text;
        break;
      case Event::Kind::cache_read:
      case Event::Kind::cache_write:
        line["artifact"] = event.text;
        line["bytes"] = event.bytes;
        line["seconds"] = event.seconds;
        break;
      case Event::Kind::node_finished:
        line.update(node_report(dag_.nodes[event.node], *event.result));
        break;
      case Event::Kind::run_finished:
        break;
    }
    print_line(line);
  }

 private:
  const Dag& dag_;
};

}  // namespace

std::unique_ptr<EventSink> event_lines(const Dag& dag) { return std::make_unique<Lines>(dag); }

void print_line(const Json& json) {
  // Foreign text (warnings of nodes, names of files) need not be UTF-8.
  const std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);  // who reads a pipe wants it now
}

}  // namespace ballflow::cli
