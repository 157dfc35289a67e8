// "ballflow report" as a user meets it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using nlohmann::json;

struct ReportCli : testing::Test {
  test::TempFolder folder;

  test::ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  std::string page(std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"report", "-o", folder.file("page.html")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = ballflow(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "wrote " + folder.file("page.html") + "\n");
    return test::read_file(folder.file("page.html"));
  }
};

TEST_F(ReportCli, is_a_page_of_the_latest_run_with_the_command_that_repeats_it) {
  const std::string graph = test::source_file("graphs/prune.json");
  const auto run =
      ballflow({"run", graph, "--set", "input=shape:torus?n=900", "--set", "sampling=vertices", "--set",
                "prune/search.seed=3", "--seed", "5", "--quiet", "--report", folder.file("report.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json report = json::parse(test::read_file(folder.file("report.json")));
  EXPECT_EQ(
      report.at("command"),
      "ballflow run " + graph +
          " --set 'input=shape:torus?n=900' --set sampling=vertices --set prune/search.seed=3 --seed 5");
  const std::string shown = page();
  EXPECT_NE(shown.find("input=shape:torus?n=900"), std::string::npos);
  EXPECT_NE(shown.find("prune/search.seed=3 --seed 5"), std::string::npos);
  EXPECT_NE(shown.find(report.at("run").get<std::string>()), std::string::npos);
  EXPECT_NE(shown.find("Unions of Balls"), std::string::npos) << "the sources of the nodes";
  const auto balls = report.at("outputs").at("balls").at("summary").at("count").get<int>();
  EXPECT_NE(shown.find("<td class=\"number\">" + std::to_string(balls) + "</td>"), std::string::npos);
  EXPECT_NE(shown.find("<strong>balls</strong>: " + std::to_string(balls) +
                       " balls</figcaption><img alt=\"balls\" src=\"data:image/png;base64,iVBOR"),
            std::string::npos);
  EXPECT_NE(shown.find("<ul class=\"facts\"><li>" + std::to_string(balls) + " balls chosen"),
            std::string::npos);
  const std::string plain = page({"--pictures", "0"});
  EXPECT_EQ(plain.find("<img"), std::string::npos);
  EXPECT_NE(plain.find("no longer in the cache: 3 more"), std::string::npos) << "balls, points and mesh";
  EXPECT_EQ(page({folder.file("report.json")}), shown) << "a report file names its run";
}

TEST_F(ReportCli, plots_a_sweep_and_names_the_content_of_its_files) {
  test::write_file(
      folder.file("box.off"),
      "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
      "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n"
      "3 3 0 4\n3 3 4 7\n");
  const auto run =
      ballflow({"run", test::source_file("graphs/experiments/epsilon_by_strategy.json"), "--set",
                "input=" + folder.file("box.off"), "--set", "sampling=surface", "--set",
                "model/dmt/sampling/sample.count=200", "--quiet", "--report", folder.file("report.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string shown = page({"latest", "--pictures", "1"});
  EXPECT_NE(shown.find("class=\"band\""), std::string::npos) << "balls down to their bound";
  EXPECT_NE(shown.find("6 variants"), std::string::npos);
  const auto digest = test::run_process({"/usr/bin/sha256sum", folder.file("box.off")}).out.substr(0, 64);
  ASSERT_EQ(digest.size(), 64u);
  EXPECT_NE(shown.find("<td>" + folder.file("box.off") + "</td><td><code>" + digest), std::string::npos);
}

TEST_F(ReportCli, says_which_runs_there_are) {
  const auto result = ballflow({"report", "absent", "-o", folder.file("page.html")});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("absent"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace ballflow
