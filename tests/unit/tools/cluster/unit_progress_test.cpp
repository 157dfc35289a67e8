// What a running unit says of itself.
#include "cluster/unit_progress.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <utility>

#include "test_data.hpp"

namespace ballflow {
namespace {

class Counting final : public EventSink {
 public:
  void on(const Event&) override { ++events; }
  int events = 0;
};

struct UnitProgressTest : testing::Test {
  UnitProgressTest() {
    decl.id = "Toy";
    for (const char* path : {"outside", "one", "two"}) dag.nodes.push_back({path, NodeKind(decl)});
    result.status = NodeStatus::run;
    result.manifest = R"({"node":"Toy"})";
    std::filesystem::create_directory(folder.file("status"));
  }
  void finish(UnitProgress& progress, std::size_t node, NodeStatus status) {
    result.status = status;
    Event event{Event::Kind::node_finished, node};
    event.result = &result;
    progress.on(event);
  }

  NodeDeclaration decl;
  Dag dag;
  NodeResult result;
  Counting display;
  test::TempFolder folder;
};

TEST_F(UnitProgressTest, nodes_of_the_unit_are_told_while_others_still_run) {
  std::promise<std::vector<NodeState>> first, second;
  int told = 0;
  UnitProgress progress(
      display, dag, 1,
      [&](const std::vector<NodeState>& nodes) { (told++ == 0 ? first : second).set_value(nodes); },
      std::chrono::milliseconds(1));
  finish(progress, 0, NodeStatus::hit);
  finish(progress, 1, NodeStatus::run);
  const std::vector<NodeState> one = first.get_future().get();
  ASSERT_EQ(one.size(), 1u) << "what is not of the unit does not count";
  EXPECT_EQ(one[0].path, "one");
  EXPECT_EQ(one[0].type, "Toy");
  EXPECT_EQ(one[0].status, "run");
  EXPECT_EQ(one[0].key, key_of(result.manifest));
  result.cause = "no";
  finish(progress, 2, NodeStatus::failed);
  const std::vector<NodeState> both = second.get_future().get();
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].status, "failed");
  EXPECT_EQ(both[1].cause, "no");
  EXPECT_FALSE(both[1].key);
  EXPECT_EQ(display.events, 3);
}

TEST_F(UnitProgressTest, a_short_unit_says_nothing_and_what_cannot_be_said_harms_nothing) {
  int told = 0;
  {
    UnitProgress progress(display, dag, 0, [&](const std::vector<NodeState>&) { ++told; });
    finish(progress, 1, NodeStatus::run);
  }
  EXPECT_EQ(told, 0);
  std::promise<void> tried;
  bool once = false;
  UnitProgress progress(
      display, dag, 0,
      [&](const std::vector<NodeState>&) {
        if (!std::exchange(once, true)) tried.set_value();
        throw Error(ExitCode::store, "the disk is full");
      },
      std::chrono::milliseconds(1));
  finish(progress, 1, NodeStatus::run);
  tried.get_future().get();
  finish(progress, 2, NodeStatus::run);
  EXPECT_EQ(display.events, 3);
}

TEST_F(UnitProgressTest, what_an_ended_job_says_counts_before_what_its_copy_says_that_runs) {
  UnitStatus status;
  status.of = 3;
  status.nodes.push_back({"one", "Toy", "run", std::nullopt, {}, {}, 0});
  EXPECT_FALSE(read_progress(folder.path(), "0-0"));
  write_progress(folder.path(), "0-0", status);
  ASSERT_TRUE(read_progress(folder.path(), "0-0"));
  EXPECT_EQ(read_progress(folder.path(), "0-0")->of, 3u);
  EXPECT_EQ(read_progress(folder.path(), "0-0")->nodes.size(), 1u);
  EXPECT_FALSE(read_status(folder.path(), "0-0")) << "it has not ended";
  status.out_of_time = true;
  write_status(folder.path(), "0-0", status);
  EXPECT_TRUE(read_status(folder.path(), "0-0")->out_of_time);
  write_progress(folder.path(), "0-0", {});
  EXPECT_FALSE(read_progress(folder.path(), "0-0"));
  EXPECT_TRUE(read_status(folder.path(), "0-0"));
}

}  // namespace
}  // namespace ballflow
