// Files that are made from the declarations of nodes and must never be stale. BALLFLOW_TEST_ACCEPT=1 rewrites
// them and skips.
#include <gtest/gtest.h>

#include <cstdlib>

#include "ballflow/schema.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

void expect_current(const std::string& path, const std::string& content) {
  const std::string file = test::source_file(path);
  const char* accept = std::getenv("BALLFLOW_TEST_ACCEPT");
  if (accept != nullptr && std::string(accept) == "1") {
    test::write_file(file, content);
    GTEST_SKIP() << "accepted into " << file;
  }
  EXPECT_TRUE(test::read_file(file) == content)
      << path << " is stale: run the test once with BALLFLOW_TEST_ACCEPT=1";
}

TEST(GeneratedFiles, node_pages_are_current) {
  const auto registry = Registry::load();
  expect_current("nodes/README.md",
                 nodes_markdown(*registry, find_examples(test::source_file("graphs"), *registry)));
}

TEST(GeneratedFiles, schema_of_nodes_is_current) {
  expect_current("schemas/nodes.schema.json", nodes_schema(*Registry::load()).dump(2) + "\n");
}

TEST(GeneratedFiles, schema_of_graphs_is_current) {
  expect_current("schemas/graph.schema.json", graph_schema(*Registry::load()).dump(2) + "\n");
}

}  // namespace
}  // namespace ballflow
