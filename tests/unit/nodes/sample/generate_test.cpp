#include "sample/generate.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/circle.hpp"
#include "sample/sample.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {
namespace {

double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += dot(at(0), cross(at(1), at(2))) / 6;
  }
  return sum;
}

double mean_edge(const TriangleMesh& mesh) {
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      sum += distance(mesh.vertices[static_cast<std::size_t>(t[k])],
                      mesh.vertices[static_cast<std::size_t>(t[(k + 1) % 3])]);
    }
  }
  return sum / (3 * static_cast<double>(mesh.triangles.size()));
}

/// The smallest distance of two points, by a sweep along x.
double least_distance(const TriangleMesh& mesh, double at_most) {
  std::vector<Vec3> p(mesh.vertices.begin(), mesh.vertices.end());
  std::sort(p.begin(), p.end());
  double least = at_most;
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size() && p[j].x - p[i].x < least; ++j)
      least = std::min(least, distance(p[i], p[j]));
  }
  return least;
}

class EveryShape : public testing::TestWithParam<ShapeInfo> {};

TEST_P(EveryShape, is_a_well_sampled_closed_surface_of_its_genus) {
  const ShapeInfo& info = GetParam();
  const TriangleMesh mesh = generate(parse_shape(info.name));
  const MeshTopology t = mesh_topology(mesh);
  EXPECT_TRUE(t.closed && t.manifold && t.oriented);
  EXPECT_EQ(t.genus, info.genus);
  EXPECT_EQ(t.components, 1);
  EXPECT_GT(volume(mesh), 0) << "turned inside out";
  EXPECT_EQ(broken_invariant(PointSet{mesh.vertices, {}}), "");
  EXPECT_NEAR(static_cast<double>(t.vertices), static_cast<double>(info.n),
              0.13 * static_cast<double>(info.n));
  const double edge = mean_edge(mesh);
  EXPECT_GT(least_distance(mesh, edge), edge / 3);
}

TEST_P(EveryShape, scales_with_R) {
  const ShapeInfo& info = GetParam();
  ShapeOptions options = parse_shape(std::string(info.name) + "?n=3000");
  const TriangleMesh unit = generate(options);
  options.R = 4;
  if (info.r_per_R != 0) options.r = 4 * info.r_per_R;
  const TriangleMesh large = generate(options);
  ASSERT_EQ(unit.vertices.size(), large.vertices.size());
  for (std::size_t v = 0; v < unit.vertices.size(); ++v) EXPECT_EQ(large.vertices[v], 4 * unit.vertices[v]);
  EXPECT_EQ(unit.triangles, large.triangles);
}

INSTANTIATE_TEST_SUITE_P(generate, EveryShape, testing::ValuesIn(shapes().begin(), shapes().end()),
                         [](const auto& shape) { return "of_" + std::string(shape.param.name); });

TEST(generate, vertices_of_sphere_and_torus_lie_on_the_surface) {
  for (const Vec3& p : generate(parse_shape("sphere?R=2&n=2000")).vertices)
    EXPECT_NEAR(length(p), 2, 1e-15 * 8);
  for (const Vec3& p : generate(parse_shape("torus?R=2&r=0.5&n=2000")).vertices) {
    EXPECT_NEAR(std::hypot(std::hypot(p.x, p.y) - 2, p.z), 0.5, 1e-14);
  }
}

TEST(generate, vertices_of_the_double_torus_satisfy_its_equation) {
  for (const Vec3& p : generate(parse_shape("doubleTorus?r=0.2&n=5000")).vertices) {
    const double q = p.x * p.x * (1 - p.x * p.x) - p.y * p.y;
    EXPECT_NEAR(q * q + (p.z * p.z - 0.04) / 2, 0, 1e-14);
  }
}

TEST(generate, volumes_approach_the_formulas) {
  constexpr double pi = std::numbers::pi;
  EXPECT_NEAR(volume(generate(parse_shape("sphere"))), 4 * pi / 3, 2e-3 * 4 * pi / 3);
  EXPECT_NEAR(volume(generate(parse_shape("torus"))), 2 * pi * pi * 0.09, 2e-3 * 2 * pi * pi * 0.09);
  EXPECT_NEAR(volume(generate(parse_shape("box?R=2&r=0.5&n=500"))), 16, 1e-12);
  EXPECT_NEAR(volume(generate(parse_shape("bracket?r=0.2&n=500"))),
              0.8 * 0.2 + 0.8 * 0.8 * 0.2 - 0.4 * 0.4 * 0.2, 1e-12);
  // A cube less a ball that has lost six caps.
  const double r = 1.2, cap = pi * (r - 1) * (r - 1) * (2 * r + 1) / 3;
  EXPECT_NEAR(volume(generate(parse_shape("frame?n=20000"))), 8 - (4 * pi / 3 * r * r * r - 6 * cap), 2e-3);
}

TEST(generate, the_bump_adds_a_gaussian_wherever_it_is) {
  const auto integral = [](double from, double to) {  // of exp(-x^2 / (2 * 0.2^2))
    const double width = 0.2 * std::sqrt(2.0);
    return 0.1 * std::sqrt(2 * std::numbers::pi) * (std::erf(to / width) - std::erf(from / width));
  };
  for (const double place : {0.56, 0.7, 0.96}) {
    const TriangleMesh mesh = generate(parse_shape("bumpBox?n=20000&r=" + std::to_string(place)));
    const double bump = 0.32 * integral(-place, 2 - place) * integral(-0.4, 0.4);
    EXPECT_NEAR(volume(mesh), 2 * 0.8 * 0.6 + bump, 1e-4) << place;
  }
}

TEST(generate, the_frame_is_one_of_every_size_and_its_vertices_lie_on_cube_and_ball) {
  for (int n : {50, 100, 333, 1000, 5000}) {
    for (const char* r : {"1.02", "1.1", "1.2", "1.39"}) {
      const TriangleMesh mesh =
          generate(parse_shape("frame?r=" + std::string(r) + "&n=" + std::to_string(n)));
      EXPECT_EQ(mesh_topology(mesh).genus, 5);
      EXPECT_GT(volume(mesh), 0);
      for (const Vec3 p : mesh.vertices) {
        const double cube = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        EXPECT_TRUE(cube == 1 || std::abs(length(p) - std::stod(r)) < 1e-14);
        EXPECT_LE(cube, 1);
        EXPECT_GE(length(p), std::stod(r) - 1e-14);
      }
    }
  }
}

TEST(generate, the_double_torus_is_resolved_at_every_size) {
  // Grids that are nearly tangent at a saddle give non-manifold edges unless they are moved.
  for (int n = 4000; n < 12000; n += 400) {
    ShapeOptions options = parse_shape("doubleTorus");
    options.n = n;
    EXPECT_EQ(mesh_topology(generate(options)).genus, 2) << n;
  }
}

TEST(generate, refuses_sizes_out_of_range_and_says_which_are_in) {
  const auto error = [](const char* shape) -> std::string {
    try {
      generate(parse_shape(shape));
    } catch (const InputError& e) {
      return e.what();
    }
    return {};
  };
  EXPECT_NE(error("teapot").find("there is no shape \"teapot\"\nthe shapes are sphere, torus, doubleTorus"),
            std::string::npos);
  EXPECT_NE(error("torus?q=1").find("there is no parameter \"q\"\nthe parameters are n, R and r"),
            std::string::npos);
  EXPECT_NE(error("torus?n=1e3").find("not a whole number"), std::string::npos);
  EXPECT_NE(error("torus?R=big").find("not a number"), std::string::npos);
  EXPECT_NE(error("torus?R"), "");
  EXPECT_NE(error("torus?r=1"), "");
  EXPECT_NE(error("torus?r=-0.1"), "");
  EXPECT_NE(error("torus?r=nan"), "");
  EXPECT_NE(error("torus?R=-1"), "");
  EXPECT_NE(error("torus?R=inf"), "");
  EXPECT_NE(error("torus?n=3"), "");
  EXPECT_NE(error("torus?n=6000000"), "");
  EXPECT_NE(error("sphere?r=1").find("r is not used"), std::string::npos);
  EXPECT_NE(error("frame?r=1").find("r is above 1.01 R"), std::string::npos);
  EXPECT_NE(error("frame?r=1.5").find("below 1.4 R"), std::string::npos);
  EXPECT_NE(error("torus?r=0.01&n=100").find("are too few"), std::string::npos);
  EXPECT_EQ(error("torus?"), "");
}

TEST(on_circle, agrees_with_the_library_and_is_exact_at_quarters) {
  for (int i = -300; i < 1300; ++i) {
    const double turns = i / 997.0;
    const auto [c, s] = on_circle(turns);
    const double fraction = turns - std::floor(turns);
    EXPECT_NEAR(c, std::cos(2 * std::numbers::pi * fraction), 1e-15);
    EXPECT_NEAR(s, std::sin(2 * std::numbers::pi * fraction), 1e-15);
  }
  for (int quarter = 0; quarter < 5; ++quarter) {
    const auto [c, s] = on_circle(0.25 * quarter);
    EXPECT_EQ(c, quarter % 2 != 0 ? 0 : quarter == 2 ? -1 : 1);
    EXPECT_EQ(s, quarter % 2 == 0 ? 0 : quarter == 3 ? -1 : 1);
  }
}

}  // namespace
}  // namespace ballflow::geometry
