#include "look/look.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

MeshFile off(const std::string& text) { return parse_mesh(text, MeshFormat::off); }

const std::string tetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST(look, at_a_tetrahedron_knows_its_solid) {
  const Look look = look_at(off(tetrahedron));
  EXPECT_TRUE(look.closed);
  EXPECT_TRUE(look.topology.manifold);
  EXPECT_EQ(look.turned, 0);
  ASSERT_TRUE(look.betti);
  EXPECT_EQ(*look.betti, (Betti{1, 0, 0}));
  EXPECT_NEAR(look.shells->volume(), 1.0 / 6, 1e-15);
  EXPECT_NEAR(look.area, 1.5 + std::sqrt(3) / 2, 1e-15);
  EXPECT_EQ(look.unknown_because, "");
  EXPECT_DOUBLE_EQ(look.spacing.largest, std::sqrt(2));
  EXPECT_TRUE(look.strays.points.empty());
}

TEST(look, turns_what_faces_the_other_way_before_it_measures) {
  std::string one = tetrahedron;
  one.replace(one.find("3 0 1 3"), 7, "3 1 0 3");
  const Look look = look_at(off(one));
  EXPECT_EQ(look.turned, 1);
  EXPECT_TRUE(look.closed);
  ASSERT_TRUE(look.betti);
  EXPECT_NEAR(look.shells->volume(), 1.0 / 6, 1e-15);

  std::string inwards = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 3 1\n3 0 2 3\n3 1 3 2\n";
  const Look inside_out = look_at(off(inwards));
  EXPECT_TRUE(inside_out.shells->inside_out);
  EXPECT_NEAR(inside_out.shells->volume(), 1.0 / 6, 1e-15);
  for (const Triangle& t : inside_out.outwards.triangles) {
    const auto corner = [&](std::size_t k) {
      return inside_out.outwards.vertices[static_cast<std::size_t>(t[k])];
    };
    EXPECT_GT(dot(cross(corner(1) - corner(0), corner(2) - corner(0)), corner(0) - Vec3{0.1, 0.1, 0.1}), 0);
  }
}

TEST(look, says_why_the_solid_is_unknown) {
  std::string open = tetrahedron;
  open.replace(open.find("4 4 0"), 5, "4 3 0");
  open.resize(open.find("3 1 2 3"));
  const Look look = look_at(off(open));
  EXPECT_FALSE(look.closed);
  EXPECT_FALSE(look.betti);
  EXPECT_FALSE(look.shells);
  EXPECT_EQ(look.gaps.open_edges, 3);
  EXPECT_EQ(look.unknown_because, "the surface is open");
  // Two tetrahedra with a common corner: closed, and what is inside is known, but no manifold.
  const Look touching =
      look_at(off("OFF\n7 8 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n-1 0 0\n0 -1 0\n0 0 -1\n"
                  "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n3 0 4 5\n3 0 6 4\n3 0 5 6\n3 4 6 5\n"));
  EXPECT_TRUE(touching.closed);
  EXPECT_EQ(touching.unknown_because, "the surface is not a manifold");
  EXPECT_NEAR(touching.shells->volume(), 1.0 / 3, 1e-15);
}

TEST(look, says_where_triangles_cross) {
  // A triangle that is pierced at (0.25, 0.25, 0) by one that stands on a corner.
  const MeshFile model =
      off("OFF\n6 2 0\n0 0 0\n1 0 0\n0 1 0\n0.25 0.25 -1\n0.25 0.25 1\n0.26 0.26 1\n3 0 1 2\n3 3 4 5\n");
  const Look look = look_at(model);
  ASSERT_EQ(look.intersections.pairs.size(), 1u);
  EXPECT_LT(distance(place_of(model.mesh, look.intersections.pairs[0]), {0.25, 0.25, 0}), 0.01);
}

TEST(look, at_points_finds_the_few_that_stretch_the_box) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  MeshFile cloud;
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{normal(random), normal(random), normal(random)};
    points.push_back((1 / length(p)) * p);
  }
  points[7] = {0, 500, 0};
  points[1200] = {-900, 0, 3};
  cloud.points.points = points;
  const Look look = look_at(cloud);
  EXPECT_EQ(look.strays.points, (std::vector<std::int32_t>{7, 1200}));
  EXPECT_LT(look.spacing.median, 0.1);
  EXPECT_FALSE(look.betti);
}

TEST(look, at_real_models_agrees_with_what_another_program_measured) {
  const std::string manifest = test::data_file("manifest.json");
  if (manifest.empty()) GTEST_SKIP() << "no test data";
  int seen = 0;
  for (const auto& entry : nlohmann::json::parse(test::read_file(manifest))) {
    const std::string name = entry.at("name");
    const auto count = [&](const char* field) {
      return entry.contains(field) && entry.at(field).is_number() ? entry.at(field).get<std::int64_t>() : -1;
    };
    if (count("verts") < 4 || count("verts") > 30000 || count("faces") < 4 || name.starts_with("broken") ||
        !entry.contains("volume") || !entry.at("volume").is_number() || entry.at("reader_error") != "" ||
        count("dup_faces") != 0)
      continue;
    const std::string file = test::data_file(entry.at("file"));
    if (file.empty()) continue;
    const Look look = look_at(read_mesh_file(file));
    ++seen;
    EXPECT_EQ(look.topology.vertices, count("verts")) << name;
    EXPECT_EQ(look.topology.faces, count("faces")) << name;
    EXPECT_EQ(look.gaps.open_edges, count("boundary_edges")) << name;
    EXPECT_EQ(look.topology.nonmanifold_edges, count("nonmanifold_edges")) << name;
    EXPECT_NEAR(look.area, entry.at("area").get<double>(), 1e-5 * look.area) << name;
    if (look.betti) {
      const double volume = entry.at("volume");
      EXPECT_NEAR(look.shells->volume(), std::abs(volume), 1e-5 * std::abs(volume)) << name;
    }
    if (count("self_intersecting_pairs") < 0) continue;
    EXPECT_EQ(static_cast<std::int64_t>(look.intersections.pairs.size()), count("self_intersecting_pairs"))
        << name;
  }
  EXPECT_GE(seen, 10);
}

}  // namespace
}  // namespace ballflow::geometry
