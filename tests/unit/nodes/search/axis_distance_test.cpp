#include "search/axis_distance.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "axis/medial_axis.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/alpha_shape.hpp"
#include "search/local_feature_size.hpp"
#include "search/sampling_ratio.hpp"
#include "shapes.hpp"

namespace ballflow::geometry {
namespace {

MedialAxis axis_of_balls(const Balls& balls, AlphaTolerance tolerance) {
  const SimplicialComplex complex = alpha_shape(balls, {tolerance}, no_monitor());
  return medial_axis(complex, {}, no_monitor());
}

/// Exact distances to all triangles of all fans, to all edges and to all vertices.
double brute_force(const MedialAxis& axis, Vec3 from) {
  using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
  const auto point = [](Vec3 v) { return Kernel::Point_3(v.x, v.y, v.z); };
  const auto vertex = [&](std::int32_t v) { return point(axis.vertices[static_cast<std::size_t>(v)]); };
  const Kernel::Point_3 p = point(from);
  Kernel::FT least = CGAL::squared_distance(p, vertex(0));
  for (const Vec3& v : axis.vertices) least = std::min(least, CGAL::squared_distance(p, point(v)));
  for (const auto& [a, b] : axis.edges) {
    least = std::min(least, CGAL::squared_distance(p, Kernel::Segment_3(vertex(a), vertex(b))));
  }
  for (std::size_t i = 0; i < axis.polygons(); ++i) {
    const auto corners = axis.polygon(i);
    for (std::size_t k = 2; k < corners.size(); ++k) {
      const Kernel::Triangle_3 t(vertex(corners[0]), vertex(corners[k - 1]), vertex(corners[k]));
      for (int e = 0; e < 3; ++e) {
        least = std::min(least, CGAL::squared_distance(p, Kernel::Segment_3(t.vertex(e), t.vertex(e + 1))));
      }
      if (!t.is_degenerate()) least = std::min(least, CGAL::squared_distance(p, t));
    }
  }
  return std::sqrt(CGAL::to_double(least));
}

TEST(axis_distance, is_that_of_brute_force) {
  std::mt19937 random(3);
  const auto unit = [&random] { return static_cast<double>(random()) / 4294967296.0; };
  std::size_t polygons = 0, edges = 0, vertices = 0;
  for (int round = 0; round < 12; ++round) {
    Balls balls;
    std::vector<Vec3> centers;
    std::vector<double> radii;
    for (int i = 0; i < 20; ++i) {
      centers.push_back({unit(), unit(), unit()});
      radii.push_back(0.1 + 0.03 * round * unit());
    }
    balls.centers = centers;
    balls.radii = radii;
    const MedialAxis axis = axis_of_balls(balls, AlphaTolerance::none);
    polygons += axis.polygons();
    edges += axis.edges.size();
    vertices += axis.vertices.size();
    const AxisDistance distance_to_axis(std::span(&axis, 1));
    for (int i = 0; i < 60; ++i) {
      const Vec3 p{2 * unit() - 0.5, 2 * unit() - 0.5, 2 * unit() - 0.5};
      EXPECT_NEAR(distance_to_axis(p), brute_force(axis, p), 1e-13) << round << ' ' << i;
    }
  }
  EXPECT_GT(polygons, 100U);
  EXPECT_GT(edges, 30U);
  EXPECT_GT(vertices, 100U);
}

MedialAxis one_polygon(std::vector<Vec3> corners) {
  MedialAxis axis;
  std::vector<std::int32_t> order;
  for (std::size_t i = 0; i < corners.size(); ++i) order.push_back(static_cast<std::int32_t>(i));
  axis.radii = std::vector<double>(corners.size(), 1);
  axis.polygon_offsets = {0, static_cast<std::int64_t>(order.size())};
  axis.polygon_vertices = order;
  axis.polygon_kinds = {0};
  axis.vertices = std::move(corners);
  return with_sheets(axis);
}

TEST(axis_distance, of_a_polygon_that_is_not_convex_leaves_its_dent_out) {
  // An arrow head: seen from corner 2, or from the tip, corner 0.
  for (std::size_t turn = 0; turn < 4; ++turn) {
    std::vector<Vec3> corners{{0, 0, 0}, {2, 1, 0}, {1, 0, 0}, {2, -1, 0}};
    std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(turn), corners.end());
    const MedialAxis axis = one_polygon(corners);
    const AxisDistance to(std::span(&axis, 1));
    EXPECT_NEAR(to({0.5, 0, 3}), 3, 1e-15);
    EXPECT_NEAR(to({2, 0, 0}), std::sqrt(0.5), 1e-15) << "the dent, from corner " << turn;
  }
}

TEST(axis_distance, of_polygons_without_area_is_never_too_small) {
  // A needle along x at a distance of 1: what rounding makes of its plane is no answer.
  std::mt19937 random(5);
  const auto noise = [&random] { return 1e-16 * (static_cast<double>(random()) / 2147483648.0 - 1); };
  for (int i = 0; i < 200; ++i) {
    const MedialAxis axis = one_polygon({{100, noise(), noise()},
                                         {101, noise(), noise()},
                                         {100.7, noise(), noise()},
                                         {100.3, noise(), noise()}});
    const AxisDistance to(std::span(&axis, 1));
    EXPECT_NEAR(to({100.5, 0.6, 0.8}), 1, 1e-14);
    EXPECT_NEAR(to({99, 0, 0}), 1, 1e-14);
  }
}

TEST(axis_distance, of_several_axes_is_the_smallest) {
  const MedialAxis near = one_polygon({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}});
  const MedialAxis far = one_polygon({{0, 0, -2}, {1, 0, -2}, {0, 1, -2}});
  const std::vector<MedialAxis> both{far, near}, none{MedialAxis{}, near};
  EXPECT_EQ(AxisDistance(both)({0.1, 0.1, 0}), 1);
  EXPECT_EQ(AxisDistance(both)({0.1, 0.1, -1}), 1);
  EXPECT_EQ(AxisDistance(none)({0.1, 0.1, 0}), 1) << "of nothing outside";
}

TEST(axis_distance, refuses_axes_without_a_vertex) {
  const std::vector<MedialAxis> empty(2);
  EXPECT_THROW(AxisDistance{empty}, InputError);
  EXPECT_THROW(AxisDistance{std::span<const MedialAxis>()}, InputError);
}

// ---- the bounds of the thesis, on surfaces whose medial axis is known ----

struct Surface {
  std::string name;
  test::Mesh mesh;
  bool large;  // for tools/nightly: its polar balls are so near to ties that their axis takes seconds
  std::function<double(Vec3)> axis_distance;  // from the medial axis, by formula; the local feature size
};

double from_disk(Vec3 p, double radius) {
  return std::hypot(std::max(0.0, std::hypot(p.x, p.y) - radius), p.z);
}
double from_segment(Vec3 p, double half) { return std::hypot(p.x, p.y, std::max(0.0, std::abs(p.z) - half)); }

/// An ellipsoid: an octahedron with n^2 triangles on every side, its vertices moved a little, on a sphere,
/// stretched.
test::Mesh spheroid(Vec3 axes, int n) {
  test::LatticeMesh lattice;
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      for (const int z : {-1, 1}) {
        const auto at = [&](int i, int j) { return std::array<int, 3>{x * i, y * j, z * (n - i - j)}; };
        const auto add = [&](std::array<int, 3> a, std::array<int, 3> b, std::array<int, 3> c) {
          if (x * y * z > 0) std::swap(b, c);
          lattice.add_triangle(a, c, b);
        };
        for (int i = 0; i < n; ++i) {
          for (int j = 0; i + j < n; ++j) {
            add(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
          }
        }
      }
    }
  }
  std::mt19937 random(7);
  const auto moved = [&](int i) { return i + 0.05 * (static_cast<double>(random()) / 2147483648.0 - 1); };
  return lattice.placed([&](std::array<int, 3> cell) {
    const Vec3 v{moved(cell[0]), moved(cell[1]), moved(cell[2])};
    return Vec3{axes.x / length(v) * v.x, axes.y / length(v) * v.y, axes.z / length(v) * v.z};
  });
}

/// A torus of large radius 1 whose samples are moved a little on it.
test::Mesh shaken_torus(int around, int across, double tube) {
  test::Mesh mesh;
  std::mt19937 random(11);
  const auto angle = [&](int i, int n) {
    const double noise = 0.03 * (static_cast<double>(random()) / 2147483648.0 - 1);
    return 2 * 3.14159265358979323846 * (i + noise) / n;
  };
  const auto id = [&](int i, int j) { return (i % around) * across + j % across; };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      const double u = angle(i, around), v = angle(j, across), reach = 1 + tube * std::cos(v);
      mesh.vertices.push_back({reach * std::cos(u), reach * std::sin(u), tube * std::sin(v)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
      mesh.triangles.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
    }
  }
  return mesh;
}

const std::vector<Surface>& surfaces() {
  // The axis of an ellipsoid of revolution ends where it curves most: at (a^2 - c^2) / a.
  const double wide = 1.15, reach = (wide * wide - 1) / wide;
  static const std::vector<Surface> all = {
      {"sphere", spheroid({1, 1, 1}, 26), false, [](Vec3 p) { return length(p); }},
      {"prolate", spheroid({1, 1, wide}, 26), false, [=](Vec3 p) { return from_segment(p, reach); }},
      {"oblate", spheroid({wide, wide, 1}, 26), true, [=](Vec3 p) { return from_disk(p, reach); }},
      {"torus", shaken_torus(186, 62, 0.5), true,
       [](Vec3 p) {
         const double r = std::hypot(p.x, p.y);
         return std::min(r, std::hypot(r - 1, p.z));
       }},
  };
  return all;
}

TEST(discrete_feature_size, keeps_the_bounds_of_the_thesis_on_r_samples) {
  double smallest = 1, largest = 0;
  for (const Surface& surface : surfaces()) {
    if (surface.large && std::getenv("BALLFLOW_TEST_LARGE") == nullptr) continue;
    SCOPED_TRACE(surface.name);
    const test::Mesh& mesh = surface.mesh;
    // Chords are less than 0.001 off the surface, which adds as little to r.
    const SamplingRatio r = sampling_ratio(mesh.vertices, mesh.mesh(), surface.axis_distance);
    ASSERT_LT(r.at_most, 0.078) << "an r-sample for r <= 0.08";
    ASSERT_GT(r.at_least, 0.03) << "and no better one than it takes";

    const PoleSet poles = voronoi_poles(mesh.points(), {});
    LabelPolesOptions options;
    options.outer = OuterBalls::bounded;
    const LabelledPoles labelled = label_poles(poles, mesh.mesh(), options);
    const std::vector<MedialAxis> axes{axis_of_balls(labelled.inner, AlphaTolerance::polar),
                                       axis_of_balls(labelled.outer, AlphaTolerance::polar)};
    const auto discrete = axis_distances(mesh.vertices, AxisDistance(axes));
    const LocalFeatureSize size = local_feature_size(mesh.points(), poles);
    for (std::size_t s = 0; s < mesh.vertices.size(); ++s) {
      const double pole = size.pole_distances[s];
      EXPECT_LE(surface.axis_distance(mesh.vertices[s]), LocalFeatureSize::at_most * pole)
          << "Lemma 4.8, " << s;
      EXPECT_LE(discrete[s], pole * (1 + 1e-9)) << "Corollary 4.12: poles are in the axis, " << s;
      EXPECT_GE(discrete[s], LocalFeatureSize::discrete_at_least * pole) << "Corollary 4.12, " << s;
      smallest = std::min(smallest, discrete[s] / pole);
      largest = std::max(largest, surface.axis_distance(mesh.vertices[s]) / pole);
    }
  }
  RecordProperty("smallest", std::to_string(smallest));
  RecordProperty("largest", std::to_string(largest));
  EXPECT_LT(smallest, 1) << "somewhere the axis is nearer than every pole";
}

}  // namespace
}  // namespace ballflow::geometry
