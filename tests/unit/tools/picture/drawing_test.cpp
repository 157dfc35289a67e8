// How a picture is drawn: threads, progress, speed, and what is refused.
#include <gtest/gtest.h>

#include <atomic>
#include <ctime>
#include <random>
#include <string>
#include <vector>

#include "ballflow/error.hpp"
#include "picture_cases.hpp"
#include "png_decoder.hpp"

namespace ballflow::show {
namespace {

using geometry::Vec3;
using picture_cases::at;
using picture_cases::balls;
using picture_cases::front;
using picture_cases::Rgba;
using picture_cases::square;

/// Everything at once: balls, points, lines, facets, sheets, a cut.
std::vector<Layer> mixed_scene() {
  std::mt19937 bits(21);
  const auto number = [&bits](double from, double to) {
    return from + (to - from) * (bits() / 4294967296.0);
  };
  std::vector<Vec3> centers, points;
  std::vector<double> radii;
  for (int i = 0; i < 400; ++i) {
    centers.push_back({number(-1, 1), number(-1, 1), number(-1, 1)});
    radii.push_back(number(0.02, 0.3));
    points.push_back({number(-1.4, 1.4), number(-1.4, 1.4), number(-1.4, 1.4)});
  }
  Layer many = balls("balls", centers, radii);
  many.attributes = {{"radius", "model units", {}, true, radii}};
  many.colour_by = "radius";
  Layer cloud;
  cloud.name = "points";
  cloud.vertices = points;
  Layer lines = cloud;
  lines.name = "lines";
  lines.shape = Shape::segments;
  for (std::uint32_t i = 0; i + 1 < 60; ++i) lines.segments.push_back({i, i + 1});
  Layer sheet = square("sheet", 1.2, 1.3);
  sheet.opacity = 0.3;
  Layer shell = balls("shell", {{0, 0, 0}, {0.6, 0, 0}}, {1.2, 1});
  shell.opacity = 0.2;
  return {many, cloud, lines, sheet, shell};
}

TEST(picture, is_the_same_for_any_number_of_threads_and_again) {
  PictureOptions options;
  options.width = 211;
  options.height = 157;
  options.clips = {clip_named("x=80%")};
  options.threads = 1;
  const std::string expected = png(draw(mixed_scene(), options));
  for (const unsigned threads : {1U, 2U, 4U}) {
    options.threads = threads;
    EXPECT_TRUE(png(draw(mixed_scene(), options)) == expected) << threads << " threads";
  }
  const test::DecodedPng decoded = test::decode_png(expected);
  EXPECT_EQ(decoded.width, 211);
  EXPECT_EQ(decoded.height, 157);
}

TEST(picture, says_that_there_is_nothing_to_draw_and_what_is_hidden) {
  const auto message = [](const std::vector<Layer>& scene) {
    try {
      draw(scene);
      return std::string("drawn");
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      return error.what() + (": " + error.hint());
    }
  };
  EXPECT_EQ(message({}), "there is nothing to draw: all layers are empty");
  Layer hidden = balls("outer poles", {{0, 0, 0}}, {1});
  hidden.visible = false;
  EXPECT_EQ(message({hidden, Layer{}}), "there is nothing to draw: these layers are hidden: outer poles");
}

TEST(picture, refuses_options_out_of_range) {
  const Layer ball = balls("balls", {{0, 0, 0}}, {1});
  EXPECT_THROW(draw({ball}, front(15, 100)), Error);
  EXPECT_THROW(draw({ball}, front(100, 16385)), Error);
  for (const char* clip : {"", "x", "x=", "x=a", "w=1", "x=1%%", "--x=1", "x:1", "x=nan", "x=1 "}) {
    EXPECT_THROW(clip_named(clip), Error) << clip;
  }
}

TEST(picture, ends_soon_when_cancelled) {
  class Impatient final : public geometry::Monitor {
   public:
    bool cancelled() override { return ++looks > 5; }
    std::atomic<int> looks = 0;
  };
  Impatient monitor;
  PictureOptions options = front(4000, 4000);
  EXPECT_THROW(draw(mixed_scene(), options, monitor), geometry::Cancelled);
  EXPECT_LT(monitor.looks, 200);
}

TEST(picture, progress_ends_at_one) {
  class Watching final : public geometry::Monitor {
   public:
    void progress(double fraction) override {
      double before = most.load();
      while (before < fraction && !most.compare_exchange_weak(before, fraction)) {
      }
    }
    std::atomic<double> most = 0;
  };
  Watching monitor;
  draw(mixed_scene(), front(150, 100), monitor);
  EXPECT_EQ(monitor.most, 1);
}

TEST(picture, draws_ten_thousand_balls_within_ten_seconds_of_one_core) {
  std::mt19937 bits(31);
  const auto number = [&bits](double from, double to) {
    return from + (to - from) * (bits() / 4294967296.0);
  };
  std::vector<Vec3> centers;
  std::vector<double> radii;
  while (centers.size() < 10000) {
    const Vec3 p{number(-1, 1), number(-1, 1), number(-1, 1)};
    if (geometry::squared_length(p) > 1) continue;
    centers.push_back(p);
    radii.push_back(number(0.01, 0.05));
  }
  const std::clock_t begin = std::clock();
  const Image image = draw({balls("balls", centers, radii)}, front(1600, 1200));
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  RecordProperty("cpu_seconds", std::to_string(seconds));
  EXPECT_FALSE(at(image, 800, 600) == (Rgba{255, 255, 255, 255}));
#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_LT(seconds, 10);
#endif
}

}  // namespace
}  // namespace ballflow::show
