#include "power/alpha_shape.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>

#include "gudhi_oracle.hpp"
#include "power/power_diagram.hpp"
#include "power/regular_cells.hpp"
#include "power/union_betti.hpp"
#include "power/union_vertices.hpp"
#include "test_data.hpp"
#include "types/topology_table.hpp"

namespace ballflow::geometry {
namespace {

using Simplices = std::vector<std::vector<std::int32_t>>;

Balls make_balls(std::vector<Vec3> centers, std::vector<double> radii) {
  return {std::move(centers), std::move(radii), {}, {}};
}

Balls make_balls(std::vector<Vec3> centers, double radius) {
  std::vector<double> radii(centers.size(), radius);
  return make_balls(std::move(centers), std::move(radii));
}

bool same(const std::vector<ExposedSide>& a, const std::vector<ExposedSide>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const ExposedSide& x, const ExposedSide& y) {
    return x.triangle == y.triangle && x.side == y.side && x.regular == y.regular;
  });
}

/// The complex, which keeps its own invariants, is that of the power diagram, and has the Betti numbers that
/// are counted without it.
SimplicialComplex shape_of(const Balls& balls, const AlphaShapeOptions& options = {}) {
  SimplicialComplex complex = alpha_shape(balls, options, no_monitor());
  EXPECT_EQ(broken_invariant(complex), "");
  const PowerDiagram diagram = power_diagram(balls, options, no_monitor());
  EXPECT_EQ(broken_invariant(diagram), "");
  EXPECT_EQ(union_betti(diagram, no_monitor()), complex.betti);
  EXPECT_EQ(union_betti(balls, options.tolerance, no_monitor()), complex.betti);
  EXPECT_TRUE(same(exposed_sides(complex, diagram), exposed_sides(complex)));
  EXPECT_NO_THROW(check_diagram_of(diagram, complex));
  EXPECT_EQ(complex.centers, balls.centers);
  return complex;
}

Simplices simplices_of(const SimplicialComplex& complex) {
  Simplices all;
  for (const auto v : complex.vertices) all.push_back({v});
  for (const auto& s : complex.edges) all.emplace_back(s.begin(), s.end());
  for (const auto& s : complex.triangles) all.emplace_back(s.begin(), s.end());
  for (const auto& s : complex.tetrahedra) all.emplace_back(s.begin(), s.end());
  std::sort(all.begin(), all.end());
  return all;
}

double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Vec3 uniform_point(std::mt19937_64& random) {
  const double x = uniform(random, 0, 1), y = uniform(random, 0, 1), z = uniform(random, 0, 1);
  return {x, y, z};
}

Balls random_balls(std::mt19937_64& random, int n, double low, double high) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < n; ++i) {
    centers.push_back(uniform_point(random));
    radii.push_back(uniform(random, low, high));
  }
  return make_balls(std::move(centers), std::move(radii));
}

/// Centers and radii on small grids: cospherical centers, equal balls, tangent balls, nested balls.
Balls grid_balls(std::mt19937_64& random, int n, int side) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  const auto digit = [&] { return static_cast<double>(random() % static_cast<unsigned>(side)); };
  for (int i = 0; i < n; ++i) {
    const double x = digit(), y = digit(), z = digit();
    centers.push_back({x, y, z});
    radii.push_back(0.25 * static_cast<double>(random() % 6));
  }
  return make_balls(std::move(centers), std::move(radii));
}

void expect_as_gudhi(const Balls& balls) {
  const SimplicialComplex complex = shape_of(balls);
  const test::GudhiComplex expected = test::gudhi_complex(complex.centers, complex.weights);
  EXPECT_EQ(simplices_of(complex), expected.simplices);
  EXPECT_EQ(complex.betti, expected.betti);
}

/// Classes as they follow from the complex alone: a simplex is interior when the tetrahedra of the complex
/// close up around it.
void expect_classes(const SimplicialComplex& complex) {
  std::map<std::array<std::int32_t, 3>, int> tetrahedra;
  for (const auto& t : complex.tetrahedra) {
    for (std::size_t k = 0; k < 4; ++k) {
      std::array<std::int32_t, 3> f{};
      std::copy_if(t.begin(), t.end(), f.begin(), [&](auto v) { return v != t[k]; });
      ++tetrahedra[f];
    }
  }
  std::map<std::vector<std::int32_t>, std::pair<int, int>> around;  // triangles, those that are no boundary
  for (const auto& f : complex.triangles) {
    const int closed = tetrahedra[f] == 2;
    const std::vector<std::vector<std::int32_t>> faces = {{f[0]},       {f[1]},       {f[2]},
                                                          {f[0], f[1]}, {f[0], f[2]}, {f[1], f[2]}};
    for (const auto& face : faces) {
      ++around[face].first;
      around[face].second += closed;
    }
  }
  std::set<std::int32_t> edged;
  for (const auto& e : complex.edges) edged.insert(e.begin(), e.end());
  const auto expected = [&](const std::vector<std::int32_t>& face, bool has_coface) {
    const auto [count, closed] = around[face];
    if (count > 0 && count == closed) return SimplexClass::interior;
    return has_coface ? SimplexClass::regular : SimplexClass::singular;
  };
  for (std::size_t i = 0; i < complex.vertices.size(); ++i) {
    const auto v = complex.vertices[i];
    ASSERT_EQ(complex.vertex_classes[i], static_cast<std::uint8_t>(expected({v}, edged.contains(v)))) << v;
  }
  for (std::size_t i = 0; i < complex.edges.size(); ++i) {
    const auto& e = complex.edges[i];
    const std::vector<std::int32_t> face(e.begin(), e.end());
    ASSERT_EQ(complex.edge_classes[i], static_cast<std::uint8_t>(expected(face, around[face].first > 0)));
  }
  for (std::size_t i = 0; i < complex.triangles.size(); ++i) {
    const int count = tetrahedra[complex.triangles[i]];
    const auto kind = count == 2   ? SimplexClass::interior
                      : count == 1 ? SimplexClass::regular
                                   : SimplexClass::singular;
    ASSERT_EQ(complex.triangle_classes[i], static_cast<std::uint8_t>(kind));
  }
}

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

TEST(alpha_shape, agrees_with_gudhi_on_small_random_sets) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 150; ++round) {
    const int n = 4 + static_cast<int>(random() % 40);
    expect_as_gudhi(random_balls(random, n, 0, uniform(random, 0.05, 0.6)));
    if (HasFailure()) FAIL() << "round " << round << ", " << n << " balls";
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_degenerate_grids) {
  std::mt19937_64 random(2);
  for (int round = 0; round < 150; ++round) {
    Balls balls = grid_balls(random, 6 + static_cast<int>(random() % 40), 2 + static_cast<int>(random() % 4));
    if (regular_cells(balls.centers, balls.radii, no_monitor()).dimension < 3) continue;
    expect_as_gudhi(balls);
    if (HasFailure()) FAIL() << "round " << round;
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_thousands_of_balls) {
  std::mt19937_64 random(3);
  expect_as_gudhi(random_balls(random, 3000, 0, 0.09));
}

TEST(alpha_shape, agrees_with_gudhi_when_radii_span_twelve_orders_of_magnitude) {
  std::mt19937_64 random(4);
  for (int round = 0; round < 10; ++round) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < 200; ++i) {
      const double size = std::pow(10.0, uniform(random, -12, 0));
      centers.push_back(0.5 * (uniform_point(random) - Vec3{0.5, 0.5, 0.5}));
      if (i % 2 == 1) centers.back() = centers[static_cast<std::size_t>(i) - 1] + 3 * size * centers.back();
      radii.push_back(0.3 * size);
    }
    expect_as_gudhi(make_balls(std::move(centers), std::move(radii)));
  }
}

TEST(alpha_shape, agrees_with_gudhi_on_a_real_model) {
  const std::string path = test::data_file("models/kitten_points.xyz.gz");
  if (path.empty()) GTEST_SKIP() << "models/kitten_points.xyz.gz is not there";
  std::vector<Vec3> centers;
  gzFile file = gzopen(path.c_str(), "rb");
  char line[256];
  Vec3 p;
  while (gzgets(file, line, sizeof line) != nullptr) {
    if (std::sscanf(line, "%lf %lf %lf", &p.x, &p.y, &p.z) == 3) centers.push_back(p);
  }
  gzclose(file);
  ASSERT_GT(centers.size(), 5000u);
  expect_as_gudhi(make_balls(centers, 0.02 * bounding_box(centers).longest_edge()));
}

TEST(alpha_shape, of_flat_input_is_that_of_the_input_with_far_points_added) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 60; ++round) {
    const bool collinear = round % 3 == 0;
    std::vector<Vec3> centers;
    std::vector<double> radii;
    const int n = 1 + static_cast<int>(random() % 30);
    for (int i = 0; i < n; ++i) {
      const double x = static_cast<double>(random() % 16),
                   y = collinear ? 3 : static_cast<double>(random() % 16);
      centers.push_back({x, y, x + y});
      radii.push_back(0.25 * static_cast<double>(random() % 12));
    }
    const SimplicialComplex flat = shape_of(make_balls(centers, radii));
    EXPECT_EQ(flat.betti[2], 0);
    for (const auto kind : flat.edge_classes) EXPECT_NE(kind, 0);
    for (const auto kind : flat.vertex_classes) EXPECT_NE(kind, 0);

    for (const Vec3 far : {Vec3{0, 0, 4096}, {0, 0, -4096}, {0, 4096, 0}, {4096, 0, 0}}) {
      centers.push_back(far);
      radii.push_back(0);
    }
    std::vector<double> weights;
    for (const double r : radii) weights.push_back(r * r);
    test::GudhiComplex expected = test::gudhi_complex(centers, weights);
    std::erase_if(expected.simplices, [n](const auto& s) { return s.back() >= n; });
    EXPECT_EQ(simplices_of(flat), expected.simplices) << "round " << round;
    EXPECT_EQ(flat.betti, (Betti{expected.betti[0] - 4, expected.betti[1], expected.betti[2]}));
  }
}

TEST(alpha_shape, classifies_simplices_by_the_tetrahedra_around_them) {
  std::mt19937_64 random(6);
  std::set<std::uint8_t> met;
  for (int round = 0; round < 40; ++round) {
    const Balls balls =
        round % 2 == 0 ? random_balls(random, 200, 0, 0.02 * (1 + round / 4)) : grid_balls(random, 60, 5);
    const SimplicialComplex complex = shape_of(balls);
    expect_classes(complex);
    met.insert(complex.vertex_classes.begin(), complex.vertex_classes.end());
  }
  EXPECT_EQ(met.size(), 3u);
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

TEST(simplicial_complex, names_a_face_that_is_missing) {
  std::mt19937_64 random(12);
  SimplicialComplex complex = shape_of(random_balls(random, 50, 0.1, 0.3));
  ASSERT_EQ(broken_invariant(complex), "");
  std::vector<std::array<std::int32_t, 3>> triangles(complex.triangles.begin(), complex.triangles.end());
  std::vector<std::uint8_t> classes(complex.triangle_classes.begin(), complex.triangle_classes.end());
  const auto of_a_tetrahedron = std::find(classes.begin(), classes.end(), 0) - classes.begin();
  triangles.erase(triangles.begin() + of_a_tetrahedron);
  classes.erase(classes.begin() + of_a_tetrahedron);
  complex.triangles = triangles;
  complex.triangle_classes = classes;
  EXPECT_NE(broken_invariant(complex).find("its face triangle"), std::string::npos)
      << broken_invariant(complex);
}

TEST(simplicial_complex, reports_what_does_not_fit) {
  const SimplicialComplex path = shape_of(make_balls({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.75));
  SimplicialComplex c = path;
  c.betti = {1, 1, 0};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.edges = {{1, 0}, {1, 2}};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.edges = {{1, 2}, {0, 1}};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.edges = {{0, 1}, {1, 3}};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.edge_classes = {2, 1};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.vertex_classes = {2, 1, 1};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.edge_classes = {2};
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.delta = -1;
  EXPECT_NE(broken_invariant(c), "");
  c = path;
  c.weights = {1, 1};
  EXPECT_NE(broken_invariant(c), "");
}

}  // namespace
}  // namespace ballflow::geometry
