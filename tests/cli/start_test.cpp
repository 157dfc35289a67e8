// What the program loads before it does anything.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using test::ProcessResult;

struct StartTest : testing::Test {
  StartTest() { std::filesystem::create_directory(folder.file("cache")); }

  test::TempFolder folder;

  ProcessResult ballflow(std::vector<std::string> arguments,
                         std::map<std::string, std::string> environment = {}) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    environment["BALLFLOW_CACHE"] = folder.file("cache");
    return test::run_process(arguments, environment);
  }
  /// The shared libraries with this in their path that a command opens, as the dynamic loader says.
  std::vector<std::string> opened(const std::string& what, std::vector<std::string> arguments) {
    const ProcessResult result = ballflow(std::move(arguments), {{"LD_DEBUG", "files"}});
    EXPECT_EQ(result.exit_code, 0);
    std::vector<std::string> files;
    std::istringstream lines(result.err);
    for (std::string line; std::getline(lines, line);) {
      const std::string init = "calling init: ";
      const std::size_t at = line.find(init);
      if (at != std::string::npos && line.find(what, at) != std::string::npos)
        files.push_back(line.substr(at + init.size()));
    }
    return files;
  }
};

TEST_F(StartTest, opens_only_the_node_libraries_that_it_runs) {
  const std::string graph = test::source_file("graphs/shape.json"), nodes = "/lib/ballflow/";
  const std::string version = ballflow({"version"}).out;
  EXPECT_EQ(opened(nodes, {"version"}), std::vector<std::string>());
  EXPECT_EQ(ballflow({"version"}).out, version);

  const auto only_these = [&](const std::vector<std::string>& arguments) {
    std::vector<std::string> names;
    for (const std::string& file : opened(nodes, arguments))
      names.push_back(file.substr(file.rfind('/') + 1));
    return names;
  };
  EXPECT_FALSE(only_these({"run", graph, "--set", "n=300"}).empty());
  const std::vector<std::string> again = only_these({"run", graph, "--set", "n=400"});
  EXPECT_EQ(std::count(again.begin(), again.end(), "types.so"), 1);
  EXPECT_EQ(std::count(again.begin(), again.end(), "cover.so"), 0);
  EXPECT_EQ(only_these({"run", graph, "--set", "n=300"}), std::vector<std::string>());
  EXPECT_EQ(only_these({"nodes", "VoronoiPoles"}), std::vector<std::string>());
  const std::vector<std::string> all = only_these({"run", graph, "--set", "n=300", "--no-cache"});
  EXPECT_EQ(std::count(all.begin(), all.end(), "cover.so"), 1) << "without a cache nothing is known";
}

TEST_F(StartTest, needs_no_libcurl_before_an_upstream_is_on_a_server) {
  EXPECT_EQ(opened("libcurl", {"version"}), std::vector<std::string>());
  test::write_file(folder.file("libcurl.so.4"), "no library");
  const std::map<std::string, std::string> without = {{"LD_LIBRARY_PATH", folder.path()}};
  const std::vector<std::string> run = {"run", test::source_file("graphs/shape.json"), "--set", "n=300"};
  EXPECT_EQ(ballflow(run, without).exit_code, 0);
  std::vector<std::string> shared = run;
  shared.insert(shared.end(), {"--upstream", "http://127.0.0.1:1/x"});
  const ProcessResult refused = ballflow(shared, without);
  EXPECT_EQ(refused.exit_code, 5);
  EXPECT_NE(refused.err.find("an upstream on a server needs libcurl, which cannot be loaded"),
            std::string::npos)
      << refused.err;
  EXPECT_NE(refused.err.find("Debian package libcurl4"), std::string::npos) << refused.err;
}

}  // namespace
}  // namespace ballflow
