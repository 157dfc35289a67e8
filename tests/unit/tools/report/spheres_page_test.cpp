#include "report/spheres_page.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "report/spheres_measures.hpp"

namespace ballflow::report {
namespace {

using Row = std::vector<std::string>;

/// A link of the volume 2 in three spheres whose union has 3, and whose volumes add up to 5.
LinkCheck enclosed(const std::string& name = "hand") {
  LinkCheck link;
  link.link = name;
  link.enclosure.balls = 3;
  link.enclosure.triangles = 12;
  link.enclosure.closed = 1;
  link.enclosure.area = 10;
  link.enclosure.protrusion = 0.25;
  link.volume = 3;
  link.solid_volume = 2;
  link.ball_volume = 5;
  return link;
}

/// A fifth of its surface is outside, at a place that is named.
LinkCheck open_link(const std::string& name = "base") {
  LinkCheck link = enclosed(name);
  link.enclosure.open_triangles = {7};
  link.enclosure.open_points = {{1, 2, 3}};
  link.enclosure.open_why = {0};
  link.enclosure.open_area = 2;
  link.enclosure.gap = 0.01;
  return link;
}

SpheresCheck check_of(std::vector<LinkCheck> links) {
  SpheresCheck check;
  check.robot = "r.urdf";
  check.spheres = "s.yml";
  check.geometry = "collision";
  check.links = std::move(links);
  check.version = "1.2.3";
  return check;
}

TEST(spheres_page, states_what_other_programs_state) {
  const auto rows = measures(check_of({enclosed(), open_link()}));
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[1], (Row{"hand", "3", "100 %", "100 %", "250 mm", "2.5"}));
  EXPECT_EQ(rows[2], (Row{"base", "3", "80 %", "-", "250 mm", "2.5"}));
  EXPECT_EQ(rows[3], (Row{"all links", "6", "90 %", "-", "250 mm", "2.5"}));
}

TEST(spheres_page, nearly_all_is_not_all) {
  LinkCheck link = open_link();
  link.enclosure.open_area = 1e-9;
  EXPECT_EQ(measures(check_of({link}))[1][2], "over 99.9 %");
  link.enclosure.open_area = 0;  // less than is looked at
  EXPECT_EQ(measures(check_of({link}))[1][2], "over 99.9 %");
}

TEST(spheres_page, what_is_not_known_is_not_stated) {
  LinkCheck sheet = enclosed("sheet");
  sheet.solid_volume = 0;
  sheet.enclosure.closed = 0;
  const auto rows = measures(check_of({sheet, enclosed()}));
  EXPECT_EQ(rows[1], (Row{"sheet", "3", "100 %", "-", "250 mm", "-"}));
  EXPECT_EQ(rows[3], (Row{"all links", "6", "100 %", "-", "250 mm", "-"}));
}

TEST(spheres_page, spheres_inside_cover_their_own_volume) {
  LinkCheck link = open_link();
  link.enclosure.protrusion = 0;
  link.volume = 1.5;
  link.ball_volume = 1.8;
  EXPECT_EQ(measures(check_of({link}))[1], (Row{"base", "3", "80 %", "75 %", "0", "0.9"}));
}

TEST(spheres_page, one_link_needs_no_sum) { EXPECT_EQ(measures(check_of({enclosed()})).size(), 2u); }

TEST(spheres_page, a_curve_has_what_was_tried_and_what_was_made) {
  SpheresCheck check = check_of({enclosed("<hand>")});
  EXPECT_EQ(curves(check), "");
  check.curves = {{"<hand>", {{2, 1.5}, {3, 0.9}, {4, 0.25}}}};
  const std::string plot = curves(check);
  EXPECT_NE(plot.find("<svg"), std::string::npos);
  EXPECT_NE(plot.find("&lt;hand&gt;"), std::string::npos);
  EXPECT_EQ(plot.find("<hand>"), std::string::npos);
  EXPECT_NE(plot.find("volume outside"), std::string::npos);
  EXPECT_NE(plot.find("150"), std::string::npos) << plot;
  EXPECT_NE(plot.find("made"), std::string::npos);
  EXPECT_EQ(plot.find("tried quickly", plot.find("made")) != std::string::npos, true) << "4 come after 3";
  // In place of the quick one with as many spheres: (3 - 2) / 2 outside.
  EXPECT_NE(plot.find("50"), std::string::npos);
  EXPECT_EQ(plot.find(">90<"), std::string::npos);
  check.curves = {{"<hand>", {{3, 0.9}}}};
  EXPECT_EQ(curves(check), "") << "one number alone is no curve";
}

TEST(spheres_page, a_page_holds_its_pictures_and_loads_nothing) {
  SpheresCheck check = check_of({enclosed(), open_link("<b>")});
  check.pictures = {{"What is <left out>", "PNG"}};
  const std::string page = html_page(check);
  EXPECT_NE(page.find("src=\"data:image/png;base64,UE5H\""), std::string::npos);
  EXPECT_NE(page.find("What is &lt;left out&gt;"), std::string::npos);
  EXPECT_EQ(page.find("<b>"), std::string::npos);
  EXPECT_NE(page.find("1 of 2 links enclosed by 6 spheres"), std::string::npos);
  EXPECT_NE(page.find("triangle 7 at (1, 2, 3)"), std::string::npos);
  for (const char* const foreign : {"<script", "http:", "https:", "src=\"/"})
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  const std::string markdown = markdown_page(check);
  EXPECT_NE(markdown.find("| hand | 3 | 100 % | 100 % | 250 mm | 2.5 |"), std::string::npos) << markdown;
  EXPECT_EQ(markdown.find("base64"), std::string::npos);
}

TEST(spheres_page, a_void_is_told_where_the_surface_is_covered) {
  LinkCheck hollow = enclosed();
  hollow.enclosure.void_points = {{0, 0, 0}};
  hollow.enclosure.void_places = {static_cast<std::uint8_t>(geometry::VoidPlace::inside)};
  EXPECT_EQ(verdict(check_of({hollow})),
            "0 of 1 link enclosed by 3 spheres; 1 has voids inside that no sphere fills");
  EXPECT_EQ(verdict(check_of({hollow, open_link()})),
            "0 of 2 links enclosed by 6 spheres; 1 has voids inside that no sphere fills; 10 % of the "
            "surface is outside, "
            "up to 10 mm");
  EXPECT_EQ(measures(check_of({hollow}))[1][3], "-") << "not all of the volume is inside";
}

TEST(spheres_page, a_mesh_is_no_robot) {
  SpheresCheck check = check_of({enclosed("cube.off")});
  EXPECT_NE(markdown_page(check).find("Do the spheres contain the robot?"), std::string::npos);
  check.geometry.clear();
  const std::string page = markdown_page(check);
  EXPECT_NE(page.find("Do the spheres contain the link?"), std::string::npos);
  EXPECT_EQ(page.find("obot"), std::string::npos);
  EXPECT_EQ(page.find("Shapes"), std::string::npos);
}

TEST(spheres_page, all_links_count_for_the_verdict) {
  EXPECT_TRUE(all_enclosed(check_of({enclosed(), enclosed("base")})));
  EXPECT_FALSE(all_enclosed(check_of({enclosed(), open_link()})));
}

}  // namespace
}  // namespace ballflow::report
