// "ballflow look" as a user meets it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProcessResult;

struct LookCli : testing::Test {
  test::TempFolder folder;
  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  /// A generated model as a file.
  std::string model(const std::string& shape, const std::string& format) {
    const ProcessResult made =
        ballflow({"run", test::source_file("graphs/shape.json"), "--set", "shape=" + shape, "--set", "n=4000",
                  "--out", folder.path(), "--format", "mesh=" + format, "--quiet"});
    EXPECT_EQ(made.exit_code, 0) << made.err;
    return folder.file("mesh." + format);
  }
  /// A command is one that a shell understands and that the program accepts.
  void expect_planned(std::string command) {
    ASSERT_TRUE(command.starts_with("ballflow run medial_axis ")) << command;
    command.replace(0, 8, test::binary_file("bin/ballflow"));
    command.replace(command.find(" run "), 5, " plan ");
    command.resize(command.find(" --out"));
    const ProcessResult planned =
        test::run_process({"/bin/sh", "-c", command}, {{"BALLFLOW_CACHE", folder.file("cache")}});
    EXPECT_EQ(planned.exit_code, 0) << command << "\n" << planned.err;
  }
};

TEST_F(LookCli, tells_the_topology_and_the_command_which_runs) {
  const std::string file = model("doubleTorus", "off");
  const ProcessResult text = ballflow({"look", file});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("1 component, 2 tunnels, no cavity"), std::string::npos) << text.out;
  const ProcessResult structured = ballflow({"look", file, "--json"});
  const json found = json::parse(structured.out);
  EXPECT_EQ(found.at("mesh").at("solid").at("betti"), json({1, 2, 0}));
  EXPECT_EQ(found.at("findings").size(), 0u) << found.at("findings").dump(1);
  EXPECT_FALSE(fs::exists(folder.file("look"))) << "nothing is written but what was asked for";
  expect_planned(found.at("command"));
}

TEST_F(LookCli, names_options_that_the_graph_has) {
  const std::string wall = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1e-3\n1 0 1e-3\n1 1 1e-3\n0 1 1e-3\n";
  test::write_file(folder.file("thin plate.off"),
                   "OFF\n8 12 0\n" + wall +
                       "3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n"
                       "3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n");
  std::string points = "0 0 5e4\n";
  for (int i = 0; i < 200; ++i)
    points += std::to_string(std::sin(i)) + " " + std::to_string(std::cos(i)) + " " +
              std::to_string(i / 200.0) + "\n";
  test::write_file(folder.file("stray.xyz"), points);
  std::string cracks = "solid c\n";
  for (const char* facet :
       {"0 0 0 0 1 0 1 0 0", "0 0 0 1 0 0 0 0 1", "0 0 0 0 0 1 0 1 0", "1.00001 0 0 0 1 0 0 0 1"}) {
    std::istringstream in(facet);
    cracks += "facet normal 0 0 0\nouter loop\n";
    std::string x, y, z;
    while (in >> x >> y >> z) cracks += "vertex " + x + " " + y + " " + z + "\n";
    cracks += "endloop\nendfacet\n";
  }
  test::write_file(folder.file("cracks.stl"), cracks + "endsolid c\n");
  for (const auto& [name, option] : std::map<std::string, std::string>{
           {"thin plate.off", "input="}, {"stray.xyz", "strays=drop"}, {"cracks.stl", "weld="}}) {
    const ProcessResult structured = ballflow({"look", folder.file(name), "--json"});
    ASSERT_EQ(structured.exit_code, 0) << structured.err;
    const json found = json::parse(structured.out);
    EXPECT_GE(found.at("findings").size(), 1u) << name;
    const std::string command = found.at("command");
    EXPECT_NE(command.find(option), std::string::npos) << command;
    expect_planned(command);
  }
}

TEST_F(LookCli, draws_a_picture_and_writes_it_over_nothing) {
  const std::string file = model("torus", "stl");
  EXPECT_EQ(ballflow({"look", file, "-o", folder.file("look.png")}).exit_code, 0);
  EXPECT_EQ(test::read_file(folder.file("look.png")).substr(1, 3), "PNG");
  const std::string before = test::read_file(file);
  EXPECT_EQ(ballflow({"look", file, "-o", file}).exit_code, 2);
  EXPECT_EQ(test::read_file(file), before);
}

TEST_F(LookCli, refuses_what_cannot_be_read_with_the_reason) {
  test::write_file(folder.file("bad.off"), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  const ProcessResult bad = ballflow({"look", folder.file("bad.off")});
  EXPECT_EQ(bad.exit_code, 2);
  EXPECT_NE(bad.err.find("vertex index 7 is out of range"), std::string::npos) << bad.err;
  EXPECT_EQ(ballflow({"look", folder.file("nothing.ply")}).exit_code, 2);
}

TEST_F(LookCli, takes_less_than_a_second_for_a_hundred_thousand_triangles) {
  const std::string file = test::data_file("models/stanford_dragon_50k.obj.gz");
  if (file.empty()) GTEST_SKIP() << "no test data";
  // CPU time of this process alone: others may be busy.
  const ProcessResult result = test::run_process(
      {"/bin/bash", "-c", "TIMEFORMAT=%U; time " + test::binary_file("bin/ballflow") + " look " + file});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("100 000 triangles"), std::string::npos) << result.out;
  EXPECT_LT(std::stod(result.err), 2.0) << "a second, with room for a slow machine";
}

}  // namespace
}  // namespace ballflow
