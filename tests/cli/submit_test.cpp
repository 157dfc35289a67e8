// "ballflow submit" with programs that stand for those of Slurm and run tasks at once, one after the other:
// what is submitted, with what, and what comes of it. tests/cluster has the real one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

class SubmitCli : public testing::Test {
 protected:
  SubmitCli() {
    fs::create_directory(store);
    fs::create_directory(folder.file("bin"));
    // Does as sbatch: a task of an array after the other. What $FAKE_LOSE names ("0-1": task 1 of array 0) is
    // not run the first time, and leaves the text of the file $FAKE_LAST_WORDS in its log.
    program("sbatch", R"(
echo "$@" >> "$FAKE/calls"
while [ $# -gt 0 ]; do
  case $1 in
    --array=0-*) last=${1#--array=0-} ;;
    --output=*) output=${1#--output=} ;;
    --chdir=*) folder=${1#--chdir=} ;;
    --*) ;;
    *) break ;;
  esac
  shift
done
cd "$folder" || exit 1
for task in $(seq 0 "$last"); do
  log=$(echo "$output" | sed "s/%a/$task/")
  if [ "$2-$task" = "$FAKE_LOSE" ] && [ ! -e "$FAKE/lost" ]; then
    touch "$FAKE/lost"
    cat "$FAKE/last_words" >> "$log"
    continue
  fi
  SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_JOB_ID=7 BALLFLOW_CACHE="$FAKE/cache of $task" sh "$@" >> "$log" 2>&1
done
echo 7)");
    program("scontrol", R"(
[ "$1" = show ] && echo "Configuration data
MaxArraySize            = ${FAKE_ARRAY:-1001}
MaxJobCount             = 10000"
exit 0)");
    // How the first task ended: $FAKE_END.
    program("squeue", R"(
case "$*" in *--states=all*) [ -z "$FAKE_END" ] || echo "7_0|$FAKE_END|None" ;; esac
exit 0)");
    program("scancel", "echo scancel \"$@\" >> \"$FAKE/calls\"");
    test::write_file(folder.file("last_words"), "");
  }

  void program(const std::string& name, const std::string& text) const {
    const std::string path = folder.file("bin/" + name);
    test::write_file(path, "#!/bin/sh\n" + text + "\n");
    fs::permissions(path, fs::perms::owner_all);
  }
  ProcessResult ballflow(std::vector<std::string> arguments,
                         std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    environment["PATH"] = folder.file("bin") + ":" + std::getenv("PATH");
    environment["FAKE"] = folder.path();
    environment.try_emplace("BALLFLOW_CACHE", folder.file("cache of the submitter"));
    return test::run_process(arguments, environment);
  }
  /// Two strategies, one of them with a loop, on two small shapes.
  std::vector<std::string> sweep(const std::string& command, std::vector<std::string> more,
                                 const std::string& models = "shape:torus?n=300,shape:box?n=200") {
    std::vector<std::string> arguments{command,  test::source_file("graphs/prune.json"),
                                       "--set",  "sampling=vertices",
                                       "--set",  "growth=additive",
                                       "--set",  "repair=none",
                                       "--axis", "input=" + models,
                                       "--axis", "strategy=greedy,hybrid"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  ProcessResult submit(std::vector<std::string> more, std::map<std::string, std::string> environment = {}) {
    more.insert(more.end(), {"--store", store, "--patience", "0"});
    return ballflow(sweep("submit", more), std::move(environment));
  }
  std::vector<std::string> calls() const {
    std::vector<std::string> lines;
    std::istringstream in(fs::exists(folder.file("calls")) ? test::read_file(folder.file("calls")) : "");
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
  }
  /// Digests of all outputs by path and port, from a report.
  static std::map<std::string, std::string> digests(const std::string& out) {
    std::map<std::string, std::string> found;
    const json report = json::parse(test::read_file(out + "/report.json"));
    for (const auto& [path, node] : report.at("nodes").items()) {
      for (const auto& [port, output] : node.at("outputs").items())
        found[path + '.' + port] = output.at("digest");
    }
    return found;
  }
  std::map<std::string, std::string> local() {
    const std::string out = folder.file("local");
    const ProcessResult run =
        ballflow(sweep("sweep", {"--out", out}), {{"BALLFLOW_CACHE", folder.file("alone")}});
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return digests(out);
  }

  const test::TempFolder folder;
  const std::string store = folder.file("store");
};

TEST_F(SubmitCli, jobs_give_the_digests_of_a_local_run_and_a_second_submission_sends_none) {
  const auto expected = local();
  const ProcessResult run = submit({"--watch", "--unit-seconds", "3", "--out", folder.file("out")});
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_EQ(digests(folder.file("out")), expected);
  EXPECT_FALSE(expected.empty());
  const std::size_t sent = calls().size();
  EXPECT_GE(sent, 2u);
  const ProcessResult again = submit({"--out", folder.file("out")});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.out.find("nothing to submit"), std::string::npos) << again.out;
  EXPECT_EQ(calls().size(), sent);
  // A run like any other, with pages and tables of it.
  const std::string page = folder.file("report.html");
  EXPECT_EQ(ballflow({"report", "latest", "--pictures", "0", "-o", page}).exit_code, 0);
  EXPECT_NE(test::read_file(page).find("hybrid"), std::string::npos);
  const ProcessResult table = ballflow({"compare", "latest", "--format", "csv"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1 + 4) << table.out;
  const ProcessResult status = ballflow({"status", "--store", store});
  EXPECT_EQ(status.exit_code, 0) << status.err;
  EXPECT_NE(status.out.find("Greedy"), std::string::npos) << status.out;
  EXPECT_EQ(ballflow({"cancel", "prune", "--store", store}).exit_code, 2) << "no run is called so";
}

TEST_F(SubmitCli, a_dry_run_shows_arrays_and_resources_and_submits_nothing) {
  const ProcessResult run = submit({"--dry-run", "--unit-seconds", "3"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* word : {"array", "units", "memory", "limit", "hours predicted"})
    EXPECT_NE(run.out.find(word), std::string::npos) << run.out;
  EXPECT_TRUE(calls().empty());
  EXPECT_FALSE(fs::exists(store + "/submissions"));
}

TEST_F(SubmitCli, a_lost_task_is_sent_again) {
  const auto expected = local();
  const ProcessResult run =
      submit({"--watch", "--unit-seconds", "1", "--out", folder.file("out")}, {{"FAKE_LOSE", "0-0"}});
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  EXPECT_TRUE(fs::exists(folder.file("lost")));
  EXPECT_EQ(digests(folder.file("out")), expected);
}

TEST_F(SubmitCli, what_ran_out_of_memory_or_time_gets_twice_as_much) {
  const auto option = [](const std::string& call, const std::string& name) {
    const std::size_t at = call.find(name);
    return std::atoi(call.c_str() + at + name.size());
  };
  test::write_file(folder.file("last_words"),
                   "slurmstepd: error: Step 7.0 exceeded memory limit (9 > 8), being killed\n");
  const ProcessResult run = submit({"--watch", "--unit-seconds", "1000"}, {{"FAKE_LOSE", "0-0"}});
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  int least = 1 << 30, most = 0;
  for (const std::string& call : calls()) {
    least = std::min(least, option(call, "--mem="));
    most = std::max(most, option(call, "--mem="));
  }
  EXPECT_GE(most, 2 * least);
}

TEST_F(SubmitCli, the_state_of_a_job_says_what_it_ran_out_of_where_its_log_is_silent) {
  const auto most = [this](const std::string& name) {
    int number = 0;
    for (const std::string& call : calls())
      number = std::max(number, std::atoi(call.c_str() + call.find(name) + name.size()));
    return number;
  };
  const auto run = [&](const std::string& end) {
    fs::remove(folder.file("lost"));
    fs::remove(folder.file("calls"));
    fs::remove_all(store);
    fs::create_directory(store);
    // One model, nothing from earlier runs.
    const ProcessResult done = ballflow(
        sweep("submit",
              {"--store", store, "--patience", "0", "--watch", "--unit-seconds", "1000", "--minutes", "70"},
              "shape:box?n=200"),
        {{"FAKE_LOSE", end.empty() ? "" : "0-0"},
         {"FAKE_END", end},
         {"BALLFLOW_CACHE", folder.file("cache " + end)}});
    EXPECT_EQ(done.exit_code, 0) << done.err << done.out;
  };
  run("");
  const int memory = most("--mem="), minutes = most("--time=");
  run("OUT_OF_MEMORY");
  EXPECT_EQ(most("--mem="), 2 * memory);
  EXPECT_EQ(most("--time="), minutes);
  run("TIMEOUT");
  EXPECT_EQ(most("--mem="), memory);
  EXPECT_EQ(most("--time="), 2 * minutes);
}

TEST_F(SubmitCli, what_ran_into_its_time_limit_gets_twice_the_time) {
  const auto expected = local();
  test::write_file(
      folder.file("last_words"),
      "slurmstepd: error: *** JOB 7 ON n1 CANCELLED AT 2026-12-01T10:00:00 DUE TO TIME LIMIT ***\n");
  // Other than the least and the usual limit, so that the one asked for is seen.
  const ProcessResult run =
      submit({"--watch", "--unit-seconds", "1000", "--minutes", "70", "--out", folder.file("out")},
             {{"FAKE_LOSE", "0-0"}});
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  std::set<int> minutes;
  for (const std::string& call : calls()) {
    const std::size_t time = call.find("--time=");
    ASSERT_NE(time, std::string::npos) << call;
    minutes.insert(std::atoi(call.c_str() + time + 7));
  }
  EXPECT_EQ(*minutes.begin(), 70);
  EXPECT_EQ(*minutes.rbegin(), 140) << "once, not again and again";
  EXPECT_EQ(digests(folder.file("out")), expected);
}

TEST_F(SubmitCli, a_node_that_fails_stops_nothing_else_and_is_not_repeated) {
  test::write_file(folder.file("bad.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  const auto with_bad = [&](std::vector<std::string> more) {
    more.insert(more.end(), {"--store", store, "--patience", "0"});
    return ballflow(sweep("submit", more, "shape:torus?n=300," + folder.file("bad.off")));
  };
  const ProcessResult run = with_bad({"--watch", "--unit-seconds", "1"});
  EXPECT_EQ(run.exit_code, 3) << run.err << run.out;
  EXPECT_NE(run.err.find("failed"), std::string::npos);
  EXPECT_NE(run.err.find("exec-node"), std::string::npos) << "the line that runs it alone";
  const ProcessResult status = ballflow({"status", "--store", store});
  EXPECT_EQ(status.exit_code, 3);
  EXPECT_NE(status.out.find("bad.off"), std::string::npos) << status.out;
  const std::size_t sent = calls().size();
  // Only the failed node and what needs it are sent again.
  const ProcessResult again = with_bad({"--dry-run"});
  EXPECT_NE(again.out.find("nodes are done"), std::string::npos) << again.out;
  EXPECT_EQ(calls().size(), sent);
}

TEST_F(SubmitCli, arrays_are_split_at_the_limit_of_the_cluster) {
  const ProcessResult run = submit({"--watch", "--unit-seconds", "0.001"}, {{"FAKE_ARRAY", "2"}});
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  for (const std::string& call : calls()) {
    EXPECT_TRUE(call.find("--array=0-0 ") != std::string::npos ||
                call.find("--array=0-1 ") != std::string::npos)
        << call;
  }
}

TEST_F(SubmitCli, without_a_cluster_it_says_so) {
  for (const char* name : {"sbatch", "scontrol", "squeue"})
    fs::remove(folder.file(std::string("bin/") + name));
  program("env", "exit 0");
  std::vector<std::string> arguments = sweep("submit", {"--store", store});
  arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
  const ProcessResult run = test::run_process(
      arguments, {{"PATH", folder.file("bin")}, {"BALLFLOW_CACHE", folder.file("cache of the submitter")}});
  EXPECT_EQ(run.exit_code, 5);
  EXPECT_NE(run.err.find("scontrol is not on the path"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace ballflow
