// The parts that EncloseBalls consists of.
#include "enclose/enclosing_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "enclose/ball_cover.hpp"
#include "enclose/solid_lattice.hpp"
#include "enclose/surface_patches.hpp"
#include "enclose_shapes.hpp"

namespace ballflow::geometry {
namespace {

double area_of(const SurfacePatches& patches) {
  const std::vector<Triangle> triangles(patches.corners.begin(), patches.corners.end());
  return surface_area(patches.vertices, triangles);
}

double longest_edge_of(const SurfacePatches& patches) {
  double longest = 0;
  for (const auto& c : patches.corners) {
    for (std::size_t k = 0; k < 3; ++k) {
      longest = std::max(longest, distance(patches.vertices[static_cast<std::size_t>(c[k])],
                                           patches.vertices[static_cast<std::size_t>(c[(k + 1) % 3])]));
    }
  }
  return longest;
}

TEST(surface_patches, are_the_surface_in_pieces_no_longer_than_asked) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const SurfacePatches patches = surface_patches(box.vertices.span(), box.triangles.span(), 0.2);
  EXPECT_NEAR(area_of(patches), 22, 1e-12);
  EXPECT_LE(longest_edge_of(patches), 0.2);
  EXPECT_EQ(std::set<Vec3>(patches.vertices.begin(), patches.vertices.end()).size(), patches.vertices.size());
  const TriangleMesh twice = joined(box, box);
  EXPECT_EQ(surface_patches(twice.vertices.span(), twice.triangles.span(), 0.2).corners, patches.corners);
}

TEST(surface_patches, refined_are_the_same_surface_and_only_those_named_are_cut) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3});
  const SurfacePatches patches = surface_patches(box.vertices.span(), box.triangles.span(), 0.5);
  std::vector<std::uint8_t> cut(patches.corners.size(), 0);
  for (std::size_t p = 0; p < cut.size(); p += 3) cut[p] = 1;
  const SurfacePatches finer = refined(patches, cut, 1e-6);
  EXPECT_EQ(finer.corners.size(), patches.corners.size() + (cut.size() + 2) / 3);
  EXPECT_NEAR(area_of(finer), 22, 1e-12);
  EXPECT_EQ(refined(patches, cut, 10).corners, patches.corners);  // none is that long
}

/// Turned, so that no face is parallel to a lattice.
TriangleMesh askew(const TriangleMesh& mesh) {
  std::vector<Vec3> vertices;
  for (const Vec3 p : mesh.vertices) {
    const double x = 0.8 * p.x - 0.6 * p.y, y = 0.6 * p.x + 0.8 * p.y;
    vertices.push_back({x, 0.6 * y - 0.8 * p.z, 0.8 * y + 0.6 * p.z});
  }
  return {std::move(vertices), mesh.triangles};
}

double solid_of(const TriangleMesh& mesh) {
  SolidLatticeOptions options;
  options.band = 0.4;
  const OutsidePoints found = outside_points(askew(mesh), options);
  return static_cast<double>(found.solid) * found.unit;
}

constexpr double ball_volume = 4.0 / 3 * 3.14159265358979323846;  // of radius 1

TEST(solid_lattice, counts_the_volume_inside) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 2, 3}), sphere = shape("sphere?n=2000&R=1");
  EXPECT_NEAR(solid_of(box), 6, 0.06);
  EXPECT_NEAR(solid_of(turned_over(box)), 6, 0.06);
  EXPECT_NEAR(solid_of(joined(box, box)), 6, 0.06);  // every triangle twice
  const TriangleMesh hollow = joined(box, turned_over(box_mesh({0.2, 0.2, 0.2}, {0.8, 1.8, 2.8})));
  EXPECT_NEAR(solid_of(hollow), 6 - 0.6 * 1.6 * 2.6, 0.06);
  EXPECT_NEAR(solid_of(sphere), ball_volume, 0.05);
  TriangleMesh leaking = sphere;  // lines through the hole have no say
  leaking.triangles = std::vector<Triangle>(sphere.triangles.begin() + 1, sphere.triangles.end());
  EXPECT_NEAR(solid_of(leaking), ball_volume, 0.05);
}

TEST(solid_lattice, weights_of_points_outside_are_their_volume) {
  SolidLatticeOptions options;
  options.band = 0.4;
  options.points = 100000;
  const OutsidePoints lattice = outside_points(askew(shape("sphere?n=2000&R=1")), options);
  double outside = 0;
  for (std::size_t i = 0; i < lattice.points.size(); ++i) {
    EXPECT_GT(length(lattice.points[i]), 0.97);
    if (length(lattice.points[i]) <= 1.3) outside += lattice.weights[i] * lattice.unit;
  }
  EXPECT_NEAR(outside, ball_volume * (1.3 * 1.3 * 1.3 - 1), 0.1);
}

class CoverTest : public testing::Test {
 protected:
  static SolidLatticeOptions few() {
    SolidLatticeOptions options;
    options.band = 0.2;
    options.points = 5000;
    options.inside = 100;
    return options;
  }

  CoverTest()
      : box_(askew(box_mesh({0, 0, 0}, {0.3, 0.6, 0.9}))),
        patches_(surface_patches(box_.vertices.span(), box_.triangles.span(), 0.1)),
        outside_(outside_points(box_, few())),
        cover_(patches_, outside_.inside, outside_) {
    cover_.resize(6);
  }

  FloatBall random_ball() {
    const Vec3 c = patches_.vertices[static_cast<std::size_t>(random_.unit() *
                                                              static_cast<double>(patches_.vertices.size()))];
    return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z),
            static_cast<float>(0.1 + 0.6 * random_.unit())};
  }

  bool holds(std::size_t place, float x, float y, float z) const {
    const FloatBall& ball = cover_.place(place).ball;
    return cover_.place(place).used && squared_from(ball, x, y, z) <= ball.r * ball.r;
  }

  /// What the cover keeps up to date, counted anew.
  void expect_right() {
    std::int64_t waste = 0;
    for (std::size_t i = 0; i < outside_.points.size(); ++i) {
      const Vec3 p = outside_.points[i];
      bool in = false;
      for (std::size_t b = 0; b < cover_.places(); ++b) {
        in = in || holds(b, static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z));
      }
      if (in) waste += outside_.weights[i];
    }
    EXPECT_EQ(cover_.waste(), waste);
    std::size_t uncovered = 0, used = 0;
    for (std::size_t p = 0; p < cover_.patches(); ++p) {
      int holders = 0;
      for (std::size_t b = 0; b < cover_.places(); ++b) {
        bool all_corners = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const FloatPoints& c = cover_.patch_blocks().corner(k);
          all_corners = all_corners && holds(b, c.x[p], c.y[p], c.z[p]);
        }
        holders += all_corners ? 1 : 0;
      }
      ASSERT_EQ(cover_.patch_counts()[p], holders);
      uncovered += holders == 0 ? 1 : 0;
    }
    EXPECT_EQ(cover_.uncovered(), uncovered);
    for (std::size_t b = 0; b < cover_.places(); ++b) used += cover_.place(b).used ? 1 : 0;
    EXPECT_EQ(cover_.used(), used);
  }

  TriangleMesh box_;
  SurfacePatches patches_;
  OutsidePoints outside_;
  BallCover cover_;
  Random random_{17};
};

TEST_F(CoverTest, keeps_counts_through_changes_and_undoing) {
  for (int change = 0; change < 40; ++change) {
    const std::size_t mark = cover_.mark(), place = static_cast<std::size_t>(change) % 6;
    const std::int64_t waste = cover_.waste();
    if (change % 7 == 6 && cover_.place(place).used) {
      cover_.remove(place);
    } else {
      cover_.set(place, random_ball());
    }
    if (change % 3 == 2) {
      cover_.set((place + 1) % 6, random_ball());
      cover_.undo_to(mark);
      EXPECT_EQ(cover_.waste(), waste);
    }
    if (change % 5 == 0) expect_right();
  }
  EXPECT_GT(cover_.waste(), 0);
  expect_right();
}

TEST_F(CoverTest, no_step_of_the_search_uncovers_a_patch_or_wastes_more) {
  EnclosingSearch search(cover_, random_, no_monitor());
  search.take({random_ball(), random_ball()});
  std::int64_t before = cover_.waste();
  const auto expect_better = [&](const char* step) {
    EXPECT_EQ(cover_.uncovered(), 0U) << step;
    EXPECT_LE(cover_.waste(), before) << step;
    before = cover_.waste();
    expect_right();
  };
  expect_better("take");
  const std::int64_t first = before;
  search.sweep(3);
  expect_better("sweep");
  search.fill();
  expect_better("fill");
  EXPECT_EQ(cover_.used(), 6U);
  for (int n = 0; n < 30; ++n) search.shift();
  expect_better("shift");
  for (int n = 0; n < 10 && search.swap(); ++n) expect_better("swap");
  EXPECT_LT(before, first / 2);
}

}  // namespace
}  // namespace ballflow::geometry
