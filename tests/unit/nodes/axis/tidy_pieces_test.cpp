#include "axis/tidy_pieces.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace ballflow::geometry {
namespace {

using Polygons = std::vector<std::vector<std::int32_t>>;

constexpr bool needless = true;

AxisPiece piece(std::vector<std::int32_t> corners, bool is_needless = false) {
  return {std::move(corners), AxisKind::voronoi, is_needless};
}

/// Names below 100 are balls; names that agree in their last two digits are one place.
Polygons tidied(std::vector<AxisPiece> pieces, const std::vector<std::array<std::int32_t, 2>>& edges = {}) {
  TidyOptions options;
  options.balls = 100;
  options.same = [](std::int32_t a, std::int32_t b) { return a % 100 == b % 100; };
  tidy_pieces(pieces, edges, options, no_monitor());
  Polygons left;
  for (const AxisPiece& p : pieces) left.push_back(p.corners);
  return left;
}

TEST(tidy_pieces, leaves_what_is_in_order) {
  const std::vector<AxisPiece> pieces{piece({0, 1, 150}), piece({1, 2, 150})};
  EXPECT_EQ(tidied(pieces), (Polygons{{0, 1, 150}, {1, 2, 150}}));
}

TEST(tidy_pieces, takes_a_needless_piece_away_that_hangs_on_a_side) {
  EXPECT_EQ(tidied({piece({0, 1, 150}), piece({1, 2, 150}, needless)}), (Polygons{{0, 1, 150}}));
}

TEST(tidy_pieces, keeps_a_needless_piece_that_closes_a_sphere) {
  const Polygons sphere{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  std::vector<AxisPiece> pieces;
  for (const auto& corners : sphere) pieces.push_back(piece(corners, needless));
  EXPECT_EQ(tidied(pieces), sphere);
}

TEST(tidy_pieces, keeps_a_needless_piece_that_joins_two_others) {
  // Without the middle one of three squares in a row the first and the last are apart.
  const std::vector<AxisPiece> row{piece({0, 1, 5, 4}), piece({1, 2, 6, 5}, needless), piece({2, 3, 7, 6})};
  EXPECT_EQ(tidied(row).size(), 3u);
}

TEST(tidy_pieces, keeps_a_needless_piece_on_which_an_edge_hangs) {
  EXPECT_EQ(tidied({piece({0, 1, 150}), piece({1, 2, 150}, needless)}, {{2, 3}}).size(), 2u);
  EXPECT_EQ(tidied({piece({0, 1, 150}), piece({1, 2, 150}, needless)}, {{0, 3}}).size(), 1u);
}

TEST(tidy_pieces, takes_away_what_becomes_free_by_that) {
  EXPECT_EQ(tidied({piece({0, 1, 2}), piece({1, 2, 3}, needless), piece({2, 3, 4}, needless)}),
            (Polygons{{0, 1, 2}}));
}

TEST(tidy_pieces, joins_corners_that_are_one) {
  // 203 and 103 are one place: the triangle between them goes, the square is a triangle.
  EXPECT_EQ(tidied({piece({0, 1, 103}), piece({1, 103, 203}), piece({1, 2, 203}), piece({0, 4, 203, 103})}),
            (Polygons{{0, 1, 103}, {1, 2, 103}, {0, 4, 103}}));
}

TEST(tidy_pieces, joins_a_corner_to_the_ball_whose_centre_it_is) {
  EXPECT_EQ(tidied({piece({0, 1, 101, 2})}), (Polygons{{0, 1, 2}}));
}

TEST(tidy_pieces, does_not_join_balls) {
  // Both are 3 but for rounding of the test's places; their names say that they are balls.
  TidyOptions options;
  options.balls = 100;
  options.same = [](std::int32_t, std::int32_t) { return true; };
  std::vector<AxisPiece> pieces{piece({0, 1, 2})};
  tidy_pieces(pieces, {}, options, no_monitor());
  EXPECT_EQ(pieces[0].corners, (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(tidy_pieces, does_not_close_a_tunnel_by_joining_corners) {
  // Three squares around a tunnel, of which 103 and 203 are two corners that are one place.
  const Polygons tunnel{{103, 203, 14, 13}, {203, 5, 15, 14}, {5, 103, 13, 15}};
  std::vector<AxisPiece> pieces;
  for (const auto& corners : tunnel) pieces.push_back(piece(corners));
  EXPECT_EQ(tidied(pieces), tunnel) << "no triangle fills 103, 203, 5";
}

}  // namespace
}  // namespace ballflow::geometry
