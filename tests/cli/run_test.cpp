#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

struct CliTest : testing::Test {
  test::TempFolder folder;

  ProcessResult ballflow(std::vector<std::string> arguments, double stop_after = 0, int signal = SIGKILL) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}}, stop_after, signal);
  }
  ProcessResult run(std::vector<std::string> arguments, double stop_after = 0, int signal = SIGKILL) {
    arguments.insert(arguments.begin(),
                     {"run", test::source_file("graphs/medial_axis.json"), "--set", "sampling=vertices",
                      "--set", "growth=additive", "--set", "repair=none"});
    return ballflow(std::move(arguments), stop_after, signal);
  }
  json report() { return json::parse(test::read_file(folder.file("report.json"))); }
  /// Digests of all outputs of the graph.
  static std::map<std::string, std::string> digests(const json& report) {
    std::map<std::string, std::string> result;
    for (const auto& [name, output] : report.at("outputs").items()) result[name] = output.at("digest");
    return result;
  }
  static std::map<std::string, std::string> statuses(const json& report) {
    std::map<std::string, std::string> result;
    for (const auto& [path, node] : report.at("nodes").items()) result[path] = node.at("status");
    return result;
  }
  ProcessResult run_graph(const std::string& text) {
    test::write_file(folder.file("graph.json"), text);
    return ballflow({"run", folder.file("graph.json")});
  }
  /// The medial axis of a file with this content: must fail with exit 3 and say `expected`.
  void expect_refused(const std::string& name, const std::string& content, const std::string& expected) {
    test::write_file(folder.file(name), content);
    const ProcessResult result = run({"--set", "input=" + folder.file(name)});
    EXPECT_EQ(result.exit_code, 3) << name << ": " << result.err;
    EXPECT_NE(result.err.find(expected), std::string::npos) << name << ": " << result.err;
    EXPECT_NE(result.err.find("node dmt/sampling/sample (Sample) failed"), std::string::npos) << result.err;
  }
};

const std::string small = "input=shape:torus?n=3000";

TEST_F(CliTest, a_second_run_executes_nothing_and_rewrites_nothing) {
  ASSERT_EQ(
      run({"--set", small, "--out", folder.file("out"), "--report", folder.file("report.json")}).exit_code,
      0);
  const json first = report();
  const auto time = fs::last_write_time(folder.file("out/balls.ply"));
  ASSERT_EQ(
      run({"--set", small, "--out", folder.file("out"), "--report", folder.file("report.json")}).exit_code,
      0);
  for (const auto& [path, status] : statuses(report())) EXPECT_EQ(status, "hit") << path;
  EXPECT_EQ(digests(report()), digests(first));
  EXPECT_EQ(fs::last_write_time(folder.file("out/balls.ply")), time);
  // Nothing was read either: the run does not need the artifacts.
  fs::remove_all(folder.file("cache/cas"));
  ASSERT_EQ(
      run({"--set", small, "--out", folder.file("out"), "--report", folder.file("report.json")}).exit_code,
      0);
  for (const auto& [path, status] : statuses(report())) EXPECT_EQ(status, "hit") << path;
}

TEST_F(CliTest, a_changed_output_file_is_written_again) {
  ASSERT_EQ(run({"--set", small, "--out", folder.file("out")}).exit_code, 0);
  const std::string before = test::read_file(folder.file("out/balls.ply"));
  test::write_file(folder.file("out/balls.ply"), "damaged");
  ASSERT_EQ(run({"--set", small, "--out", folder.file("out")}).exit_code, 0);
  EXPECT_EQ(test::read_file(folder.file("out/balls.ply")), before);
}

TEST_F(CliTest, another_epsilon_reruns_enlarge_and_what_follows_and_nothing_before) {
  ASSERT_EQ(run({"--set", small, "--set", "epsilon=0.3"}).exit_code, 0);
  ASSERT_EQ(run({"--set", small, "--set", "epsilon=0.6", "--report", folder.file("report.json")}).exit_code,
            0);
  const auto status = statuses(report());
  EXPECT_EQ(status.at("dmt/sampling/sample"), "hit");
  EXPECT_EQ(status.at("dmt/sampling/poles"), "hit");
  EXPECT_EQ(status.at("dmt/sampling/label"), "hit");
  EXPECT_EQ(status.at("enlarge"), "run");
  EXPECT_EQ(status.at("matrix"), "run");
  EXPECT_EQ(status.at("select"), "run");
  EXPECT_NE(
      report().at("nodes").at("enlarge").at("reason").get<std::string>().find("params.epsilon 0.3 -> 0.6"),
      std::string::npos);
}

TEST_F(CliTest, swapping_the_strategy_reruns_only_the_pruning_and_what_follows) {
  ASSERT_EQ(run({"--set", small}).exit_code, 0);
  ASSERT_EQ(
      run({"--set", small, "--set", "strategy=hybrid", "--report", folder.file("report.json")}).exit_code, 0);
  const auto status = statuses(report());
  EXPECT_EQ(status.at("enlarge"), "hit");
  EXPECT_EQ(status.at("matrix"), "hit");
  EXPECT_EQ(status.at("alpha"), "run");
  EXPECT_GE(report().at("nodes").at("prune/rounds").at("iterations").get<int>(), 1);
}

TEST_F(CliTest, a_run_ends_with_what_matters_and_where_to_look) {
  const ProcessResult result = run({"--set", small});
  const std::size_t facts = result.out.find(" MB at most");
  ASSERT_NE(facts, std::string::npos) << result.out;
  const std::string last = result.out.substr(facts);
  EXPECT_NE(last.find(" balls chosen"), std::string::npos) << result.out;
  EXPECT_NE(last.find("topology kept: 1 component, 1 tunnel, no cavity"), std::string::npos) << result.out;
  const std::size_t more = last.find("more: ballflow report ");
  ASSERT_NE(more, std::string::npos) << result.out;
  const std::string id = last.substr(more + 22, last.find(',', more) - more - 22);
  EXPECT_EQ(ballflow({"compare", id}).exit_code, 0) << id;
  // A run that leaves no record names no place where there is none.
  EXPECT_EQ(run({"--set", small, "--no-cache"}).out.find("more:"), std::string::npos);
}

TEST_F(CliTest, what_nodes_share_is_not_said_to_come_from_the_cache) {
  test::write_file(folder.file("graph.json"), R"({
    "nodes": { "a": { "type": "Sample", "params": { "file": "shape:sphere?n=300" } },
               "b": { "type": "Sample", "params": { "file": "shape:sphere?n=300" } },
               "c": { "type": "Sample", "params": { "file": "shape:sphere?n=400" } } },
    "outputs": { "a": "a.mesh", "b": "b.mesh", "c": "c.mesh" } })");
  const auto totals = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", folder.file("graph.json")});
    return ballflow(std::move(arguments)).out;
  };
  const std::string alone = totals({"--no-cache"}), first = totals({}), second = totals({});
  EXPECT_NE(alone.find("\n2 run, 0 from the cache, 1 shared, "), std::string::npos) << alone;
  EXPECT_NE(first.find("\n2 run, 0 from the cache, 1 shared, "), std::string::npos) << first;
  EXPECT_NE(second.find("\n0 run, 2 from the cache, 1 shared, "), std::string::npos) << second;
}

TEST_F(CliTest, a_cover_as_small_as_its_bound_is_called_the_fewest_possible) {
  EXPECT_NE(run({"--set", small}).out.find("balls chosen, the fewest possible"), std::string::npos);
  const ProcessResult greedy = run({"--set", small, "--set", "strategy=greedy"});
  EXPECT_EQ(greedy.out.find("the fewest possible"), std::string::npos) << greedy.out;
}

TEST_F(CliTest, changing_one_side_of_a_minkowski_sum_leaves_the_other_in_the_cache) {
  const auto sum = [&](const std::string& b) {
    return ballflow({"run", test::source_file("graphs/minkowski_sum.json"), "--set", "a=shape:torus?n=1000",
                     "--set", "b=" + b, "--report", folder.file("report.json")});
  };
  ASSERT_EQ(sum("shape:sphere?n=500&R=0.2").exit_code, 0);
  ASSERT_EQ(sum("shape:box?n=500&R=0.2").exit_code, 0);
  int hits = 0, runs = 0;
  for (const auto& [path, status] : statuses(report())) {
    const bool of_a = path.starts_with("side_a");
    if (status == "skipped") continue;  // no output of the graph needs it
    EXPECT_EQ(status, of_a ? "hit" : "run") << path;
    (of_a ? hits : runs) += 1;
  }
  EXPECT_GT(hits, 5);
  EXPECT_GT(runs, 5);
}

TEST_F(CliTest, one_more_shape_to_match_computes_what_is_its_own_and_nothing_of_the_others) {
  const auto match = [&](const std::string& shapes) {
    return ballflow({"run", test::source_file("graphs/shape_match.json"), "--set", "instances=" + shapes,
                     "--set", "template=0", "--set", "points=400", "--set", "samples=80", "--set", "balls=10",
                     "--report", folder.file("report.json")});
  };
  const std::string two = "shape:bracket?n=1500&r=0.2,shape:bracket?n=1500&r=0.25";
  ASSERT_EQ(match(two).exit_code, 0);
  ASSERT_EQ(match(two + ",shape:bracket?n=1500&r=0.28").exit_code, 0);
  int own = 0, others = 0;
  for (const auto& [path, status] : statuses(report())) {
    if (status == "skipped" || path == "choose") continue;  // the choice looks at all shapes
    const bool is_new = path.find("r_0.28") != std::string::npos;
    if (!is_new) {
      EXPECT_EQ(status, "hit") << path;
    }
    if (is_new && status == "run") ++own;
    others += is_new ? 0 : 1;
  }
  EXPECT_GE(own, 7);  // read, points, poles, label, surface, align, match; in both maps, each is run once
  EXPECT_GT(others, 15);
}

TEST_F(CliTest, plan_and_check_say_what_a_run_would_do) {
  const std::string graph = test::source_file("graphs/medial_axis.json");
  const std::vector<std::string> plan_it = {
      "plan",  graph,        "--set", small, "--set", "sampling=vertices", "--set", "growth=additive",
      "--set", "repair=none"};
  EXPECT_NE(ballflow(plan_it).out.find("RUN"), std::string::npos);
  ASSERT_EQ(run({"--set", small}).exit_code, 0);
  const ProcessResult plan = ballflow(plan_it);
  EXPECT_EQ(plan.exit_code, 0);
  EXPECT_EQ(plan.out.find("RUN"), std::string::npos) << plan.out;
  EXPECT_EQ(ballflow({"check", graph}).exit_code, 0);
}

TEST_F(CliTest, any_number_of_threads_gives_the_same_digests) {
  ASSERT_EQ(
      run({"--set", small, "--threads", "1", "--no-cache", "--report", folder.file("report.json")}).exit_code,
      0);
  const auto one = digests(report());
  ASSERT_EQ(
      run({"--set", small, "--threads", "2", "--no-cache", "--report", folder.file("report.json")}).exit_code,
      0);
  EXPECT_EQ(digests(report()), one);
}

TEST_F(CliTest, kill_9_at_any_moment_needs_no_repair) {
  ASSERT_EQ(run({"--set", small, "--no-cache", "--report", folder.file("report.json")}).exit_code, 0);
  const auto expected = digests(report());
  int killed = 0;
  for (int i = 0; i < 8; ++i) {
    killed += run({"--set", small}, 0.01 + 0.03 * i, SIGKILL).exit_code == 128 + SIGKILL ? 1 : 0;
  }
  EXPECT_GT(killed, 0) << "every run ended before it was killed";
  const ProcessResult after = run({"--set", small, "--report", folder.file("report.json")});
  ASSERT_EQ(after.exit_code, 0) << after.err;
  EXPECT_EQ(digests(report()), expected);
}

TEST_F(CliTest, two_runs_at_once_on_one_cache_are_both_right) {
  ProcessResult results[2];
  std::thread threads[2];
  for (int i = 0; i < 2; ++i) {
    threads[i] = std::thread([&, i] {
      results[i] = run({"--set", small, "--report", folder.file("report" + std::to_string(i) + ".json")});
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(results[0].exit_code, 0) << results[0].err;
  EXPECT_EQ(results[1].exit_code, 0) << results[1].err;
  const auto read = [&](int i) {
    return digests(json::parse(test::read_file(folder.file("report" + std::to_string(i) + ".json"))));
  };
  EXPECT_EQ(read(0), read(1));
}

TEST_F(CliTest, ctrl_c_exits_4_and_the_next_run_goes_on) {
  const std::string big = "input=shape:3cross";
  const ProcessResult result = run({"--set", big}, 0.6, SIGINT);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_LT(result.seconds, 0.6 + 3) << "cancelling took too long";
  EXPECT_NE(result.err.find("cancelled"), std::string::npos) << result.err;
}

TEST_F(CliTest, bad_files_are_refused_with_the_reason) {
  expect_refused("empty.off", "", "empty");
  expect_refused("three.xyz", "0 0 0\n1 0 0\n0 1 0\n", "only 3 distinct points");
  expect_refused("flat.xyz", "0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 3 0\n", "plane");
  expect_refused("equal.xyz", "1 2 3\n1 2 3\n1 2 3\n1 2 3\n1 2 3\n", "point");
  expect_refused("nan.xyz", "0 0 0\n1 0 0\n0 nan 0\n0 0 1\n1 1 1\n", "nan");
  expect_refused("index.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 9\n", "9");
  expect_refused("cut.off.gz", std::string("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03\x01\x02", 12), "gz");
  fs::create_directory(folder.file("folder.off"));
  const ProcessResult directory = run({"--set", "input=" + folder.file("folder.off")});
  EXPECT_EQ(directory.exit_code, 3);
  EXPECT_NE(directory.err.find("directory"), std::string::npos) << directory.err;
  const ProcessResult absent = run({"--set", "input=" + folder.file("absent.off")});
  EXPECT_EQ(absent.exit_code, 3);
  EXPECT_NE(absent.err.find("absent.off"), std::string::npos) << absent.err;
}

TEST_F(CliTest, broken_models_run_with_a_warning_or_are_refused_by_name) {
  bool any = false;
  for (const std::string name :
       {"broken_truncated", "broken_bad_index", "broken_nan", "broken_cow", "broken_octagonal_pocket",
        "broken_not_convex", "broken_soup", "broken_soup_flipped_dup"}) {
    std::string file;
    for (const char* extension :
         {".off.gz", ".obj.gz", ".ply.gz", ".stl.gz", ".off", ".obj", ".ply", ".stl"}) {
      if (file.empty()) file = test::data_file("models/" + name + extension);
    }
    if (file.empty()) continue;
    any = true;
    const ProcessResult result = run({"--set", "input=" + file});
    const bool unreadable = name == "broken_truncated" || name == "broken_bad_index" || name == "broken_nan";
    if (unreadable) {
      EXPECT_EQ(result.exit_code, 3) << name << result.err;
    } else {
      EXPECT_TRUE(result.exit_code == 0 || result.exit_code == 3)
          << name << " " << result.exit_code << result.err;
      EXPECT_NE(result.err.find(result.exit_code == 0 ? "warning" : "what to do"), std::string::npos)
          << name << result.err;
    }
  }
  if (!any) GTEST_SKIP() << "the folder of test models is absent";
}

TEST_F(CliTest, bad_graphs_exit_2_with_place_and_reason) {
  const auto expect = [&](const std::string& text, const std::string& expected) {
    const ProcessResult result = run_graph(text);
    EXPECT_EQ(result.exit_code, 2) << text.substr(0, 80);
    EXPECT_NE(result.err.find(expected), std::string::npos)
        << expected << " is not in: " << result.err.substr(0, 500);
    EXPECT_NE(result.err.find("graph.json:"), std::string::npos) << result.err.substr(0, 500);
    EXPECT_LT(result.seconds, 5);
  };
  const std::string outputs = R"(, "outputs": {"o": "s.points"}})";
  expect("{", "graph.json:1:");
  expect(R"({"nodes": {"s": {"type": "Sampel", "params": {"file": "shape:box"}}})" + outputs, "Sample");
  expect(R"({"nodes": {"s": {"type": "Sample", "params": {"file": "shape:box", "file": "x"}}})" + outputs,
         "file");
  expect(
      R"({"nodes": {"s": {"type": "Sample", "params": {"file": "shape:box"}}, "v": {"type": "VoronoiPoles", "inputs": {"point": "s.points"}}}, "outputs": {"o": "v.poles"}})",
      "points");
  expect(
      R"({"nodes": {"s": {"type": "Sample", "params": {"file": "shape:box"}}, "v": {"type": "VoronoiPoles", "inputs": {"points": "s.mesh"}}}, "outputs": {"o": "v.poles"}})",
      "TriangleMesh");
  expect(R"({"nodes": {"v": {"type": "VoronoiPoles"}}, "outputs": {"o": "v.poles"}})", "points");
  expect(
      R"({"nodes": {"a": {"type": "Reduce", "inputs": {"cover": "b.cover"}}, "b": {"type": "Reduce", "inputs": {"cover": "a.cover"}}}, "outputs": {"o": "a.cover"}})",
      "cycle");
  expect(
      R"({"nodes": {"s": {"type": "Sample", "params": {"file": "shape:box"}}, "e": {"type": "Enlarge", "inputs": {"balls": "s.points", "points": "s.points"}, "params": {"epsilon": -1}}}, "outputs": {"o": "e.balls"}})",
      "-1");
  expect(std::string(10 << 20, '['), "nest");
  expect(std::string(200000, '[') + std::string(200000, ']'), "nest");
}

TEST_F(CliTest, an_override_that_matches_nothing_names_the_nearest) {
  const ProcessResult result = run({"--set", "epsilom=0.5"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("epsilon"), std::string::npos) << result.err;
}

TEST_F(CliTest, wrong_usage_exits_2_and_help_exits_0) {
  EXPECT_EQ(ballflow({"rum"}).exit_code, 2);
  EXPECT_EQ(ballflow({}).exit_code, 2);
  EXPECT_EQ(ballflow({"run"}).exit_code, 2);
  EXPECT_EQ(ballflow({"run", folder.file("absent.json")}).exit_code, 2);
  EXPECT_EQ(ballflow({"--help"}).exit_code, 0);
  EXPECT_EQ(ballflow({"run", "--help"}).exit_code, 0);
  EXPECT_EQ(ballflow({"nodes", "Enlarge"}).exit_code, 0);
  EXPECT_EQ(ballflow({"nodes", "Enlarg"}).exit_code, 2);
  EXPECT_EQ(ballflow({"version"}).exit_code, 0);
  EXPECT_EQ(ballflow({"cache", "stat"}).exit_code, 0);
  EXPECT_FALSE(json::parse(ballflow({"nodes", "--schema"}).out).empty());
}

TEST_F(CliTest, an_artifact_is_exported_by_its_digest) {
  ASSERT_EQ(run({"--set", small, "--report", folder.file("report.json")}).exit_code, 0);
  const std::string digest = report().at("outputs").at("balls").at("digest");
  for (const std::string extension : {"ply", "csv"}) {
    const ProcessResult result = ballflow({"export", digest.substr(0, 12), folder.file("b." + extension)});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_GT(fs::file_size(folder.file("b." + extension)), 100u);
  }
  EXPECT_EQ(ballflow({"export", digest, folder.file("b.xyzzy")}).exit_code, 2);
  EXPECT_EQ(ballflow({"export", "ffffffffffff", folder.file("c.ply")}).exit_code, 2);
}

TEST_F(CliTest, what_cannot_be_written_is_refused_before_anything_runs) {
  test::write_file(folder.file("file"), "in the way");
  const auto refused = [&](std::vector<std::string> arguments, int code) {
    arguments.insert(arguments.begin(), {"--set", small});
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, code) << arguments[1] << ": " << result.err;
    EXPECT_EQ(result.err.find("dmt/sampling/sample"), std::string::npos) << result.err;
  };
  refused({"--out", folder.file("file")}, 5);
  refused({"--report", folder.file("absent/report.json")}, 5);
  refused({"--format", "balls=xyzzy"}, 2);
  refused({"--threads", "1", "--set", "input=caf\xe9.off"}, 2);
}

TEST_F(CliTest, outputs_stay_inside_their_folder) {
  const ProcessResult result = run_graph(
      R"({"nodes": {"s": {"type": "Sample", "params": {"file": "shape:box"}}}, "outputs": {"../../x": "s.points"}})");
  EXPECT_EQ(result.exit_code, 2);
}

TEST_F(CliTest, an_output_folder_may_have_any_name) {
  const std::string out = folder.file("caf\xe9");
  ASSERT_EQ(run({"--set", small, "--out", out}).exit_code, 0);
  const ProcessResult again = run({"--set", small, "--out", out});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.out.find("wrote"), std::string::npos) << again.out;
}

TEST_F(CliTest, a_damaged_artifact_is_not_exported) {
  ASSERT_EQ(run({"--set", small, "--report", folder.file("report.json")}).exit_code, 0);
  const std::string digest = report().at("outputs").at("balls").at("digest");
  const std::string path = folder.file("cache/cas/" + digest.substr(0, 2) + "/" + digest.substr(2));
  std::string bytes = test::read_file(path);
  bytes.back() ^= 1;
  fs::remove(path);
  test::write_file(path, bytes);
  EXPECT_EQ(ballflow({"export", digest, folder.file("b.ply")}).exit_code, 5);
}

TEST_F(CliTest, an_unwritable_cache_is_no_failure) {
  if (geteuid() == 0) {
    // root writes everywhere: a file where the folder should be does the same
    test::write_file(folder.file("cache"), "in the way");
  } else {
    fs::create_directory(folder.file("cache"));
    fs::permissions(folder.file("cache"), fs::perms::owner_read | fs::perms::owner_exec);
  }
  const ProcessResult result = run({"--set", small});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("cache"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ballflow
