#include "types/axis_sheets.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace ballflow::geometry {
namespace {

using Corners = std::vector<std::int32_t>;

MedialAxis complex_of(std::size_t vertices, const std::vector<Corners>& polygons) {
  MedialAxis axis;
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < vertices; ++i) places.push_back({static_cast<double>(i), 0, 0});
  std::vector<std::int64_t> offsets{0};
  Corners corners;
  for (const Corners& polygon : polygons) {
    corners.insert(corners.end(), polygon.begin(), polygon.end());
    offsets.push_back(static_cast<std::int64_t>(corners.size()));
  }
  axis.vertices = std::move(places);
  axis.radii = std::vector<double>(vertices, 1.0);
  axis.polygon_offsets = std::move(offsets);
  axis.polygon_vertices = std::move(corners);
  axis.polygon_kinds = std::vector<std::uint8_t>(polygons.size(), 0);
  return axis;
}

using Ids = Array<std::int32_t>;
using Marks = Array<std::uint8_t>;
using Edges = Array<std::array<std::int32_t, 2>>;

TEST(axis_sheets, of_no_polygons_are_none) {
  const MedialAxis axis = with_sheets(complex_of(2, {}));
  EXPECT_TRUE(axis.polygon_sheets.empty());
  EXPECT_TRUE(axis.sheet_orientable.empty());
  EXPECT_TRUE(axis.seams.empty());
  EXPECT_EQ(broken_invariant(axis), "");
}

TEST(axis_sheets, turn_polygons_so_that_neighbours_run_through_their_edge_in_opposite_directions) {
  // A strip of three triangles; the middle one faces the other way.
  const MedialAxis axis = with_sheets(complex_of(5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));
  EXPECT_EQ(axis.polygon_vertices, (Ids{0, 1, 2, 1, 3, 2, 2, 3, 4}));
  EXPECT_EQ(axis.polygon_sheets, (Ids{0, 0, 0}));
  EXPECT_EQ(axis.sheet_orientable, (Marks{1}));
  EXPECT_EQ(broken_invariant(axis), "");
}

TEST(axis_sheets, end_at_an_edge_of_three_polygons) {
  const MedialAxis axis = with_sheets(complex_of(6, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 4, 5}}));
  EXPECT_EQ(axis.polygon_sheets, (Ids{0, 1, 2, 2}));
  EXPECT_EQ(axis.seams, (Edges{{0, 1}}));
  EXPECT_EQ(axis.seam_degrees, (Ids{3}));
  EXPECT_EQ(axis.seam_curves, (Ids{0}));
}

TEST(axis_sheets, that_share_but_a_vertex_are_two) {
  EXPECT_EQ(with_sheets(complex_of(5, {{0, 1, 2}, {2, 3, 4}})).polygon_sheets, (Ids{0, 1}));
}

TEST(axis_sheets, say_that_a_moebius_band_has_one_side) {
  const MedialAxis band = with_sheets(complex_of(5, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {0, 3, 4}, {0, 1, 4}}));
  EXPECT_EQ(band.polygon_sheets, (Ids{0, 0, 0, 0, 0}));
  EXPECT_EQ(band.sheet_orientable, (Marks{0}));
  EXPECT_EQ(axis_topology(band).euler_characteristic, 0);
  EXPECT_EQ(broken_invariant(band), "");
}

TEST(axis_sheets, of_a_ring_that_is_not_twisted_have_two_sides) {
  const MedialAxis ring =
      with_sheets(complex_of(6, {{0, 1, 2}, {1, 2, 3}, {2, 3, 4}, {3, 4, 5}, {0, 4, 5}, {0, 1, 5}}));
  EXPECT_EQ(ring.sheet_orientable, (Marks{1}));
  EXPECT_EQ(axis_topology(ring).euler_characteristic, 0);
}

TEST(axis_sheets, meet_in_seams_that_go_on_through_a_vertex_of_two_and_end_where_more_meet) {
  // Three leaves along 0 1 2, and three more along 2 3: one curve. With three along 2 4 there are three.
  std::vector<Corners> book;
  std::int32_t next = 5;
  const auto leaves = [&](std::int32_t a, std::int32_t b) {
    for (int k = 0; k < 3; ++k) book.push_back({a, b, next++});
  };
  leaves(0, 1);
  leaves(1, 2);
  leaves(2, 3);
  EXPECT_EQ(with_sheets(complex_of(static_cast<std::size_t>(next), book)).seam_curves, (Ids{0, 0, 0}));
  leaves(2, 4);
  const MedialAxis axis = with_sheets(complex_of(static_cast<std::size_t>(next), book));
  EXPECT_EQ(axis.seams, (Edges{{0, 1}, {1, 2}, {2, 3}, {2, 4}}));
  EXPECT_EQ(axis.seam_curves, (Ids{0, 0, 1, 2}));
}

TEST(axis_sheets, that_are_wrong_are_named) {
  const MedialAxis right = with_sheets(complex_of(6, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}, {1, 4, 5}}));
  ASSERT_EQ(broken_invariant(right), "");
  const auto says = [](const MedialAxis& axis, const std::string& words) {
    EXPECT_NE(broken_invariant(axis).find(words), std::string::npos) << broken_invariant(axis);
  };
  MedialAxis axis = right;
  axis.polygon_sheets = {0, 1, 2, 3};
  says(axis, "sheets of polygons are wrong at 3");
  axis = right;
  axis.polygon_sheets = {0, 1, 2};
  says(axis, "3 sheets of polygons, there are 4 polygons");
  axis = right;
  axis.sheet_orientable = {1, 1, 0};
  says(axis, "marks of orientable sheets are wrong at 2");
  axis = right;
  axis.seams = {};
  says(axis, "0 seams, there are 1 edges of three and more polygons");
  axis = right;
  axis.seam_degrees = {4};
  says(axis, "degrees of seams are wrong at 0");
  axis = right;
  axis.seam_curves = {1};
  says(axis, "curves of seams are wrong at 0");
  axis = right;
  axis.polygon_vertices = {0, 1, 2, 0, 1, 3, 0, 1, 4, 1, 4, 5};
  ASSERT_NE(axis.polygon_vertices, right.polygon_vertices);
  says(axis, "polygon 3 faces another way than its neighbours in its sheet");
}

}  // namespace
}  // namespace ballflow::geometry
