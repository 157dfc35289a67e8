// The classes of simplices, and what breaks a complex.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "alpha_cases.hpp"

namespace ballflow::geometry {
namespace {

using alpha_cases::grid_balls;
using alpha_cases::make_balls;
using alpha_cases::random_balls;
using alpha_cases::shape_of;

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
