#include "types/ellipsoids.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "base/random.hpp"
#include "cover/greedy.hpp"
#include "ellipsoids/apply_scaling.hpp"
#include "ellipsoids/ellipsoid_matrix.hpp"
#include "ellipsoids/principal_scaling.hpp"
#include "ellipsoids/scale_back.hpp"
#include "ellipsoids/select_ellipsoids.hpp"
#include "ellipsoids/verify_ellipsoids.hpp"
#include "search/ellipsoid.hpp"

using namespace ballflow::geometry;

namespace {

double between(Random& random, double low, double high) { return low + (high - low) * random.unit(); }

Frame turned_frame() { return frame_of({0.8, 0.1, -0.5, 0.3}); }

/// A closed box with these edges, turned and moved.
TriangleMesh box_mesh(Vec3 edges, const Frame& frame, Vec3 center) {
  std::vector<Vec3> vertices;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5})
        vertices.push_back(center + frame.out_of({x * edges.x, y * edges.y, z * edges.z}));
  const std::vector<Triangle> triangles{{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                                        {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  return {vertices, triangles};
}

struct Warnings : Monitor {
  void warn(const std::string& text) override { all += text; }
  std::string all;
};

std::string refusal(auto&& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

}  // namespace

TEST(PrincipalScaling, a_turned_box_is_stretched_to_a_cube) {
  const Vec3 edges{3, 2, 0.05};
  const TriangleMesh mesh = box_mesh(edges, turned_frame(), {10, -4, 7});
  for (const ScalingFactors factors : {ScalingFactors::chords, ScalingFactors::extents}) {
    PrincipalScalingOptions options;
    options.factors = factors;
    const Scaling s = principal_scaling({mesh.vertices, {}}, mesh, options);
    EXPECT_EQ(broken_invariant(s), "");
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(std::abs(dot(s.frame().axes[i], turned_frame().axes[i])), 1, 1e-9);
    EXPECT_NEAR(s.thickness.x, 3, 1e-9);
    EXPECT_NEAR(s.thickness.z, 0.05, 1e-9);
    EXPECT_NEAR(s.factors.y, 1.5, 1e-9);
    EXPECT_NEAR(s.factors.z, 60, 1e-6);
    const TriangleMesh forth = apply_scaling(mesh, s, ScalingDirection::forth);
    const Box box = bounding_box(forth.vertices.span());
    EXPECT_NEAR(box.upper.x - box.lower.x, 3, 1e-9);
    EXPECT_NEAR(box.upper.z - box.lower.z, 3, 1e-9);
    const TriangleMesh back = apply_scaling(forth, s, ScalingDirection::back);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
      EXPECT_LE(distance(back.vertices[v], mesh.vertices[v]), 1e-13);
  }
}

TEST(PrincipalScaling, a_bent_sheet_goes_by_its_thickness_and_not_by_how_far_it_is_bent) {
  // A roof of two plates at 90 degrees: its box is as high as wide, the mean chord along its height is
  // (thickness) * sqrt 2, along the ridge its length.
  std::vector<Vec3> profile{{-1, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0.98, 0, 0}, {0, 0, 0.98}, {-0.98, 0, 0}};
  std::vector<Vec3> vertices;
  for (const double y : {0.0, 3.0})
    for (const Vec3 p : profile) vertices.push_back({p.x, y, p.z});
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : {Triangle{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}}) {
    triangles.push_back({a, c, b});
    triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (int i = 0; i < 6; ++i) {
    const int j = (i + 1) % 6;
    triangles.push_back({i, j, j + 6});
    triangles.push_back({i, j + 6, i + 6});
  }
  PrincipalScalingOptions options;
  options.axes = ScalingAxes::coordinates;
  const Scaling s = principal_scaling({}, {vertices, triangles}, options);
  EXPECT_NEAR(s.thickness.y, 3, 1e-12);
  // The section has the area 1 - 0.98^2; projected along z with all that lies above each other it has the
  // width 2 (half of the integral of |n.u|: 2 above, 1.96 below, 0.04 at the feet). Along x it is 1 high
  // twice.
  const double section = 1 - 0.98 * 0.98;
  EXPECT_NEAR(s.thickness.z, section / 2, 1e-12);
  EXPECT_NEAR(s.thickness.x, section / ((1 + 0.98) * 2 / 2), 1e-12);
}

TEST(PrincipalScaling, equal_moments_give_axes_that_do_not_depend_on_rounding) {
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    TriangleMesh mesh = box_mesh({1, 1, 0.02}, {}, {0.1, 0.2, 0.3});
    std::vector<Vec3> moved(mesh.vertices.begin(), mesh.vertices.end());
    for (Vec3& p : moved) p = p + 1e-13 * Vec3{random.unit(), random.unit(), random.unit()};
    mesh.vertices = moved;
    const Frame frame = principal_scaling({}, mesh).frame();
    EXPECT_NEAR(std::abs(frame.axes[0].x) + std::abs(frame.axes[0].y), 1, 1e-6);
    EXPECT_NEAR(std::abs(frame.axes[2].z), 1, 1e-9);
  }
  Warnings warnings;
  const Scaling cube = principal_scaling({}, box_mesh({2, 2, 2}, turned_frame(), {}), {}, warnings);
  EXPECT_EQ(cube.frame().axes, Frame{}.axes);
  EXPECT_NE(warnings.all.find("hardly be fewer"), std::string::npos);
}

TEST(PrincipalScaling, clouds_and_normals_and_given_factors) {
  std::vector<Vec3> points;
  for (const double x : {0.0, 1.0, 2.0, 3.0, 4.0})
    for (const double y : {0.0, 1.0, 2.0})
      for (const double z : {0.0, 0.1}) points.push_back({z, x, y});
  const Scaling cloud = principal_scaling({points, {}}, {});
  EXPECT_NEAR(cloud.factors.y, 2, 1e-12);
  EXPECT_NEAR(cloud.factors.z, 40, 1e-9);
  EXPECT_EQ(cloud.thickness_from, static_cast<std::uint8_t>(ThicknessFrom::extents));
  PrincipalScalingOptions options;
  options.factors = ScalingFactors::given;
  options.given = {2, 4, 100};
  options.axes = ScalingAxes::normals;
  const TriangleMesh mesh = box_mesh({3, 2, 0.05}, turned_frame(), {});
  const Scaling given = principal_scaling({}, mesh, options);
  EXPECT_EQ(given.factors, (Vec3{1, 2, 50}));
  EXPECT_NEAR(std::abs(dot(given.frame().axes[2], turned_frame().axes[2])), 1, 1e-9);
  options = {};
  options.stretch = 0;
  EXPECT_EQ(principal_scaling({}, mesh, options).factors, (Vec3{1, 1, 1}));
  options.stretch = 0.5;
  EXPECT_NEAR(principal_scaling({}, mesh, options).factors.z, 1 + 59 / 2.0, 1e-6);
}

TEST(PrincipalScaling, flat_and_damaged_objects_are_refused_with_a_next_step) {
  const auto flat = [](Vec3 edges) {
    return refusal([&] { (void)principal_scaling({}, box_mesh(edges, turned_frame(), {})); });
  };
  EXPECT_NE(flat({1, 1, 0}).find("no volume"), std::string::npos);
  EXPECT_NE(flat({1, 1, 1e-11}).find("flat"), std::string::npos);
  EXPECT_NE(flat({0, 0, 0}).find("one"), std::string::npos);
  EXPECT_NE(refusal([] {
              (void)principal_scaling({{Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}}, {});
            }).find("flat"),
            std::string::npos);
  EXPECT_NE(refusal([] { (void)principal_scaling({}, {}); }).find("no points"), std::string::npos);
  PrincipalScalingOptions options;
  options.factors = ScalingFactors::given;
  options.given = {1, 0, 1};
  EXPECT_NE(refusal([&] {
              (void)principal_scaling({}, box_mesh({1, 2, 3}, {}, {}), options);
            }).find("factors"),
            std::string::npos);
}

TEST(ScaleBack, no_point_of_a_grown_ellipsoid_is_farther_from_the_solid_than_it_may) {
  const Vec3 edges{3, 2, 0.05};
  const TriangleMesh mesh = box_mesh(edges, turned_frame(), {1, 2, 3});
  const Scaling s = principal_scaling({}, mesh);
  const TriangleMesh stretched = apply_scaling(mesh, s, ScalingDirection::forth);
  Random random(7);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < 60; ++i) {
    // Inside the stretched box, with radii that stand out of it by far.
    centers.push_back({between(random, -1.5, 1.5), between(random, -1.5, 1.5), between(random, -1.5, 1.5)});
    radii.push_back(between(random, 0, 3));
  }
  const Balls balls{centers, radii, {}, {}};
  for (const EllipsoidGrowth growth : {EllipsoidGrowth::axes, EllipsoidGrowth::scaled}) {
    ScaleBackOptions options;
    options.growth = growth;
    options.max_error = 0.03;
    const ScaledBack result = scale_back(balls, s, stretched, options);
    ASSERT_EQ(result.ellipsoids.size(), balls.size());
    EXPECT_EQ(broken_invariant(result.ellipsoids), "");
    EXPECT_GT(result.shortened, 0);
    double farthest = 0;
    for (std::size_t i = 0; i < balls.size(); ++i) {
      const Ellipsoid e(result.ellipsoids, i);
      for (int k = 0; k < 200; ++k) {
        const Vec3 v{between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
        if (squared_length(v) == 0) continue;
        // The distance to a box by its formula, in the object's own space.
        const Vec3 p = turned_frame().into(e.at(1 / length(v) * v) - Vec3{1, 2, 3});
        const auto outside = [](double x, double half) { return std::max(std::abs(x) - half, 0.0); };
        farthest = std::max(farthest, length({outside(p.x, 1.5), outside(p.y, 1), outside(p.z, 0.025)}));
      }
    }
    EXPECT_LE(farthest, 0.03 * (1 + 1e-12));
    EXPECT_GE(farthest, 0.02);  // and it uses what it may
  }
}

TEST(ScaleBack, a_ball_is_the_image_of_itself_and_growth_is_what_it_says) {
  Scaling s;
  s.factors = {1, 2, 10};
  s.longest_edge = 4;
  const Balls balls{{Vec3{1, 2, 3}, {0, 0, 0}}, {2.0, 0.0}, {}, {}};
  ScaleBackOptions options;
  options.epsilon = 0;
  const Ellipsoids plain = scale_back(balls, s, {}, options).ellipsoids;
  ASSERT_EQ(plain.size(), 1U);  // a point has no half-axes
  EXPECT_EQ(plain.centers[0], (Vec3{1, 1, 0.3}));
  EXPECT_EQ(plain.radii[0], (Vec3{2, 1, 0.2}));
  options.epsilon = 5;  // % of 4
  EXPECT_EQ(scale_back(balls, s, {}, options).ellipsoids.radii[0], (Vec3{2.2, 1.2, 0.4}));
  EXPECT_EQ(scale_back(balls, s, {}, options).ellipsoids.size(), 2U);
  options.growth = EllipsoidGrowth::scaled;
  EXPECT_EQ(scale_back(balls, s, {}, options).ellipsoids.radii[0], (Vec3{2.2, 1.1, 0.22000000000000003}));
  Bisection search;
  search.value = 10;
  options.max_error = 1;  // the search is asked in its place
  EXPECT_EQ(scale_back(balls, s, {}, options, &search).growth, 0.4);
  options.max_error = -1;
  EXPECT_NE(refusal([&] { (void)scale_back(balls, s, {}, options); }).find("growth"), std::string::npos);
}

TEST(EllipsoidMatrix, has_the_entries_that_looking_at_all_pairs_finds) {
  Random random(11);
  std::vector<Vec3> points, centers, radii;
  std::vector<Quaternion> rotations;
  for (int i = 0; i < 700; ++i)
    points.push_back({between(random, -1, 1), between(random, -1, 1), between(random, -0.2, 0.2)});
  for (int i = 0; i < 60; ++i) {
    centers.push_back({between(random, -1, 1), between(random, -1, 1), between(random, -0.2, 0.2)});
    radii.push_back({between(random, 0.01, 0.9), between(random, 0.01, 0.9), between(random, 0.01, 0.3)});
    rotations.push_back(quaternion_of(i % 3 == 0 ? Frame{}
                                      : i % 3 == 1
                                          ? turned_frame()
                                          : frame_of({random.unit() + 0.1, 0.3, random.unit(), -0.4})));
  }
  const Ellipsoids all{centers, radii, rotations};
  std::vector<Triangle> triangles;
  for (int t = 0; t + 2 < 700; t += 3) triangles.push_back({t, t + 1, t + 2});
  const TriangleMesh patches{points, triangles};
  for (const bool whole : {false, true}) {
    const CoverState cover = ellipsoid_matrix(all, {points, {}}, whole ? patches : TriangleMesh{});
    ASSERT_EQ(broken_invariant(cover), "");
    std::vector<std::uint8_t> covered(whole ? triangles.size() : points.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      std::vector<std::int32_t> expected, found;
      const Frame f = frame_of(rotations[i]);
      const auto in = [&](Vec3 p) {
        const Vec3 d = p - centers[i];
        const double x = dot(d, f.axes[0]) / radii[i].x, y = dot(d, f.axes[1]) / radii[i].y,
                     z = dot(d, f.axes[2]) / radii[i].z;
        return x * x + y * y + z * z <= 1;
      };
      for (std::size_t j = 0; j < covered.size(); ++j) {
        const bool is =
            whole ? in(points[3 * j]) && in(points[3 * j + 1]) && in(points[3 * j + 2]) : in(points[j]);
        if (is) expected.push_back(static_cast<std::int32_t>(j));
        if (is) covered[j] = 1;
      }
      for (const std::int32_t c : cover.row(i))
        found.push_back(cover.column_ids[static_cast<std::size_t>(c)]);
      EXPECT_EQ(found, expected) << i;
    }
    for (const std::int32_t j : cover.uncovered) EXPECT_EQ(covered[static_cast<std::size_t>(j)], 0);
    EXPECT_EQ(cover.cols() + cover.uncovered.size(), covered.size());

    GreedyOptions until;
    const CoverState done = greedy(cover, until);
    const Ellipsoids chosen = select_ellipsoids(done, all);
    EXPECT_LT(chosen.size(), all.size());
    const CoverCheck check =
        verify_ellipsoids(chosen, {points, {}}, whole ? patches : TriangleMesh{}, &done, &all);
    EXPECT_EQ(check.uncovered, cover.uncovered);
    // One less, and something is uncovered.
    std::vector<std::int32_t> fewer;
    for (std::size_t i = 1; i < chosen.size(); ++i) fewer.push_back(static_cast<std::int32_t>(i));
    const Ellipsoids less = select(chosen, fewer);
    EXPECT_NE(refusal([&] {
                (void)verify_ellipsoids(less, {points, {}}, whole ? patches : TriangleMesh{}, &done, &all);
              }).find("lies in none"),
              std::string::npos);
  }
}

TEST(VerifyEllipsoids, refuses_a_certificate_that_proves_nothing) {
  const Ellipsoids all{{Vec3{0, 0, 0}, {5, 0, 0}}, {Vec3{1, 2, 1}, {1, 1, 1}}, {Quaternion{}, Quaternion{}}};
  const PointSet points{{Vec3{0, 1.5, 0}, {0, -1.5, 0}, {5, 0.5, 0}}, {}};
  CoverState cover = greedy(ellipsoid_matrix(all, points, {}), {});
  cover.certificate_samples = {0, 2};
  cover.certificate_prices = {1 << 20, 1 << 20};
  cover.certificate_groups = {0, 0};
  EXPECT_EQ(verify_ellipsoids(all, points, {}, &cover, &all).certified_bound, 2);
  cover.certificate_samples = {0, 1};  // both in one ellipsoid
  EXPECT_NE(refusal([&] { (void)verify_ellipsoids(all, points, {}, &cover, &all); }).find("more than 1"),
            std::string::npos);
  cover.certificate_samples = {0, 1};
  cover.certificate_prices = {1, 1};
  cover.certificate_groups = {0, 1};
  EXPECT_NE(refusal([&] { (void)verify_ellipsoids(all, points, {}, &cover, &all); }).find("two groups"),
            std::string::npos);
}

TEST(Ellipsoids, what_breaks_them_is_said) {
  Ellipsoids one{{Vec3{0, 0, 0}}, {Vec3{1, 2, 3}}, {Quaternion{}}};
  EXPECT_EQ(broken_invariant(one), "");
  EXPECT_NEAR(sum_of_volumes(one), 8 * 3.14159265358979, 1e-12);
  one.radii = {Vec3{1, 0, 3}};
  EXPECT_NE(broken_invariant(one).find("radii 1.000000, 0.000000"), std::string::npos);
  one.radii = {Vec3{1, 2, 3}};
  one.rotations = {Quaternion{1, 1, 0, 0}};
  EXPECT_NE(broken_invariant(one).find("squared length 2"), std::string::npos);
  one.rotations = {};
  EXPECT_NE(broken_invariant(one).find("0 rotations"), std::string::npos);
  // The box of a turned one is met by its surface on every side.
  const Ellipsoids turned{{Vec3{1, 2, 3}}, {Vec3{3, 1, 0.1}}, {quaternion_of(turned_frame())}};
  const Box box = bounding_box(turned);
  const Ellipsoid e(turned, 0);
  Box sampled;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 200; ++j) {
      const double phi = i * 3.14159265358979 / 200, theta = (j + 0.5) * 3.14159265358979 / 200;
      sampled.add(e.at({std::cos(phi) * std::sin(theta), std::sin(phi) * std::sin(theta), std::cos(theta)}));
    }
  for (const double gap :
       {sampled.lower.x - box.lower.x, sampled.lower.y - box.lower.y, sampled.lower.z - box.lower.z,
        box.upper.x - sampled.upper.x, box.upper.y - sampled.upper.y, box.upper.z - sampled.upper.z}) {
    EXPECT_GE(gap, 0);
    EXPECT_LE(gap, 1e-3);
  }
}
