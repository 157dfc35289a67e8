// "ballflow look" as a user meets it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

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
  // The command is one that a shell understands and that the program accepts.
  std::string command = found.at("command");
  ASSERT_TRUE(command.starts_with("ballflow run graphs/")) << command;
  command.replace(0, 8, test::binary_file("bin/ballflow"));
  command.replace(command.find("graphs/"), 7, test::source_file("graphs/"));
  command.replace(command.find(" run "), 5, " plan ");
  command.resize(command.find(" --out"));
  const ProcessResult planned =
      test::run_process({"/bin/sh", "-c", command}, {{"BALLFLOW_CACHE", folder.file("cache")}});
  EXPECT_EQ(planned.exit_code, 0) << command << "\n" << planned.err;
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
