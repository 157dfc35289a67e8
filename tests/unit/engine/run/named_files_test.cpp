// Files that a file names: they are in the key like the file itself.
#include <gtest/gtest.h>

#include "ballflow/explain.hpp"
#include "ballflow/key.hpp"
#include "ballflow/run.hpp"
#include "run_fixture.hpp"

namespace ballflow {
namespace {

struct NamedFiles : RunTest {
  NamedFiles() {
    write("a/list", "x.txt\ny.txt\n");
    write("a/x.txt", "1");
    write("a/y.txt", "2");
  }
  ~NamedFiles() override { toy::before_reading = nullptr; }
  void write(const std::string& name, const std::string& text) { test::write_file(folder.file(name), text); }
  Dag total(const std::string& list, double scale = 1) {
    Dag dag;
    dag.file = "total.json";
    const auto total = node(dag, "total", "Total", {}, {{"file", folder.file(list)}, {"scale", scale}});
    dag.outputs.push_back({"total", "", {total, "numbers"}});
    return dag;
  }
  /// Status of the node and the sum.
  std::pair<NodeStatus, std::string> result(const Dag& dag, std::shared_ptr<Store> where) {
    const RunResult all = run(dag, std::move(where));
    const NodeResult& node = all.nodes[0];
    return {node.status, node.outputs.empty() ? node.cause : node.outputs[0].summary};
  }
  ActionKey key(const std::string& list, double scale = 1) {
    return action_key(total(list, scale).nodes[0], {}, 0, *store());
  }
};

TEST_F(NamedFiles, a_changed_file_is_no_hit) {
  const auto cache = store();
  const auto first = result(total("a/list"), cache);
  EXPECT_EQ(first.first, NodeStatus::run);
  EXPECT_EQ(result(total("a/list"), cache).first, NodeStatus::hit);
  write("a/y.txt", "5");
  const auto second = result(total("a/list"), cache);
  EXPECT_EQ(second.first, NodeStatus::run);
  EXPECT_NE(second.second, first.second);
  write("a/y.txt", "2");
  const auto third = result(total("a/list"), cache);
  EXPECT_EQ(third.first, NodeStatus::hit);
  EXPECT_EQ(third.second, first.second);
}

TEST_F(NamedFiles, contents_count_and_places_do_not) {
  write("b/list", "x.txt\ny.txt\n");
  write("b/x.txt", "1");
  write("b/y.txt", "2");
  EXPECT_EQ(key("a/list").key, key("b/list").key);
  write("b/y.txt", "3");  // the list is the same, what it names is not
  EXPECT_NE(key("a/list").key, key("b/list").key);
  EXPECT_EQ(key_of(key("b/list").manifest), key("b/list").key);
}

TEST_F(NamedFiles, a_file_that_appears_is_no_hit_and_its_absence_none) {
  write("c/list", "x.txt\nlater.txt\n");
  write("c/x.txt", "1");
  const auto cache = store();
  const auto missing = result(total("c/list"), cache);
  EXPECT_EQ(missing.first, NodeStatus::failed);
  EXPECT_NE(missing.second.find("later.txt"), std::string::npos);
  EXPECT_NE(key("c/list").manifest.find("\"later.txt\":null"), std::string::npos);
  write("c/later.txt", "9");
  EXPECT_EQ(result(total("c/list"), cache).first, NodeStatus::run);
}

TEST_F(NamedFiles, parameters_say_which_files_are_read) {
  const Digest before = key("a/list", 0).key;
  write("a/y.txt", "8");
  EXPECT_EQ(key("a/list", 0).key, before);
  EXPECT_TRUE(files_named_by(total("a/list", 0).nodes[0]).empty());
  ASSERT_EQ(files_named_by(total("a/list").nodes[0]).size(), 2U);
  EXPECT_EQ(files_named_by(total("a/list").nodes[0])[1].path, folder.file("a/y.txt"));
}

TEST_F(NamedFiles, what_cannot_be_listed_is_left_to_the_node) {
  write("d/list", "throw\n");
  EXPECT_TRUE(files_named_by(total("d/list").nodes[0]).empty());
  EXPECT_EQ(result(total("d/list"), store()).first, NodeStatus::failed);
}

TEST_F(NamedFiles, a_file_that_changes_while_it_is_read_fails_the_node) {
  toy::before_reading = [this](const std::string&) { write("a/x.txt", "7.5"); };
  const auto failed = result(total("a/list"), store());
  EXPECT_EQ(failed.first, NodeStatus::failed);
  EXPECT_NE(failed.second.find("or a file that it names, changed while"), std::string::npos) << failed.second;
}

TEST_F(NamedFiles, explain_names_the_file) {
  const std::string before = key("a/list").manifest;
  write("a/y.txt", "8");
  EXPECT_EQ(manifest_differences(before, key("a/list").manifest),
            std::vector<std::string>{"file y.txt: other content"});
}

TEST_F(NamedFiles, a_loop_has_those_of_its_body) {
  const auto body = std::make_shared<Loop>();
  body->body = total("a/list");
  DagNode loop{"loop", std::shared_ptr<const Loop>(body)};
  for (const ParamDecl& param : loop_params()) loop.params[param.name] = param.default_value;
  loop.params["until"] = "x.y == 0";
  EXPECT_EQ(files_named_by(loop).size(), 2U);
  const Digest before = action_key(loop, {}, 0, *store()).key;
  write("a/x.txt", "4");
  EXPECT_NE(action_key(loop, {}, 0, *store()).key, before);
}

}  // namespace
}  // namespace ballflow
