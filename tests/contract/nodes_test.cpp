// What every registered node owes its users, whoever wrote it.
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>

#include "ballflow/registry.hpp"
#include "ballflow/run.hpp"
#include "ballflow/schema.hpp"
#include "quick_graphs.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

std::vector<std::string> graph_files() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(test::source_file("graphs"))) {
    if (entry.path().extension() == ".json") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Another valid value of a parameter, or null when there is only one.
Json another_value(const ParamDecl& param) {
  std::vector<Json> candidates;
  switch (param.kind) {
    case ParamKind::boolean:
      candidates = {!param.default_value.get<bool>()};
      break;
    case ParamKind::integer:
      for (const int step : {1, -1, 2, 10})
        candidates.push_back(param.default_value.get<std::int64_t>() + step);
      break;
    case ParamKind::number:
      for (const double step : {0.125, -0.125, 1.0, 0.001})
        candidates.push_back(param.default_value.get<double>() + step);
      break;
    case ParamKind::choice:
      for (const auto& [value, doc] : param.choices) candidates.push_back(value);
      break;
    case ParamKind::list:  // no node has one of these
    case ParamKind::files:
    case ParamKind::artifact:
      break;
    case ParamKind::string:
      candidates = {param.required ? Json("other") : Json(param.default_value.get<std::string>() + "x")};
      break;
    case ParamKind::file:
      for (const std::string& scheme : param.schemes) candidates.push_back(scheme + "other");
      break;
  }
  for (const Json& candidate : candidates) {
    if (param.refuse(candidate).empty() && candidate != param.default_value) return candidate;
  }
  return nullptr;
}

DagNode with_defaults(const NodeDeclaration& decl) {
  DagNode node{"node", decl};
  for (const ParamDecl& param : decl.params) {
    node.params[param.name] = param.required && param.kind == ParamKind::file && !param.schemes.empty()
                                  ? Json(param.schemes.front() + "sphere")
                                  : param.default_value;
  }
  return node;
}

class EveryNode : public testing::TestWithParam<std::string> {
 protected:
  const NodeDeclaration& node() const { return *registry().node(GetParam()); }
};

std::vector<std::string> node_ids() {
  std::vector<std::string> ids;
  for (const auto& [id, node] : registry().nodes()) ids.push_back(id);
  return ids;
}

TEST(Registry, loads_the_nodes_of_the_thesis) {
  const std::set<std::string> expected = {
      "Sample",  "Shape",  "VoronoiPoles", "LabelPoles",  "Enlarge",    "CoverMatrix", "Reduce",
      "IPSolve", "Greedy", "SelectBalls",  "VerifyCover", "AlphaShape", "MedialAxis"};
  for (const std::string& id : expected) EXPECT_NE(registry().node(id), nullptr) << id;
  for (const PluginCandidate& candidate : registry().candidates())
    EXPECT_EQ(candidate.refused, "") << candidate.path;
}

TEST_P(EveryNode, has_an_id_without_a_dot_because_namespaces_belong_to_others) {
  EXPECT_EQ(GetParam().find('.'), std::string::npos);
}

TEST_P(EveryNode, is_documented) {
  EXPECT_GT(node().summary.size(), 10u);
  EXPECT_GT(node().doc.size(), 40u) << "say what it accepts and refuses";
  EXPECT_GT(node().avoid_when.size(), 10u) << "say when not to use it";
  EXPECT_GE(node().version, 1);
  for (const PortDecl& port : node().inputs) EXPECT_FALSE(port.doc.empty()) << port.name;
  for (const PortDecl& port : node().outputs) EXPECT_FALSE(port.doc.empty()) << port.name;
}

TEST_P(EveryNode, documents_every_parameter_with_unit_and_range) {
  for (const ParamDecl& param : node().params) {
    EXPECT_FALSE(param.doc.empty()) << param.name;
    if (param.kind == ParamKind::number || param.kind == ParamKind::integer) {
      EXPECT_FALSE(param.unit.empty()) << param.name << " has no unit (\"1\" for a pure number)";
      EXPECT_TRUE(param.minimum || param.maximum || param.exclusive_minimum || param.exclusive_maximum)
          << param.name << " has no range";
    }
    for (const auto& [value, doc] : param.choices) EXPECT_FALSE(doc.empty()) << param.name << " " << value;
    if (!param.required) {
      EXPECT_EQ(param.refuse(param.default_value), "") << param.name;
    }
  }
}

TEST_P(EveryNode, cites_sources_that_the_bibliography_has) {
  const std::string bibliography = test::read_file(test::source_file("nodes/refs.bib"));
  EXPECT_FALSE(node().cites.empty());
  for (const Citation& citation : node().cites) {
    EXPECT_NE(bibliography.find("{" + citation.key + ","), std::string::npos) << citation.key;
    EXPECT_FALSE(citation.where.empty()) << citation.key;
  }
}

TEST_P(EveryNode, is_used_by_a_graph) {
  static const std::set<std::string> used = [] {
    const std::regex use("\"type\"\\s*:\\s*\"([^\"]*)\"");
    std::set<std::string> types;
    for (const std::string& file : graph_files()) {
      const std::string text = test::read_file(file);
      for (std::sregex_iterator it(text.begin(), text.end(), use), end; it != end; ++it)
        types.insert((*it)[1]);
    }
    return types;
  }();
  EXPECT_TRUE(used.contains(GetParam()));
}

TEST_P(EveryNode, has_an_example_that_the_schemas_and_the_tests_of_graphs_know) {
  static const auto examples = find_examples(test::source_file("graphs"), registry());
  ASSERT_EQ(examples.count(GetParam()), 1u);
  const NodeExample& example = examples.at(GetParam());
  EXPECT_EQ(example.entry.front().at("type"), GetParam());
}

TEST_P(EveryNode, has_types_that_are_registered_with_the_same_version) {
  for (const auto* ports : {&node().inputs, &node().outputs}) {
    for (const PortDecl& port : *ports) {
      const TypeDeclaration* type = registry().type(port.type);
      ASSERT_NE(type, nullptr) << port.type;
      EXPECT_EQ(type->version, port.type_version) << port.type;
    }
  }
}

TEST_P(EveryNode, has_a_key_that_every_hashed_parameter_changes) {
  const auto store = Store::open({});
  const DagNode node_with_defaults = with_defaults(node());
  for (const ParamDecl& param : node().params) {
    if (!param.hashed) continue;
    DagNode changed = node_with_defaults;
    changed.params[param.name] = another_value(param);
    if (changed.params[param.name].is_null()) continue;
    EXPECT_NE(action_key(changed, {}, 0, *store).key, action_key(node_with_defaults, {}, 0, *store).key)
        << param.name;
  }
}

TEST_P(EveryNode, refuses_parameters_outside_their_range) {
  for (const ParamDecl& param : node().params) {
    if (param.minimum) {
      EXPECT_NE(param.refuse(*param.minimum - 1), "") << param.name;
    }
    if (param.exclusive_minimum) {
      EXPECT_NE(param.refuse(*param.exclusive_minimum), "") << param.name;
    }
    if (param.maximum) {
      EXPECT_NE(param.refuse(*param.maximum + 1), "") << param.name;
    }
    EXPECT_NE(param.refuse(Json::array()), "") << param.name;
    EXPECT_NE(param.refuse(nullptr), "") << param.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Nodes, EveryNode, testing::ValuesIn(node_ids()),
                         [](const auto& instance) { return instance.param; });

/// What the pages of the nodes say can be typed runs, with a small model in place of the usual one.
TEST(Examples, run) {
  std::map<std::string, std::vector<Setting>> commands;
  for (const auto& [id, example] : find_examples(test::source_file("graphs"), registry())) {
    std::string name = example.graph;
    for (const Setting& set : example.settings) name += " " + set.name + "=" + set.value;
    const std::string file = test::source_file("graphs/" + example.graph);
    std::vector<Setting> settings = quick_settings(std::filesystem::path(example.graph).stem());
    settings.insert(settings.end(), example.settings.begin(), example.settings.end());
    if (!commands.emplace(name, settings).second) continue;
    const Dag dag = load_graph(file, registry(), settings);
    Silent events;
    RunOptions options;
    options.threads = 1;
    Runner runner(dag, registry(), results_with(1), options, events);
    EXPECT_EQ(runner.run().status, ExitCode::ok) << name;
  }
  EXPECT_GE(commands.size(), 3u);
}

TEST(EveryType, is_documented) {
  for (const auto& [id, type] : registry().types()) {
    EXPECT_FALSE(type.doc.empty()) << id;
    EXPECT_FALSE(type.summary.empty()) << id;
    for (const ArrayDecl& array : type.arrays) EXPECT_FALSE(array.doc.empty()) << id << "." << array.name;
    for (const auto& [field, doc] : type.summary) EXPECT_FALSE(doc.empty()) << id << "." << field;
  }
}

}  // namespace
}  // namespace ballflow
