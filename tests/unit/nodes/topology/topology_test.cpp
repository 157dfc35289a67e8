#include "topology/topology.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "binary_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "homology/binary_system.hpp"
#include "power/alpha_shape.hpp"
#include "power/power_diagram.hpp"
#include "search/self_intersection.hpp"
#include "topology/solid_topology.hpp"
#include "topology/union_topology.hpp"

namespace ballflow::geometry {
namespace {

class Listener final : public Monitor {
 public:
  void warn(const std::string& text) override { warnings.push_back(text); }
  std::vector<std::string> warnings;
};

/// Meshes put together from closed pieces.
struct Pieces {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;

  Pieces& add(std::vector<Vec3> corners, const std::vector<Triangle>& faces, bool inwards) {
    const auto first = static_cast<std::int32_t>(vertices.size());
    vertices.insert(vertices.end(), corners.begin(), corners.end());
    for (Triangle t : faces) {
      if (inwards) std::swap(t[1], t[2]);
      triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    return *this;
  }
  Pieces& box(Vec3 center, double half, bool inwards = false) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
      corners.push_back(center + half * Vec3{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    }
    return add(corners,
               {{0, 2, 1},
                {1, 2, 3},
                {4, 5, 6},
                {5, 7, 6},
                {0, 1, 4},
                {1, 5, 4},
                {2, 6, 3},
                {3, 6, 7},
                {0, 4, 2},
                {2, 4, 6},
                {1, 3, 5},
                {3, 7, 5}},
               inwards);
  }
  Pieces& torus(Vec3 center, double radius, double tube, bool inwards = false) {
    std::vector<Vec3> corners;
    std::vector<Triangle> faces;
    const std::int32_t m = 24, n = 12;
    for (std::int32_t i = 0; i < m; ++i) {
      for (std::int32_t k = 0; k < n; ++k) {
        const double u = 6.283185307179586 * i / m, v = 6.283185307179586 * k / n;
        const double d = radius + tube * std::cos(v);
        corners.push_back(center + Vec3{d * std::cos(u), d * std::sin(u), tube * std::sin(v)});
        const auto id = [&](std::int32_t a, std::int32_t b) { return a % m * n + b % n; };
        faces.push_back({id(i, k), id(i + 1, k), id(i + 1, k + 1)});
        faces.push_back({id(i, k), id(i + 1, k + 1), id(i, k + 1)});
      }
    }
    return add(corners, faces, inwards);
  }
  TriangleMesh mesh() const { return {vertices, triangles}; }
};

SolidTopology solid(const Pieces& pieces) { return solid_topology(pieces.mesh(), no_monitor()); }

TEST(solid_topology, of_a_box_is_a_ball_and_of_a_torus_a_ring) {
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 1)).betti, (Betti{1, 0, 0}));
  EXPECT_EQ(solid(Pieces().torus({0, 0, 0}, 3, 1)).betti, (Betti{1, 1, 0}));
  EXPECT_EQ(solid(Pieces()).betti, (Betti{0, 0, 0}));
}

TEST(solid_topology, counts_shells_inside_shells) {
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5).box({0, 0, 0}, 3, true)).betti, (Betti{1, 0, 1}));
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5).box({0, 0, 0}, 3, true).box({0, 0, 0}, 1)).betti,
            (Betti{2, 0, 1}));
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5).torus({0, 0, 0}, 3, 1, true)).betti, (Betti{1, 1, 1}));
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5).box({20, 0, 0}, 3, false).torus({0, 30, 0}, 3, 1)).betti,
            (Betti{3, 1, 0}));
}

TEST(solid_topology, turns_shells_outwards_that_bound_no_cavity) {
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 1, true)).betti, (Betti{1, 0, 0}));
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5, true).torus({30, 0, 0}, 3, 1)).betti, (Betti{2, 1, 0}));
}

TEST(solid_topology, turns_a_surface_that_is_inside_out_as_a_whole) {
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 5, true).box({0, 0, 0}, 3, false)).betti, (Betti{1, 0, 1}));
}

TEST(solid_topology, takes_no_notice_of_a_shell_inside_the_solid) {
  EXPECT_EQ(solid(Pieces().box({0, 0, 0}, 9).torus({0, 0, 0}, 3, 1)).betti, (Betti{1, 0, 0}));
}

TEST(solid_topology, is_unknown_for_surfaces_that_bound_no_solid) {
  Pieces open = Pieces().box({0, 0, 0}, 1);
  open.triangles.pop_back();
  EXPECT_FALSE(solid(open).betti);
  EXPECT_NE(solid(open).unknown_because.find("3 edges"), std::string::npos) << solid(open).unknown_because;

  const SolidTopology crossing = solid(Pieces().box({0, 0, 0}, 2).box({1, 1.5, 1.25}, 2));
  EXPECT_FALSE(crossing.betti);
  EXPECT_NE(crossing.unknown_because.find("intersects itself"), std::string::npos)
      << crossing.unknown_because;

  Pieces turned = Pieces().box({0, 0, 0}, 1);
  std::swap(turned.triangles[3][0], turned.triangles[3][1]);
  EXPECT_FALSE(solid(turned).betti);

  Pieces flat = Pieces().box({0, 0, 0}, 1);
  flat.vertices[0] = flat.vertices[1];
  EXPECT_NE(solid(flat).unknown_because.find("no area"), std::string::npos) << solid(flat).unknown_because;
}

/// By brute force: some edge of one triangle meets the other one beyond their common corners.
TEST(self_intersection, finds_an_edge_that_pierces_and_a_fold) {
  const auto found = [](std::vector<Vec3> v, std::vector<Triangle> t) {
    return self_intersection({std::move(v), std::move(t)}, no_monitor()).has_value();
  };
  const std::vector<Vec3> flat = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](std::vector<Vec3> more) {
    more.insert(more.begin(), flat.begin(), flat.end());
    return more;
  };
  EXPECT_FALSE(found(with({{1, 1, 1}, {2, 1, 1}, {1, 2, 1}}), {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(found(with({{1, 1, 1}, {1, 1, -1}, {1, 9, 0}}), {{0, 1, 2}, {3, 4, 5}}));
  EXPECT_TRUE(found(with({{1, 1, 0}, {1, 1, 1}, {9, 9, 9}}), {{0, 1, 2}, {3, 4, 5}})) << "touches";
  EXPECT_TRUE(found(with({{4, 4, 0}}), {{0, 1, 2}, {0, 3, 1}})) << "folded along an edge";
  EXPECT_FALSE(found(with({{4, -4, 0}}), {{0, 1, 2}, {0, 3, 1}}));
  EXPECT_FALSE(found(with({{4, 4, 1e-300}}), {{0, 1, 2}, {0, 3, 1}}));
  EXPECT_FALSE(found(with({{-4, 1, 0}, {-4, 0, 0}}), {{0, 1, 2}, {0, 3, 4}})) << "a common corner";
  EXPECT_TRUE(found(with({{2, 1, 1}, {2, 1, -1}}), {{0, 1, 2}, {0, 3, 4}})) << "an edge through the other";
  EXPECT_TRUE(found(with({{1, 0, 0}, {1, 0, 5}}), {{0, 1, 2}, {0, 3, 4}})) << "sides on one line";
}

TEST(binary_system, agrees_with_plain_elimination) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 300; ++round) {
    const std::size_t n = 1 + random() % 30, m = random() % 40;
    std::vector<std::int64_t> offsets{0};
    std::vector<std::int32_t> terms;
    std::vector<std::set<std::int64_t>> equations;
    for (std::size_t i = 0; i < m; ++i) {
      std::set<std::int64_t> sum;
      for (std::size_t k = random() % 5; k > 0; --k) {
        terms.push_back(static_cast<std::int32_t>(random() % n));
        if (!sum.insert(terms.back()).second) sum.erase(terms.back());
      }
      offsets.push_back(static_cast<std::int64_t>(terms.size()));
      equations.push_back(sum);
    }
    const std::vector<std::int32_t> zero{static_cast<std::int32_t>(random() % n)};
    std::vector<std::set<std::int64_t>> all = equations;
    all.push_back({zero[0]});
    const BinarySystem system(n, offsets, terms, zero, no_monitor());
    ASSERT_EQ(static_cast<std::int64_t>(system.dimension()), static_cast<std::int64_t>(n) - test::rank(all));
    EXPECT_TRUE(system.value(zero[0]).empty());
    for (const auto& equation : equations) {
      std::vector<std::int32_t> sum;
      for (const std::int64_t x : equation) sum = binary_sum(sum, system.value(static_cast<std::int32_t>(x)));
      ASSERT_TRUE(sum.empty()) << "round " << round;
    }
    for (std::size_t k = 0; k < system.dimension(); ++k) {
      const auto value = system.value(system.free_variable(k));
      ASSERT_EQ(std::vector<std::int32_t>(value.begin(), value.end()),
                std::vector<std::int32_t>{std::int32_t(k)});
    }
  }
}

TEST(axis_betti, are_those_of_plain_elimination_and_of_the_union) {
  std::mt19937_64 random(2);
  const auto unit = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::int64_t tunnels = 0, cavities = 0;
  for (int round = 0; round < 40; ++round) {
    std::vector<Vec3> centers;
    std::vector<double> radii;
    const std::size_t n = 40 + random() % 80;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = unit(), y = unit(), z = unit();
      const Vec3 p{x - 0.5, y - 0.5, z - 0.5};
      centers.push_back(round % 2 == 0 ? p : 1 / length(p) * p);
      radii.push_back(round % 2 == 0 ? 0.05 + 0.15 * unit() : 0.45 + 0.1 * unit());
    }
    const SimplicialComplex complex = alpha_shape({centers, radii, {}, {}}, {}, no_monitor());
    const MedialAxis axis = medial_axis(complex, {}, no_monitor());
    const Betti betti = axis_betti(axis, no_monitor());
    EXPECT_EQ(betti, test::betti_of(axis));
    EXPECT_EQ(betti, complex.betti);
    tunnels += betti[1];
    cavities += betti[2];
  }
  EXPECT_GT(tunnels, 20);
  EXPECT_GT(cavities, 5);
}

Balls ring(int n, double radius) {
  std::vector<Vec3> centers;
  for (int i = 0; i < n; ++i) {
    const double t = 6.283185307179586 * i / n;
    centers.push_back({std::cos(t), std::sin(t), 0});
  }
  return {centers, std::vector<double>(static_cast<std::size_t>(n), radius), {}, {}};
}

TopologyTable row_of(const Balls& balls, TopologyStage stage) {
  return union_row(balls, {stage}, no_monitor());
}

TEST(topology, says_in_words_what_growing_and_pruning_changed) {
  const TopologyTable inner = row_of(ring(24, 0.2), TopologyStage::inner),
                      enlarged = row_of(ring(24, 1.01), TopologyStage::enlarged),
                      apart = row_of(ring(24, 0.01), TopologyStage::kept);
  Listener listener;
  const TopologyTable table = topology({.inner = &inner, .enlarged = &enlarged, .kept = &apart}, listener);
  EXPECT_EQ(broken_invariant(table), "");
  EXPECT_EQ(table.betti, (Array<Betti>{{1, 1, 0}, {1, 0, 0}, {24, 0, 0}}));
  EXPECT_EQ(table.euler, (Array<std::int64_t>{0, 1, 24}));
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_EQ(listener.warnings[0], "growing closed 1 tunnel; pruning added 23 components");
}

TEST(topology, is_silent_where_every_stage_agrees) {
  const TriangleMesh surface = Pieces().torus({0, 0, 0}, 1, 0.25).mesh();
  const Balls balls = ring(24, 0.25);
  const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
  const MedialAxis axis = medial_axis(complex, {}, no_monitor());
  Listener listener;
  const TopologyTable solid = solid_row(surface, listener), inner = row_of(balls, TopologyStage::inner),
                      enlarged = row_of(balls, TopologyStage::enlarged),
                      kept = row_of(balls, TopologyStage::kept);
  const TopologyTable table = topology({&solid, &inner, &enlarged, &kept, &complex, &axis}, listener);
  ASSERT_EQ(table.size(), 6u);
  for (const Betti& row : table.betti) EXPECT_EQ(row, (Betti{1, 1, 0}));
  EXPECT_TRUE(listener.warnings.empty());
  EXPECT_TRUE(topology_changes(table).empty());
}

TEST(topology, compares_across_an_unknown_surface_and_says_why_it_is_unknown) {
  Pieces open = Pieces().box({0, 0, 0}, 1);
  open.triangles.pop_back();
  const TriangleMesh surface = open.mesh();
  const Balls balls = ring(24, 0.25);
  Listener listener;
  const TopologyTable solid = solid_row(surface, listener), enlarged = row_of(balls, TopologyStage::enlarged);
  const TopologyTable table = topology({.surface = &solid, .enlarged = &enlarged}, listener);
  EXPECT_FALSE(table.known(0));
  EXPECT_TRUE(topology_changes(table).empty());
  ASSERT_EQ(listener.warnings.size(), 1u);
  EXPECT_NE(listener.warnings[0].find("open"), std::string::npos);
}

TEST(topology, has_no_row_for_a_cloud_of_points_and_refuses_nothing_at_all) {
  const TopologyTable cloud = solid_row(TriangleMesh{}, no_monitor());
  const TopologyTable none = row_of(Balls{}, TopologyStage::kept);
  EXPECT_EQ(topology({.surface = &cloud, .kept = &none}, no_monitor()).betti, (Array<Betti>{{0, 0, 0}}));
  EXPECT_THROW(topology({.surface = &cloud}, no_monitor()), InputError);
  EXPECT_THROW(topology({}, no_monitor()), InputError);
}

TEST(topology, refuses_a_row_of_another_stage) {
  const TopologyTable inner = row_of(ring(24, 0.2), TopologyStage::inner);
  EXPECT_THROW(topology({.kept = &inner}, no_monitor()), InputError);
  EXPECT_THROW(row_of(ring(24, 0.2), TopologyStage::axis), InputError);
}

TEST(union_row, is_the_same_from_balls_and_from_their_power_diagram) {
  for (const double radius : {0.01, 0.2, 1.01}) {
    const Balls balls = ring(24, radius);
    const TopologyTable polar = union_row(power_diagram(balls, {AlphaTolerance::polar}, no_monitor()),
                                          {TopologyStage::inner}, no_monitor());
    EXPECT_EQ(row_of(balls, TopologyStage::inner).betti, polar.betti);
    EXPECT_EQ(row_of(balls, TopologyStage::kept).betti[0], alpha_shape(balls, {}, no_monitor()).betti);
  }
}

TEST(topology_table, reports_what_does_not_fit) {
  EXPECT_EQ(broken_invariant(TopologyTable{{0, 3}, {{1, 2, 0}, {-1, -1, -1}}, {-1, 0}}), "");
  EXPECT_NE(broken_invariant(TopologyTable{{0}, {{1, 2, 0}}, {0}}), "");
  EXPECT_NE(broken_invariant(TopologyTable{{0}, {{1, -1, -1}}, {1}}), "");
  EXPECT_NE(broken_invariant(TopologyTable{{3, 0}, {{1, 0, 0}, {1, 0, 0}}, {1, 1}}), "");
  EXPECT_NE(broken_invariant(TopologyTable{{6}, {{1, 0, 0}}, {1}}), "");
  EXPECT_NE(broken_invariant(TopologyTable{{0, 1}, {{1, 0, 0}}, {1}}), "");
}

}  // namespace
}  // namespace ballflow::geometry
