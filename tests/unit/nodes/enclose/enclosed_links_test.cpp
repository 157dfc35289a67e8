// Links of real robots in balls, against a million samples of their surfaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "enclose/enclose_balls.hpp"
#include "enclose/verify_enclosure.hpp"
#include "shipped_spheres.hpp"

namespace ballflow::geometry {
namespace {

/// The farthest of many random points of the surface from the balls; negative when all are inside.
double farthest_sample(const TriangleMesh& mesh, const Balls& balls, int samples) {
  std::vector<double> areas;
  double sum = 0;
  for (const Triangle t : mesh.triangles) {
    const Vec3 a = mesh.vertices[t[0]], b = mesh.vertices[t[1]], c = mesh.vertices[t[2]];
    areas.push_back(sum += 0.5 * length(cross(b - a, c - a)));
  }
  Random random(1);
  double farthest = -std::numeric_limits<double>::infinity();
  for (int n = 0; n < samples; ++n) {
    const auto at = std::lower_bound(areas.begin(), areas.end(), random.unit() * sum) - areas.begin();
    const Triangle t = mesh.triangles[std::min<std::size_t>(at, areas.size() - 1)];
    const double s = std::sqrt(random.unit()), v = random.unit();
    const Vec3 p =
        (1 - s) * mesh.vertices[t[0]] + s * (1 - v) * mesh.vertices[t[1]] + s * v * mesh.vertices[t[2]];
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < balls.size() && least > 0; ++i)
      least = std::min(least, distance(p, balls.centers[i]) - balls.radii[i]);
    farthest = std::max(farthest, least);
  }
  return farthest;
}

TEST(enclose_balls, of_the_links_of_robots_hold_a_million_samples) {
  const std::vector<ShippedSpheres> links = shipped_spheres();
  if (links.empty()) GTEST_SKIP() << "SKIPPED: no links of robots here";
  const bool all = std::getenv("BALLFLOW_TEST_LARGE") != nullptr;  // tools/nightly
  int proven = 0;
  for (const ShippedSpheres& link : links) {
    if (link.name.rfind("morphit", 0) != 0) continue;  // the others have the same links
    if (!all && link.name != "morphit_panda-panda_hand_0" && link.name != "morphit_ur5-wrist_3_link_0")
      continue;
    for (const std::int64_t k : {1, 2, 8, 20, 64}) {
      if (!all && k > 8) continue;
      EncloseBallsOptions options;
      options.balls = k;
      options.effort = all ? EncloseEffort::normal : EncloseEffort::low;
      const EnclosingBalls found = enclose_balls(link.mesh, options);
      const std::string what = link.name + ", " + std::to_string(k) + " balls";
      EXPECT_LE(found.balls.size(), static_cast<std::size_t>(k)) << what;
      const Enclosure proof = verify_enclosure(link.mesh, found.balls, {.on_open = OnOpen::report});
      EXPECT_TRUE(proof.encloses()) << what << ": " << describe(proof);
      EXPECT_LE(farthest_sample(link.mesh, found.balls, all ? 1'000'000 : 100'000), 0) << what;
      ++proven;
    }
  }
  EXPECT_EQ(proven, all ? 90 : 6);
}

}  // namespace
}  // namespace ballflow::geometry
