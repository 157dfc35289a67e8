// Damaged graph texts never crash or hang, and every finding about them is fit to be shown. Deterministic.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "ballflow/graph.hpp"
#include "test_data.hpp"
#include "toy_nodes.hpp"

namespace ballflow {
namespace {

const char* const valid = R"({
  // comment
  "doc": "A graph with everything, ä.",
  "params": { "input": { "kind": "file", "default": "m.off", "doc": "model" },
              "epsilon": { "kind": "number", "default": 0.3, "minimum": 0, "maximum": 1e2, "unit": "%" },
              "how": { "kind": "choice", "default": "fast", "choices": ["fast", { "value": "exact", "doc": "slow" }] } },
  "sweep": { "axes": { "epsilon": [0.1, 2], "grow.closed": [true, false] }, "mode": "product",
             "exclude": [{ "epsilon": 2, "grow.closed": true }] },
  "map": { "input": ["a.off", "b.off"] },
  "nodes": {
    "load":  { "type": "Load", "params": { "file": "x-${input}", "mode": "${how}", "scale": 2.5 } },
    "grow":  { "type": "Grow", "inputs": { "points": "load.points", "extra": "sub.same" }, "params": { "epsilon": "${epsilon}", "closed": true } },
    "match": { "type": "Match", "inputs": { "balls": "grow.balls", "points": "load.points" } }, /* c */
    "sub":   { "graph": "sub.json", "inputs": { "cover": "match.cover", "points": "load.points" }, "params": { "keep": 1 } }
  },
  "outputs": { "cover": { "from": "sub.cover", "doc": "result" }, "rest": "match.rest" }
})";

const char* const subgraph = R"({ "params": { "keep": { "kind": "number" } },
  "inputs": { "cover": { "type": "Cover" }, "points": { "type": "Points", "optional": false } },
  "nodes": { "trim": { "type": "Trim", "inputs": { "cover": "inputs.cover" }, "params": { "keep": "${keep}" } } },
  "outputs": { "cover": "trim.cover", "same": "inputs.points" } })";

class graph_fuzz : public testing::Test {
 protected:
  graph_fuzz() : registry_(test::toy_registry()) {
    test::write_file(folder_.file("sub.json"), subgraph);
    test::write_file(folder_.file("pass.json"), "[]");
  }

  /// Parses; returns whether the text was accepted.
  bool survives(const std::string& text) {
    try {
      parse_graph(text, folder_.file("g.json"), registry_, {{"grow.steps", "4"}});
      return true;
    } catch (const GraphError& error) {
      const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
      std::set<std::string> seen;
      EXPECT_FALSE(error.findings().empty());
      for (const Diagnostic& finding : error.findings()) {
        EXPECT_FALSE(finding.message.empty());
        EXPECT_TRUE(seen.insert(finding.text()).second) << "twice: " << finding.text();
        if (finding.file == folder_.file("g.json")) {
          EXPECT_GE(finding.line, 1);
          EXPECT_LE(finding.line, lines);
          EXPECT_GE(finding.column, 1);
        }
      }
      for (const char c : std::string(error.what()))
        EXPECT_TRUE(c == '\n' || static_cast<unsigned char>(c) >= 32) << error.what();
      return false;
    }
  }

  test::TempFolder folder_;
  Registry registry_;
};

TEST_F(graph_fuzz, the_undamaged_text_is_accepted) { EXPECT_TRUE(survives(valid)); }

TEST_F(graph_fuzz, every_prefix) {
  const std::string text = valid;
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_FALSE(survives(text.substr(0, length))) << length;
}

TEST_F(graph_fuzz, bytes_are_changed_inserted_and_removed) {
  std::mt19937 random(20100101);
  int accepted = 0;
  for (int round = 0; round < 4000; ++round) {
    std::string text = valid;
    for (unsigned k = 0, n = 1 + random() % 4; k < n && !text.empty(); ++k) {
      const std::size_t at = random() % text.size();
      constexpr std::string_view likely = "{}[]\",:/*$.0-e\\u\n\t ${}x";
      const char byte = random() % 2 == 0 ? likely[random() % likely.size()] : static_cast<char>(random());
      switch (random() % 4) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(at, 1, byte);
          break;
        case 2:
          text.erase(at, 1 + random() % 20);
          break;
        default:
          text.insert(random() % text.size(), text.substr(at, random() % 40));
          break;
      }
    }
    accepted += survives(text) ? 1 : 0;
  }
  EXPECT_GT(accepted, 20) << "some mutations only touch texts and comments";
  EXPECT_LT(accepted, 3000);
}

/// Replaces a random value inside `json`.
void replace_somewhere(Json& json, std::mt19937& random) {
  Json* at = &json;
  while (at->is_structured() && !at->empty() && random() % 5 != 0) {
    auto item = at->begin();
    std::advance(item, random() % at->size());
    at = &*item;
  }
  const std::vector<Json> values = {nullptr,
                                    true,
                                    -1,
                                    1e300,
                                    3.5,
                                    "",
                                    "x",
                                    "load.points",
                                    "sub.cover",
                                    "sub.same",
                                    "inputs.x",
                                    "${epsilon}",
                                    "${nothing}",
                                    "Grow",
                                    "Match",
                                    "sub.json",
                                    "g.json",
                                    "pass.json",
                                    "${input}.json",
                                    Json::array(),
                                    Json::object(),
                                    Json::array({1, "a"}),
                                    Json{{"type", "Load"}},
                                    Json{{"graph", "sub.json"}},
                                    Json{{"kind", "choice"}},
                                    "number",
                                    "choice"};
  *at = values[random() % values.size()];
}

TEST_F(graph_fuzz, values_are_replaced_by_others) {
  std::mt19937 random(42);
  const Json original = Json::parse(valid, nullptr, true, true);
  int refused = 0;
  for (int round = 0; round < 4000; ++round) {
    Json json = original;
    for (unsigned k = 0, n = 1 + random() % 3; k < n; ++k) replace_somewhere(json, random);
    refused += survives(json.dump(round % 3 - 1)) ? 0 : 1;
  }
  EXPECT_GT(refused, 3000);
  EXPECT_LT(refused, 4000);
}

}  // namespace
}  // namespace ballflow
