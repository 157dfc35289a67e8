#include "poles/label_poles.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "poles/voronoi_poles.hpp"
#include "sample/read_mesh.hpp"
#include "shapes.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using geometry::InputError;
using geometry::label_poles;
using geometry::LabelledPoles;
using geometry::LabelMethod;
using geometry::PoleLabel;
using geometry::PoleSet;
using geometry::voronoi_poles;
using test::Mesh;
using test::TriangleMesh;
using test::Vec3;

constexpr auto inner = static_cast<std::uint8_t>(PoleLabel::inner);
constexpr auto outer = static_cast<std::uint8_t>(PoleLabel::outer);

struct Warnings final : geometry::Monitor {
  std::string text;
  void warn(const std::string& line) override { text += line + "\n"; }
};

LabelledPoles label(const PoleSet& poles, const TriangleMesh& mesh,
                    LabelMethod method = LabelMethod::automatic) {
  LabelledPoles result = label_poles(poles, mesh, {method});
  EXPECT_EQ(geometry::broken_invariant(result.poles), "");
  EXPECT_EQ(geometry::broken_invariant(result.inner), "");
  EXPECT_EQ(geometry::broken_invariant(result.outer), "");
  EXPECT_EQ(result.inner.size() + result.outer.size(), poles.size());
  return result;
}

std::string refusal(const PoleSet& poles, const TriangleMesh& mesh,
                    LabelMethod method = LabelMethod::automatic) {
  try {
    label_poles(poles, mesh, {method});
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(label_poles, finds_the_one_inner_ball_of_a_cube) {
  // The ray from the centre hits the diagonal of the top face.
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  const LabelledPoles result = label(poles, test::cube().mesh());
  EXPECT_EQ(result.method, LabelMethod::mesh);
  ASSERT_EQ(result.inner.size(), 1U);
  EXPECT_EQ(result.inner.centers[0], (Vec3{0, 0, 0}));
  EXPECT_EQ(result.inner.radii[0], std::sqrt(3.0));
  EXPECT_EQ(result.inner.samples_of(0).size(), 8U);
  for (std::size_t i = 0; i < poles.size(); ++i) {
    EXPECT_EQ(result.poles.labels[i], poles.unbounded[i] == 1 ? outer : inner);
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
  const std::size_t step = poles.size() * model.mesh.triangles.size() / 8000000 + 1;
  for (std::size_t i = 0; i < poles.size(); i += step) {
    if (poles.unbounded[i] == 1) continue;
    const double winding = brute_force_winding(model.mesh, poles.centers[i]);
    if (std::abs(winding - 0.5) < 1e-6) continue;
    EXPECT_EQ(result.poles.labels[i], winding > 0.5 ? inner : outer)
        << "pole " << i << ", winding " << winding;
  }
  EXPECT_EQ(label(poles, model.mesh, LabelMethod::winding).poles.labels, result.poles.labels);
  const double share =
      static_cast<double>(result.inner.size()) / static_cast<double>(model.points.points.size());
  EXPECT_GT(share, 0.85);
  EXPECT_LE(share, 1.1);
}

INSTANTIATE_TEST_SUITE_P(models, label_poles_of_model,
                         testing::Values("fandisk.off.gz", "rocker_arm.obj.gz", "three_holes.off.gz",
                                         "stanford_bunny.obj.gz", "stanford_dragon_res4.ply.gz"));

TEST(label_poles, of_the_open_bunny_by_generalized_winding_number) {
  const auto path = test::data_file("models/stanford_bunny.obj.gz");
  if (path.empty()) GTEST_SKIP() << "models/stanford_bunny.obj.gz is not there";
  const geometry::MeshFile model = geometry::read_mesh_file(path);
  const PoleSet poles = voronoi_poles(model.points, {});
  Warnings warnings;
  const LabelledPoles result = label_poles(poles, model.mesh, {}, warnings);
  EXPECT_EQ(result.method, LabelMethod::winding);
  EXPECT_NE(warnings.text.find("the mesh is open: 223 boundary edges in 5 loops"), std::string::npos)
      << warnings.text;
  EXPECT_GT(result.inner.size() * 10, model.points.points.size() * 9);
  EXPECT_GT(result.uncertain, 0);
  EXPECT_LT(result.uncertain, 500);
  EXPECT_NE(refusal(poles, model.mesh, LabelMethod::mesh).find("5 loops"), std::string::npos);

  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const LabelledPoles sequential = label(voronoi_poles(model.points, {}), model.mesh);
  EXPECT_EQ(sequential.poles.labels, result.poles.labels);
  EXPECT_EQ(sequential.inner.centers, result.inner.centers);
  EXPECT_EQ(sequential.inner.defining_samples, result.inner.defining_samples);

  Mesh turned{{model.mesh.vertices.begin(), model.mesh.vertices.end()},
              {model.mesh.triangles.begin(), model.mesh.triangles.end()}};
  EXPECT_EQ(label(poles, turned.turn().mesh()).poles.labels, result.poles.labels);
}

TEST(label_poles, of_broken_models_are_made_or_refused_with_a_reason) {
  for (const char* name : {"broken_cow.obj.gz", "broken_octagonal_pocket.stl.gz", "broken_not_convex.obj.gz",
                           "broken_soup.stl.gz", "broken_soup_flipped_dup.off.gz"}) {
    const auto path = test::data_file(std::string("models/") + name);
    if (path.empty()) GTEST_SKIP() << name << " is not there";
    const geometry::MeshFile model = geometry::read_mesh_file(path);
    const PoleSet poles = voronoi_poles(model.points, {});
    for (const LabelMethod method : {LabelMethod::automatic, LabelMethod::mesh, LabelMethod::winding}) {
      const std::string outcome = refusal(poles, model.mesh, method);
      if (outcome != "accepted") {
        EXPECT_NE(outcome.find("mesh"), std::string::npos) << name << ": " << outcome;
        EXPECT_NE(outcome.find('\n'), std::string::npos) << name << " is refused without a hint";
      }
    }
  }
}

TEST(label_poles, of_randomly_turned_triangles_are_those_of_the_clean_model) {
  const auto clean = test::data_file("models/eight.off.gz");
  const auto soup = test::data_file("models/broken_soup_flipped_dup.off.gz");
  if (clean.empty() || soup.empty()) GTEST_SKIP() << "models/eight.off.gz is not there";
  const geometry::MeshFile eight = geometry::read_mesh_file(clean), flipped = geometry::read_mesh_file(soup);
  const LabelledPoles expected = label(voronoi_poles(eight.points, {}), eight.mesh);
  const LabelledPoles found = label(voronoi_poles(eight.points, {}), flipped.mesh);
  EXPECT_EQ(found.poles.labels, expected.poles.labels);
}

TEST(label_poles, of_an_open_sheet_are_refused) {
  // The upper half of a sphere, without a bottom.
  Mesh half = test::sphere(3);
  std::erase_if(half.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](std::int32_t v) { return half.vertices[static_cast<std::size_t>(v)].z < 0.7; });
  });
  const PoleSet poles = voronoi_poles(half.points(), {});
  const std::string why = refusal(poles, half.mesh());
  EXPECT_NE(why.find("no pole is inside"), std::string::npos) << why;
  EXPECT_NE(why.find("the mesh is open"), std::string::npos) << why;
}

TEST(label_poles, of_a_mesh_without_triangles_are_refused) {
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  EXPECT_NE(refusal(poles, {}).find("no triangles"), std::string::npos);
  EXPECT_NE(refusal(poles, {test::cube().vertices, {{0, 1, 8}}}).find("damaged"), std::string::npos);
  EXPECT_NE(refusal(poles, {test::cube().vertices, {{0, 1, 1}}}).find("repeated corner"), std::string::npos);
}

TEST(label_poles, of_a_projective_plane_are_refused_by_method_mesh) {
  // Its six-vertex triangulation: every edge has two triangles, and no orientation exists.
  const std::vector<geometry::Triangle> triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 1},
                                                     {1, 2, 4}, {2, 3, 5}, {3, 4, 1}, {4, 5, 2}, {5, 1, 3}};
  const Mesh sphere = test::sphere(0);
  const PoleSet poles = voronoi_poles(sphere.points(), {});
  EXPECT_NE(refusal(poles, {sphere.vertices, triangles}, LabelMethod::mesh).find("not orientable"),
            std::string::npos);
}

TEST(label_poles, stops_when_cancelled) {
  struct Impatient final : geometry::Monitor {
    bool cancelled() override { return true; }
  } monitor;
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  EXPECT_THROW(label_poles(poles, test::cube().mesh(), {}, monitor), geometry::Cancelled);
}

}  // namespace
}  // namespace ballflow
