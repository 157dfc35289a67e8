#include "ballflow/history.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <regex>
#include <set>
#include <thread>

#include "ballflow/gc.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/report.hpp"
#include "child_process.hpp"
#include "faulty_file_system.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct HistoryTest : testing::Test {
  HistoryTest() {
    decl.id = "Probe";
    dag.nodes.push_back({"part/probe", decl});
    result.nodes.resize(1);
    result.seconds = 1.5;
    result.nodes[0].status = NodeStatus::run;
    result.nodes[0].manifest = R"({"node":"Probe"})";
  }

  std::shared_ptr<Store> open(bool read_only = false) { return Store::open({root, read_only}, files); }

  Json report_of(const std::string& id, const std::string& graph) {
    dag.file = graph;
    return run_report(id, dag, result);
  }

  bool save(Store& store, const std::string& id, const std::string& graph) {
    return save_run(store, id, manifests_of(dag, result), report_of(id, graph));
  }

  /// An id as it is made at second `second` of some day.
  static std::string id_at(const std::string& graph, int second) {
    char time[32];
    std::snprintf(time, sizeof time, "20261122T%02d%02d%02d.000", second / 3600, second / 60 % 60,
                  second % 60);
    return time + new_run_id(graph).substr(19);
  }

  static std::string hint_of(const std::function<void()>& action) {
    try {
      action();
    } catch (const Error& error) {
      return std::string(error.what()) + " | " + error.hint();
    }
    return "nothing was thrown";
  }

  test::TempFolder folder;
  std::string root = folder.file("cache");
  std::shared_ptr<test::FaultyFileSystem> files = std::make_shared<test::FaultyFileSystem>();
  NodeDeclaration decl;
  Dag dag;
  RunResult result;
};

TEST_F(HistoryTest, a_run_is_found_by_id_prefix_and_age) {
  const auto store = open();
  const std::string first = id_at("a.json", 1), second = id_at("b.json", 2), third = id_at("a.json", 3);
  EXPECT_TRUE(save(*store, first, "a.json"));
  EXPECT_TRUE(save(*store, second, "b.json"));
  EXPECT_TRUE(save(*store, third, "a.json"));
  EXPECT_EQ(find_run(*store, "latest").id, third);
  EXPECT_EQ(find_run(*store, "previous").id, second);
  EXPECT_EQ(find_run(*store, "latest", "b.json").id, second);
  EXPECT_EQ(find_run(*store, "previous", "a.json").id, first);
  EXPECT_EQ(find_run(*store, second).id, second);
  EXPECT_EQ(find_run(*store, "20261122T000002").id, second);
  EXPECT_EQ(find_run(*store, second).report.at("graph"), "b.json");
  EXPECT_EQ(run_manifests(*store, third).at("part/probe"), result.nodes[0].manifest);
}

TEST_F(HistoryTest, the_list_is_newest_first_and_says_what_happened) {
  const auto store = open();
  save(*store, id_at("a.json", 1), "a.json");
  result.status = ExitCode::node_failed;
  save(*store, id_at("b.json", 2), "b.json");
  const std::vector<RunInfo> runs = list_runs(*store);
  ASSERT_EQ(runs.size(), 2u);
  EXPECT_EQ(runs[0].graph, "b.json");
  EXPECT_EQ(runs[0].status, "failed");
  EXPECT_EQ(runs[0].seconds, 1.5);
  EXPECT_EQ(runs[1].status, "ok");
  EXPECT_EQ(list_runs(*store, 1).size(), 1u);
}

TEST_F(HistoryTest, one_graph_has_one_latest_run_however_its_path_is_written) {
  const auto store = open();
  const std::string path = folder.file("g.json");
  save(*store, new_run_id(path), path);
  EXPECT_FALSE(latest_manifests(*store, folder.path() + "/./x/../g.json").empty());
  EXPECT_TRUE(latest_manifests(*store, folder.file("h.json")).empty());
}

TEST_F(HistoryTest, ids_sort_by_time_and_give_it) {
  const std::string id = new_run_id("a.json");
  EXPECT_TRUE(std::regex_match(id, std::regex("[0-9]{8}T[0-9]{6}\\.[0-9]{3}-[0-9a-f]{8}-[0-9a-f]{4}"))) << id;
  EXPECT_EQ(start_of_run("20261122T141503.482-1f9b03c2-7e1d"), "2026-11-22T14:15:03.482Z");
  EXPECT_EQ(start_of_run("20261122T141503-4711"), "");
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_LT(id, new_run_id("a.json"));
}

TEST_F(HistoryTest, a_report_file_and_its_folder_are_runs_too) {
  const auto store = open();
  const std::string id = id_at("a.json", 1);
  write_atomically(folder.file("report.json"), report_of(id, "a.json").dump());
  EXPECT_EQ(find_run(*store, folder.file("report.json")).id, id);
  EXPECT_EQ(find_run(*store, folder.path()).id, id);
  EXPECT_EQ(find_run(*Store::open({}), folder.path()).id, id) << "without a cache";
  test::write_file(folder.file("other.json"), R"({"nodes": {}})");
  test::write_file(folder.file("broken.json"), R"({"run": "a", "gra)");
  for (const char* name : {"other.json", "broken.json"}) {
    EXPECT_NE(hint_of([&] { find_run(*store, folder.file(name)); }).find("is no run report"),
              std::string::npos);
  }
}

TEST_F(HistoryTest, an_unknown_run_names_the_nearest) {
  const auto store = open();
  EXPECT_NE(hint_of([&] { find_run(*store, "latest"); }).find("there is no latest run in the history of"),
            std::string::npos);
  const std::string first = id_at("a.json", 1), second = id_at("a.json", 2);
  save(*store, first, "a.json");
  EXPECT_NE(hint_of([&] { find_run(*store, "previous"); }).find("no previous run"), std::string::npos);
  EXPECT_NE(hint_of([&] { find_run(*store, "latest", "c.json"); }).find("no latest run of c.json"),
            std::string::npos);
  save(*store, second, "a.json");
  std::string misspelt = first;
  misspelt[17] = '9';
  EXPECT_NE(hint_of([&] { find_run(*store, misspelt); }).find("did you mean \"" + first + "\"?"),
            std::string::npos)
      << hint_of([&] { find_run(*store, misspelt); });
  EXPECT_NE(hint_of([&] { find_run(*store, "lates"); }).find("did you mean \"latest\"?"), std::string::npos);
  EXPECT_NE(hint_of([&] { find_run(*store, "2026"); }).find("is the beginning of 2 runs"), std::string::npos);
  EXPECT_NE(hint_of([&] { find_run(*store, "results"); }).find(second), std::string::npos)
      << "the newest are named";
}

TEST_F(HistoryTest, what_was_not_recorded_as_a_whole_does_not_count) {
  const auto store = open();
  const std::string good = id_at("a.json", 1), killed = id_at("a.json", 2), damaged = id_at("a.json", 3);
  save(*store, good, "a.json");
  store->put_run(killed, {{"manifests.json", "{}"}});
  store->put_run(damaged, {{"report.json", R"({"run": ")"}});
  fs::create_directory(root + "/runs/latest-0123");  // of an older version
  EXPECT_EQ(find_run(*store, "latest").id, good);
  EXPECT_EQ(list_runs(*store).size(), 1u);
  EXPECT_FALSE(latest_manifests(*store, "a.json").empty());
}

TEST_F(HistoryTest, a_store_that_cannot_be_written_records_nothing) {
  open();
  const auto reading = open(true);
  EXPECT_FALSE(save(*reading, new_run_id("a.json"), "a.json"));
  EXPECT_FALSE(save(*Store::open({}), new_run_id("a.json"), "a.json"));
  EXPECT_TRUE(list_runs(*Store::open({})).empty());
}

TEST_F(HistoryTest, a_full_disk_leaves_no_remains_and_says_nothing) {
  const auto store = open();
  for (const char* call : {"write", "open", "make_folder", "rename_replace"}) {
    // From the n-th call on nothing goes: every place at which a disk can be full.
    for (int n = 0; n < 4; ++n) {
      int calls = 0;
      files->fault = [&](const std::string& name) { return name == call && calls++ >= n ? -ENOSPC : 0; };
      const bool saved = save(*store, new_run_id("a.json"), "a.json");
      files->fault = nullptr;
      EXPECT_EQ(list_runs(*store).size(), saved ? 1u : 0u) << call << " " << n;
      EXPECT_EQ(store->trouble(), "");
      fs::remove_all(root + "/runs");
      fs::create_directory(root + "/runs");
      const auto again = open();
    }
  }
  EXPECT_TRUE(save(*open(), new_run_id("a.json"), "a.json"));
}

TEST_F(HistoryTest, links_and_foreign_folders_are_not_read) {
  const auto store = open();
  const std::string id = id_at("a.json", 1), linked = id_at("a.json", 2);
  save(*store, id, "a.json");
  fs::rename(root + "/runs/" + id, folder.file("elsewhere"));
  fs::create_directory_symlink(folder.file("elsewhere"), root + "/runs/" + id);
  EXPECT_TRUE(list_runs(*store).empty());
  fs::create_directory(root + "/runs/" + linked);
  fs::create_symlink(folder.file("elsewhere/report.json"), root + "/runs/" + linked + "/report.json");
  EXPECT_TRUE(list_runs(*store).empty());
}

TEST_F(HistoryTest, only_the_last_runs_stay) {
  const auto store = open();
  std::vector<std::string> ids;
  for (int i = 0; i < 230; ++i) {
    ids.push_back(id_at("a.json", i));
    save(*store, ids.back(), "a.json");
  }
  const std::vector<RunInfo> runs = list_runs(*store);
  EXPECT_GE(runs.size(), 200u);
  EXPECT_LE(runs.size(), 220u);
  EXPECT_EQ(runs.front().id, ids.back());
  // A long run that began before all of them has just ended.
  const std::string old = id_at("a.json", 0);
  EXPECT_TRUE(save(*store, old, "a.json"));
  for (int i = 300; i < 400; ++i) save(*store, id_at("a.json", i), "a.json");
  EXPECT_EQ(find_run(*store, old).id, old);
}

TEST_F(HistoryTest, the_collector_removes_the_oldest_records_but_not_the_latest) {
  const auto store = open();
  dag.file = std::string(20000, 'x');  // so that a record takes some blocks
  std::string last;
  for (int i = 0; i < 30; ++i) {
    last = id_at("a.json", i);
    save_run(*store, last, manifests_of(dag, result), run_report(last, dag, result));
  }
  const Collected before = collect(*store, {no_limit, no_limit, true, true});
  EXPECT_GT(before.bytes_before, 30u * 20000u) << "records count as content of the store";
  const std::uint64_t limit = before.bytes_before - 1;
  const Collected done = collect(*store, {limit, limit, false, true});
  EXPECT_GT(done.runs, 20u);
  EXPECT_EQ(list_runs(*store).size(), 30 - done.runs);
  EXPECT_LE(done.bytes_after, limit / 20);
  collect(*store, {0, 0, false, true});
  ASSERT_EQ(list_runs(*store).size(), 1u);
  EXPECT_EQ(list_runs(*store)[0].id, last);
}

TEST_F(HistoryTest, processes_record_side_by_side) {
  open();
  std::vector<pid_t> children;
  for (int child = 0; child < 4; ++child) {
    children.push_back(start([&] {
      const auto store = Store::open({root, false});
      for (int i = 0; i < 20; ++i) {
        if (!save(*store, new_run_id("a.json"), "a.json")) ::_exit(1);
        if (list_runs(*store).empty() || latest_manifests(*store, "a.json").empty()) ::_exit(2);
      }
    }));
  }
  for (const pid_t child : children) EXPECT_EQ(finish(child), 0);
  std::set<std::string> ids;
  for (const RunInfo& run : list_runs(*open())) ids.insert(run.id);
  EXPECT_EQ(ids.size(), 80u);
}

TEST_F(HistoryTest, a_killed_recorder_leaves_nothing_that_counts) {
  open();
  result.nodes[0].reason = std::string(1 << 20, 'x');
  std::size_t recorded = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const pid_t child = start([&] {
      const auto store = Store::open({root, false});
      for (;;) {
        const std::string id = new_run_id("a.json");
        save_run(*store, id, manifests_of(dag, result), run_report(id, dag, result));
      }
    });
    // In the middle of the second record or of a later one, however slow the machine is.
    for (int i = 0; i < 20000 && list_runs(*open(true)).empty(); ++i) ::usleep(500);
    ::usleep(static_cast<useconds_t>(200 * trial));
    ::kill(child, SIGKILL);
    finish(child);
    const auto store = open();
    const std::vector<RunInfo> runs = list_runs(*store);
    for (const RunInfo& run : runs)
      EXPECT_EQ(find_run(*store, run.id).report.at("nodes").at("part/probe").at("reason"),
                result.nodes[0].reason);
    recorded += runs.size();
    fs::remove_all(root + "/runs");
  }
  EXPECT_GT(recorded, 0u);
  EXPECT_TRUE(save(*open(), new_run_id("a.json"), "a.json"));
}

TEST_F(HistoryTest, recording_and_looking_up_cost_a_run_few_calls) {
  const auto store = open();
  for (int i = 0; i < 100; ++i) save(*store, id_at("b.json", i), "b.json");
  save(*store, id_at("a.json", 50), "a.json");
  files->reset_counts();
  EXPECT_FALSE(latest_manifests(*store, "a.json").empty());
  save(*store, id_at("a.json", 200), "a.json");
  EXPECT_LE(files->total(), 40) << "does not depend on the number of runs";
}

}  // namespace
}  // namespace ballflow
