// "ballflow spheres" as a user meets it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;
using test::ProcessResult;

const char* const cube =
    "OFF\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

struct SpheresCli : testing::Test {
  ProcessResult ballflow(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), test::binary_file("bin/ballflow"));
    return test::run_process(arguments, {{"BALLFLOW_CACHE", folder.file("cache")}});
  }
  void write(const std::string& name, const std::string& text) { test::write_file(folder.file(name), text); }
  /// Two links with the same cube as their mesh.
  std::string two_cubes(const std::string& mesh = "cube.off") {
    write(
        "r.urdf",
        "<robot name=\"two\"><link name=\"a\"><collision><geometry><mesh filename=\"" + mesh +
            "\"/></geometry></collision></link><link name=\"b.c\"><collision><geometry><box size=\"1 1 1\"/>"
            "</geometry></collision></link><link name=\"empty\"/><joint name=\"j\" type=\"fixed\"><parent "
            "link=\"a\"/><child link=\"b.c\"/></joint><joint name=\"k\" type=\"fixed\"><parent "
            "link=\"a\"/><child "
            "link=\"empty\"/></joint></robot>");
    return folder.file("r.urdf");
  }
  test::TempFolder folder;
};

TEST_F(SpheresCli, tells_what_spheres_leave_out_link_by_link) {
  const ProcessResult told = ballflow({"spheres", "robot:arm", "--check", "spheres:arm"});
  EXPECT_EQ(told.exit_code, 1) << "the answer is no" << told.err;
  EXPECT_EQ(ballflow({"spheres", "robot:arm", "--check", "spheres:arm", "--links", "left_finger", "--quiet"})
                .exit_code,
            0);
  EXPECT_EQ(
      ballflow({"spheres", "robot:arm", "--check", "spheres:arm", "--buffer", "0.1", "--quiet"}).exit_code,
      0);
  EXPECT_NE(told.out.find("3 of 6 links enclosed by 9 spheres"), std::string::npos) << told.out;
  std::istringstream lines(told.out);
  std::string line, base, finger;
  while (std::getline(lines, line)) {
    if (line.starts_with("base ")) base = line;
    if (line.starts_with("left_finger ")) finger = line;
  }
  EXPECT_NE(base.find("not enclosed"), std::string::npos) << told.out;
  EXPECT_NE(finger.find("enclosed: proven"), std::string::npos) << told.out;
}

TEST_F(SpheresCli, writes_a_page_that_stands_alone) {
  two_cubes();
  write("cube.off", cube);
  write("s.csv", "link,x,y,z,radius\na,0.5,0.5,0.5,0.8661\nb.c,0,0,0,0.5\n");
  for (const char* const page : {"p.md", "p.html"}) {
    const ProcessResult made =
        ballflow({"spheres", folder.file("r.urdf"), "--check", folder.file("s.csv"), "--page",
                  folder.file(page), "--picture", folder.file("p.png"), "--quiet"});
    EXPECT_EQ(made.exit_code, 1) << made.err;
    EXPECT_EQ(test::read_file(folder.file("p.png")).substr(1, 3), "PNG");
    EXPECT_EQ(made.out, "");
    const std::string text = test::read_file(folder.file(page));
    for (const char* const part : {"1 of 2 links enclosed by 2 spheres", "b.c", "r.urdf", "s.csv", "SHA-256",
                                   "not enclosed", "volume inside"})
      EXPECT_NE(text.find(part), std::string::npos) << page << part << text;
    EXPECT_EQ(text.find(folder.path()), std::string::npos) << "names of files, not where they are";
    EXPECT_EQ(text.find("http"), std::string::npos);
    EXPECT_EQ(text.find("data:image/png;base64,") != std::string::npos, page == std::string("p.html"));
  }
}

TEST_F(SpheresCli, a_changed_mesh_is_never_a_stale_hit) {
  two_cubes();
  write("cube.off", cube);
  write("s.csv", "link,x,y,z,radius\na,0.5,0.5,0.5,0.8661\nb.c,0,0,0,0.8661\n");
  const std::vector<std::string> command = {"spheres", folder.file("r.urdf"), "--check",
                                            folder.file("s.csv")};
  EXPECT_NE(ballflow(command).out.find("2 links are enclosed by 2 spheres: proven;"), std::string::npos);
  const ProcessResult again = ballflow(command);
  EXPECT_NE(again.out.find("\n0 run, "), std::string::npos) << again.out;
  std::string longer = cube;
  longer.replace(longer.find("1 1 1\n"), 5, "1 1 3");
  write("cube.off", longer);
  const ProcessResult changed = ballflow(command);
  EXPECT_NE(changed.out.find("1 of 2 links enclosed"), std::string::npos) << changed.out;
  // The robot, the spheres, which take it, and all of link a but its balls and what those give; nothing of
  // link b.c after its mesh, whose bytes are as before.
  EXPECT_EQ(changed.out.find("verify"), std::string::npos);
}

TEST_F(SpheresCli, links_visual_shapes_and_packages_are_chosen) {
  two_cubes("package://p/m/cube.off");
  write("elsewhere/p/m/cube.off", cube);
  write("s.csv", "link,x,y,z,radius\na,0.5,0.5,0.5,0.9\n");
  const std::string robot = folder.file("r.urdf"), spheres = folder.file("s.csv");
  const ProcessResult one = ballflow(
      {"spheres", robot, "--check", spheres, "--links", "a", "--packages", folder.file("elsewhere")});
  EXPECT_NE(one.out.find("1 link is enclosed by 1 sphere: proven"), std::string::npos) << one.out << one.err;
  const ProcessResult nowhere =
      ballflow({"spheres", robot, "--check", spheres, "--links", "a", "--packages", "nowhere", "--no-cache"});
  EXPECT_EQ(nowhere.exit_code, 0) << "below the folder of the URDF it is found by its name\n" << nowhere.err;
  EXPECT_NE(nowhere.err.find("is not there"), std::string::npos) << nowhere.err;
  const ProcessResult visual = ballflow({"spheres", robot, "--check", spheres, "--visual"});
  EXPECT_EQ(visual.exit_code, 2);
  EXPECT_NE(visual.err.find("no link has a shape that is meant to be seen"), std::string::npos) << visual.err;
  const ProcessResult typo = ballflow({"spheres", robot, "--check", spheres, "--links", "b_c"});
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_NE(typo.err.find("did you mean \"b.c\"?"), std::string::npos) << typo.err;
}

TEST_F(SpheresCli, a_mesh_is_checked_by_itself) {
  write("cube.off", cube);
  write("balls.csv", "x,y,z,r\n0.5,0.5,0.5,0.87\n");
  const ProcessResult told =
      ballflow({"spheres", folder.file("cube.off"), "--check", folder.file("balls.csv")});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_NE(told.out.find("1 link is enclosed by 1 sphere: proven"), std::string::npos) << told.out;
  EXPECT_EQ(
      ballflow({"spheres", folder.file("cube.off"), "--check", folder.file("balls.csv"), "--links", "a"})
          .exit_code,
      2);
}

TEST_F(SpheresCli, a_mesh_gets_a_page_too) {
  write("cube.off", cube);
  const ProcessResult made = ballflow({"spheres", folder.file("cube.off"), "--balls", "2", "--effort", "low",
                                       "--page", folder.file("p.html"), "--picture", folder.file("p.png")});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const std::string page = test::read_file(folder.file("p.html"));
  for (const char* const part : {"1 link is enclosed by", "Link: cube.off", "data:image/png;base64,"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(test::read_file(folder.file("p.png")).substr(1, 3), "PNG");
  EXPECT_EQ(ballflow({"spheres", folder.file("cube.off"), "--page", folder.file("cube.off")}).exit_code, 2);
}

TEST_F(SpheresCli, what_is_wrong_is_said_before_anything_runs) {
  two_cubes("gone.off");
  write("s.csv", "link,x,y,z,radius\na,0.5,0.5,0.5,0.9\n");
  const ProcessResult gone = ballflow({"spheres", folder.file("r.urdf"), "--check", folder.file("s.csv")});
  EXPECT_EQ(gone.exit_code, 3);
  EXPECT_NE(gone.err.find("there is no mesh \"gone.off\""), std::string::npos) << gone.err;
  write("loop.urdf",
        "<robot><link name=\"a\"/><joint name=\"j\" type=\"fixed\"><parent link=\"a\"/><child "
        "link=\"a\"/></joint></robot>");
  const ProcessResult loop = ballflow({"spheres", folder.file("loop.urdf"), "--check", folder.file("s.csv")});
  EXPECT_EQ(loop.exit_code, 2);
  EXPECT_NE(loop.err.find("the joints run in a circle"), std::string::npos) << loop.err;
  EXPECT_EQ(ballflow({"spheres", folder.file("none.urdf"), "--check", folder.file("s.csv")}).exit_code, 2);
  // What is read is not written over: neither the spheres nor a mesh that only the URDF names.
  write("gone.off", cube);
  for (const char* const name : {"s.csv", "r.urdf", "gone.off"}) {
    const ProcessResult over = ballflow(
        {"spheres", folder.file("r.urdf"), "--check", folder.file("s.csv"), "--page", folder.file(name)});
    EXPECT_EQ(over.exit_code, 2) << name;
    EXPECT_NE(over.err.find("nothing was run, and no file was changed"), std::string::npos) << over.err;
  }
}

TEST_F(SpheresCli, makes_spheres_that_contain_links_and_reads_them_back) {
  const std::string out = folder.file("out");
  const ProcessResult made = ballflow(
      {"spheres", "robot:arm", "--links", "hand,left_finger", "--balls", "12", "--effort", "low", "--out",
       out, "--format", "urdf,srdf,curobo,xrdf,foam,mjcf,csv", "--page", folder.file("made.html")});
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const std::string page = test::read_file(folder.file("made.html"));
  for (const char* const part :
       {"How many spheres do how well", "<svg", "volume outside, % of the link", ">hand<",
        "Links and spheres", "data:image/png;base64,", "sum of spheres / link"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_NE(made.out.find("2 links are enclosed by 12 spheres: proven; "), std::string::npos) << made.out;
  for (const char* const file :
       {"spheres.urdf", "spheres.srdf", "spheres.yml", "spheres.xrdf", "spheres.json", "spheres.csv"}) {
    const ProcessResult read =
        ballflow({"spheres", "robot:arm", "--links", "hand,left_finger", "--check", out + "/" + file});
    EXPECT_NE(read.out.find("2 links are enclosed by 12 spheres: proven"), std::string::npos)
        << file << read.out << read.err;
  }
  EXPECT_TRUE(fs::exists(out + "/spheres.xml"));
  // A number for one link computes that link alone.
  const ProcessResult other =
      ballflow({"spheres", "robot:arm", "--links", "hand,left_finger", "--balls", "14", "--effort", "low",
                "--per-link", "hand=8,*finger=6", "--out", out});
  EXPECT_NE(other.out.find("2 links are enclosed by 14 spheres"), std::string::npos)
      << other.out << other.err;
  const ProcessResult same =
      ballflow({"spheres", "robot:arm", "--links", "hand,left_finger", "--balls", "15", "--effort", "low",
                "--per-link", "hand=8,*finger=7", "--out", out, "--report", folder.file("report.json")});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  std::map<std::string, std::string> status;
  const auto report = nlohmann::json::parse(test::read_file(folder.file("report.json")));
  for (const auto& [path, node] : report.at("nodes").items()) status[path] = node.at("status");
  EXPECT_EQ(status["links[hand]/enclose/enclose"], "hit");
  EXPECT_EQ(status["links[left_finger]/enclose/enclose"], "run");
  // Where all numbers are fixed nothing is handed out, so no fits with many balls are made for that.
  EXPECT_EQ(status.count("curves[hand]/with[1]/enclose"), 1U);
  EXPECT_EQ(status.count("curves[hand]/with[64]/enclose"), 0U);
}

TEST_F(SpheresCli, wrong_wishes_are_named) {
  const auto refusal = [&](std::vector<std::string> more) {
    std::vector<std::string> all = {"spheres", "robot:arm"};
    all.insert(all.end(), more.begin(), more.end());
    const ProcessResult result = ballflow(all);
    EXPECT_EQ(result.exit_code, 2) << result.out;
    return result.err;
  };
  EXPECT_NE(refusal({"--per-link", "hnd=3"}).find("did you mean \"hand\"?"), std::string::npos);
  EXPECT_NE(refusal({"--per-link", "hand=0"}).find("is no number of balls"), std::string::npos);
  EXPECT_NE(refusal({"--mode", "protrude", "--within", "-1mm"}).find("is no length"), std::string::npos);
  EXPECT_NE(refusal({"--format", "obj"}).find("formats are urdf"), std::string::npos);
}

/// Spheres that programs ship, with the meshes of their links, as a URDF and a YAML file.
void unpack(const std::string& tool, const std::string& into) {
  const std::string script = R"(
import glob, gzip, os, struct, sys
source, tool, into = sys.argv[1:]
links = []
for file in sorted(glob.glob(source + '/' + tool + '-*.txt.gz')):
    name = os.path.basename(file)[len(tool) + 1:-7]
    lines = gzip.open(file, 'rt').read().split('\n')
    triangles, spheres = map(int, lines[0].split()[:2])
    with open(into + '/' + name + '.stl', 'wb') as out:
        out.write(b'\0' * 80 + struct.pack('<I', triangles))
        for line in lines[1:1 + triangles]:
            out.write(struct.pack('<12fH', 0, 0, 0, *map(float, line.split()), 0))
    links.append((name, [line.split() for line in lines[1 + triangles:1 + triangles + spheres]]))
with open(into + '/robot.urdf', 'w') as out:
    out.write('<robot name="r">')
    for name, _ in links:
        out.write('<link name="%s"><collision><geometry><mesh filename="%s.stl"/></geometry></collision></link>' % (name, name))
    for i in range(1, len(links)):
        out.write('<joint name="j%d" type="fixed"><parent link="%s"/><child link="%s"/></joint>' % (i, links[0][0], links[i][0]))
    out.write('</robot>')
with open(into + '/spheres.yml', 'w') as out:
    out.write('robot_cfg:\n  kinematics:\n    collision_spheres:\n')
    for name, spheres in links:
        out.write('      %s:\n' % name)
        for x, y, z, r in spheres:
            out.write('      - "center": [%s, %s, %s]\n        "radius": %s\n' % (x, y, z, r))
)";
  const std::string source = fs::path(test::data_file("spheres/README.md")).parent_path().string();
  const ProcessResult made =
      test::run_process({"/usr/bin/env", "python3", "-c", script, source, tool, into}, {});
  ASSERT_EQ(made.exit_code, 0) << made.err;
}

TEST_F(SpheresCli, shipped_models_leave_out_what_was_measured) {
  if (test::data_file("spheres/README.md").empty()) GTEST_SKIP() << "SKIPPED: no spheres of other programs";
  struct Model {
    const char *tool, *verdict;
  };
  for (const auto& [tool, verdict] :
       {Model{"curobo",
              "0 of 10 links enclosed by 59 spheres; 75.6 % of the surface is outside, up to 100 mm"},
        Model{"morphit_panda",
              "0 of 11 links enclosed by 220 spheres; 36.7 % of the surface is outside, up to 18.7 mm"}}) {
    fs::create_directories(folder.file(tool));
    unpack(tool, folder.file(tool));
    const ProcessResult told = ballflow({"spheres", folder.file(tool) + std::string("/robot.urdf"), "--check",
                                         folder.file(tool) + std::string("/spheres.yml")});
    EXPECT_NE(told.out.find(verdict), std::string::npos) << told.out << told.err;
  }
}

}  // namespace
}  // namespace ballflow
