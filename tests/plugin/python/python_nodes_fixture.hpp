// A folder with nodes in Python and a graph of theirs, and the program that runs it.
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

/// An interpreter that has numpy; empty where there is none.
inline const std::string& interpreter() {
  static const std::string found = [] {
    const char* const named = std::getenv("BALLFLOW_PYTHON");
    for (const std::string& python :
         {std::string(named != nullptr ? named : ""), std::string("/usr/bin/python3"),
          std::string("/usr/local/bin/python3")}) {
      if (!python.empty() && fs::exists(python) &&
          test::run_process({python, "-c", "import sys, numpy; assert sys.version_info >= (3, 10)"})
                  .exit_code == 0)
        return python;
    }
    return std::string();
  }();
  return found;
}

inline const std::string scale = R"(import ballflow as bf
import numpy as np

def factor_of(x):
    return x * 1.0

def unrelated():
    return 1

@bf.node(inputs={"balls": bf.Balls}, outputs={"balls": bf.Balls})
def Scale(balls, factor: float = 2.0):
    "Multiplies every radius."
    print("scaling")
    return bf.Balls(balls.centers, balls.radii * factor_of(factor))

@bf.node
def Row(count: int = 5) -> bf.Balls:
    "Balls in a row."
    centers = np.zeros((count, 3))
    centers[:, 0] = np.arange(count)
    return bf.Balls(centers, np.ones(count))
)";

inline const std::string scale_graph = R"({"nodes": {
  "row": {"type": "Row", "params": {"count": 7}},
  "scale": {"type": "Scale", "params": {"factor": 3}, "inputs": {"balls": "row.balls"}},
  "alpha": {"type": "AlphaShape", "inputs": {"balls": "scale.balls"}}},
  "outputs": {"balls": "scale.balls", "complex": "alpha.complex"}})";

struct PythonNodes : testing::Test {
  void SetUp() override {
    if (interpreter().empty())
      GTEST_SKIP() << "no python3 (3.10 or later) with numpy; see tools/packages.txt";
    file("nodes.py", scale);
    file("graph.json", scale_graph);
  }

  std::string file(const std::string& name, const std::string& content) {
    test::write_file(folder.file(name), content);
    return folder.file(name);
  }
  std::map<std::string, std::string> environment() const {
    return {{"BALLFLOW_CACHE", folder.file("cache")}, {"BALLFLOW_PYTHON", interpreter()}};
  }
  ProcessResult ballflow(std::vector<std::string> arguments, const std::string& library = "nodes.py") const {
    arguments.insert(arguments.begin(),
                     {test::binary_file("bin/ballflow"), "--plugin", folder.file(library)});
    return test::run_process(arguments, environment());
  }
  /// Runs the graph, or another one; what each node did ("run", "hit").
  std::map<std::string, std::string> states(std::vector<std::string> options = {},
                                            const std::string& graph = "graph.json") const {
    options.insert(options.begin(), {"run", folder.file(graph), "--report", folder.file("report.json")});
    const ProcessResult result = ballflow(options);
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    std::map<std::string, std::string> all;
    if (result.exit_code != 0) return all;
    const json report = json::parse(test::read_file(folder.file("report.json")));
    for (const auto& [path, node] : report.at("nodes").items()) all[path] = node.at("status");
    return all;
  }
  void replace(const std::string& name, const std::string& what, const std::string& by) const {
    std::string content = test::read_file(folder.file(name));
    const std::size_t at = content.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    test::write_file(folder.file(name), content.replace(at, what.size(), by));
  }
  /// Processes that were started with this cache: no other test has it.
  std::vector<std::string> processes() const {
    std::vector<std::string> found;
    std::error_code error;
    for (fs::directory_iterator entry("/proc", error), end; !error && entry != end; entry.increment(error)) {
      const std::string name = entry->path().filename().string();
      if (name.find_first_not_of("0123456789") != std::string::npos) continue;
      try {
        const std::string command = test::read_file("/proc/" + name + "/cmdline");
        if (command.find("_worker.py") != std::string::npos &&
            test::read_file("/proc/" + name + "/environ").find(folder.path()) != std::string::npos)
          found.push_back(name);
      } catch (const std::exception&) {
        continue;  // it has ended meanwhile, or is somebody else's
      }
    }
    return found;
  }
  /// The kernel takes a moment to end what a killed process has left.
  bool all_end() const {
    for (int i = 0; i < 1000 && !processes().empty(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return processes().empty();
  }

  test::TempFolder folder;
};

}  // namespace ballflow
