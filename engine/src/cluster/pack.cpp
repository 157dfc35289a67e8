#include <algorithm>
#include <bit>
#include <map>
#include <utility>

#include "ballflow/units.hpp"

namespace ballflow {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

bool has_to_run(const NodePlan& plan) {
  return plan.verdict == NodePlan::Verdict::run || plan.verdict == NodePlan::Verdict::maybe;
}

/// Nodes that follow each other and that nobody else reads in between.
struct Chain {
  std::vector<std::size_t> nodes;
  std::size_t level = 0;
  std::uint64_t memory = 0;
  double seconds = 0;
  double time_factor = 1;
  bool unknown = false, alone = false;
};

std::vector<std::size_t> producers_of(const DagNode& node, const std::vector<std::size_t>& chain_of) {
  std::vector<std::size_t> producers;
  for (const auto& [port, edge] : node.inputs) {
    if (chain_of[edge.node] != none) producers.push_back(edge.node);
  }
  std::sort(producers.begin(), producers.end());
  producers.erase(std::unique(producers.begin(), producers.end()), producers.end());
  return producers;
}

/// A quarter more than the node says, rounded up: few classes, and room for outputs.
std::uint64_t memory_class(std::uint64_t estimate, double factor, const PackOptions& options) {
  const auto most = static_cast<double>(options.base + estimate + estimate / 4) * factor;
  return std::bit_ceil(static_cast<std::uint64_t>(most));
}

double usual_seconds(const DagNode& node, const PackOptions& options) {
  const auto usual = options.usual_seconds.find(node.kind.type());
  return usual == options.usual_seconds.end() ? options.unknown_seconds : usual->second;
}

}  // namespace

double UnitArray::longest() const {
  double most = 0;
  for (const PackedUnit& unit : units) most = std::max(most, unit.seconds);
  return most;
}

std::vector<UnitArray> pack(const Dag& dag, const std::vector<NodePlan>& plans, const PackOptions& options) {
  const std::size_t n = dag.nodes.size();
  std::vector<std::size_t> readers(n, 0), chain_of(n, none);
  for (std::size_t i = 0; i < n; ++i) {
    if (!has_to_run(plans[i])) continue;
    chain_of[i] = 0;  // any number marks a node that runs; its chain is found below
    for (const std::size_t producer : producers_of(dag.nodes[i], chain_of)) ++readers[producer];
  }
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < n; ++i) {
    if (chain_of[i] == none) continue;
    const std::vector<std::size_t> producers = producers_of(dag.nodes[i], chain_of);
    const double more = options.memory_factor.empty() ? 1 : options.memory_factor[i];
    const std::uint64_t memory = memory_class(plans[i].memory, more, options);
    std::size_t chain = chains.size();
    if (producers.size() == 1 && readers[producers[0]] == 1 &&
        chains[chain_of[producers[0]]].memory == memory) {
      chain = chain_of[producers[0]];
    } else {
      chains.emplace_back().memory = memory;
      for (const std::size_t producer : producers)
        chains[chain].level = std::max(chains[chain].level, chains[chain_of[producer]].level + 1);
    }
    chain_of[i] = chain;
    chains[chain].nodes.push_back(i);
    chains[chain].seconds += plans[i].seconds.value_or(usual_seconds(dag.nodes[i], options));
    if (!options.time_factor.empty())
      chains[chain].time_factor = std::max(chains[chain].time_factor, options.time_factor[i]);
    if (!options.alone.empty()) chains[chain].alone = chains[chain].alone || options.alone[i];
    chains[chain].unknown = chains[chain].unknown || !plans[i].seconds;
  }

  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<std::size_t>> classes;  // level, memory: chains
  for (std::size_t c = 0; c < chains.size(); ++c) classes[{chains[c].level, chains[c].memory}].push_back(c);
  std::vector<UnitArray> arrays;
  std::vector<std::pair<std::size_t, std::size_t>> place(chains.size());  // array and unit
  for (const auto& [key, members] : classes) {
    const std::size_t first_array = arrays.size();
    bool full = true;  // the last unit takes no more
    arrays.push_back({key.first, key.second, false, 1, {}, {}, false});
    for (const std::size_t c : members) {
      const std::vector<PackedUnit>& units = arrays.back().units;
      if (full || chains[c].alone || units.back().seconds >= options.unit_seconds ||
          units.back().seconds + chains[c].seconds > 2 * options.unit_seconds) {
        if (units.size() >= options.most_units)
          arrays.push_back({key.first, key.second, false, 1, {}, {}, false});
        arrays.back().units.emplace_back();
      }
      full = chains[c].alone;
      UnitArray& array = arrays.back();
      PackedUnit& unit = array.units.back();
      unit.nodes.insert(unit.nodes.end(), chains[c].nodes.begin(), chains[c].nodes.end());
      unit.seconds += chains[c].seconds;
      array.unknown = array.unknown || chains[c].unknown;
      array.time_factor = std::max(array.time_factor, chains[c].time_factor);
      place[c] = {arrays.size() - 1, array.units.size() - 1};
    }
    for (std::size_t a = first_array; a < arrays.size(); ++a) {
      for (PackedUnit& unit : arrays[a].units) std::sort(unit.nodes.begin(), unit.nodes.end());
    }
  }

  for (std::size_t a = 0; a < arrays.size(); ++a) {
    bool aligned = true;
    for (std::size_t u = 0; u < arrays[a].units.size(); ++u) {
      for (const std::size_t i : arrays[a].units[u].nodes) {
        for (const std::size_t producer : producers_of(dag.nodes[i], chain_of)) {
          const auto [array, unit] = place[chain_of[producer]];
          if (array == a) continue;
          arrays[a].needs.push_back(array);
          aligned = aligned && unit == u;
        }
      }
    }
    std::vector<std::size_t>& needs = arrays[a].needs;
    std::sort(needs.begin(), needs.end());
    needs.erase(std::unique(needs.begin(), needs.end()), needs.end());
    arrays[a].one_to_one =
        aligned && needs.size() == 1 && arrays[needs[0]].units.size() == arrays[a].units.size();
  }
  return arrays;
}

Unit make_unit(const Dag& dag, const std::vector<NodePlan>& plans, const std::vector<std::size_t>& nodes,
               const std::vector<std::string>& unit_of) {
  Unit unit;
  std::map<std::size_t, std::size_t> inside, outside;
  for (std::size_t k = 0; k < nodes.size(); ++k) inside[nodes[k]] = k;
  for (const std::size_t i : nodes) {
    DagNode node = dag.nodes[i];
    for (auto& [port, edge] : node.inputs) {
      if (const auto found = inside.find(edge.node); found != inside.end()) {
        edge.node = found->second;
        continue;
      }
      const auto [found, first] = outside.try_emplace(edge.node, unit.outside.size());
      if (first) {
        OutsideNode& other = unit.outside.emplace_back();
        other.path = dag.nodes[edge.node].path;
        if (const Given* given = dag.nodes[edge.node].kind.given()) {
          other.artifact = output_entry(given->outputs[0].name, *given->artifact);
        } else if (!unit_of[edge.node].empty()) {
          other.unit = unit_of[edge.node];
        } else {
          other.key = key_of(plans[edge.node].manifest);
        }
      }
      edge.node = nodes.size() + found->second;
    }
    unit.nodes.push_back(std::move(node));
  }
  return unit;
}

}  // namespace ballflow
