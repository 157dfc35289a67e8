// Order and cycles of directed graphs, and what a node of a DAG needs.
#include "document/order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "ballflow/graph.hpp"

namespace ballflow {
namespace {

/// The order by its definition: of all nodes whose producers are in it already, the smallest is next.
std::vector<std::uint32_t> order_by_definition(std::size_t n, const DigraphEdges& edges) {
  std::vector<std::uint32_t> order;
  std::vector<bool> done(n, false);
  for (bool found = true; found;) {
    found = false;
    for (std::uint32_t node = 0; node < n && !found; ++node) {
      const auto waits = [&](const auto& edge) { return edge.second == node && !done[edge.first]; };
      if (done[node] || std::any_of(edges.begin(), edges.end(), waits)) continue;
      done[node] = found = true;
      order.push_back(node);
    }
  }
  return order;
}

DigraphEdges random_edges(std::mt19937& random, std::uint32_t n, std::size_t count, bool acyclic) {
  std::vector<std::uint32_t> place(n);
  for (std::uint32_t i = 0; i < n; ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  DigraphEdges edges;
  while (edges.size() < count) {
    std::uint32_t a = random() % n, b = random() % n;
    if (acyclic && a == b) continue;
    if (acyclic && place[a] > place[b]) std::swap(a, b);
    edges.emplace_back(a, b);
  }
  return edges;
}

TEST(topological_order, is_the_smallest_of_a_dag) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const std::uint32_t n = 2 + random() % 12;
    const DigraphEdges edges = random_edges(random, n, random() % 20, true);
    const TopologicalOrder order = topological_order(digraph(n, edges));
    EXPECT_EQ(order.nodes, order_by_definition(n, edges));
    EXPECT_EQ(order.nodes.size(), n);
    EXPECT_TRUE(order.cycles.empty());
  }
}

TEST(topological_order, cycles_are_real_disjoint_and_all_that_there_are) {
  std::mt19937 random(2);
  std::size_t several = 0;
  for (int round = 0; round < 1000; ++round) {
    const std::uint32_t n = 1 + random() % 12;
    const DigraphEdges edges = random_edges(random, n, random() % 24, false);
    const TopologicalOrder order = topological_order(digraph(n, edges));
    EXPECT_EQ(order.nodes, order_by_definition(n, edges));
    EXPECT_EQ(order.cycles.empty(), order.nodes.size() == n);
    std::set<std::uint32_t> on_cycles;
    for (const auto& cycle : order.cycles) {
      EXPECT_EQ(*std::min_element(cycle.begin(), cycle.end()), cycle[0]);
      for (std::size_t i = 0; i < cycle.size(); ++i) {
        EXPECT_TRUE(on_cycles.insert(cycle[i]).second) << "on two cycles";
        const std::pair step{cycle[i], cycle[(i + 1) % cycle.size()]};
        EXPECT_NE(std::find(edges.begin(), edges.end(), step), edges.end()) << "no edge";
      }
    }
    several += order.cycles.size() > 1 ? 1 : 0;
    DigraphEdges rest;
    for (const auto& edge : edges) {
      if (!on_cycles.contains(edge.first) && !on_cycles.contains(edge.second)) rest.push_back(edge);
    }
    EXPECT_EQ(order_by_definition(n, rest).size(), n) << "a cycle was not found";
  }
  EXPECT_GT(several, 20u) << "the instances are too easy";
}

// The way 0, 1, 2, 3 closes at 0, but touches the cycle 1, 2 that was found; 4 is reached when 3 is done, so
// that 0, 4, 3 is found only when the search begins again without 1 and 2.
TEST(topological_order, a_cycle_behind_one_that_was_found_is_found_too) {
  const TopologicalOrder order =
      topological_order(digraph(5, {{0, 1}, {1, 2}, {2, 1}, {2, 3}, {3, 0}, {0, 4}, {4, 3}}));
  EXPECT_EQ(order.cycles, (std::vector<std::vector<std::uint32_t>>{{1, 2}, {0, 4, 3}}));
  EXPECT_TRUE(order.nodes.empty());
}

TEST(topological_order, a_million_nodes_in_a_ring_take_no_stack) {
  constexpr std::uint32_t n = 1'000'000;
  DigraphEdges ring;
  for (std::uint32_t i = 0; i < n; ++i) ring.emplace_back(i, (i + 1) % n);
  const TopologicalOrder order = topological_order(digraph(n, ring));
  ASSERT_EQ(order.cycles.size(), 1u);
  EXPECT_EQ(order.cycles[0].size(), n);
  ring.pop_back();
  EXPECT_EQ(topological_order(digraph(n, ring)).nodes.size(), n);
}

TEST(topological_order, many_cycles_are_not_all_looked_for) {
  DigraphEdges pairs;
  for (std::uint32_t i = 0; i < 2000; i += 2) {
    pairs.emplace_back(i, i + 1);
    pairs.emplace_back(i + 1, i);
  }
  EXPECT_EQ(topological_order(digraph(2000, pairs)).cycles.size(), 1000u) << "one search finds them all";
}

TEST(needed_nodes, are_the_targets_and_all_that_they_reach_against_the_edges) {
  const NodeDeclaration decl;
  std::mt19937 random(3);
  for (int round = 0; round < 200; ++round) {
    Dag dag;
    const std::size_t n = 1 + random() % 15;
    for (std::size_t i = 0; i < n; ++i) {
      dag.nodes.push_back({"n" + std::to_string(i), decl});
      for (const char* port : {"a", "b", "c"}) {
        if (i > 0 && random() % 3 == 0) dag.nodes[i].inputs[port] = {random() % i, "out"};
      }
      if (random() % 5 == 0) dag.nodes[i].inputs["outside"] = {loop_input, "x"};
    }
    std::set<std::size_t> targets;
    for (std::size_t i = random() % 3; i > 0; --i) targets.insert(random() % n);
    std::vector<bool> expected(n, false);
    const auto visit = [&](const auto& self, std::size_t node) -> void {
      expected[node] = true;
      for (const auto& [port, edge] : dag.nodes[node].inputs) {
        if (edge.node != loop_input) self(self, edge.node);
      }
    };
    for (const std::size_t target : targets) visit(visit, target);
    EXPECT_EQ(needed_nodes(dag, targets), expected);
    for (const std::size_t target : targets) dag.outputs.push_back({"o", "", {target, "out"}});
    dag.outputs.push_back({"passed", "", {loop_input, "x"}});
    EXPECT_EQ(needed_nodes(dag), expected);
  }
}

}  // namespace
}  // namespace ballflow
