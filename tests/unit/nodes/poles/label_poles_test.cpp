#include "poles/label_poles.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/read_mesh.hpp"
#include "label_cases.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using namespace label_cases;

TEST(label_poles, finds_the_one_inner_ball_of_a_cube) {
  // The ray from the centre hits the diagonal of the top face.
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  const LabelledPoles result = label(poles, test::cube().mesh());
  EXPECT_EQ(result.method, LabelMethod::mesh);
  ASSERT_EQ(result.inner.size(), 1U);
  EXPECT_EQ(result.inner.centers[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(result.inner.radii[0], std::sqrt(3.0));
  EXPECT_EQ(result.inner.samples_of(0).size(), 8U);
  for (std::size_t i = 0; i < result.poles.size(); ++i) {
    EXPECT_EQ(result.poles.labels[i], result.poles.unbounded[i] == 1 ? outer : inner);
  }
}

TEST(label_poles, finds_the_core_of_a_torus) {
  const Mesh torus = test::torus(120, 50, 0.3);
  const LabelledPoles result = label(voronoi_poles(torus.points(), {}), torus.mesh());
  for (std::size_t i = 0; i < result.inner.size(); ++i) {
    const Vec3 c = result.inner.centers[i];
    const double to_core = std::hypot(std::hypot(c.x, c.y) - 1, c.z);
    EXPECT_LT(to_core, 0.02);
    EXPECT_NEAR(result.inner.radii[i], 0.3, 0.02);
  }
  EXPECT_GT(result.inner.size(), torus.vertices.size() / 4);
  for (std::size_t i = 0; i < result.outer.size(); ++i) {
    const Vec3 c = result.outer.centers[i];
    EXPECT_GT(std::hypot(std::hypot(c.x, c.y) - 1, c.z), 0.3);
  }
}

TEST(label_poles, does_not_mind_how_triangles_are_turned) {
  Mesh torus = test::torus(60, 30, 0.3);
  const PoleSet poles = voronoi_poles(torus.points(), {});
  const auto labels = label(poles, torus.mesh()).poles.labels;
  const auto count = static_cast<std::int64_t>(torus.triangles.size());

  Mesh inside_out = torus;
  const LabelledPoles turned = label(poles, inside_out.turn().mesh());
  EXPECT_EQ(turned.poles.labels, labels);
  EXPECT_EQ(turned.turned_triangles, count);

  Mesh one_wrong = torus;
  std::swap(one_wrong.triangles[17][0], one_wrong.triangles[17][1]);
  const LabelledPoles repaired = label(poles, one_wrong.mesh(), LabelMethod::mesh);
  EXPECT_EQ(repaired.poles.labels, labels);
  EXPECT_EQ(repaired.turned_triangles, 1);

  Mesh chaos = torus;
  std::mt19937 random(5);
  for (auto& t : chaos.triangles) {
    if (random() % 2 == 0) std::swap(t[0], t[1]);
  }
  EXPECT_EQ(label(poles, chaos.mesh(), LabelMethod::mesh).poles.labels, labels);
}

TEST(label_poles, keeps_the_cavity_of_a_hollow_sphere) {
  Mesh hollow = test::sphere(4);
  hollow.add(test::sphere(3).move({0.1, 0, 0}, 0.5).turn());
  const PoleSet poles = voronoi_poles(hollow.points(), {});
  for (const bool inside_out : {false, true}) {
    if (inside_out) hollow.turn();
    const LabelledPoles result = label(poles, hollow.mesh());
    EXPECT_GT(result.inner.size(), 100U);
    for (std::size_t i = 0; i < result.inner.size(); ++i) {
      EXPECT_GT(distance(result.inner.centers[i], {0.1, 0, 0}), 0.5);
      EXPECT_LT(length(result.inner.centers[i]), 1);
    }
  }
}

TEST(label_poles, turns_an_inside_out_component_outwards) {
  Mesh pair = test::sphere(3);
  pair.add(test::sphere(2).move({3, 0, 0}, 0.5).turn());
  const LabelledPoles result = label(voronoi_poles(pair.points(), {}), pair.mesh());
  EXPECT_EQ(result.turned_triangles, 8 * 16);
  std::size_t in_small = 0;
  for (std::size_t i = 0; i < result.inner.size(); ++i) {
    if (distance(result.inner.centers[i], {3, 0, 0}) < 0.5) ++in_small;
  }
  EXPECT_GT(in_small, 0U);
  EXPECT_GT(result.inner.size(), in_small);
}

TEST(label_poles, takes_the_overlap_of_two_solids_as_inside) {
  Mesh pair = test::sphere(3);
  pair.add(test::sphere(3).move({0.5, 0.01, 0.02}));
  const TriangleMesh mesh = pair.mesh();
  const LabelledPoles result = label(voronoi_poles(pair.points(), {}), mesh);
  std::size_t overlap = 0;
  for (std::size_t i = 0; i < result.poles.size(); ++i) {
    const double a = length(result.poles.centers[i]);
    const double b = distance(result.poles.centers[i], {0.5, 0.01, 0.02});
    if (a < 0.95 && b < 0.95) {
      ++overlap;
      EXPECT_EQ(result.poles.labels[i], inner);
    }
    if (a > 1 && b > 1) {
      EXPECT_EQ(result.poles.labels[i], outer);
    }
  }
  EXPECT_GT(overlap, 0U);
}

// Generalized winding number by the C library's arc tangent in long double, one triangle after the other.
double brute_force_winding(const TriangleMesh& mesh, Vec3 point) {
  long double sum = 0;
  for (const auto& t : mesh.triangles) {
    long double v[3][3], l[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = mesh.vertices[static_cast<std::size_t>(t[k])];
      v[k][0] = static_cast<long double>(p.x) - point.x;
      v[k][1] = static_cast<long double>(p.y) - point.y;
      v[k][2] = static_cast<long double>(p.z) - point.z;
      l[k] = std::sqrt(v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2]);
    }
    const auto scalar = [&](int a, int b) {
      return v[a][0] * v[b][0] + v[a][1] * v[b][1] + v[a][2] * v[b][2];
    };
    const long double volume = v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) +
                               v[0][1] * (v[1][2] * v[2][0] - v[1][0] * v[2][2]) +
                               v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
    sum += std::atan2(volume,
                      l[0] * l[1] * l[2] + scalar(0, 1) * l[2] + scalar(1, 2) * l[0] + scalar(2, 0) * l[1]);
  }
  return static_cast<double>(sum / (2 * 3.14159265358979323846264L));
}

class label_poles_of_model : public testing::TestWithParam<const char*> {};

TEST_P(label_poles_of_model, agree_with_the_brute_force_winding_number) {
  const auto path = test::data_file(std::string("models/") + GetParam());
  if (path.empty()) GTEST_SKIP() << GetParam() << " is not there";
  const geometry::MeshFile model = geometry::read_mesh_file(path);
  const PoleSet poles = voronoi_poles(model.points, {});
  const LabelledPoles result = label(poles, model.mesh);
  const std::size_t step = result.poles.size() * model.mesh.triangles.size() / 8000000 + 1;
  for (std::size_t i = 0; i < result.poles.size(); i += step) {
    if (result.poles.unbounded[i] == 1) continue;
    const double winding = brute_force_winding(model.mesh, result.poles.centers[i]);
    if (std::abs(winding - 0.5) < 1e-6) continue;
    EXPECT_EQ(result.poles.labels[i], winding > 0.5 ? inner : outer)
        << "pole " << i << ", winding " << winding;
  }
  EXPECT_EQ(label(poles, model.mesh, LabelMethod::winding).poles.labels, result.poles.labels);
  const LabelledPoles again = label(result.poles, model.mesh);
  EXPECT_EQ(again.poles.labels, result.poles.labels);
  EXPECT_EQ(again.poles.sample_poles, result.poles.sample_poles);
  const double share =
      static_cast<double>(result.inner.size()) / static_cast<double>(model.points.points.size());
  EXPECT_GT(share, 0.85);
  EXPECT_LE(share, 1.1);
}

INSTANTIATE_TEST_SUITE_P(models, label_poles_of_model,
                         testing::Values("fandisk.off.gz", "rocker_arm.obj.gz", "three_holes.off.gz",
                                         "stanford_bunny.obj.gz", "stanford_dragon_res4.ply.gz"));

std::size_t samples_in_no_ball(const geometry::Balls& balls, std::size_t samples) {
  std::vector<bool> covered(samples, false);
  for (const std::int32_t s : balls.defining_samples) covered[at(s)] = true;
  return static_cast<std::size_t>(std::count(covered.begin(), covered.end(), false));
}

// Samples whose farthest vertex and the farthest behind it are both labelled outer.
std::size_t without_inner_pole_of_two(const PoleSet& poles) {
  return static_cast<std::size_t>(
      std::count_if(poles.sample_poles.begin(), poles.sample_poles.end(), [&](const auto& own) {
        return poles.labels[at(own[0])] == outer && poles.labels[at(own[1])] == outer;
      }));
}

TEST(label_poles, of_a_smooth_solid_are_the_first_two_of_every_sample) {
  for (const Mesh& smooth : {test::torus(120, 50, 0.3), test::sphere(4)}) {
    const PoleSet poles = voronoi_poles(smooth.points(), {});
    const LabelledPoles result = label(poles, smooth.mesh());
    EXPECT_EQ(result.poles.centers, poles.centers);  // no candidates
    EXPECT_EQ(result.poles.sample_poles, poles.sample_poles);
    for (const auto& own : result.poles.sample_poles) {
      EXPECT_NE(result.poles.labels[at(own[0])], result.poles.labels[at(own[1])]);
      EXPECT_EQ(own[2], -1);
    }
  }
}

TEST(label_poles, give_every_sample_of_cubes_side_by_side_an_inner_ball) {
  // The cells of edges and corners that face another cube are bounded outside too.
  Mesh cubes;
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 place{(i & 1) != 0 ? 1.7 : -1.7, (i & 2) != 0 ? 1.6 : -1.6, (i & 4) != 0 ? 1.5 : -1.5};
    cubes.add(test::lattice_cube(6, 0.3, i).move(place));
  }
  const LabelledPoles result = label(voronoi_poles(cubes.points(), {}), cubes.mesh());
  EXPECT_EQ(samples_in_no_ball(result.inner, cubes.vertices.size()), 0U);
  EXPECT_GT(without_inner_pole_of_two(result.poles), 0U);
}

TEST(label_poles, give_nearly_every_sample_of_a_sharp_wedge_an_inner_ball) {
  struct Case {
    double thickness, jitter;
    std::size_t most;  // cells of these samples have no vertex inside: they are cut off by the other face
  };
  for (const auto& [thickness, jitter, most] : {Case{0.5, 0.1, 0}, Case{0.2, 0.1, 2}, Case{0.1, 0.1, 12}}) {
    const Mesh wedge = test::lattice_wedge(12, thickness, jitter);
    const LabelledPoles result = label(voronoi_poles(wedge.points(), {}), wedge.mesh());
    EXPECT_LE(samples_in_no_ball(result.inner, wedge.vertices.size()), most) << "thickness " << thickness;
    EXPECT_GT(without_inner_pole_of_two(result.poles), 5 * most);
  }
}

class label_poles_of_sharp_model : public testing::TestWithParam<std::pair<const char*, std::size_t>> {};

TEST_P(label_poles_of_sharp_model, give_nearly_every_sample_an_inner_ball) {
  const auto [name, most] = GetParam();
  const auto path = test::data_file(std::string("models/") + name);
  if (path.empty()) GTEST_SKIP() << name << " is not there";
  const geometry::MeshFile model = geometry::read_mesh_file(path);
  const PoleSet poles = voronoi_poles(model.points, {});
  const LabelledPoles result = label(poles, model.mesh);
  const std::size_t missing = samples_in_no_ball(result.inner, model.points.points.size());
  EXPECT_LE(missing, most);
  const std::size_t without = without_inner_pole_of_two(result.poles);
  EXPECT_GT(without, 20 * missing);
  RecordProperty("samples_in_no_inner_ball", static_cast<int>(missing));

  // The third pole is the farthest: what is farther in the cell is on the side of the first.
  std::vector<std::vector<std::size_t>> cell(poles.sample_poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    for (const std::int32_t s : samples_of(poles, i)) cell[at(s)].push_back(i);
  }
  std::size_t budget = 5000000 / model.mesh.triangles.size(), compared = 0;
  for (std::size_t s = 0; s < cell.size(); s += 7) {
    const auto& own = result.poles.sample_poles[s];
    const std::uint8_t first = result.poles.labels[at(own[0])];
    if (first != result.poles.labels[at(own[1])]) continue;
    const double reach = own[2] < 0 ? 0 : result.poles.radii[at(own[2])];
    for (const std::size_t i : cell[s]) {
      if (poles.radii[i] <= reach || poles.unbounded[i] == 1 || budget == 0) continue;
      --budget;
      const double winding = brute_force_winding(model.mesh, poles.centers[i]);
      if (std::abs(winding - 0.5) < 1e-6) continue;
      EXPECT_EQ(winding > 0.5 ? inner : outer, first) << "sample " << s << ", vertex " << i;
      ++compared;
    }
  }
  EXPECT_GT(compared, 0U);
}

INSTANTIATE_TEST_SUITE_P(models, label_poles_of_sharp_model,
                         testing::Values(std::pair("fandisk.off.gz", std::size_t{0}),
                                         std::pair("anchor_dense.off.gz", std::size_t{0}),
                                         std::pair("stanford_dragon_res3.ply.gz", std::size_t{11})));

TEST(label_poles, stops_when_cancelled) {
  struct Impatient final : geometry::Monitor {
    bool cancelled() override { return true; }
  } monitor;
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  EXPECT_THROW(label_poles(poles, test::cube().mesh(), {}, monitor), geometry::Cancelled);
}

}  // namespace
}  // namespace ballflow
