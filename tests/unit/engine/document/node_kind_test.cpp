// The kinds of nodes, and what they have in common.
#include <gtest/gtest.h>

#include <memory>

#include "ballflow/graph.hpp"

namespace ballflow {
namespace {

PortDecl port(const std::string& name, const std::string& type) {
  PortDecl decl;
  decl.name = name;
  decl.type = type;
  decl.type_version = 3;
  return decl;
}

TEST(node_kind, of_a_library_says_what_its_declaration_says) {
  NodeDeclaration decl;
  decl.id = "Enlarge";
  decl.version = 4;
  decl.libraries = {{"CGAL", "5.5"}};
  decl.uses_seed = true;
  decl.memory_fixed = 100;
  decl.memory_per_input_byte = 2.5;
  decl.inputs = {port("balls", "Balls"), port("points", "PointSet")};
  decl.outputs = {port("enlarged", "Balls")};
  decl.params.emplace_back().name = "epsilon";
  const NodeKind kind = decl;
  EXPECT_EQ(kind.declared(), &decl);
  EXPECT_EQ(kind.loop(), nullptr);
  EXPECT_EQ(kind.given(), nullptr);
  EXPECT_EQ(kind.type(), "Enlarge");
  EXPECT_EQ(kind.version(), 4);
  EXPECT_EQ(kind.libraries(), decl.libraries);
  EXPECT_EQ(kind.inputs(), decl.inputs);
  EXPECT_EQ(kind.output("enlarged"), kind.outputs().data());
  EXPECT_EQ(kind.output("balls"), nullptr);
  EXPECT_EQ(kind.params().size(), 1u);
  EXPECT_TRUE(kind.uses_seed());
  EXPECT_EQ(kind.memory().for_inputs_of(11), 127u) << "100 + 27.5, whole bytes";
}

TEST(node_kind, loop_has_the_ports_of_its_body_and_parameters_of_its_own) {
  const auto loop = std::make_shared<Loop>();
  loop->inputs = {port("cover", "CoverState"), port("balls", "Balls")};
  loop->outputs = {port("cover", "CoverState")};
  loop->memory = {7, 1};
  const NodeKind kind = std::shared_ptr<const Loop>(loop);
  EXPECT_EQ(kind.loop(), loop.get());
  EXPECT_EQ(kind.declared(), nullptr);
  EXPECT_EQ(kind.type(), "loop");
  EXPECT_EQ(kind.version(), 0);
  EXPECT_TRUE(kind.libraries().empty());
  EXPECT_EQ(kind.inputs(), loop->inputs);
  EXPECT_EQ(kind.outputs(), loop->outputs);
  EXPECT_EQ(kind.params(), loop_params());
  EXPECT_FALSE(kind.uses_seed());
  loop->uses_seed = true;
  EXPECT_TRUE(kind.uses_seed());
  EXPECT_EQ(kind.memory().for_inputs_of(5), 12u);
}

TEST(node_kind, artifact_from_outside_has_an_output_and_nothing_else) {
  const NodeKind kind = Given{{port("balls", "Balls")}, nullptr};
  ASSERT_NE(kind.given(), nullptr);
  EXPECT_EQ(kind.declared(), nullptr);
  EXPECT_EQ(kind.loop(), nullptr);
  EXPECT_EQ(kind.type(), "artifact");
  EXPECT_EQ(kind.output("balls")->type_version, 3);
  EXPECT_TRUE(kind.inputs().empty());
  EXPECT_TRUE(kind.params().empty());
  EXPECT_EQ(kind.memory().for_inputs_of(1000), 0u);
}

}  // namespace
}  // namespace ballflow
