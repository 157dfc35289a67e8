#include "enclose/one_sided_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ball_bounds.hpp"
#include "base/random.hpp"
#include "enclose/verify_enclosure.hpp"
#include "enclose_shapes.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

/// Centres inside, that know nothing of the surface; radii that mean nothing.
Balls random_centers_inside(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  const WindingNumber winding(mesh, no_monitor());
  const Box box = bounding_box(mesh.vertices.span());
  Random random(seed);
  std::vector<Vec3> centers;
  while (centers.size() < count) {
    const Vec3 r = random_vector(random), edge = box.upper - box.lower;
    const Vec3 p = box.lower + Vec3{r.x * edge.x, r.y * edge.y, r.z * edge.z};
    if (winding.around(p).number != 0) centers.push_back(p);
  }
  return {centers, std::vector<double>(count, 0.01), {}, {}};
}

Balls sided(const TriangleMesh& mesh, const Balls& balls, BallSide side) {
  return one_sided_balls(mesh, balls, {.side = side});
}

std::vector<TriangleMesh> solids() {
  const TriangleMesh nested =
      joined(box_mesh({0, 0, 0}, {3, 3, 3}), turned_over(box_mesh({1, 1, 1}, {2, 2, 2})));
  return {box_mesh({0, 0, 0}, {1, 2, 3}), shape("torus?n=300"), nested, turned_over(shape("knot?n=600"))};
}

TEST(one_sided_balls, of_the_inner_side_touch_the_surface_and_have_no_point_outside) {
  for (const TriangleMesh& mesh : solids()) {
    const Balls balls = random_centers_inside(mesh, 40, 3);
    const Balls inner = sided(mesh, balls, BallSide::inner);
    EXPECT_EQ(inner.size(), balls.size());
    expect_bounded(mesh, inner, 0);
    // A millionth more of the box reaches out.
    const double edge = bounding_box(mesh.vertices.span()).longest_edge();
    for (std::size_t i = 0; i < inner.size(); ++i)
      EXPECT_LT(squared_from_mesh(mesh, inner.centers[i]),
                (inner.radii[i] + 1e-6 * edge) * (inner.radii[i] + 1e-6 * edge));
  }
}

TEST(one_sided_balls, of_the_inner_side_are_none_around_centres_outside) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const Balls balls{{{2, 0.5, 0.5}, {0.5, 0.5, 0.5}, {0, 0.5, 0.5}}, {9, 9, 9}, {}, {}};
  const Balls inner = sided(box, balls, BallSide::inner);
  ASSERT_EQ(inner.size(), 1U);
  EXPECT_EQ(inner.centers[0], (Vec3{0.5, 0.5, 0.5}));
  EXPECT_NEAR(inner.radii[0], 0.5, 1e-8);
  EXPECT_LT(inner.radii[0], 0.5);
}

TEST(one_sided_balls, of_the_outer_side_contain_the_solid) {
  for (const TriangleMesh& mesh : solids()) {
    const Balls outer = sided(mesh, random_centers_inside(mesh, 40, 4), BallSide::outer);
    EXPECT_TRUE(verify_enclosure(mesh, outer, {.on_open = OnOpen::report}).encloses());
    // Without what proves it: points of the solid are in balls.
    const Balls inside = random_centers_inside(mesh, 2000, 5);
    for (const Vec3 p : inside.centers) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t i = 0; i < outer.size(); ++i)
        least = std::min(least, distance(p, outer.centers[i]) - outer.radii[i]);
      EXPECT_LE(least, 0);
    }
  }
}

TEST(one_sided_balls, of_the_outer_side_grow_no_more_than_needed) {
  // One ball in a cube: to the corners.
  const TriangleMesh cube = box_mesh({-1, -1, -1}, {1, 1, 1});
  const Balls one = sided(cube, {{{0, 0, 0}}, {0.1}, {}, {}}, BallSide::outer);
  ASSERT_EQ(one.size(), 1U);
  EXPECT_NEAR(one.radii[0], std::sqrt(3.0), 1e-7);
  // Two balls in a bar of 4 x 2 x 2: each holds its half, and as much of the middle as tolerance leaves open.
  const TriangleMesh bar = box_mesh({-2, -1, -1}, {2, 1, 1});
  const Balls two = sided(bar, {{{-1, 0, 0}, {1, 0, 0}}, {1, 1}, {}, {}}, BallSide::outer);
  ASSERT_EQ(two.size(), 2U);
  for (const double r : two.radii) EXPECT_NEAR(r, std::sqrt(3.0), 4 * 2e-4 + 1e-6);
}

TEST(one_sided_balls, of_the_outer_side_fill_voids_of_the_solid_and_leave_cavities) {
  // Small balls under the surface of a box leave a void in its middle.
  std::vector<Vec3> centers;
  constexpr int n = 12;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      for (const double side : {0.08, 0.92}) {
        const double u = (i + 0.5) / n, v = (j + 0.5) / n;
        centers.insert(centers.end(), {{side, u, v}, {u, side, v}, {u, v, side}});
      }
    }
  }
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const Balls under{centers, std::vector<double>(centers.size(), 0.08), {}, {}};
  const Balls filled = sided(box, under, BallSide::outer);
  EXPECT_GT(filled.size(), under.size());
  EXPECT_LT(filled.size(), under.size() + 100);
  const Enclosure found = verify_enclosure(box, filled, {.on_open = OnOpen::report});
  EXPECT_TRUE(found.encloses());
  EXPECT_LT(found.protrusion, 0.2);
  // The same balls around a cavity: the void is no part of the solid.
  const TriangleMesh hollow = joined(box, turned_over(box_mesh({0.17, 0.17, 0.17}, {0.83, 0.83, 0.83})));
  const Balls around = sided(hollow, under, BallSide::outer);
  EXPECT_EQ(around.size(), under.size());
  EXPECT_TRUE(verify_enclosure(hollow, around, {.on_open = OnOpen::report}).encloses());
}

TEST(one_sided_balls, of_the_outer_side_take_open_meshes_and_centres_outside) {
  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                           std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}};
  const Balls balls{{{0.2, 0.5, 0.1}, {0.8, 0.5, -0.1}, {5, 5, 5}}, {0.05, 0.05, 0.01}, {}, {}};
  const Balls outer = sided(sheet, balls, BallSide::outer);
  EXPECT_TRUE(verify_enclosure(sheet, outer, {.on_open = OnOpen::report}).encloses());
  // A ball outside of a closed mesh that holds nothing of it is left out.
  const Balls far =
      sided(box_mesh({0, 0, 0}, {1, 1, 1}), {{{0.5, 0.5, 0.5}, {9, 9, 9}}, {1, 1}, {}, {}}, BallSide::outer);
  EXPECT_EQ(far.size(), 1U);
}

TEST(one_sided_balls, scale_with_the_model) {
  const TriangleMesh torus = shape("torus?n=300");
  std::vector<Vec3> vertices;
  for (const Vec3 p : torus.vertices) vertices.push_back(1024.0 * p);
  const Balls small = random_centers_inside(torus, 30, 7);
  std::vector<Vec3> centers;
  for (const Vec3 p : small.centers) centers.push_back(1024.0 * p);
  const Balls large{centers, std::vector<double>(30, 1.0), {}, {}};
  for (const BallSide side : {BallSide::inner, BallSide::outer}) {
    const Balls one = sided(torus, small, side), other = sided({vertices, torus.triangles}, large, side);
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(1024 * one.radii[i], other.radii[i]);
  }
}

TEST(one_sided_balls, refuse_what_has_no_inside) {
  const auto message = [](const TriangleMesh& mesh, const Balls& balls, BallSide side) {
    try {
      sided(mesh, balls, side);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const TriangleMesh open{box.vertices,
                          std::vector<Triangle>(box.triangles.begin(), box.triangles.end() - 1)};
  const Balls ball{{{0.5, 0.5, 0.5}}, {0.1}, {}, {}};
  EXPECT_NE(message(open, ball, BallSide::inner).find("nothing is inside"), std::string::npos);
  EXPECT_NE(message({box.vertices, {}}, ball, BallSide::outer).find("no triangles"), std::string::npos);
  EXPECT_NE(message(box, {}, BallSide::outer).find("no balls"), std::string::npos);
  EXPECT_NE(message(box, {{{7, 7, 7}}, {1}, {}, {}}, BallSide::inner).find("no ball is inside"),
            std::string::npos);
}

}  // namespace
}  // namespace ballflow::geometry
