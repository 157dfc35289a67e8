#include "show/picture/picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "picture_cases.hpp"
#include "show/picture/light.hpp"

namespace ballflow::show {
namespace {

using geometry::Vec3;
using picture_cases::at;
using picture_cases::balls;
using picture_cases::front;
using picture_cases::Rgba;
using picture_cases::square;
using picture_cases::white;

/// Colours every element by its own category.
void colour_by_number(Layer& layer) {
  Attribute number{"number", "", {}, layer.shape == Shape::balls || layer.shape == Shape::points, {}};
  for (std::size_t i = 0; i < layer.elements(); ++i) {
    number.categories.push_back(std::to_string(i));
    number.values.push_back(static_cast<double>(i));
  }
  layer.attributes = {number};
  layer.colour_by = "number";
}

Light light_at(const Image& image, int x, int y) {
  const Rgba c = at(image, x, y);
  return light_of(
      {static_cast<std::uint8_t>(c.r), static_cast<std::uint8_t>(c.g), static_cast<std::uint8_t>(c.b)});
}

/// The factor by which light of `colour` is shaded to give a pixel, which must be the same for all channels.
double shade(const Image& image, int x, int y, Colour colour) {
  const Light seen = light_at(image, x, y), full = light_of(colour);
  const double factor = (seen.x + seen.y + seen.z) / (full.x + full.y + full.z);
  for (const auto& [a, b] : {std::pair{seen.x, full.x}, {seen.y, full.y}, {seen.z, full.z}}) {
    EXPECT_NEAR(a, factor * b, 0.01) << "at " << x << ", " << y;
  }
  return factor;
}

TEST(light, is_what_the_standard_says) {
  for (int i = 0; i < 256; ++i) {
    const double c = i / 255.0;
    const double expected = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    const auto channel = static_cast<std::uint8_t>(i);
    EXPECT_NEAR(light_of_channel(channel), expected, 1e-14);
    EXPECT_EQ(colour_of(light_of({channel, channel, channel})).green, i);
  }
  EXPECT_EQ(colour_of({-1, 2, 0}), (Colour{0, 255, 0}));
}

TEST(picture, a_ball_covers_the_pixels_whose_rays_meet_it) {
  const Layer ball = balls("balls", {{3, -2, 5}}, {0.5});
  const PictureOptions options = front(120, 90);
  const Image image = draw({ball}, options);
  const Camera camera({ball}, options.from, options.up, {0, 0, 120, 90}, 0.04 * 90);
  int covered = 0;
  for (int y = 0; y < 90; ++y) {
    for (int x = 0; x < 120; ++x) {
      int inside = 0;
      for (const double dx : {0.0, 0.5, 1.0}) {
        for (const double dy : {0.0, 0.5, 1.0}) {
          const Ray ray = camera.ray(x + dx, y + dy);
          if (geometry::length(geometry::cross(ray.origin, ray.direction)) < 0.5) ++inside;
        }
      }
      if (inside == 0) {
        EXPECT_EQ(at(image, x, y), (Rgba{255, 255, 255, 255})) << x << " " << y;
      }
      if (inside == 9) {
        ++covered;
        const double factor = shade(image, x, y, plain(ball));
        EXPECT_GT(factor, 0.3);
        EXPECT_LT(factor, 1.3);
      }
    }
  }
  EXPECT_GT(covered, 3000);
}

TEST(picture, a_ball_is_brightest_towards_the_lamp_at_the_upper_left) {
  const Layer ball = balls("balls", {{0, 0, 0}}, {1});
  const Image image = draw({ball}, front(200, 200));
  const double upper_left = shade(image, 70, 60, plain(ball)),
               lower_right = shade(image, 130, 140, plain(ball));
  EXPECT_GT(upper_left, 1.4 * lower_right);
  EXPECT_GT(shade(image, 100, 40, plain(ball)), 1.2 * shade(image, 100, 160, plain(ball)));
}

TEST(picture, elements_have_the_colours_of_the_palette) {
  Layer layer = balls("balls", {{-2, 0, 0}, {0, 0, 0}, {2, 0, 0}}, {0.9, 0.9, 0.9});
  layer.attributes = {{"height", "", {}, true, {10, 15, 20}}};
  layer.colour_by = "height";
  const Image image = draw({layer}, front(300, 100));
  shade(image, 57, 50, scalar(0));
  shade(image, 150, 50, scalar(0.5));
  shade(image, 243, 50, scalar(1));
  colour_by_number(layer);
  const Image numbered = draw({layer}, front(300, 100));
  shade(numbered, 57, 50, category(0));
  shade(numbered, 150, 50, category(1));
  shade(numbered, 243, 50, category(2));
}

TEST(picture, values_are_interpolated_along_segments_and_within_triangles) {
  Layer triangle = square("square", 0);
  triangle.attributes = {{"height", "", {}, true, {0, 1, 1, 0}}};
  triangle.colour_by = "height";
  const Image image = draw({triangle}, front(100, 100));
  for (const int x : {20, 50, 80}) shade(image, x, 50, scalar((x + 0.5 - 4) / 92));
  Layer line = square("line", 0);
  line.shape = Shape::segments;
  line.triangles.clear();
  line.segments = {{0, 2}};
  line.attributes = triangle.attributes;
  line.colour_by = "height";
  PictureOptions options = front(100, 100);
  options.point_size = 8;
  const Image drawn = draw({line}, options);
  for (const int x : {20, 50, 80}) shade(drawn, x, 99 - x, scalar((x + 0.5 - 4) / 92));
}

TEST(picture, what_is_in_front_hides_what_is_behind) {
  Layer layer = balls("balls", {{0, 0, 0}, {0, 0, 3}}, {1, 0.5});
  colour_by_number(layer);
  shade(draw({layer}, front(100, 100)), 50, 50, category(1));
  PictureOptions back = front(100, 100);
  back.from = direction_named("back");
  shade(draw({layer}, back), 50, 50, category(0));
}

TEST(picture, a_translucent_sheet_lets_its_share_of_light_through) {
  // Seen straight on, a sheet has just its opacity; behind it there is white ground.
  Layer sheet = square("sheet", 0);
  const Image solid = draw({sheet}, front(101, 101));
  const Light full = light_at(solid, 50, 50);
  for (const double opacity : {0.25, 0.5, 0.9}) {
    sheet.opacity = opacity;
    const Light seen = light_at(draw({sheet}, front(101, 101)), 50, 50);
    EXPECT_NEAR(seen.x, opacity * full.x + (1 - opacity), 0.006);
    EXPECT_NEAR(seen.z, opacity * full.z + (1 - opacity), 0.006);
  }
}

TEST(picture, translucent_layers_lie_over_each_other_in_order_along_the_ray) {
  Layer near = square("near", 1), far = square("far", -1), solid = square("solid", -2);
  near.opacity = far.opacity = 0.5;
  for (Layer* layer : {&near, &far, &solid}) colour_by_number(*layer);
  near.attributes[0].values = {0, 0};
  near.attributes[0].categories = far.attributes[0].categories = {"0", "1", "2"};
  solid.attributes[0].categories = {"0", "1", "2"};
  far.attributes[0].values = {1, 1};
  solid.attributes[0].values = {2, 2};
  // In any order of the layers.
  const Image image = draw({solid, near, far}, front(101, 101));
  EXPECT_EQ(png(image), png(draw({far, solid, near}, front(101, 101))));
  const auto alone = [](Layer layer) {
    layer.opacity = 1;
    return light_at(draw({layer}, front(101, 101)), 50, 50);
  };
  const Light expected = 0.5 * alone(near) + 0.5 * (0.5 * alone(far) + 0.5 * alone(solid));
  const Light seen = light_at(image, 50, 50);
  EXPECT_NEAR(seen.x, expected.x, 0.01);
  EXPECT_NEAR(seen.y, expected.y, 0.01);
  EXPECT_NEAR(seen.z, expected.z, 0.01);
}

TEST(picture, of_translucent_balls_only_the_boundary_of_the_union_is_seen) {
  Layer one = balls("balls", {{0, 0, 0}}, {1}), nested = balls("balls", {{0, 0, 0}, {0.2, 0, 0}}, {1, 0.5});
  one.opacity = nested.opacity = 0.4;
  EXPECT_TRUE(draw({one}, front(80, 80)).rgba == draw({nested}, front(80, 80)).rgba);
}

TEST(picture, a_plane_cuts_balls_open_and_shows_whose_points_these_are) {
  // Two overlapping balls cut in the middle: their radical plane is x = 0.25.
  Layer layer = balls("balls", {{-0.5, 0, 0}, {0.5, 0, 0}}, {1, std::sqrt(0.5)});
  colour_by_number(layer);
  PictureOptions options = front(200, 200);
  options.clips = {clip_named("z=0")};
  const Image image = draw({layer}, options);
  const Camera camera({layer}, options.from, options.up, {0, 0, 200, 200}, 0.04 * 200);
  const auto pixel = [&](double x, double y) {
    const auto place = camera.place({x, y, 0});
    return std::pair{static_cast<int>(place.x), static_cast<int>(place.y)};
  };
  const auto [lx, ly] = pixel(0.2, 0);
  const auto [rx, ry] = pixel(0.3, 0);
  const double left = shade(image, lx, ly, category(0)), right = shade(image, rx, ry, category(1));
  EXPECT_NEAR(left, right, 0.02) << "the cut is flat";
  const auto [ex, ey] = pixel(-1.3, 0);
  EXPECT_NEAR(shade(image, ex, ey, category(0)), left, 0.02);
}

TEST(picture, clipping_removes_what_is_beyond_the_plane) {
  Layer layer = balls("balls", {{-1, 0, 0}, {1, 0, 0}}, {0.8, 0.8});
  const auto ground = [&](const std::string& clip, int x) {
    PictureOptions options = front(200, 100);
    options.clips = {clip_named(clip)};
    return at(draw({layer}, options), x, 50) == Rgba{255, 255, 255, 255};
  };
  EXPECT_FALSE(ground("x=0", 50));
  EXPECT_TRUE(ground("x=0", 150));
  EXPECT_TRUE(ground("-x=0", 50));
  EXPECT_FALSE(ground("-x=0", 150));
  EXPECT_TRUE(ground("x=50%", 150));
  EXPECT_FALSE(ground("x=50%", 50));
  EXPECT_TRUE(ground("x=0%", 50));
  EXPECT_FALSE(ground("x=100%", 150));
}

TEST(picture, a_hollow_is_darker_than_a_free_surface) {
  // A pit between four high walls.
  Layer floor = square("floor", 0, 4);
  Layer pit = square("pit", 0, 0);
  std::vector<Vec3> v;
  for (const double z : {0.0, 1.5}) {
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
      v.push_back({x, y, z});
  }
  pit.vertices = v;
  pit.triangles = {{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  const Image open = draw({floor}, front(101, 101)), walled = draw({floor, pit}, front(101, 101));
  EXPECT_LT(light_at(walled, 50, 50).y, 0.75 * light_at(open, 50, 50).y);
}

TEST(picture, the_lamp_throws_a_shadow_to_the_lower_right) {
  const Layer floor = square("floor", 0, 4), ball = balls("ball", {{0, 0, 2.2}}, {0.5});
  const Image without = draw({floor}, front(201, 201)), with = draw({floor, ball}, front(201, 201));
  const auto ratio = [&](int x, int y) { return light_at(with, x, y).y / light_at(without, x, y).y; };
  double least = 1;
  for (int i = 105; i < 168; ++i) least = std::min(least, ratio(i, i + (i - 100) / 2));
  EXPECT_LT(least, 0.85);
  EXPECT_GT(ratio(60, 60), 0.97);
}

TEST(picture, facets_are_flat_and_smooth_layers_are_not) {
  // Two faces with 38 degrees between their normals.
  Layer roof;
  roof.name = "roof";
  roof.shape = Shape::triangles;
  roof.vertices =
      std::vector<Vec3>{{-1, -1, 0}, {0, -1, 0.344}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 0.344}, {1, 1, 0}};
  roof.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
  const auto range = [](const Image& image) {
    double least = 9, most = 0;
    for (int x = 57; x < 82; ++x) {
      least = std::min(least, light_at(image, x, 50).y);
      most = std::max(most, light_at(image, x, 50).y);
    }
    return most - least;
  };
  const double flat = range(draw({roof}, front(101, 101)));
  roof.smooth = true;
  EXPECT_LT(flat, 0.004);
  EXPECT_GT(range(draw({roof}, front(101, 101))), 0.008);
  // An edge of a box stays sharp.
  roof.vertices =
      std::vector<Vec3>{{-1, -1, 0}, {0, -1, 1.2}, {1, -1, 0}, {-1, 1, 0}, {0, 1, 1.2}, {1, 1, 0}};
  EXPECT_LT(range(draw({roof}, front(101, 101))), 0.004);
}

TEST(picture, ground_is_white_transparent_or_a_colour) {
  const Layer ball = balls("balls", {{0, 0, 0}}, {1});
  PictureOptions options = front(60, 60);
  const Image on_white = draw({ball}, options);
  options.ground.reset();
  const Image transparent = draw({ball}, options);
  options.ground = Colour{10, 20, 200};
  const Image on_blue = draw({ball}, options);
  EXPECT_EQ(at(on_white, 0, 0), (Rgba{255, 255, 255, 255}));
  EXPECT_EQ(at(transparent, 0, 0), (Rgba{0, 0, 0, 0}));
  EXPECT_EQ(at(on_blue, 0, 0), (Rgba{10, 20, 200, 255}));
  EXPECT_EQ(at(transparent, 30, 30), at(on_white, 30, 30));
  // At the silhouette: laid over white, the transparent picture is the white one.
  int mixed_pixels = 0;
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 60; ++x) {
      const double opacity = at(transparent, x, y).a / 255.0;
      if (opacity > 0 && opacity < 1) ++mixed_pixels;
      const Light over = opacity * light_at(transparent, x, y) + (1 - opacity) * light_of(white);
      EXPECT_NEAR(over.y, light_at(on_white, x, y).y, 0.01);
    }
  }
  EXPECT_GT(mixed_pixels, 50);
}

TEST(picture, scenes_stand_side_by_side_in_one_scale) {
  const Layer large = balls("balls", {{0, 0, 0}}, {2}), small = balls("balls", {{0, 0, 0}}, {1});
  const Image image = draw_beside({{large}, {small}}, front(200, 100));
  const auto width = [&image](int from, int to) {
    int count = 0;
    for (int x = from; x < to; ++x) count += at(image, x, 50) == Rgba{255, 255, 255, 255} ? 0 : 1;
    return count;
  };
  EXPECT_NEAR(width(0, 100), 92, 2);
  EXPECT_NEAR(width(100, 200), 46, 3);
}

TEST(picture, equal_colours_mean_equal_values_in_scenes_side_by_side) {
  Layer low = balls("low", {{0, 0, 0}}, {1}), high = balls("high", {{0, 0, 0}}, {1});
  for (Layer* layer : {&low, &high}) layer->colour_by = "height";
  low.attributes = {{"height", "", {}, true, {1}}};
  high.attributes = {{"height", "", {}, true, {3}}};
  const Image image = draw_beside({{low}, {high}}, front(200, 100));
  shade(image, 50, 50, scalar(0));
  shade(image, 150, 50, scalar(1));
}

}  // namespace
}  // namespace ballflow::show
