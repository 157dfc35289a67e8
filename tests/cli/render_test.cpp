// ballflow render: pictures of runs, artifacts and models.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "png_decoder.hpp"
#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

struct RenderTest : testing::Test {
  test::ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }

  test::ProcessResult render(std::vector<std::string> arguments) {
    if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end()) {
      arguments.insert(arguments.end(), {"--size", "120x90"});
    }
    arguments.insert(arguments.end(), {"-o", folder.file("picture.png")});
    arguments.insert(arguments.begin(), "render");
    return ballflow(arguments);
  }

  test::DecodedPng picture() { return test::decode_png(test::read_file(folder.file("picture.png"))); }

  /// Parts of the picture that differ from its white ground.
  int drawn(const test::DecodedPng& png, int from, int to) {
    int count = 0;
    for (int y = 0; y < png.height; ++y) {
      for (int x = from; x < to; ++x) count += png.at(x, y) == std::array{255, 255, 255, 255} ? 0 : 1;
    }
    return count;
  }

  void run_medial_axis() {
    const auto run = ballflow({"run", "--quiet", test::source_file("graphs/medial_axis.json"), "--set",
                               "sampling=vertices", "--set", "growth=additive", "--set", "repair=none",
                               "--set", "input=shape:torus?n=500", "--report", folder.file("report.json")});
    ASSERT_EQ(run.exit_code, 0) << run.err;
  }

  test::TempFolder folder;
};

TEST_F(RenderTest, says_on_a_terminal_how_much_is_drawn) {
  const std::string command = test::binary_file("bin/ballflow") + " render shape:torus --size 300x200 -o " +
                              folder.file("picture.png");
  const auto shown =
      test::run_process({"/usr/bin/script", "-qec", command, "/dev/null"}, {{"TERM", "xterm"}});
  EXPECT_EQ(shown.exit_code, 0) << shown.out << shown.err;
  EXPECT_NE(shown.out.find("\r\033[K  100 % drawn\r\033[K"), std::string::npos) << shown.out;
  EXPECT_EQ(render({"shape:torus"}).err, "") << "in a pipe";
}

TEST_F(RenderTest, draws_the_outputs_of_a_run_the_same_way_each_time) {
  run_medial_axis();
  const auto result = render({"latest"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("(120 x 90)"), std::string::npos) << result.out;
  const test::DecodedPng first = picture();
  EXPECT_EQ(first.width, 120);
  EXPECT_EQ(first.height, 90);
  EXPECT_GT(drawn(first, 0, 120), 1000);
  const std::string bytes = test::read_file(folder.file("picture.png"));
  ASSERT_EQ(render({folder.file("report.json"), "--threads", "1"}).exit_code, 0);
  EXPECT_TRUE(test::read_file(folder.file("picture.png")) == bytes);
}

TEST_F(RenderTest, animates_a_joint) {
  const auto run = ballflow({"run", "--quiet", test::source_file("graphs/check_spheres.json"), "--report",
                             folder.file("report.json")});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto moved = render({"latest", "--animate", "elbow", "--frames", "3"});
  ASSERT_EQ(moved.exit_code, 0) << moved.err;
  const std::string bytes = test::read_file(folder.file("picture.png"));
  EXPECT_NE(bytes.find("acTL"), std::string::npos);
  EXPECT_GT(drawn(picture(), 0, 120), 100);
  ASSERT_EQ(render({"latest", "--animate", "elbow", "--frames", "3", "--threads", "1"}).exit_code, 0);
  EXPECT_TRUE(test::read_file(folder.file("picture.png")) == bytes);
  const auto refused = render({"latest", "--animate", "tail"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("the joints are"), std::string::npos) << refused.err;
  EXPECT_NE(render({"shape:torus", "--animate", "elbow"}).err.find("nothing moves"), std::string::npos);
}

TEST_F(RenderTest, puts_chosen_layers_side_by_side) {
  run_medial_axis();
  ASSERT_EQ(render({"latest", "--beside", "--layers", "balls,medial_axis", "--no-legend"}).exit_code, 0);
  const test::DecodedPng both = picture();
  EXPECT_GT(drawn(both, 0, 60), 300);
  EXPECT_GT(drawn(both, 60, 120), 100);
  ASSERT_EQ(render({"latest", "--layers", "medial_axis/medial axis edges", "--no-legend"}).exit_code, 0);
  EXPECT_LT(drawn(picture(), 0, 120), 120 * 90);
}

TEST_F(RenderTest, draws_artifacts_by_digest_and_models_by_name) {
  run_medial_axis();
  const auto report = nlohmann::json::parse(test::read_file(folder.file("report.json")));
  const auto digest = report.at("outputs").at("balls").at("digest").get<std::string>();
  ASSERT_EQ(render({digest.substr(0, 16), "--ground", "none"}).exit_code, 0);
  EXPECT_EQ(picture().at(0, 0)[3], 0);
  EXPECT_EQ(picture().colour_type, 6);
  const auto shape = render({"shape:box?n=200", "--opacity", "mesh=1", "--view", "top", "--clip", "x=50%"});
  ASSERT_EQ(shape.exit_code, 0) << shape.err;
  EXPECT_GT(drawn(picture(), 0, 55), 500);
  EXPECT_EQ(drawn(picture(), 65, 120), 0);
  test::write_file(folder.file("tetrahedron.off"),
                   "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  ASSERT_EQ(render({folder.file("tetrahedron.off")}).exit_code, 0);
  EXPECT_GT(drawn(picture(), 0, 120), 500);
}

TEST_F(RenderTest, draws_files_of_balls_as_balls) {
  // Four points cover next to nothing, four balls a good part.
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  test::write_file(folder.file("balls.ply"),
                   header + "property float radius\nend_header\n0 0 0 1\n2 0 0 1\n0 2 0 1\n0 0 2 1\n");
  test::write_file(folder.file("points.ply"), header + "end_header\n0 0 0\n2 0 0\n0 2 0\n0 0 2\n");
  ASSERT_EQ(render({folder.file("points.ply"), "--no-legend"}).exit_code, 0);
  const int points = drawn(picture(), 0, 120);
  ASSERT_EQ(render({folder.file("balls.ply"), "--no-legend"}).exit_code, 0);
  EXPECT_GT(drawn(picture(), 0, 120), 1000);
  EXPECT_LT(points, 500);
}

TEST_F(RenderTest, refuses_what_cannot_be_drawn_and_says_what_can) {
  run_medial_axis();
  const auto expect = [&](std::vector<std::string> arguments, const std::string& text) {
    const auto result = render(std::move(arguments));
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(folder.file("picture.png")));
  };
  expect({"latest", "--layers", "bals"}, "did you mean \"balls\"?");
  expect({"latest", "--colour-by", "temperature"}, "no layer has an attribute \"temperature\"");
  expect({"latest", "--opacity", "balls=0"}, "not a number above 0 and at most 1");
  expect({"latest", "--clip", "x"}, "\"x\" is no clipping plane");
  expect({"latest", "--view", "north"}, "there is no view \"north\"");
  expect({"latest", "--ground", "pink"}, "there is no ground \"pink\"");
  expect({"latest", "--size", "10x10"}, "choose a width and a height");
  expect({"latest", "--size", "large"}, "is no size of a picture");
  expect({"shape:teapot"}, "teapot");
  expect({folder.file("absent.off")}, "absent.off");
  expect({"0123456789abcdef"}, "0123456789abcdef");
  EXPECT_EQ(ballflow({"render", "latest"}).exit_code, 2) << "no -o";
}

TEST_F(RenderTest, a_run_without_anything_to_draw_names_its_outputs) {
  test::write_file(folder.file("scp.txt"), "2 3\n1 1 1\n2\n1 2\n1\n3\n");
  ASSERT_EQ(ballflow({"run", "--quiet", test::source_file("graphs/cover.json"), "--set",
                      "file=" + folder.file("scp.txt"), "--set", "strategy=greedy"})
                .exit_code,
            0);
  const auto result = render({"latest"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("has no output that can be drawn"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("cover"), std::string::npos) << result.err;
}

TEST_F(RenderTest, ctrl_c_ends_it_within_a_second_and_leaves_no_file) {
  std::vector<std::string> command = {
      test::binary_file("bin/ballflow"), "render", "shape:torus?n=20000", "--size", "8000x8000", "-o",
      folder.file("large.png")};
  const auto result = test::run_process(command, {{"BALLFLOW_CACHE", folder.file("cache")}}, 2, 2);
  EXPECT_EQ(result.exit_code, 4) << result.err;
  EXPECT_LT(result.seconds, 4);
  EXPECT_FALSE(fs::exists(folder.file("large.png")));
}

}  // namespace
}  // namespace ballflow
