#include "show/picture/camera.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "ballflow/error.hpp"

namespace ballflow::show {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::length;
using geometry::Vec3;

Layer balls(std::vector<Vec3> centers, std::vector<double> radii) {
  Layer layer;
  layer.name = "balls";
  layer.shape = Shape::balls;
  layer.vertices = std::move(centers);
  layer.radii = std::move(radii);
  return layer;
}

TEST(camera, names_look_from_where_they_say) {
  const std::vector<Layer> scene = {balls({{0, 0, 0}}, {1})};
  const auto from = [&](const char* name, Upward up) {
    return Camera(scene, direction_named(name), up, {0, 0, 100, 100}, 0).backward();
  };
  const auto expect = [](Vec3 a, Vec3 b) { EXPECT_LT(length(a - b), 1e-12); };
  expect(from("front", Upward::y), {0, 0, 1});
  expect(from("back", Upward::y), {0, 0, -1});
  expect(from("right", Upward::y), {1, 0, 0});
  expect(from("left", Upward::y), {-1, 0, 0});
  expect(from("top", Upward::y), {0, 1, 0});
  expect(from("bottom", Upward::y), {0, -1, 0});
  expect(from("front", Upward::z), {0, -1, 0});
  expect(from("top", Upward::z), {0, 0, 1});
  expect(from("right", Upward::z), {1, 0, 0});
  const double third = 1 / std::sqrt(3.0);
  expect(from("iso", Upward::y), {third, third, third});
  expect(from("90,0", Upward::y), {1, 0, 0});
}

TEST(camera, axes_are_orthonormal_and_right_handed) {
  const std::vector<Layer> scene = {balls({{0, 0, 0}}, {1})};
  for (const char* name : {"iso", "front", "top", "bottom", "-123.5,67", "300,-12"}) {
    for (const Upward up : {Upward::y, Upward::z}) {
      const Camera camera(scene, direction_named(name), up, {0, 0, 100, 100}, 0);
      EXPECT_LT(length(cross(camera.right(), camera.up()) - camera.backward()), 1e-12) << name;
      EXPECT_NEAR(length(camera.right()), 1, 1e-12);
      EXPECT_NEAR(dot(camera.right(), camera.up()), 0, 1e-12);
    }
  }
}

TEST(camera, everything_is_seen_and_touches_a_side) {
  std::mt19937 bits(3);
  const auto number = [&bits](double from, double to) {
    return from + (to - from) * (bits() / 4294967296.0);
  };
  for (const double unit : {1e-200, 1e-5, 1.0, 1e7, 1e200}) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < 50; ++i) {
      centers.push_back({unit * number(5, 8), unit * number(-1, 1), unit * number(0, 9)});
      radii.push_back(unit * number(0, 0.5));
    }
    const std::vector<Layer> scene = {balls(centers, radii)};
    const Viewport part{40, 20, 300, 200};
    const Camera camera(scene, {35, 25}, Upward::y, part, 10);
    // Rays through the frame that the margin leaves pass every ball; one of them nearly touches one.
    double closest = 1e9;
    for (int i = 0; i < 2000; ++i) {
      const double t = i % 500 / 500.0;
      const double x = i < 500 ? 50 : i < 1000 ? 330 : 50 + 280 * t;
      const double y = i < 1000 ? 30 + 180 * t : i < 1500 ? 30 : 210;
      const Ray ray = camera.ray(x, y);
      for (std::size_t k = 0; k < centers.size(); ++k) {
        const Vec3 off = cross(camera.inward(centers[k]) - ray.origin, ray.direction);
        const double gap = length(off) - camera.inward(radii[k]);
        EXPECT_GT(gap, -1e-9);
        closest = std::min(closest, gap);
      }
    }
    EXPECT_LT(closest, 0.01);
  }
}

TEST(camera, a_place_in_the_picture_lies_on_the_ray_through_it) {
  const std::vector<Layer> scene = {balls({{3, 4, 5}, {6, 4, 1}}, {1, 2})};
  const Camera camera(scene, {200, -40}, Upward::z, {0, 0, 640, 480}, 5);
  for (const Vec3 point : {Vec3{3, 4, 5}, Vec3{6, 4, 1}, Vec3{5, 5, 2}}) {
    const auto place = camera.place(point);
    const Ray ray = camera.ray(place.x, place.y);
    EXPECT_LT(length(cross(camera.inward(point) - ray.origin, ray.direction)), 1e-12);
    EXPECT_NEAR(dot(camera.inward(point) - ray.origin, -camera.backward()), place.distance, 1e-12);
  }
}

TEST(camera, a_single_point_is_seen_in_the_middle) {
  Layer layer;
  layer.vertices = std::vector<Vec3>{{7, 8, 9}};
  const Camera camera({layer}, {}, Upward::y, {0, 0, 100, 80}, 3);
  EXPECT_NEAR(camera.place({7, 8, 9}).x, 50, 1e-9);
  EXPECT_NEAR(camera.place({7, 8, 9}).y, 40, 1e-9);
  EXPECT_GT(camera.pixel(), 0);
}

TEST(camera, refuses_views_that_are_none) {
  for (const char* name : {"", "ISO", "north", "30", "30,", "30,91", "361,0", "a,b", "nan,0", "1,2,3"}) {
    EXPECT_THROW(direction_named(name), Error) << name;
  }
  try {
    direction_named("north");
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "there is no view \"north\"");
    EXPECT_NE(error.hint().find("bottom"), std::string::npos);
  }
}

TEST(camera, refuses_coordinates_whose_difference_is_no_number) {
  EXPECT_THROW(Camera({balls({{-1.7e308, 0, 0}, {1.7e308, 0, 0}}, {0, 0})}, {}, Upward::y, {0, 0, 9, 9}, 0),
               Error);
}

TEST(camera, robots_stand_on_z) {
  Layer still, robot;
  robot.chain = std::make_shared<const Chain>();
  EXPECT_EQ(upward_of({}), Upward::y);
  EXPECT_EQ(upward_of({still}), Upward::y);
  EXPECT_EQ(upward_of({still, robot}), Upward::z);
}

}  // namespace
}  // namespace ballflow::show
