#include "enclose/enclose_balls.hpp"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "enclose/verify_enclosure.hpp"
#include "enclose_shapes.hpp"

namespace ballflow::geometry {
namespace {

constexpr double pi = 3.14159265358979323846;

EnclosingBalls enclosed_by(const TriangleMesh& mesh, std::int64_t balls,
                           EncloseEffort effort = EncloseEffort::low) {
  EncloseBallsOptions options;
  options.balls = balls;
  options.effort = effort;
  return enclose_balls(mesh, options);
}

Enclosure looked_at(const TriangleMesh& mesh, const Balls& balls) {
  VerifyEnclosureOptions options;
  options.on_open = OnOpen::report;
  return verify_enclosure(mesh, balls, options);
}

void expect_enclosed(const TriangleMesh& mesh, const Balls& balls, const std::string& what) {
  const Enclosure proof = looked_at(mesh, balls);
  EXPECT_TRUE(proof.encloses()) << what << ": " << describe(proof);
}

std::string cause_of(const TriangleMesh& mesh, std::int64_t balls, const Balls* start = nullptr) {
  EncloseBallsOptions options;
  options.balls = balls;
  try {
    enclose_balls(mesh, options, no_monitor(), start);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(enclose_balls, one_ball_is_about_the_smallest_one) {
  using Kernel = CGAL::Simple_cartesian<double>;
  Random random(3);
  for (int trial = 0; trial < 2; ++trial) {
    const TriangleMesh mesh = trial == 0 ? box_mesh({0, 0, 0}, {3, 2, 1}) : triangle_soup(random, 20);
    std::vector<Kernel::Point_3> points;
    for (const Vec3 p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
    const double least = CGAL::Min_sphere_of_spheres_d<CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>>(
                             points.begin(), points.end())
                             .radius();
    const EnclosingBalls found = enclosed_by(mesh, 1);
    ASSERT_EQ(found.balls.size(), 1U);
    EXPECT_GE(found.balls.radii[0], least * (1 - 1e-12));
    EXPECT_LE(found.balls.radii[0], least * 1.01);
    expect_enclosed(mesh, found.balls, "trial " + std::to_string(trial));
  }
}

/// A box, rod, plate, L-profile, soup, hollow box, doubled box or torus.
TriangleMesh random_model(Random& random, int kind) {
  const auto size = [&](double low, double high) { return low + (high - low) * random.unit(); };
  const Vec3 at = 10.0 * random_vector(random), a{size(1, 2), size(1, 2), size(1, 2)};
  const double thin = size(0.001, 0.1), length = size(2, 20);
  switch (kind) {
    case 0:
      return box_mesh(at, at + a);
    case 1:
      return box_mesh(at, at + Vec3{thin, thin, length});
    case 2:
      return box_mesh(at, at + Vec3{a.x, length, thin});
    case 3:
      return joined(box_mesh(at, at + Vec3{1, 1, 4}), box_mesh(at + Vec3{0, 0, 3}, at + Vec3{4, 1, 4}));
    case 4:
      return triangle_soup(random, 30);
    case 5:
      return joined(box_mesh(at, at + a), turned_over(box_mesh(at + 0.2 * a, at + 0.8 * a)));
    case 6:
      return joined(box_mesh(at, at + a), box_mesh(at, at + a));
    default:
      return shape("torus?n=400");
  }
}

TEST(enclose_balls, of_boxes_rods_plates_profiles_shells_tori_and_soups_is_proven) {
  const char* const more = std::getenv("BALLFLOW_TEST_MODELS");  // tools/nightly asks for many
  const int trials = more == nullptr ? 8 : std::atoi(more);      // one of each kind
  Random random(5);
  for (int trial = 0; trial < trials; ++trial) {
    const TriangleMesh mesh = random_model(random, trial % 8);
    const std::int64_t balls = std::int64_t{1} << (trial * 5 % 7);  // 1 to 64
    const EnclosingBalls found = enclosed_by(mesh, balls);
    EXPECT_LE(found.balls.size(), static_cast<std::size_t>(balls));
    expect_enclosed(mesh, found.balls, "trial " + std::to_string(trial));
  }
}

TEST(enclose_balls, of_many_pieces_hold_them_all_even_where_there_are_fewer_balls) {
  TriangleMesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  for (int piece = 1; piece < 12; ++piece) {
    const Vec3 at{5.0 * (piece % 4), 5.0 * (piece / 4), 0};
    mesh = joined(mesh, box_mesh(at, at + Vec3{1, 1, 1}));
  }
  for (const std::int64_t balls : {1, 5}) {
    expect_enclosed(mesh, enclosed_by(mesh, balls).balls, std::to_string(balls));
  }
  // One each is best then: a ball around a unit cube.
  const EnclosingBalls each = enclosed_by(mesh, 12);
  expect_enclosed(mesh, each.balls, "one each");
  ASSERT_EQ(each.balls.size(), 12U);
  for (const double r : each.balls.radii) EXPECT_NEAR(r, std::sqrt(0.75), 0.02);
}

TEST(enclose_balls, waste_less_the_more_there_are_and_the_fit_says_how_much) {
  const TriangleMesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  double before = std::numeric_limits<double>::infinity();
  for (const std::int64_t balls : {1, 8, 20}) {
    const EnclosingBalls found =
        enclosed_by(mesh, balls, balls == 8 ? EncloseEffort::normal : EncloseEffort::low);
    EXPECT_NEAR(found.fit.solid, 8, 0.08);
    EXPECT_NEAR(found.fit.area, 24, 1e-9);
    EXPECT_EQ(found.fit.balls, static_cast<std::int64_t>(found.balls.size()));
    EXPECT_LT(found.fit.outside, before);
    before = found.fit.outside;
    if (balls == 1) {
      EXPECT_NEAR(found.fit.outside, 4 * pi * std::sqrt(3.0) - 8, 0.2);
    }
    // Not more than balls around the eight octants, if they did not overlap.
    if (balls == 8) {
      EXPECT_LT(found.fit.outside, 8 * (4.0 / 3 * pi * std::pow(0.75, 1.5) - 1));
    }
  }
}

TEST(enclose_balls, a_void_that_balls_close_off_is_filled) {
  const TriangleMesh sphere = shape("sphere?n=500&R=1");
  std::vector<Vec3> centers;
  std::vector<double> radii;
  constexpr int count = 400;
  for (int i = 0; i < count; ++i) {  // evenly spread, by the golden angle
    const double z = 1 - 2 * (i + 0.5) / count, r = std::sqrt(1 - z * z), angle = 2.399963229728653 * i;
    centers.push_back({r * std::cos(angle), r * std::sin(angle), z});
    radii.push_back(0.18);
  }
  const Balls start{std::move(centers), std::move(radii), {}, {}};
  ASSERT_EQ(looked_at(sphere, start).voids_that_matter(), 1);
  EncloseBallsOptions options;
  options.balls = count;
  options.effort = EncloseEffort::low;
  expect_enclosed(sphere, enclose_balls(sphere, options, no_monitor(), &start).balls, "started with a void");
}

TEST(enclose_balls, are_the_same_for_a_model_in_other_units_and_alike_elsewhere) {
  const TriangleMesh mesh = joined(box_mesh({0, 0, 0}, {1, 2, 3}), box_mesh({0, 0, 0}, {3, 1, 1}));
  const EnclosingBalls found = enclosed_by(mesh, 10);
  std::vector<Vec3> scaled, shifted;
  for (const Vec3 p : mesh.vertices) {
    scaled.push_back(1024.0 * p);
    shifted.push_back(1000.0 * p + Vec3{1e4, 1e4, 1e4});
  }
  const EnclosingBalls large = enclosed_by({scaled, mesh.triangles}, 10);
  ASSERT_EQ(found.balls.size(), large.balls.size());
  for (std::size_t i = 0; i < found.balls.size(); ++i) {
    EXPECT_EQ(1024.0 * found.balls.centers[i], large.balls.centers[i]);
    EXPECT_EQ(1024.0 * found.balls.radii[i], large.balls.radii[i]);
  }
  const EnclosingBalls far = enclosed_by({shifted, mesh.triangles}, 10);
  EXPECT_EQ(found.balls.size(), far.balls.size());
  EXPECT_NEAR(far.fit.solid / found.fit.solid, 1e9, 1e7);
  EXPECT_NEAR(far.fit.outside / found.fit.outside, 1e9, 1e7);
  expect_enclosed({shifted, mesh.triangles}, far.balls, "far away");
}

TEST(enclose_balls, of_degenerate_triangles_hold_their_points) {
  const std::vector<Vec3> line{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  const TriangleMesh segments{line, std::vector<Triangle>{{0, 1, 2}, {2, 1, 1}}};
  const TriangleMesh point{std::vector<Vec3>{{3, 4, 5}}, std::vector<Triangle>{{0, 0, 0}}};
  const TriangleMesh one{std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e6, 0, 0}},
                         std::vector<Triangle>{{0, 1, 2}}};
  for (const std::int64_t balls : {1, 3}) {
    expect_enclosed(segments, enclosed_by(segments, balls).balls, "a line");
    expect_enclosed(point, enclosed_by(point, balls).balls, "a point");
    expect_enclosed(one, enclosed_by(one, balls).balls, "a triangle");
  }
  EXPECT_LT(enclosed_by(one, 1).balls.radii[0], 1);  // the vertex of no triangle is far away
}

TEST(enclose_balls, refuses_what_cannot_be_enclosed) {
  const TriangleMesh box = box_mesh({0, 0, 0}, {1, 1, 1});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh broken{std::vector<Vec3>{{nan, 0, 0}}, std::vector<Triangle>{{0, 0, 0}}};
  EXPECT_NE(cause_of({}, 2).find("nothing to enclose"), std::string::npos);
  EXPECT_NE(cause_of(broken, 2).find("damaged"), std::string::npos);
  EXPECT_NE(cause_of(box, 0).find("balls is 0"), std::string::npos);
  const Balls three{std::vector<Vec3>(3), std::vector<double>(3, 1), {}, {}};
  EXPECT_NE(cause_of(box, 2, &three).find("3 balls where at most 2"), std::string::npos);
}

TEST(enclose_balls, ends_when_cancelled) {
  class Impatient final : public Monitor {
   public:
    bool cancelled() override { return ++looks_ > 40; }

   private:
    int looks_ = 0;
  } impatient;
  EncloseBallsOptions options;
  options.balls = 64;
  EXPECT_THROW(enclose_balls(box_mesh({0, 0, 0}, {1, 2, 3}), options, impatient), Cancelled);
}

}  // namespace
}  // namespace ballflow::geometry
