#include <algorithm>

#include "ballflow/run.hpp"
#include "run/forecast.hpp"

namespace ballflow {

std::string_view to_string(NodePlan::Verdict verdict) {
  switch (verdict) {
    case NodePlan::Verdict::hit:
      return "HIT";
    case NodePlan::Verdict::run:
      return "RUN";
    case NodePlan::Verdict::maybe:
      return "MAYBE";
    case NodePlan::Verdict::unneeded:
      return "-";
  }
  return "";
}

namespace {

/// Fills in seconds and memory, from what is known or guessed about the sizes of the inputs.
void guess(const Dag& dag, std::vector<NodePlan>& plans,
           const std::vector<std::optional<ActionEntry>>& entries, Store& store, std::uint64_t seed) {
  Past past(store);
  std::vector<std::map<std::string, std::uint64_t>> bytes(dag.nodes.size());  // of outputs, by port
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const DagNode& node = dag.nodes[i];
    NodePlan& plan = plans[i];
    if (plan.verdict == NodePlan::Verdict::unneeded) continue;
    std::uint64_t input_bytes = 0;
    bool known = true;
    for (const auto& [port, edge] : node.inputs) {
      const auto size = bytes[edge.node].find(edge.port);
      known = known && size != bytes[edge.node].end();
      if (size != bytes[edge.node].end()) input_bytes += size->second;
    }
    plan.memory = node.kind.memory().for_inputs_of(input_bytes);
    if (entries[i]) {
      for (const OutputEntry& output : entries[i]->outputs) bytes[i][output.port] = output.bytes;
      plan.seconds = entries[i]->seconds;
      plan.seconds_from = "when it last ran";
      continue;
    }
    auto guess = past.guess(action_key(node, {}, seed, store).manifest, known ? input_bytes : 0);
    if (!guess) continue;
    plan.seconds = guess->seconds;
    plan.seconds_from = std::move(guess->from);
    bytes[i] = std::move(guess->bytes);
  }
}

}  // namespace

std::vector<NodePlan> plan(const Dag& dag, Store& store, std::uint64_t seed, const Manifests& earlier) {
  using Verdict = NodePlan::Verdict;
  const std::size_t n = dag.nodes.size();
  const std::vector<bool> needed = needed_nodes(dag);
  std::vector<NodePlan> plans(n);
  std::vector<std::optional<ActionEntry>> entries(n);

  for (std::size_t i = 0; i < n; ++i) {
    const DagNode& node = dag.nodes[i];
    NodePlan& plan = plans[i];
    if (!needed[i]) {
      plan.verdict = Verdict::unneeded;
      plan.reason = "no output of the graph needs it";
      continue;
    }
    if (const Given* given = node.kind.given()) {
      plan.verdict = Verdict::hit;
      plan.reason = "given";
      entries[i].emplace().outputs.push_back(output_entry(given->outputs[0].name, *given->artifact));
      continue;
    }
    std::map<std::string, OutputEntry> inputs;
    std::string unknown;
    for (const auto& [port, edge] : node.inputs) {
      if (!entries[edge.node]) {
        if (unknown.empty()) unknown = dag.nodes[edge.node].path;
        continue;
      }
      for (const OutputEntry& output : entries[edge.node]->outputs) {
        if (output.port == edge.port) inputs[port] = output;
      }
    }
    const ActionKey key = action_key(node, inputs, seed, store);
    plan.manifest = key.manifest;
    if (!unknown.empty()) {
      plan.verdict = Verdict::maybe;
      plan.reason = "waits for " + unknown + "; a hit if that gives the same content as before";
      continue;
    }
    entries[i] = find_entry(store, node.kind, key.key);
    if (entries[i]) {
      plan.verdict = Verdict::hit;
      plan.reason = "same inputs and parameters";
      continue;
    }
    plan.verdict = Verdict::run;
    const auto before = earlier.find(node.path);
    if (before == earlier.end()) {
      plan.reason = "never ran here";
      continue;
    }
    const std::vector<std::string> differences = manifest_differences(before->second, key.manifest);
    if (differences.empty()) plan.reason = "its entry is no longer in the cache";
    for (const std::string& difference : differences) {
      plan.reason += (plan.reason.empty() ? "" : "; ") + difference;
    }
  }

  // A hit whose artifact is not stored runs after all when something that runs needs it.
  std::vector<std::vector<std::pair<std::size_t, std::string>>> consumers(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (const auto& [port, edge] : dag.nodes[i].inputs) consumers[edge.node].emplace_back(i, edge.port);
  }
  for (std::size_t i = n; i-- > 0;) {
    if (plans[i].verdict != Verdict::hit || dag.nodes[i].kind.given() != nullptr) continue;
    for (const auto& [consumer, port] : consumers[i]) {
      if (plans[consumer].verdict != Verdict::run) continue;
      const auto output = std::find_if(entries[i]->outputs.begin(), entries[i]->outputs.end(),
                                       [&port = port](const OutputEntry& o) { return o.port == port; });
      if (output == entries[i]->outputs.end() || store.has_blob(*output)) continue;
      plans[i].verdict = Verdict::run;
      plans[i].reason = dag.nodes[consumer].path + " needs its " + port + ", which is not stored";
      break;
    }
  }
  guess(dag, plans, entries, store, seed);
  return plans;
}

}  // namespace ballflow
