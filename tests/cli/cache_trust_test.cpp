// A cache that can be trusted: whatever happens to processes and files, a run gives the results of an
// undisturbed one, and nobody has to repair anything. BALLFLOW_TEST_TRIALS sets the number of random trials;
// the nightly script takes 1000.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

/// Output or node -> digest or status.
using Names = std::map<std::string, std::string>;

int trials(int in_the_suite) {
  const char* text = std::getenv("BALLFLOW_TEST_TRIALS");
  return text != nullptr ? std::atoi(text) : in_the_suite;
}

struct CacheTrustTest : testing::Test {
  test::TempFolder folder;
  std::string cache = folder.file("cache");
  std::mt19937 random{20101};

  std::size_t below(std::size_t n) { return random() % n; }

  /// A small pipeline with a loop; `variant` changes its second half only.
  ProcessResult run(int variant, const std::string& report, std::vector<std::string> more = {},
                    double stop_after = 0) {
    std::vector<std::string> command = {test::binary_file("bin/ballflow"),
                                        "run",
                                        test::source_file("graphs/medial_axis.json"),
                                        "--set",
                                        "sampling=vertices",
                                        "--set",
                                        "growth=additive",
                                        "--set",
                                        "repair=none",
                                        "--set",
                                        "input=shape:torus?n=600",
                                        "--set",
                                        "strategy=hybrid",
                                        "--set",
                                        "epsilon=" + std::to_string(1 + variant),
                                        "--report",
                                        folder.file(report)};
    command.insert(command.end(), more.begin(), more.end());
    return test::run_process(command, {{"BALLFLOW_CACHE", cache}}, stop_after);
  }
  json read_report(const std::string& name) { return json::parse(test::read_file(folder.file(name))); }
  Names digests(const std::string& report) {
    Names result;
    const json document = read_report(report);
    for (const auto& [name, output] : document.at("outputs").items()) result[name] = output.at("digest");
    return result;
  }
  Names statuses(const std::string& report) {
    Names result;
    const json document = read_report(report);
    for (const auto& [name, node] : document.at("nodes").items()) result[name] = node.at("status");
    return result;
  }
  static Names files_of(const fs::path& out) {
    Names result;
    for (const auto& entry : fs::directory_iterator(out)) {
      if (entry.path().extension() != ".json")
        result[entry.path().filename()] = test::read_file(entry.path());
    }
    return result;
  }
  std::vector<fs::path> files_in_cache() const {
    std::vector<fs::path> result;
    for (const auto& entry : fs::recursive_directory_iterator(cache)) {
      if (entry.is_regular_file() && entry.file_size() > 0) result.push_back(entry.path());
    }
    std::sort(result.begin(), result.end());
    return result;
  }
};

TEST_F(CacheTrustTest, killed_at_random_moments_no_run_leaves_a_wrong_result) {
  constexpr int variants = 3;
  Names expected[variants];
  double longest = 0;
  for (int v = 0; v < variants; ++v) {
    const ProcessResult result = run(v, "report.json", {"--no-cache"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expected[v] = digests("report.json");
    longest = std::max(longest, result.seconds);
  }
  const int count = trials(20);
  int killed = 0;
  for (int trial = 0; trial < count; ++trial) {
    // From time to time from nothing, so that every stage is interrupted often.
    if (trial % 5 == 0) fs::remove_all(cache);
    const int v = static_cast<int>(below(variants));
    const double moment = longest * (1 + static_cast<double>(below(1000))) / 1000;
    killed += run(v, "killed.json", {}, moment).exit_code == 128 + SIGKILL ? 1 : 0;
    const ProcessResult after = run(v, "report.json");
    ASSERT_EQ(after.exit_code, 0) << "trial " << trial << ": " << after.err;
    ASSERT_EQ(digests("report.json"), expected[v]) << "trial " << trial;
  }
  EXPECT_GT(killed, count / 10) << "most runs ended before they were killed";
  std::cout << count << " trials, " << killed << " runs killed\n";
}

TEST_F(CacheTrustTest, a_flipped_bit_anywhere_is_never_a_wrong_result) {
  constexpr int variants = 2;
  Names expected[variants], files[variants];
  for (int v = 0; v < variants; ++v) {
    const std::string out = folder.file("out" + std::to_string(v));
    const ProcessResult result = run(v, "report.json", {"--no-cache", "--out", out});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    expected[v] = digests("report.json");
    files[v] = files_of(out);
    ASSERT_FALSE(files[v].empty());
  }
  const int count = trials(20);
  int computed_again = 0;
  for (int trial = 0; trial < count; ++trial) {
    const int v = trial % variants;
    if (trial % 50 == 0) {
      fs::remove_all(cache);
      for (int w = 0; w < variants; ++w) ASSERT_EQ(run(w, "report.json").exit_code, 0);
    }
    const std::vector<fs::path> all = files_in_cache();
    const fs::path& victim = all[below(all.size())];
    std::string content = test::read_file(victim);
    const std::size_t at = below(content.size());
    content[at] = static_cast<char>(content[at] ^ (1 << below(8)));
    std::ofstream(victim, std::ios::binary) << content;

    // The outputs are exported, so their artifacts are read; every other trial something upstream of them is
    // recomputed, so others are.
    const std::string out = folder.file("out_now");
    fs::remove_all(out);
    if (trial % 4 >= 2) fs::remove_all(cache + "/ac/" + std::string(1, "0123456789abcdef"[below(16)]) + "0");
    const ProcessResult after = run(v, "report.json", {"--out", out});
    const std::string where =
        "trial " + std::to_string(trial) + ": byte " + std::to_string(at) + " of " + victim.string();
    ASSERT_EQ(after.exit_code, 0) << where << "\n" << after.err;
    ASSERT_EQ(digests("report.json"), expected[v]) << where;
    ASSERT_EQ(files_of(out), files[v]) << where;
    for (const auto& [node, status] : statuses("report.json")) computed_again += status == "run" ? 1 : 0;
  }
  EXPECT_GT(computed_again, 0) << "no damage mattered: the test looks at nothing";
  std::cout << count << " bits flipped, " << computed_again << " nodes computed again\n";
}

TEST_F(CacheTrustTest, eight_processes_on_one_cache_compute_each_action_once) {
  constexpr int processes = 8;
  std::vector<ProcessResult> results(processes);
  std::vector<std::thread> threads;
  for (int i = 0; i < processes; ++i) {
    threads.emplace_back([&, i] { results[i] = run(0, "report" + std::to_string(i) + ".json"); });
  }
  for (std::thread& thread : threads) thread.join();
  std::map<std::string, int> computed;
  for (int i = 0; i < processes; ++i) {
    ASSERT_EQ(results[i].exit_code, 0) << results[i].err;
    const std::string report = "report" + std::to_string(i) + ".json";
    EXPECT_EQ(digests(report), digests("report0.json"));
    for (const auto& [node, status] : statuses(report)) {
      EXPECT_TRUE(status == "run" || status == "hit") << node << " " << status;
      computed[node] += status == "run" ? 1 : 0;
    }
  }
  EXPECT_GT(computed.size(), 5u);
  for (const auto& [node, times] : computed) EXPECT_EQ(times, 1) << node;
}

}  // namespace
}  // namespace ballflow
