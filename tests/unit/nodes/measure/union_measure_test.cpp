#include "measure/union_measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "power/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

constexpr double pi_ = 3.14159265358979323846;

struct Ball {
  Vec3 c;
  double r;
};

Balls balls_of(const std::vector<Ball>& list) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Ball& b : list) {
    centers.push_back(b.c);
    radii.push_back(b.r);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

MassProperties measured(const std::vector<Ball>& list) {
  const MassProperties p = union_measure(alpha_shape(balls_of(list), {}, no_monitor()));
  EXPECT_EQ(broken_invariant(p), "");
  EXPECT_LT(p.closure_error, 1e-11);
  return p;
}

double ball_volume(double r) { return 4 * pi_ / 3 * r * r * r; }
double ball_area(double r) { return 4 * pi_ * r * r; }

/// Volume of the part of two balls that both contain, and the area of their spheres inside the other one.
struct Lens {
  double volume, area;
};
Lens lens(double r, double s, double d) {
  const double t = (d * d + r * r - s * s) / (2 * d);  // from the first centre to the plane
  const auto cap = [](double radius, double height) {
    return pi_ * height * height * (3 * radius - height) / 3;
  };
  const double a = r - t, b = s - (d - t);
  return {cap(r, a) + cap(s, b), 2 * pi_ * (r * a + s * b)};
}

void expect_near(const MassProperties& a, const MassProperties& b, double relative) {
  EXPECT_NEAR(a.volume, b.volume, relative * b.volume);
  EXPECT_NEAR(a.area, b.area, relative * b.area);
  EXPECT_LT(distance(a.center_of_mass, b.center_of_mass), relative * std::cbrt(b.volume));
  const double largest = std::max({b.inertia[0], b.inertia[1], b.inertia[2]});
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a.inertia[k], b.inertia[k], relative * largest) << k;
}

/// Oracle: the midpoints of a fine grid, and the area from the growth of the volume.
MassProperties by_grid(const std::vector<Ball>& list, int cells) {
  const Box box = bounding_box(balls_of(list));
  const double h = box.longest_edge() / cells;
  MassProperties p;
  Vec3 moment;
  double xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
  for (double x = box.lower.x + h / 2; x < box.upper.x; x += h) {
    for (double y = box.lower.y + h / 2; y < box.upper.y; y += h) {
      for (double z = box.lower.z + h / 2; z < box.upper.z; z += h) {
        const Vec3 q{x, y, z};
        if (std::none_of(list.begin(), list.end(),
                         [&](const Ball& b) { return squared_distance(b.c, q) <= b.r * b.r; })) {
          continue;
        }
        p.volume += h * h * h;
        moment = moment + h * h * h * q;
        xx += h * h * h * x * x, yy += h * h * h * y * y, zz += h * h * h * z * z;
        xy += h * h * h * x * y, xz += h * h * h * x * z, yz += h * h * h * y * z;
      }
    }
  }
  p.center_of_mass = 1 / p.volume * moment;
  const Vec3 g = p.center_of_mass;
  const double m = p.volume;
  xx -= m * g.x * g.x, yy -= m * g.y * g.y, zz -= m * g.z * g.z;
  xy -= m * g.x * g.y, xz -= m * g.x * g.z, yz -= m * g.y * g.z;
  p.inertia = {yy + zz, xx + zz, xx + yy, -xy, -xz, -yz};
  return p;
}

/// The area is the derivative of the volume when all balls grow.
double area_by_growth(std::vector<Ball> list, double step) {
  std::vector<Ball> larger = list, smaller = list;
  for (Ball& b : larger) b.r += step;
  for (Ball& b : smaller) b.r -= step;
  return (measured(larger).volume - measured(smaller).volume) / (2 * step);
}

std::vector<Ball> random_list(std::mt19937_64& random, int n, double low, double high) {
  std::uniform_real_distribution<double> unit(0, 1), radius(low, high);
  std::vector<Ball> list;
  for (int i = 0; i < n; ++i) {
    const double x = unit(random), y = unit(random), z = unit(random);
    list.push_back({{x, y, z}, radius(random)});
  }
  return list;
}

TEST(union_measure, of_one_ball_is_the_formula) {
  const MassProperties p = measured({{{3, -2, 5}, 2}});
  EXPECT_NEAR(p.volume, ball_volume(2), 1e-13 * p.volume);
  EXPECT_NEAR(p.area, ball_area(2), 1e-13 * p.area);
  EXPECT_LT(distance(p.center_of_mass, {3, -2, 5}), 1e-13);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(p.inertia[k], 0.4 * p.volume * 4, 1e-12 * p.volume);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(p.inertia[k], 0, 1e-12 * p.volume);
}

TEST(union_measure, of_nothing_is_nothing) {
  const MassProperties p = measured({});
  EXPECT_EQ(p.volume, 0);
  EXPECT_EQ(p.area, 0);
  EXPECT_EQ(measured({{{1, 2, 3}, 0}}).volume, 0);
}

TEST(union_measure, of_two_balls_is_the_formula_whether_they_overlap_touch_or_not) {
  for (const double d : {0.1, 0.5, 0.9, 1.3, 1.5, 1.9, 2.49999, 2.5, 2.6, 7.0}) {
    const double r = 1.5, s = 1;
    const MassProperties p = measured({{{1, 1, 1}, r}, {{1, 1 + d * 0.6, 1 + d * 0.8}, s}});
    const bool inside = d + s <= r, apart = d >= r + s;
    const Lens both = inside ? Lens{ball_volume(s), ball_area(s)} : apart ? Lens{0, 0} : lens(r, s, d);
    EXPECT_NEAR(p.volume, ball_volume(r) + ball_volume(s) - both.volume, 1e-12 * p.volume) << d;
    EXPECT_NEAR(p.area, ball_area(r) + ball_area(s) - both.area, 1e-12 * p.area) << d;
  }
}

TEST(union_measure, of_bodies_apart_follows_steiner) {
  const MassProperties p = measured({{{0, 0, 0}, 1}, {{10, 0, 0}, 1}});
  const double m = ball_volume(1);
  EXPECT_LT(distance(p.center_of_mass, {5, 0, 0}), 1e-12);
  EXPECT_NEAR(p.inertia[0], 2 * 0.4 * m, 1e-11);
  EXPECT_NEAR(p.inertia[1], 2 * (0.4 * m + 25 * m), 1e-10);
  EXPECT_NEAR(p.inertia[2], p.inertia[1], 1e-10);
}

TEST(union_measure, agrees_with_a_fine_grid) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 12; ++round) {
    const auto list = random_list(random, 3 + round * 3, 0.1, 0.35);
    const MassProperties p = measured(list);
    MassProperties grid = by_grid(list, 96);
    grid.area = area_by_growth(list, 1e-5);
    expect_near(p, grid, 4e-3);
    EXPECT_NEAR(p.area, grid.area, 1e-6 * p.area + 1e-4) << "the derivative of the volume";
  }
}

TEST(union_measure, of_balls_on_a_grid_where_many_spheres_meet_in_one_point) {
  for (const double r : {0.4, 0.5, 0.6, 0.70710678118654757, 0.75, 0.8660254037844386, 0.9}) {
    std::vector<Ball> list;
    for (int x = 0; x < 3; ++x) {
      for (int y = 0; y < 3; ++y) {
        for (int z = 0; z < 2; ++z) list.push_back({{double(x), double(y), double(z)}, r});
      }
    }
    const MassProperties p = measured(list);
    const MassProperties grid = by_grid(list, 120);
    EXPECT_NEAR(p.volume, grid.volume, 5e-3 * grid.volume) << r;
    EXPECT_LT(distance(p.center_of_mass, {1, 1, 0.5}), 1e-9) << r;
    if (r <= 0.7) {  // only neighbours overlap
      const Lens both = r > 0.5 ? lens(r, r, 1) : Lens{0, 0};
      EXPECT_NEAR(p.volume, 18 * ball_volume(r) - 33 * both.volume, 1e-10);
      EXPECT_NEAR(p.area, 18 * ball_area(r) - 33 * both.area, 1e-10);
    }
  }
}

TEST(union_measure, of_flat_and_straight_sets) {
  std::mt19937_64 random(6);
  for (int round = 0; round < 6; ++round) {
    auto flat = random_list(random, 12, 0.1, 0.3);
    for (Ball& b : flat) b.c.z = 0;
    expect_near(
        measured(flat),
        [&] {
          MassProperties grid = by_grid(flat, 96);
          grid.area = measured(flat).area;
          return grid;
        }(),
        4e-3);
    EXPECT_NEAR(measured(flat).area, area_by_growth(flat, 1e-5), 1e-4);
  }
  std::vector<Ball> chain;
  for (int i = 0; i < 6; ++i) chain.push_back({{double(i), 2.0 * i, -i * 1.0}, 1.5});
  const Lens both = lens(1.5, 1.5, std::sqrt(6.0));
  EXPECT_NEAR(measured(chain).volume, 6 * ball_volume(1.5) - 5 * both.volume, 1e-11);
}

TEST(union_measure, counts_a_cavity_as_empty) {
  // Balls around the corners of a cube close a cavity in its middle.
  std::vector<Ball> list;
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      for (const double z : {-1.0, 1.0}) list.push_back({{x, y, z}, 1.5});
    }
  }
  const SimplicialComplex complex = alpha_shape(balls_of(list), {}, no_monitor());
  ASSERT_EQ(complex.betti[2], 1);
  const MassProperties grid = by_grid(list, 120);
  EXPECT_NEAR(measured(list).volume, grid.volume, 3e-3 * grid.volume);
  EXPECT_NEAR(measured(list).area, area_by_growth(list, 1e-5), 1e-3);
}

TEST(union_measure, moves_and_scales_with_the_balls) {
  std::mt19937_64 random(7);
  const auto list = random_list(random, 30, 0.1, 0.3);
  const MassProperties p = measured(list);
  auto moved = list, scaled = list, reversed = list;
  for (Ball& b : moved) b.c = b.c + Vec3{1000, -2000, 500};
  for (Ball& b : scaled) b = {4 * b.c, 4 * b.r};
  std::reverse(reversed.begin(), reversed.end());
  MassProperties expected = p;
  expected.center_of_mass = p.center_of_mass + Vec3{1000, -2000, 500};
  expect_near(measured(moved), expected, 1e-9);
  expect_near(measured(reversed), p, 1e-12);
  expected = p;
  expected.volume *= 64, expected.area *= 16;
  expected.center_of_mass = 4 * p.center_of_mass;
  for (double& x : expected.inertia) x *= 1024;
  expect_near(measured(scaled), expected, 1e-13);
}

TEST(union_measure, does_not_notice_hidden_and_equal_balls) {
  std::mt19937_64 random(8);
  auto list = random_list(random, 20, 0.1, 0.3);
  const MassProperties p = measured(list);
  list.push_back(list[3]);
  list.push_back({list[0].c, list[0].r / 2});
  list.push_back({list[1].c, 0});
  expect_near(measured(list), p, 1e-12);
}

TEST(union_measure, of_radii_of_very_different_sizes) {
  const MassProperties p = measured({{{0, 0, 0}, 1e6}, {{1e6 + 1e-6, 0, 0}, 1e-6}, {{0, 2e6, 0}, 1}});
  EXPECT_NEAR(p.volume, ball_volume(1e6) + ball_volume(1), 1e-12 * p.volume);
}

TEST(union_measure, can_be_cancelled) {
  struct Stop final : Monitor {
    bool cancelled() override { return true; }
  } stop;
  std::mt19937_64 random(9);
  const SimplicialComplex complex =
      alpha_shape(balls_of(random_list(random, 50, 0.1, 0.3)), {}, no_monitor());
  EXPECT_THROW(union_measure(complex, stop), Cancelled);
}

TEST(union_measure, is_the_same_bit_by_bit_with_the_power_diagram_at_hand) {
  std::mt19937_64 random(23);
  for (int round = 0; round < 6; ++round) {
    const Balls balls = balls_of(random_list(random, 40, 0.1, 0.3));
    const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
    const SimplicialComplex complex = alpha_shape(diagram, no_monitor());
    const MassProperties searched = union_measure(complex), walked = union_measure(complex, diagram);
    EXPECT_EQ(walked.volume, searched.volume);
    EXPECT_EQ(walked.area, searched.area);
    EXPECT_EQ(walked.center_of_mass, searched.center_of_mass);
    EXPECT_EQ(walked.inertia, searched.inertia);
    EXPECT_THROW(union_measure(complex, power_diagram(balls, {AlphaTolerance::polar}, no_monitor())),
                 InputError);
  }
}

}  // namespace
}  // namespace ballflow::geometry
