#include "power/regular_triangulation_2.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "base/random.hpp"

namespace ballflow::geometry {
namespace {

using PlaneKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using CgalRegular = CGAL::Regular_triangulation_2<PlaneKernel>;
using PlaneTriangles = std::vector<RegularTriangulation2::Triangle>;

PlaneKernel::Weighted_point_2 cgal_site(const PlaneSite& s) { return {{s.center.x, s.center.y}, s.weight}; }

std::vector<PlaneSite> random_sites(Random& random, std::size_t n, bool grid) {
  std::vector<PlaneSite> sites(n);
  for (PlaneSite& s : sites) {
    const auto number = [&] { return grid ? static_cast<double>(random.bits() % 6) : random.unit(); };
    s = {{number(), number()}, grid ? static_cast<double>(random.bits() % 4) : 0.05 * random.unit()};
  }
  return sites;
}

/// Begins with the first three that are not on one line; the sites in the order of insertion.
std::optional<RegularTriangulation2> built(std::vector<PlaneSite>& sites, std::vector<std::int32_t>& vertex) {
  for (std::size_t i = 1; i < sites.size(); ++i) {
    if (sites[i].center == sites[0].center) continue;
    std::swap(sites[1], sites[i]);
    for (std::size_t j = 2; j < sites.size(); ++j) {
      if (orientation(sites[0].center, sites[1].center, sites[j].center) == 0) continue;
      std::swap(sites[2], sites[j]);
      RegularTriangulation2 t(sites[0], sites[1], sites[2]);
      vertex = {0, 1, 2};
      for (std::size_t k = 3; k < sites.size(); ++k) vertex.push_back(t.insert(sites[k]));
      return t;
    }
    break;
  }
  return std::nullopt;
}

TEST(regular_triangulation_2, has_triangles_that_are_regular_and_joined) {
  Random random(1);
  int tried = 0;
  for (int round = 0; round < 2000; ++round) {
    std::vector<PlaneSite> sites = random_sites(random, 3 + random.bits() % 40, round % 2 == 0);
    std::vector<std::int32_t> vertex;
    auto t = built(sites, vertex);
    if (!t) continue;
    ++tried;
    const std::size_t vertices = t->vertices();
    const PlaneTriangles triangles = t->take_triangles();
    std::set<std::int32_t> used;
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> sides;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& v = triangles[i].vertices;
        used.insert(v[k]);
        ASSERT_TRUE(
            sides.emplace(std::pair(v[(k + 1) % 3], v[(k + 2) % 3]), static_cast<std::int32_t>(i)).second);
      }
    }
    ASSERT_EQ(used.size(), vertices + 1);
    for (const auto& triangle : triangles) {
      const auto& v = triangle.vertices;
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(sides.at(std::pair(v[(k + 2) % 3], v[(k + 1) % 3])), triangle.neighbours[k]);
      const auto at_infinity = std::find(v.begin(), v.end(), RegularTriangulation2::infinite);
      if (at_infinity != v.end()) {
        const auto k = static_cast<std::size_t>(at_infinity - v.begin());
        for (const PlaneSite& s : sites)
          ASSERT_LE(orientation(t->site(v[(k + 1) % 3]).center, t->site(v[(k + 2) % 3]).center, s.center), 0);
        continue;
      }
      ASSERT_EQ(orientation(t->site(v[0]).center, t->site(v[1]).center, t->site(v[2]).center), 1);
      for (const PlaneSite& s : sites) {
        ASSERT_NE(
            CGAL::power_side_of_oriented_power_circle(cgal_site(t->site(v[0])), cgal_site(t->site(v[1])),
                                                      cgal_site(t->site(v[2])), cgal_site(s)),
            CGAL::ON_POSITIVE_SIDE);
      }
    }
  }
  EXPECT_GT(tried, 1500);
}

TEST(regular_triangulation_2, has_the_vertices_of_cgal) {
  Random random(2);
  for (int round = 0; round < 200; ++round) {
    std::vector<PlaneSite> sites = random_sites(random, 200, false);
    std::vector<std::int32_t> vertex;
    auto t = built(sites, vertex);
    ASSERT_TRUE(t);
    CgalRegular cgal;
    for (const PlaneSite& s : sites) cgal.insert(cgal_site(s));
    ASSERT_EQ(t->vertices(), cgal.number_of_vertices());
    ASSERT_EQ(t->take_triangles().size(), 2 * cgal.number_of_vertices() - 2);
  }
}

TEST(regular_triangulation_2, tells_the_neighbours_that_a_site_would_have) {
  Random random(3);
  for (int round = 0; round < 300; ++round) {
    std::vector<PlaneSite> sites = random_sites(random, 40, round % 2 == 0);
    const PlaneSite probe = random_sites(random, 1, round % 2 == 0)[0];
    std::vector<std::int32_t> vertex, found;
    auto t = built(sites, vertex);
    if (!t) continue;
    const bool has_cell = t->neighbours(probe, found);
    const std::int32_t inserted = t->insert(probe);
    ASSERT_EQ(has_cell, inserted != RegularTriangulation2::hidden);
    if (!has_cell) continue;
    std::set<std::int32_t> expected;
    for (const auto& triangle : t->take_triangles()) {
      const auto& v = triangle.vertices;
      if (std::find(v.begin(), v.end(), inserted) == v.end()) continue;
      expected.insert(v.begin(), v.end());
    }
    expected.erase(inserted);
    expected.erase(RegularTriangulation2::infinite);
    ASSERT_EQ(std::set<std::int32_t>(found.begin(), found.end()), expected);
  }
}

TEST(regular_triangulation_2, decides_exactly_for_any_magnitude) {
  for (const double scale : {1e-140, 1e-70, 1.0, 1e70, 1e140}) {
    const auto site = [scale](double x, double y) { return PlaneSite{{scale * x, scale * y}, 0}; };
    RegularTriangulation2 t(site(0, 0), site(1, 0), site(0, 1));
    EXPECT_EQ(t.insert(site(1, 1)), 3);
    EXPECT_EQ(t.insert(site(0, 0)), RegularTriangulation2::hidden);
    EXPECT_EQ(t.insert(site(0.5, 0)), 4) << "on an edge";
    EXPECT_EQ(t.insert({{scale * 0.5, scale * 0.5}, 0}), 5);
    EXPECT_EQ(t.insert({{scale * 0.5, scale * 0.5}, scale * scale * 0.125}), 6)
        << "a larger one at the same place";
    EXPECT_EQ(t.insert(site(2, 2)), 7);
    EXPECT_EQ(t.insert(site(3, 3)), 8) << "beyond the hull on the line of an edge";
    EXPECT_EQ(t.vertices(), 8u);
  }
}

}  // namespace
}  // namespace ballflow::geometry
