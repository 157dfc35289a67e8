#include "show/picture/ray_caster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace ballflow::show {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::length;
using geometry::Vec3;

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double number(double from, double to) { return from + (to - from) * (bits_() / 4294967296.0); }
  Vec3 point() { return {number(-0.5, 0.5), number(-0.5, 0.5), number(-0.5, 0.5)}; }
  Vec3 outside() {
    const Vec3 p = point() + Vec3{0, 0, 1e-6};
    return 3 / length(p) * p;
  }
  Ray ray() {
    const Vec3 from = outside();
    const Vec3 towards = point() - from;
    return {from, 1 / length(towards) * towards};
  }

 private:
  std::mt19937 bits_;
};

/// Distance of a point to a capsule's segment, from its definition.
double distance_to_segment(Vec3 p, const Capsule& capsule) {
  const Vec3 axis = capsule.b - capsule.a;
  const double t = std::clamp(dot(p - capsule.a, axis) / dot(axis, axis), 0.0, 1.0);
  return length(p - (capsule.a + t * axis));
}

TEST(intersect, points_where_a_line_enters_and_leaves_a_ball_lie_on_it) {
  Random random(1);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Ray ray = random.ray();
    const Ball ball{random.point(), random.number(0.001, 0.6)};
    const Vec3 off = cross(ball.center - ray.origin, ray.direction);
    const auto part = inside(ray, ball);
    ASSERT_EQ(part.has_value(), length(off) < ball.radius);
    if (!part) continue;
    ++met;
    EXPECT_NEAR(length(ray.at(part->lower) - ball.center), ball.radius, 1e-13);
    EXPECT_NEAR(length(ray.at(part->upper) - ball.center), ball.radius, 1e-13);
    EXPECT_LE(part->lower, part->upper);
  }
  EXPECT_GT(met, 100);
}

TEST(intersect, a_capsule_is_entered_where_the_distance_to_its_segment_first_is_the_radius) {
  Random random(2);
  int met = 0;
  for (int i = 0; i < 1500; ++i) {
    const Ray ray = random.ray();
    const Capsule capsule{random.point(), random.point(), random.number(0.01, 0.3)};
    // Marching by the distance never steps over the surface.
    double t = 0;
    for (int step = 0; step < 400 && t < 10; ++step)
      t += distance_to_segment(ray.at(t), capsule) - capsule.radius;
    const auto found = entry(ray, capsule);
    const bool reached = distance_to_segment(ray.at(t), capsule) < capsule.radius + 1e-9;
    if (found) {
      EXPECT_NEAR(distance_to_segment(ray.at(*found), capsule), capsule.radius, 1e-10);
    }
    if (reached) {
      ASSERT_TRUE(found) << i;
      EXPECT_NEAR(*found, t, 1e-5);
      ++met;
    }
  }
  EXPECT_GT(met, 200);
}

TEST(intersect, a_capsule_seen_along_its_axis_shows_its_end) {
  const Capsule capsule{{0, 0, -1}, {0, 0, 1}, 0.5};
  EXPECT_NEAR(entry({{0, 0, 5}, {0, 0, -1}}, capsule).value(), 3.5, 1e-12);
  EXPECT_NEAR(entry({{0.3, 0, 5}, {0, 0, -1}}, capsule).value(), 3.6, 1e-12);
  EXPECT_FALSE(entry({{0.6, 0, 5}, {0, 0, -1}}, capsule));
  EXPECT_NEAR(entry({{0, 0, 5}, {0, 0, -1}}, {{0, 0, 1}, {0, 0, 1}, 0.5}).value(), 3.5, 1e-12);
}

TEST(intersect, weights_of_a_triangle_give_the_point) {
  Random random(3);
  int met = 0;
  for (int i = 0; i < 3000; ++i) {
    const Ray ray = random.ray();
    const Triangle3 triangle{random.point(), random.point(), random.point()};
    const auto hit = meeting(ray, triangle);
    if (!hit) continue;
    ++met;
    EXPECT_GE(hit->of_b, 0);
    EXPECT_GE(hit->of_c, 0);
    EXPECT_LE(hit->of_b + hit->of_c, 1 + 1e-12);
    const Vec3 p = triangle.a + hit->of_b * (triangle.b - triangle.a) + hit->of_c * (triangle.c - triangle.a);
    EXPECT_LT(length(p - ray.at(hit->t)), 1e-10);
  }
  EXPECT_GT(met, 100);
}

TEST(intersect, no_ray_slips_between_triangles_that_share_edges) {
  // Rays towards points of the edges and the vertex of a fan.
  Random random(4);
  const Vec3 middle{0.013, -0.021, 0.1};
  std::vector<Vec3> ring;
  for (int i = 0; i < 7; ++i) {
    ring.push_back({std::cos(0.9 * i), std::sin(0.9 * i), random.number(-0.2, 0.2)});
  }
  for (int i = 0; i < 3000; ++i) {
    const Vec3 from{random.number(-0.2, 0.2), random.number(-0.2, 0.2), 3};
    const double t = i % 10 == 0 ? 0 : random.number(0, 0.9);
    const Vec3 towards = middle + t * (ring[static_cast<std::size_t>(i) % 7] - middle) - from;
    const Ray ray{from, 1 / length(towards) * towards};
    bool met = false;
    for (std::size_t k = 0; k < 7; ++k) {
      met = met || meeting(ray, {middle, ring[k], ring[(k + 1) % 7]}).has_value();
    }
    EXPECT_TRUE(met) << i;
  }
}

struct Scene {
  Bodies bodies;

  explicit Scene(unsigned seed, double largest) {
    Random random(seed);
    for (int i = 0; i < 300; ++i) bodies.balls.push_back({random.point(), random.number(0, largest)});
    bodies.balls.push_back(bodies.balls[7]);  // equal bodies: the number decides
    for (int i = 0; i < 60; ++i) {
      bodies.capsules.push_back({random.point(), random.point(), random.number(0.001, 0.02)});
    }
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = random.point();
      bodies.triangles.push_back({p, p + 0.2 * random.point(), p + 0.2 * random.point()});
    }
    for (std::uint32_t i = 0; i < bodies.size(); ++i) bodies.origins.push_back({0, i});
  }

  /// Every hit in the interval, by trying every body.
  std::vector<Hit> all(const Ray& ray, Interval interval) const {
    std::vector<Hit> hits;
    std::uint32_t number = 0;
    const auto within = [&](double t) { return t >= interval.lower && t <= interval.upper; };
    for (const Ball& ball : bodies.balls) {
      if (const auto part = inside(ray, ball)) {
        if (within(part->lower)) hits.push_back({part->lower, 0, number, false});
        if (part->lower < interval.lower && part->upper >= interval.lower) {
          const Vec3 p = ray.at(interval.lower) - ball.center;
          hits.push_back(
              {interval.lower, std::min(0.0, dot(p, p) - ball.radius * ball.radius), number, false});
        }
        if (within(part->upper)) hits.push_back({part->upper, 0, number, true});
      }
      ++number;
    }
    for (const Capsule& capsule : bodies.capsules) {
      if (const auto t = entry(ray, capsule); t && within(*t)) hits.push_back({*t, 0, number, false});
      ++number;
    }
    for (const Triangle3& triangle : bodies.triangles) {
      if (const auto hit = meeting(ray, triangle); hit && within(hit->t))
        hits.push_back({hit->t, 0, number, false});
      ++number;
    }
    std::sort(hits.begin(), hits.end());
    return hits;
  }
};

TEST(ray_caster, finds_what_trying_every_body_finds) {
  for (const double largest : {0.02, 0.3}) {
    const Scene scene(11, largest);
    const RayCaster caster(scene.bodies, geometry::no_monitor());
    Random random(12);
    std::vector<Hit> found;
    for (int i = 0; i < 3000; ++i) {
      const Ray ray = random.ray();
      const double begin = random.number(2, 3);
      const Interval interval = i % 3 == 0   ? Interval{0, 100}
                                : i % 3 == 1 ? Interval{begin, begin + random.number(0, 1)}
                                             : Interval{0, random.number(2, 4)};
      const std::vector<Hit> expected = scene.all(ray, interval);
      caster.all(ray, interval, found);
      ASSERT_TRUE(found == expected) << i << ": " << found.size() << " instead of " << expected.size();
      const auto first =
          std::find_if(expected.begin(), expected.end(), [](const Hit& h) { return !h.leaves; });
      const auto nearest = caster.nearest(ray, interval);
      ASSERT_EQ(nearest.has_value(), first != expected.end()) << i;
      if (nearest) {
        EXPECT_TRUE(*nearest == *first) << i;
      }
      const bool enters = std::any_of(expected.begin(), expected.end(),
                                      [&](const Hit& h) { return !h.leaves && h.power == 0; });
      EXPECT_EQ(caster.blocked(ray, interval), enters) << i;
    }
  }
}

TEST(ray_caster, of_equal_bodies_the_first_is_met) {
  Bodies bodies;
  for (int i = 0; i < 20; ++i) bodies.balls.push_back({{0.1, 0.2, 0.3}, 0.25});
  for (int i = 0; i < 5; ++i) bodies.triangles.push_back({{-1, -1, 0.4}, {1, -1, 0.4}, {0, 1, 0.4}});
  for (std::uint32_t i = 0; i < bodies.size(); ++i) bodies.origins.push_back({0, i});
  const RayCaster caster(bodies, geometry::no_monitor());
  for (const double x : {0.0, 0.05, 0.1, 0.15}) {
    EXPECT_EQ(caster.nearest({{x, 0.2, 3}, {0, 0, -1}}, {0, 100}).value().body, 0u);
    EXPECT_EQ(caster.nearest({{x, -0.4, 3}, {0, 0, -1}}, {0, 100}).value().body, 20u);
  }
}

TEST(ray_caster, nothing_is_met_where_there_is_nothing) {
  const RayCaster caster(Bodies{}, geometry::no_monitor());
  const Ray ray{{0, 0, 3}, {0, 0, -1}};
  std::vector<Hit> hits{{1, 0, 0, false}};
  EXPECT_FALSE(caster.nearest(ray, {0, 100}));
  EXPECT_FALSE(caster.blocked(ray, {0, 100}));
  caster.all(ray, {0, 100}, hits);
  EXPECT_TRUE(hits.empty());
}

TEST(ray_caster, an_empty_interval_meets_nothing) {
  const Scene scene(15, 0.3);
  const RayCaster caster(scene.bodies, geometry::no_monitor());
  EXPECT_FALSE(caster.nearest({{0, 0, 3}, {0, 0, -1}}, {3, 2}));
  EXPECT_FALSE(caster.blocked({{0, 0, 3}, {0, 0, -1}}, {3, 2}));
}

}  // namespace
}  // namespace ballflow::show
