#include "power/alpha_shape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>

#include "alpha_cases.hpp"

namespace ballflow::geometry {
namespace {

using alpha_cases::grid_balls;
using alpha_cases::make_balls;
using alpha_cases::random_balls;
using alpha_cases::shape_of;
using alpha_cases::Simplices;
using alpha_cases::simplices_of;
using alpha_cases::uniform;
using alpha_cases::uniform_point;

TEST(alpha_shape, of_no_ball_is_empty) {
  const SimplicialComplex complex = shape_of({});
  EXPECT_TRUE(simplices_of(complex).empty());
  EXPECT_EQ(complex.betti, (Betti{0, 0, 0}));
}

TEST(alpha_shape, of_one_ball_is_a_singular_vertex_even_with_radius_zero) {
  for (const double radius : {0.0, 1.0}) {
    const SimplicialComplex complex = shape_of(make_balls({{1, 2, 3}}, radius));
    EXPECT_EQ(simplices_of(complex), (Simplices{{0}}));
    EXPECT_EQ(complex.vertex_classes, (Array<std::uint8_t>{2}));
    EXPECT_EQ(complex.betti, (Betti{1, 0, 0}));
  }
}

TEST(alpha_shape, joins_two_balls_exactly_when_they_meet) {
  const double beyond = std::nextafter(2.0, 3.0);
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {1, 0, 0}}, 1))), (Simplices{{0}, {0, 1}, {1}}));
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {2, 0, 0}}, 1))), (Simplices{{0}, {0, 1}, {1}}));
  const SimplicialComplex apart = shape_of(make_balls({{0, 0, 0}, {beyond, 0, 0}}, 1));
  EXPECT_EQ(simplices_of(apart), (Simplices{{0}, {1}}));
  EXPECT_EQ(apart.betti, (Betti{2, 0, 0}));
}

TEST(alpha_shape, decides_tangency_exactly_far_from_the_origin) {
  const double base = 0x1p20, gap = 0x1p-30;
  const std::vector<Vec3> others = {{0, 50, 0}, {0, 0, 50}, {0, 0, -50}};  // make the set full-dimensional
  for (const double step : {-gap, 0.0, gap}) {
    std::vector<Vec3> centers = {{base, 0, 0}, {base + 2 + step, 0, 0}};
    centers.insert(centers.end(), others.begin(), others.end());
    EXPECT_EQ(shape_of(make_balls(centers, 1)).edges.size(), step > 0 ? 0u : 1u) << step;
  }
}

TEST(alpha_shape, leaves_out_balls_inside_others) {
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {0.5, 0, 0}}, {2, 1}))), (Simplices{{0}}));
  // Tangent from inside: closed balls share the point of contact, which keeps the smaller one in the complex.
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {1, 0, 0}}, {2, 1}))),
            (Simplices{{0}, {0, 1}, {1}}));
  // Hidden: its power cell is empty, so that it is not even a vertex of the triangulation.
  EXPECT_EQ(
      simplices_of(shape_of(make_balls(
          {{0, 0, 0}, {0, 0, 0.1}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {-9, -9, -9}}, {2, 0.1, 0, 0, 0, 0}))),
      (Simplices{{0}, {2}, {3}, {4}, {5}}));
}

TEST(alpha_shape, keeps_of_equal_centers_the_largest_ball_then_the_first) {
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, 1))), (Simplices{{0}}));
  EXPECT_EQ(simplices_of(shape_of(make_balls({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}, {1, 2, 2}))),
            (Simplices{{1}}));
  EXPECT_EQ(simplices_of(shape_of(make_balls({{5, 0, 0}, {0, 0, 0}, {-0.0, 0, 0}}, {1, 2, 2}))),
            (Simplices{{0}, {1}}));
}

TEST(alpha_shape, of_a_collinear_chain_is_a_path) {
  const SimplicialComplex complex =
      shape_of(make_balls({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {9, 9, 9}}, 1));
  EXPECT_EQ(simplices_of(complex), (Simplices{{0}, {0, 1}, {1}, {1, 2}, {2}, {2, 3}, {3}, {4}}));
  EXPECT_EQ(complex.vertex_classes, (Array<std::uint8_t>{1, 1, 1, 1, 2}));
  EXPECT_EQ(complex.edge_classes, (Array<std::uint8_t>{2, 2, 2}));
  EXPECT_EQ(complex.betti, (Betti{2, 0, 0}));
}

TEST(alpha_shape, of_coplanar_balls_has_tunnels_but_no_cavity) {
  const std::vector<Vec3> square = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  const SimplicialComplex ring = shape_of(make_balls(square, 1));  // four tangent balls
  EXPECT_EQ(ring.betti, (Betti{1, 1, 0}));
  EXPECT_EQ(ring.edges.size(), 4u);
  const SimplicialComplex filled = shape_of(make_balls(square, 1.5));
  EXPECT_EQ(filled.betti, (Betti{1, 0, 0}));
  EXPECT_EQ(filled.triangle_classes, (Array<std::uint8_t>{2, 2}));
}

TEST(alpha_shape, closes_where_four_balls_have_one_point_in_common) {
  const SimplicialComplex flat = shape_of(make_balls({{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, 1));
  EXPECT_EQ(flat.betti, (Betti{1, 0, 0}));
  EXPECT_EQ(flat.triangles.size(), 2u);
}

TEST(alpha_shape, counts_the_cavity_of_an_octahedron_until_it_closes) {
  const std::vector<Vec3> corners = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  EXPECT_EQ(shape_of(make_balls(corners, 0.70)).betti, (Betti{6, 0, 0}));
  EXPECT_EQ(shape_of(make_balls(corners, 0.75)).betti, (Betti{1, 7, 0}));  // the 12 edges
  EXPECT_EQ(shape_of(make_balls(corners, 0.82)).betti, (Betti{1, 0, 1}));  // and the 8 triangles
  EXPECT_EQ(shape_of(make_balls(corners, std::nextafter(1.0, 0.0))).betti, (Betti{1, 0, 1}));
  EXPECT_EQ(shape_of(make_balls(corners, 1)).betti, (Betti{1, 0, 0}));  // all balls meet at the origin
}

TEST(alpha_shape, of_a_ring_of_balls_has_one_tunnel) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 40; ++i) {
    const double t = 0.05 * i * 3.141592653589793;
    centers.push_back({std::cos(t), std::sin(t), 0.1 * std::sin(3 * t)});
  }
  const SimplicialComplex ring = shape_of(make_balls(centers, 0.12));
  EXPECT_EQ(ring.betti, (Betti{1, 1, 0}));
  EXPECT_EQ(ring.edges.size(), 40u);
}

TEST(alpha_shape, of_a_torus_of_balls_has_two_tunnels_and_one_cavity) {
  std::vector<Vec3> centers;
  for (int i = 0; i < 60; ++i) {
    for (int k = 0; k < 24; ++k) {
      const double u = (i + 0.01 * k) * 6.283185307179586 / 60, v = (k + 0.02 * i) * 6.283185307179586 / 24;
      centers.push_back({(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  }
  const Balls balls = make_balls(centers, 0.3);
  EXPECT_EQ(shape_of(balls).betti, (Betti{1, 2, 1}));
  expect_as_gudhi(balls);
}

TEST(alpha_shape, does_not_depend_on_the_order_of_the_balls) {
  std::mt19937_64 random(7);
  for (int round = 0; round < 30; ++round) {
    Balls balls = round % 2 == 0 ? random_balls(random, 300, 0, 0.15) : grid_balls(random, 40, 4);
    // Without the copies, whose survivor is named by its index.
    std::map<Vec3, double> largest;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      largest[balls.centers[i]] = std::max(largest[balls.centers[i]], balls.radii[i]);
    }
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (const auto& [center, radius] : largest) {
      centers.push_back(center);
      radii.push_back(radius);
    }
    balls = make_balls(centers, radii);
    std::vector<std::int32_t> order(balls.size());
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);

    const SimplicialComplex straight = shape_of(balls);
    const SimplicialComplex shuffled = shape_of(select(balls, order));
    Simplices renamed = simplices_of(shuffled);
    for (auto& simplex : renamed) {
      for (auto& v : simplex) v = order[static_cast<std::size_t>(v)];
      std::sort(simplex.begin(), simplex.end());
    }
    std::sort(renamed.begin(), renamed.end());
    EXPECT_EQ(simplices_of(straight), renamed) << "round " << round;
    EXPECT_EQ(straight.betti, shuffled.betti);
  }
}

TEST(alpha_shape, does_not_change_when_the_model_is_scaled_by_a_power_of_two) {
  std::mt19937_64 random(8);
  const Balls balls = grid_balls(random, 60, 5);
  const Simplices expected = simplices_of(shape_of(balls));
  for (const double scale : {0x1p-300, 0x1p-40, 0x1p40, 0x1p300}) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      centers.push_back(scale * balls.centers[i]);
      radii.push_back(scale * balls.radii[i]);
    }
    EXPECT_EQ(simplices_of(shape_of(make_balls(centers, radii))), expected) << scale;
  }
}

TEST(alpha_shape, polar_tolerance_joins_balls_that_touch_up_to_rounding) {
  std::mt19937_64 random(9);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int pair = 0; pair < 100; ++pair) {
    const Vec3 first{10.0 * (pair % 5) + uniform(random, 0, 1), 10.0 * (pair / 5 % 5), 10.0 * (pair / 25)};
    const Vec3 direction = uniform_point(random) + Vec3{0.01, 0, 0};
    radii.push_back(uniform(random, 0.5, 1.5));
    radii.push_back(uniform(random, 0.5, 1.5));
    centers.push_back(first);
    centers.push_back(first + ((radii.back() + radii[radii.size() - 2]) / length(direction)) * direction);
  }
  const Balls balls = make_balls(centers, radii);
  const SimplicialComplex exact = shape_of(balls);
  EXPECT_EQ(exact.delta, 0);
  EXPECT_GT(exact.betti[0], 110) << "rounding separates pairs";
  EXPECT_LT(exact.betti[0], 190) << "and joins others";

  const SimplicialComplex tolerant = shape_of(balls, {.tolerance = AlphaTolerance::polar});
  const double edge = bounding_box(balls).longest_edge();
  EXPECT_EQ(tolerant.delta, std::ldexp(edge * edge, -36));
  for (std::size_t i = 0; i < balls.size(); ++i) {
    EXPECT_EQ(tolerant.weights[i], radii[i] * radii[i] + tolerant.delta);
  }
  EXPECT_EQ(tolerant.betti, (Betti{100, 0, 0}));
  // What is apart by more than rounding stays apart.
  EXPECT_EQ(
      shape_of(make_balls({{0, 0, 0}, {2.001, 0, 0}}, 1), {.tolerance = AlphaTolerance::polar}).betti[0], 2);
}

TEST(alpha_shape, refuses_balls_that_are_none) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(alpha_shape(make_balls({{0, 0, 0}}, -1), {}, no_monitor()), InputError);
  EXPECT_THROW(alpha_shape(make_balls({{0, 0, inf}}, 1), {}, no_monitor()), InputError);
  EXPECT_THROW(alpha_shape(make_balls({{0, 0, 0}}, std::nan("")), {}, no_monitor()), InputError);
  EXPECT_THROW(alpha_shape(make_balls({{0, 0, 0}, {0, 0, 1}}, std::vector<double>{1}), {}, no_monitor()),
               InputError);
  try {
    alpha_shape(make_balls({{0, 0, 0}, {1, 0, 0}}, {1, 1e200}), {}, no_monitor());
    FAIL() << "a square that overflows";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("ball 1"), std::string::npos) << error.what();
  }
}

TEST(alpha_shape, stops_when_cancelled) {
  struct Impatient final : Monitor {
    bool cancelled() override { return ++asked > 3; }
    int asked = 0;
  } monitor;
  std::mt19937_64 random(10);
  EXPECT_THROW(alpha_shape(random_balls(random, 20000, 0, 0.1), {}, monitor), Cancelled);
}

TEST(alpha_shape, reports_progress_that_never_goes_back) {
  struct Record final : Monitor {
    void progress(double fraction) override {
      rising = rising && fraction >= last && fraction <= 1;
      last = fraction;
    }
    double last = 0;
    bool rising = true;
  } monitor;
  std::mt19937_64 random(11);
  alpha_shape(random_balls(random, 5000, 0, 0.1), {}, monitor);
  EXPECT_TRUE(monitor.rising);
  EXPECT_EQ(monitor.last, 1);
}

}  // namespace
}  // namespace ballflow::geometry
