// What the command line exports of a real run, in every format that it offers.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "check_exports.hpp"

namespace ballflow {
namespace {

using nlohmann::json;
using test::ProcessResult;

struct ExportTest : testing::Test {
  test::TempFolder folder;
  std::string prior;  // digest of the model of shapes that a graph has made

  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }

  /// Type and digest of the outputs of a graph.
  std::map<std::string, std::pair<std::string, std::string>> outputs(const std::string& graph) {
    const std::string report = folder.file("report.json");
    std::vector<std::string> run = {"run", test::source_file("graphs/" + graph + ".json"), "--report",
                                    report};
    run.insert(run.end(), {"--set", graph == "check_spheres"      ? "links=hand,left_finger"
                                    : graph == "discs"            ? "polygon=polygon:gear"
                                    : graph == "ball_distance"    ? "threshold=1"
                                    : graph == "sweep_along_path" ? "tool=shape:sphere?n=400&R=0.2"
                                    : graph == "path"             ? "robot=shape:sphere?n=400&R=0.1"
                                    : graph == "shape_prior"      ? "balls=20"
                                    : graph == "shape_fit"        ? "prior=" + prior
                                    : graph == "ellipsoids"       ? "delta=4"
                                                                  : "input=shape:torus?n=1500"});
    if (graph == "shape_prior") run.insert(run.end(), {"--set", "points=1000", "--set", "samples=300"});
    if (graph == "shape_fit") run.insert(run.end(), {"--set", "extent=whole", "--set", "samples=300"});
    const ProcessResult result = ballflow(run);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    std::map<std::string, std::pair<std::string, std::string>> found;
    const json document = json::parse(test::read_file(report));
    for (const auto& [name, output] : document.at("outputs").items()) {
      found[name] = {output.at("type"), output.at("digest")};
      if (output.at("type") == "ShapePrior") prior = output.at("digest");
    }
    return found;
  }

  /// Outputs of maps have a slash in their names.
  static std::string file_of(const char* graph, std::string name) {
    std::replace(name.begin(), name.end(), '/', '-');
    return std::string(graph) + "-" + name;
  }

  /// The formats of every type, from the help: "  Balls    ply, csv".
  std::map<std::string, std::vector<std::string>> formats() {
    std::map<std::string, std::vector<std::string>> result;
    std::istringstream lines(ballflow({"export", "--help"}).out);
    bool table = false;
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("Formats by type", 0) == 0) {
        table = true;
      } else if (table && line.rfind("  ", 0) == 0 && line.rfind("  any", 0) != 0) {
        std::istringstream words(line);
        std::string type, format;
        words >> type;
        while (words >> format) result[type].push_back(format.substr(0, format.find(',')));
      }
    }
    return result;
  }
};

TEST_F(ExportTest, every_type_of_a_run_is_exported_to_the_last_bit_in_every_format) {
  if (!test::has_python()) GTEST_SKIP() << "needs python3";
  const auto known = formats();
  ASSERT_GE(known.size(), 7u);
  std::map<std::string, int> written;
  std::size_t files = 0;
  for (const char* graph :
       {"dmt", "medial_axis", "growth", "local_feature_size", "seed_polytope", "check_spheres", "discs",
        "ball_distance", "sweep_along_path", "path", "shape_prior", "shape_fit", "ellipsoids"}) {
    for (const auto& [name, output] : outputs(graph)) {
      const auto& [type, digest] = output;
      const std::vector<std::string> all =
          known.count(type) != 0 ? known.at(type) : std::vector<std::string>{"json", "safetensors"};
      for (const std::string& format : all) {
        const ProcessResult result =
            ballflow({"export", digest, folder.file(file_of(graph, name) + "." + format)});
        EXPECT_EQ(result.exit_code, 0) << type << " " << format << ": " << result.err;
        files += format != "safetensors" ? 1 : 0;
      }
      ++written[type];
    }
  }
  for (const auto& [type, list] : known) EXPECT_GT(written[type], 0) << type << " was not tried";
  const ProcessResult check = test::check_exports(folder);
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
  EXPECT_EQ(test::count(check.out, "equal "), files) << check.out;
}

TEST_F(ExportTest, files_of_balls_are_balls_everywhere) {
  const std::string out = folder.file("out");
  const ProcessResult run =
      ballflow({"run", "--quiet", test::source_file("graphs/balls.json"), "--set",
                "file=balls:0 0 0 1; 1.5 0 0 0.5; 0 1.25 0 0.75", "--out", out, "--format", "balls=ply"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const std::string ply = out + "/balls.ply", csv = folder.file("balls.csv"),
                    again = folder.file("again.ply");
  const ProcessResult exported = ballflow({"export", ply, csv});
  ASSERT_EQ(exported.exit_code, 0) << exported.err;
  EXPECT_NE(exported.out.find("(Balls)"), std::string::npos) << exported.out;
  EXPECT_EQ(test::read_file(csv), "x,y,z,r\n0,0,0,1\n1.5,0,0,0.5\n0,1.25,0,0.75\n");
  ASSERT_EQ(ballflow({"export", csv, again}).exit_code, 0);
  EXPECT_TRUE(test::read_file(again) == test::read_file(ply));
  ASSERT_EQ(ballflow({"export", ply, csv, "--scale", "0.5"}).exit_code, 0);
  EXPECT_EQ(test::read_file(csv), "x,y,z,r\n0,0,0,0.5\n0.75,0,0,0.25\n0,0.625,0,0.375\n");
  ASSERT_EQ(ballflow({"export", ply, folder.file("balls.yaml"), "--scale", "mm"}).exit_code, 0);
  EXPECT_NE(test::read_file(folder.file("balls.yaml")).find("center: [0.0015, 0, 0]\n      radius: 5e-04"),
            std::string::npos)
      << test::read_file(folder.file("balls.yaml"));
  for (const auto& [file, scale] :
       {std::pair("wrong.ply", "0"), std::pair("wrong.ply", "1.7e308"), std::pair("wrong.json", "mm")}) {
    EXPECT_EQ(ballflow({"export", ply, folder.file(file), "--scale", scale}).exit_code, 2) << scale;
  }
  // A model is a mesh, or points.
  test::write_file(folder.file("a.off"),
                   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  EXPECT_NE(ballflow({"export", folder.file("a.off"), folder.file("a.stl")}).out.find("(TriangleMesh)"),
            std::string::npos);
  test::write_file(folder.file("a.xyz"), "0 0 0\n1 0 0\n0 1 0\n0 0 1\n");
  EXPECT_NE(ballflow({"export", folder.file("a.xyz"), folder.file("a.npy")}).out.find("(PointSet)"),
            std::string::npos);
  test::write_file(folder.file("bad.off"), "OFF\n4 4 0\n0 0 x\n");
  const ProcessResult bad = ballflow({"export", folder.file("bad.off"), folder.file("b.stl")});
  EXPECT_EQ(bad.exit_code, 2);
}

}  // namespace
}  // namespace ballflow
