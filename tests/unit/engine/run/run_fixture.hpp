// A store in a fresh folder, the toy nodes, and a listener that remembers what it heard.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ballflow/run.hpp"
#include "run_nodes.hpp"
#include "test_data.hpp"

namespace ballflow {

class Silent final : public EventSink {
 public:
  void on(const Event& event) override {
    times.push_back(event.time);
    if (event.kind == Event::Kind::node_finished) finished.insert(event.node);
    if (event.kind == Event::Kind::node_waiting) waiting.insert(event.node);
    if (event.kind == Event::Kind::cache_read) read.insert(event.text);
    if (event.kind == Event::Kind::cache_write) written.insert(event.text);
    if (event.kind == Event::Kind::node_started) started.push_back(event.node);
    if (event.kind == Event::Kind::node_message) messages.push_back(event.text);
    if (event.kind == Event::Kind::node_progress) fractions.push_back(event.fraction);
    if (event.kind == Event::Kind::node_started && on_start) on_start();
  }
  std::vector<std::size_t> started;
  std::vector<std::string> messages;
  std::vector<double> fractions;
  std::vector<double> times;
  std::set<std::size_t> finished, waiting;
  std::set<std::string> read, written;  // artifacts
  std::function<void()> on_start;
};

struct RunTest : testing::Test {
  RunTest() {
    registry.add_plugin(toy::plugin(), "toy");
    toy::reset();
  }

  std::size_t node(Dag& dag, const std::string& path, const std::string& type,
                   const std::map<std::string, EdgeRef>& inputs = {},
                   const std::map<std::string, Json>& params = {}) {
    DagNode n{path, *registry.node(type)};
    for (const ParamDecl& param : n.kind.params()) n.params[param.name] = param.default_value;
    for (const auto& [name, value] : params) n.params[name] = value;
    n.inputs = inputs;
    dag.nodes.push_back(std::move(n));
    return dag.nodes.size() - 1;
  }

  /// source -> round -> add(round, other) ; the graph's output is the sum.
  Dag diamond(double value, double other_value) {
    Dag dag;
    dag.file = "diamond.json";
    const auto source = node(dag, "source", "Source", {}, {{"value", value}});
    const auto other = node(dag, "other", "Source", {}, {{"value", other_value}});
    const auto round = node(dag, "round", "Round", {{"numbers", {source, "numbers"}}});
    const auto sum = node(dag, "sum", "Add", {{"a", {round, "rounded"}}, {"b", {other, "numbers"}}});
    dag.outputs.push_back({"sum", "", {sum, "sum"}});
    return dag;
  }

  std::shared_ptr<Store> store() { return Store::open({folder.path() + "/cache", false}); }

  RunResult run(const Dag& dag, std::shared_ptr<Store> where, unsigned threads = 2, Manifests earlier = {}) {
    RunOptions options;
    options.threads = threads;
    Runner runner(dag, registry, std::move(where), options, events, std::move(earlier));
    return runner.run();
  }

  static std::vector<NodeStatus> statuses(const RunResult& result) {
    std::vector<NodeStatus> out;
    for (const NodeResult& n : result.nodes) out.push_back(n.status);
    return out;
  }

  Registry registry;
  test::TempFolder folder;
  Silent events;
};

constexpr auto hit = NodeStatus::hit;
constexpr auto ran = NodeStatus::run;

}  // namespace ballflow
