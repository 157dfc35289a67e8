#include "enclose/verify_enclosure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "enclose/covered_triangles.hpp"
#include "enclose_shapes.hpp"
#include "power/power_diagram.hpp"
#include "sample/generate.hpp"
#include "shipped_spheres.hpp"

namespace ballflow::geometry {
namespace {

constexpr VerifyEnclosureOptions report{.on_open = OnOpen::report};

Balls balls_of(std::vector<Vec3> centers, std::vector<double> radii) {
  return {std::move(centers), std::move(radii), {}, {}};
}

double random_unit(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }
Vec3 random_point(std::mt19937_64& random) {
  const double x = random_unit(random), y = random_unit(random);
  return {x, y, random_unit(random)};
}

double distance_from_balls(const Balls& balls, Vec3 p) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    least = std::min(least, distance(p, balls.centers[i]) - balls.radii[i]);
  }
  return least;
}

std::string message_of(const TriangleMesh& mesh, const Balls& balls) {
  try {
    verify_enclosure(mesh, balls, {});
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(verify_enclosure, of_a_box_in_a_ball_that_touches_its_corners_is_decided_exactly) {
  // (3, 4, 12) has the length 13; a radius one unit in the last place less leaves the corners out.
  const TriangleMesh mesh = box_mesh({-3, -4, -12}, {3, 4, 12});
  const Enclosure touching = verify_enclosure(mesh, balls_of({{0, 0, 0}}, {13}), report);
  EXPECT_TRUE(touching.encloses());
  EXPECT_EQ(touching.pieces, 12);
  EXPECT_EQ(touching.protrusion, 10);  // 13 - 3, the distance of the centre
  const Enclosure less = verify_enclosure(mesh, balls_of({{0, 0, 0}}, {std::nextafter(13.0, 0.0)}), report);
  EXPECT_FALSE(less.covers());
  EXPECT_EQ(less.open_triangles.size(), 12u);
  EXPECT_EQ(less.open_why[0], static_cast<std::uint8_t>(OpenTriangle::point_outside));
}

TEST(verify_enclosure, cuts_triangles_until_every_part_lies_in_one_ball) {
  const TriangleMesh mesh = box_mesh({0, 0, 0}, {4, 1, 1});
  std::vector<Vec3> centers;
  for (int i = 0; i < 8; ++i) centers.push_back({0.25 + 0.5 * i, 0.5, 0.5});
  const Enclosure enough = verify_enclosure(mesh, balls_of(centers, std::vector<double>(8, 0.76)), report);
  EXPECT_TRUE(enough.encloses()) << describe(enough);
  EXPECT_GT(enough.pieces, 100);
  // In the middle between two centres 0.25 remain beside the diagonal: sqrt(0.0625 + 0.5) = 0.75. Cuts meet
  // these places, so that the balls are enough as they are.
  EXPECT_TRUE(verify_enclosure(mesh, balls_of(centers, std::vector<double>(8, 0.75)), report).covers());
  const Enclosure short_of = verify_enclosure(mesh, balls_of(centers, std::vector<double>(8, 0.7)), report);
  EXPECT_FALSE(short_of.covers());
  EXPECT_NEAR(short_of.gap, 0.05, 0.002);
}

TEST(verify_enclosure, ends_where_balls_meet_on_the_surface_without_overlapping) {
  // As before, but no cut of the length 3 in halves meets a multiple of 0.5.
  const TriangleMesh mesh = box_mesh({0, 0, 0}, {3, 1, 1});
  std::vector<Vec3> centers;
  for (int i = 0; i < 6; ++i) centers.push_back({0.25 + 0.5 * i, 0.5, 0.5});
  const Enclosure exactly = verify_enclosure(mesh, balls_of(centers, std::vector<double>(6, 0.75)), report);
  EXPECT_FALSE(exactly.covers());
  for (const std::uint8_t why : exactly.open_why)
    EXPECT_EQ(why, static_cast<std::uint8_t>(OpenTriangle::undecided));
  EXPECT_EQ(exactly.open_area, 0);
  EXPECT_NE(message_of(mesh, balls_of(centers, std::vector<double>(6, 0.75))).find("without overlapping"),
            std::string::npos);
  EXPECT_TRUE(
      verify_enclosure(mesh, balls_of(centers, std::vector<double>(6, 0.75 * (1 + 1e-9))), {}).encloses());
}

TEST(verify_enclosure, finds_the_void_in_a_shell_of_balls) {
  // Balls on a sphere that cover every triangle of it leave most of the inside out.
  std::vector<Vec3> centers;
  const int n = 400;
  for (int i = 0; i < n; ++i) {
    const double z = 1 - (2.0 * i + 1) / n, t = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    centers.push_back({0.1 * r * std::cos(t), 0.1 * r * std::sin(t), 0.1 * z});
  }
  TriangleMesh mesh = generate(parse_shape("sphere?n=2000"));
  std::vector<Vec3> vertices;
  for (const Vec3 v : mesh.vertices) vertices.push_back((0.1 / length(v)) * v);
  mesh.vertices = vertices;
  const Balls shell = balls_of(centers, std::vector<double>(n, 0.018));
  const Enclosure found = verify_enclosure(mesh, shell, report);
  EXPECT_TRUE(found.covers()) << describe(found);
  EXPECT_FALSE(found.encloses());
  ASSERT_EQ(found.void_points.size(), 1u);
  EXPECT_EQ(found.void_places[0], static_cast<std::uint8_t>(VoidPlace::inside));
  EXPECT_GT(distance_from_balls(shell, found.void_points[0]), 0.05);
  EXPECT_NE(message_of(mesh, shell).find("1 void inside"), std::string::npos) << message_of(mesh, shell);

  // The same void does no harm to the shell's own wall, a solid with a cavity there.
  TriangleMesh wall = mesh;
  std::vector<Triangle> triangles(mesh.triangles.begin(), mesh.triangles.end());
  const auto offset = static_cast<std::int32_t>(vertices.size());
  for (const Vec3 v : mesh.vertices) vertices.push_back(0.93 * v);
  for (const Triangle t : mesh.triangles) triangles.push_back({t[0] + offset, t[2] + offset, t[1] + offset});
  wall.vertices = vertices;
  wall.triangles = triangles;
  const Enclosure of_wall = verify_enclosure(wall, shell, report);
  EXPECT_TRUE(of_wall.encloses()) << describe(of_wall);
  EXPECT_EQ(of_wall.void_places[0], static_cast<std::uint8_t>(VoidPlace::outside));

  // What an open mesh holds is not known.
  TriangleMesh open = mesh;
  open.triangles = std::vector<Triangle>(mesh.triangles.begin(), mesh.triangles.end() - 1);
  const Enclosure of_open = verify_enclosure(open, shell, report);
  EXPECT_FALSE(of_open.encloses());
  EXPECT_EQ(of_open.void_places[0], static_cast<std::uint8_t>(VoidPlace::unknown));
}

TEST(verify_enclosure, says_of_random_soups_and_balls_what_samples_say) {
  std::mt19937_64 random(1);
  int enclosed = 0, open = 0;
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> vertices, centers;
    std::vector<Triangle> triangles;
    for (std::int32_t k = 0; k < 12; ++k) {
      const Vec3 at = random_point(random);
      for (int i = 0; i < 3; ++i) vertices.push_back(at + 0.3 * random_point(random));
      triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    std::vector<double> radii;
    for (int i = 0; i < 60; ++i) {
      centers.push_back(1.3 * random_point(random));
      radii.push_back((0.22 + 0.004 * round) * (0.7 + 0.6 * random_unit(random)));
    }
    const TriangleMesh mesh{vertices, triangles};
    const Balls balls = balls_of(centers, radii);
    const Enclosure found = verify_enclosure(mesh, balls, report);
    EXPECT_EQ(broken_invariant(found), "");
    std::size_t next = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const bool listed =
          next < found.open_triangles.size() && found.open_triangles[next] == static_cast<std::int32_t>(t);
      double farthest = -1;
      for (int i = 0; i < 400; ++i) {
        double u = random_unit(random), v = random_unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const Vec3 p = vertices[3 * t];
        farthest = std::max(farthest, distance_from_balls(balls, p + u * (vertices[3 * t + 1] - p) +
                                                                     v * (vertices[3 * t + 2] - p)));
      }
      if (listed) {
        EXPECT_EQ(found.open_why[next], static_cast<std::uint8_t>(OpenTriangle::point_outside));
        EXPECT_GT(distance_from_balls(balls, found.open_points[next]), -1e-12) << "round " << round;
        EXPECT_LE(farthest, found.gap + 0.01) << "round " << round;
        ++next;
        ++open;
      } else {
        EXPECT_LE(farthest, 1e-12) << "round " << round << ", triangle " << t;
        ++enclosed;
      }
    }
  }
  EXPECT_GT(enclosed, 100);
  EXPECT_GT(open, 50);
}

TEST(verify_enclosure, is_the_same_with_a_diagram_doubled_triangles_and_any_orientation) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  const Balls balls = balls_of({{0.5, 0.5, 0.25}, {0.5, 0.5, 0.75}}, {0.8, 0.8});
  const PowerDiagram diagram = power_diagram(balls, {}, no_monitor());
  EXPECT_TRUE(verify_enclosure(mesh, balls, {}, no_monitor(), &diagram).encloses());
  std::vector<Triangle> twice(mesh.triangles.begin(), mesh.triangles.end());
  for (const Triangle t : mesh.triangles) twice.push_back({t[1], t[0], t[2]});
  mesh.triangles = twice;
  EXPECT_TRUE(verify_enclosure(mesh, balls, {}).encloses());
  EXPECT_THROW(verify_enclosure(mesh, balls_of({{0.5, 0.5, 0.25}}, {0.8}), {}, no_monitor(), &diagram),
               InputError);
}

TEST(verify_enclosure, names_the_first_place_and_refuses_what_it_cannot_use) {
  const TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  EXPECT_NE(
      message_of(mesh, balls_of({{0, 0, 0}}, {0.5})).find("triangle 0: its point (0, 1, 0) is in no ball"),
      std::string::npos)
      << message_of(mesh, balls_of({{0, 0, 0}}, {0.5}));
  EXPECT_NE(message_of(mesh, {}).find("12 of 12 triangles are not covered"), std::string::npos);
  EXPECT_NE(message_of({}, {}).find("no triangles"), std::string::npos);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(verify_enclosure(mesh, balls_of({{nan, 0, 0}}, {1}), report), InputError);
  EXPECT_EQ(verify_enclosure(mesh, {}, report).open_area, 6);
}

TEST(verify_enclosure, says_of_the_spheres_of_other_tools_what_samples_say) {
  const std::vector<ShippedSpheres> shipped = shipped_spheres();
  if (shipped.empty()) GTEST_SKIP() << "SKIPPED: no spheres of other tools here";
  for (const ShippedSpheres& link : shipped) {
    const Enclosure found = verify_enclosure(link.mesh, link.balls, report);
    EXPECT_FALSE(found.encloses()) << link.name;
    EXPECT_NEAR(found.open_area / found.area, link.outside, 0.01) << link.name;
    EXPECT_NEAR(found.gap, link.gap, 0.03 * link.gap + 0.0003) << link.name;
  }
  EXPECT_GT(shipped.size(), 30U);
}

/// Samples miss what stands out a little: grown by the largest gap that 100 000 of them found, the spheres of
/// every link still leave something out, of ten of them more than 0.05 mm.
TEST(verify_enclosure, refuses_spheres_that_enclose_all_samples) {
  const std::vector<ShippedSpheres> shipped = shipped_spheres();
  if (shipped.empty()) GTEST_SKIP() << "SKIPPED: no spheres of other tools here";
  int links = 0, seen = 0;
  for (const ShippedSpheres& link : shipped) {
    if (link.name.rfind("morphit", 0) != 0) continue;
    std::vector<double> radii(link.balls.radii.begin(), link.balls.radii.end());
    for (double& r : radii) r += link.gap;
    const Enclosure found = verify_enclosure(
        link.mesh, balls_of({link.balls.centers.begin(), link.balls.centers.end()}, radii), report);
    EXPECT_FALSE(found.encloses()) << link.name;
    EXPECT_LT(found.gap, 0.001) << link.name;
    ++links;
    seen += found.gap > 5e-5 ? 1 : 0;
  }
  EXPECT_EQ(links, 18);
  EXPECT_EQ(seen, 10);
}

TEST(verify_enclosure, bounds_how_far_the_surface_is_from_the_balls) {
  // A ball in a cube: the corners are farthest.
  const TriangleMesh cube = box_mesh({-1, -1, -1}, {1, 1, 1});
  const Enclosure one = verify_enclosure(cube, balls_of({{0, 0, 0}}, {1}), report);
  const double corner = std::sqrt(3.0) - 1;
  EXPECT_GE(one.gap_at_most, corner);
  EXPECT_LE(one.gap_at_most, 1.01 * corner + 1e-9);
  // Two balls, of which either holds an end: the middle is farthest, where no corner of a triangle is.
  const TriangleMesh bar = box_mesh({-4, -1, -1}, {4, 1, 1});
  const Enclosure two = verify_enclosure(bar, balls_of({{-4, 0, 0}, {4, 0, 0}}, {2, 2}), report);
  const double middle = std::sqrt(18.0) - 2;
  EXPECT_GE(two.gap_at_most, middle);
  EXPECT_LE(two.gap_at_most, 1.02 * middle);
  EXPECT_EQ(verify_enclosure(cube, balls_of({{0, 0, 0}}, {2}), report).gap_at_most, 0);
  EXPECT_EQ(verify_enclosure(cube, {}, report).gap_at_most, -1);
}

TEST(verify_enclosure, bounds_the_gap_of_random_balls_from_above_and_closely) {
  std::mt19937_64 random(11);
  for (const char* name : {"torus?n=200", "box?n=100", "3cross?n=300"}) {
    const TriangleMesh mesh = shape(name);
    const Box box = bounding_box(mesh.vertices.span());
    for (int round = 0; round < 3; ++round) {
      std::vector<Vec3> centers;
      std::vector<double> radii;
      for (int i = 0; i < 12; ++i) {
        const Vec3 p = random_point(random), edge = box.upper - box.lower;
        centers.push_back(box.lower + Vec3{p.x * edge.x, p.y * edge.y, p.z * edge.z});
        radii.push_back(0.3 * random_unit(random) * box.longest_edge());
      }
      const Balls balls = balls_of(centers, radii);
      const Enclosure found = verify_enclosure(mesh, balls, report);
      double farthest = 0;  // of a fine grid on every triangle
      for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])],
                   b = mesh.vertices[static_cast<std::size_t>(t[1])],
                   c = mesh.vertices[static_cast<std::size_t>(t[2])];
        constexpr int fine = 12;
        for (int i = 0; i <= fine; ++i) {
          for (int j = 0; i + j <= fine; ++j) {
            const double u = static_cast<double>(i) / fine, v = static_cast<double>(j) / fine;
            farthest = std::max(farthest, distance_from_balls(balls, a + u * (b - a) + v * (c - a)));
          }
        }
      }
      EXPECT_GE(found.gap_at_most, farthest);
      EXPECT_LE(found.gap_at_most, std::max(1.03 * farthest, farthest + 1e-3 * box.longest_edge())) << name;
    }
  }
}

TEST(verify_enclosure, of_points_proves_nothing) {
  const TriangleMesh cloud{{{0, 0, 0}, {1, 0, 0}}, {}};
  const Enclosure found = verify_enclosure(cloud, balls_of({{0, 0, 0}}, {9}), {.on_open = OnOpen::expect});
  EXPECT_EQ(found.triangles, 0);
  EXPECT_FALSE(found.encloses());
  EXPECT_EQ(found.gap_at_most, -1);
  EXPECT_EQ(describe(found), "there is no surface: points enclose nothing");
  EXPECT_EQ(broken_invariant(found), "");
  EXPECT_THROW(verify_enclosure(cloud, balls_of({{0, 0, 0}}, {9}), report), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
