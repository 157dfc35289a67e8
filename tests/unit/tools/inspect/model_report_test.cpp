#include "inspect/model_report.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "inspect/picture.hpp"
#include "test_data.hpp"

namespace ballflow::inspect {
namespace {

struct InspectTest : testing::Test {
  test::TempFolder folder;

  ModelReport look(const std::string& name, const std::string& content) {
    test::write_file(folder.file(name), content);
    return look_at_file(folder.file(name));
  }
  static std::string all_findings(const ModelReport& report) {
    std::string text;
    for (const Finding& finding : report.findings) text += finding.what + " -> " + finding.remedy + "\n";
    return text;
  }
};

/// A box from 0 to `size`, of 12 triangles.
std::string box(const std::string& size, const std::string& without = "") {
  std::string text = "OFF\n8 " + std::string(without.empty() ? "12" : "11") + " 0\n";
  for (int i = 0; i < 8; ++i)
    text += (i & 1 ? size : "0") + " " + (i & 2 ? size : "0") + " " + (i & 4 ? size : "0") + "\n";
  for (const char* face : {"0 2 1", "1 2 3", "4 5 6", "5 7 6", "0 1 4", "1 5 4", "2 6 3", "3 6 7", "0 4 2",
                           "2 4 6", "1 3 5", "3 7 5"}) {
    if (face != without) text += "3 " + std::string(face) + "\n";
  }
  return text;
}

TEST_F(InspectTest, a_closed_box_is_said_to_be_one) {
  const ModelReport report = look("box.off", box("40"));
  EXPECT_EQ(report.labels, "mesh");
  EXPECT_EQ(report.samples, -1);  // Refine chooses them
  EXPECT_EQ(report.units, "millimetres");
  const std::string text = text_of(report);
  for (const char* words :
       {"a mesh, OFF", "8 vertices, 12 triangles", "40 x 40 x 40", "closed, manifold", "no triangles cross",
        "1 component, no tunnel, no cavity; volume 6.4e+04, area 9600", "the thinnest: 40 at",
        "the narrowest: none", "ballflow run medial_axis --set input="})
    EXPECT_NE(text.find(words), std::string::npos) << words << "\n" << text;
  // Eight samples could not show a box.
  EXPECT_NE(all_findings(report).find("thinner than its triangle is long"), std::string::npos)
      << all_findings(report);
  EXPECT_NE(all_findings(report).find("sampling=auto"), std::string::npos) << all_findings(report);

  const Json json = json_of(report);
  EXPECT_EQ(json.at("mesh").at("closed"), true);
  EXPECT_EQ(json.at("mesh").at("solid").at("betti"), Json({1, 0, 0}));
  EXPECT_DOUBLE_EQ(json.at("mesh").at("solid").at("volume").get<double>(), 64000);
  EXPECT_EQ(json.at("mesh").at("self_intersections").at("count"), 0);
  EXPECT_EQ(json.at("run").at("labels"), "mesh");
  EXPECT_EQ(json.at("command"), report.command);
}

TEST_F(InspectTest, an_open_box_names_its_hole_and_how_it_is_labelled) {
  const ModelReport report = look("open.off", box("1", "0 2 1"));
  EXPECT_EQ(report.labels, "winding");
  EXPECT_NE(all_findings(report).find("3 edges with one triangle in 1 rim"), std::string::npos)
      << all_findings(report);
  EXPECT_NE(all_findings(report).find("no welding closes it"), std::string::npos) << all_findings(report);
  EXPECT_NE(text_of(report).find("topology unknown: the surface is open"), std::string::npos);
  EXPECT_EQ(json_of(report).at("mesh").at("solid").at("betti"), Json(nullptr));
}

TEST_F(InspectTest, cracks_are_told_with_the_distance_that_closes_them) {
  // The box again, every triangle with corners of its own, every second one moved a little.
  std::istringstream in(box("1"));
  std::string word;
  for (int i = 0; i < 4; ++i) in >> word;
  std::vector<std::array<double, 3>> corners(8);
  for (auto& c : corners) in >> c[0] >> c[1] >> c[2];
  std::ostringstream stl;
  stl << "solid box\n";
  for (int f = 0; f < 12; ++f) {
    int n = 0;
    std::size_t v = 0;
    in >> n;
    stl << "facet normal 0 0 0\nouter loop\n";
    for (int k = 0; k < 3; ++k) {
      in >> v;
      stl << "vertex " << corners[v][0] + (f % 2) * 1e-4 << " " << corners[v][1] << " " << corners[v][2]
          << "\n";
    }
    stl << "endloop\nendfacet\n";
  }
  stl << "endsolid box\n";
  const ModelReport report = look("cracks.stl", stl.str());
  const std::string findings = all_findings(report);
  EXPECT_NE(findings.find(".weld="), std::string::npos) << findings;
  EXPECT_NE(findings.find("closes all of it, and gives a solid with 1 component, no tunnel, no cavity"),
            std::string::npos)
      << findings;
  EXPECT_EQ(findings.find("cross"), std::string::npos) << "flanks of cracks are not worth a finding\n"
                                                       << findings;
  EXPECT_NE(report.command.find(".weld="), std::string::npos) << report.command;
  EXPECT_EQ(json_of(report).at("mesh").at("gaps").at("weld").at("closed"), true);
}

TEST_F(InspectTest, sizes_beyond_what_doubles_square_are_told_with_a_scale) {
  for (const char* size : {"1e200", "1e-200"}) {
    const ModelReport report = look("far.off", box(size));
    ASSERT_FALSE(report.findings.empty());
    EXPECT_NE(report.findings[0].what.find(size[2] == '2' ? "1e+200 long" : "1e-200 long"), std::string::npos)
        << report.findings[0].what;
    EXPECT_NE(report.command.find(".scale=1e"), std::string::npos) << report.command;
  }
}

TEST_F(InspectTest, points_far_away_are_named) {
  std::ostringstream points;
  for (int i = 0; i < 300; ++i) points << std::sin(i) << " " << std::cos(i) << " " << i / 300.0 << "\n";
  const ModelReport report = look("cloud.xyz", points.str() + "0 0 5000\n");
  EXPECT_EQ(report.labels, "angle");
  EXPECT_NE(all_findings(report).find("1 point lies "), std::string::npos) << all_findings(report);
  EXPECT_NE(all_findings(report).find("(0, 0, 5000)"), std::string::npos) << all_findings(report);
  EXPECT_NE(report.command.find(".strays=drop"), std::string::npos) << report.command;
  EXPECT_EQ(json_of(report).at("stray_points").at("first"), Json({300}));
}

TEST_F(InspectTest, what_the_reader_changed_is_listed_and_names_are_words_of_a_shell) {
  const ModelReport report = look("two words.off", box("1"));
  EXPECT_TRUE(report.read.empty());
  EXPECT_NE(report.command.find("two words.off'"), std::string::npos) << report.command;
  std::string repeated = box("1");
  repeated.replace(repeated.find("8 12 0"), 6, "8 13 0");
  const ModelReport twice = look("twice.off", repeated + "3 0 2 2\n");
  ASSERT_FALSE(twice.read.empty());
  EXPECT_NE(text_of(twice).find("1 degenerate face is dropped"), std::string::npos) << text_of(twice);
}

TEST_F(InspectTest, no_line_of_the_text_is_long) {
  const ModelReport report = look("open.off", box("1", "0 2 1"));
  std::istringstream lines(text_of(report));
  for (std::string line; std::getline(lines, line);) {
    if (line.find(folder.path()) != std::string::npos) continue;
    EXPECT_LE(line.size(), 104u) << line;
  }
}

TEST_F(InspectTest, the_picture_shows_the_walls_the_rims_and_the_marks) {
  const auto names = [](const std::vector<show::Layer>& layers) {
    std::string text;
    for (const show::Layer& layer : layers) {
      EXPECT_EQ(show::broken_invariant(layer), "");
      text += layer.name + (layer.colour_by.empty() ? "" : " by " + layer.colour_by) + ";";
    }
    return text;
  };
  EXPECT_EQ(names(layers_of(look("box.off", box("40")))), "mesh by wall;marks by mark;");
  EXPECT_EQ(names(layers_of(look("open.off", box("1", "0 2 1")))), "mesh;open edges;");
}

TEST(guess_units, says_why) {
  EXPECT_EQ(guess_units("STL", 120).first, "millimetres");
  EXPECT_EQ(guess_units("OBJ", 1.0).first, "none");
  EXPECT_EQ(guess_units("PLY", 0.35).first, "metres");
  EXPECT_EQ(guess_units("PLY", 1e7).first, "unknown");
  EXPECT_NE(guess_units("STL", 120).second.find("120"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::inspect
