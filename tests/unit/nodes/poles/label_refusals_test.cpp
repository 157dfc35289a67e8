// Labels where the mesh is open, broken or absent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/read_mesh.hpp"
#include "label_cases.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using namespace label_cases;

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

TEST(label_poles, of_a_bowl_are_refused_with_the_choices_unless_a_method_is_asked_for) {
  Mesh bowl = test::sphere(4);  // half of an ellipsoid has a hollow, and no inside that is surely one
  for (Vec3& v : bowl.vertices) v = {1.5 * v.x, v.y, 0.6 * v.z};
  std::erase_if(bowl.triangles, [&](const auto& t) { return bowl.vertices[at(t[0])].z > 0; });
  std::vector<Vec3> kept;
  for (auto& t : bowl.triangles) {
    for (auto& v : t) {
      const auto found = std::find(kept.begin(), kept.end(), bowl.vertices[at(v)]);
      if (found == kept.end()) kept.push_back(bowl.vertices[at(v)]);
      v = static_cast<std::int32_t>(std::find(kept.begin(), kept.end(), bowl.vertices[at(v)]) - kept.begin());
    }
  }
  bowl.vertices = kept;
  const PoleSet poles = voronoi_poles(bowl.points(), {});
  try {
    label_poles(poles, bowl.mesh(), {});
    FAIL() << "a bowl has no inside";
  } catch (const InputError& error) {
    for (const char* words : {"the mesh is open", "sampling=wrap", "labels=winding"}) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
}

TEST(label_poles, of_a_closed_mesh_with_too_few_samples_say_so) {
  // The circumscribed ball of four vertices of a cube's corner has its centre outside.
  const std::vector<geometry::Vec3> corner = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<geometry::Triangle> sides = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  geometry::PointSet points;
  points.points = corner;
  const std::string why = refusal(voronoi_poles(points, {}), geometry::TriangleMesh{corner, sides});
  EXPECT_NE(why.find("the samples are too few"), std::string::npos) << why;
  EXPECT_EQ(why.find("open"), std::string::npos) << why;
}

TEST(label_poles, of_a_mesh_without_triangles_are_refused) {
  const PoleSet poles = voronoi_poles(test::cube().points(), {});
  EXPECT_NE(refusal(poles, {}, LabelMethod::mesh).find("no triangles"), std::string::npos);
  EXPECT_NE(refusal(poles, {}, LabelMethod::winding).find("no triangles"), std::string::npos);
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

}  // namespace
}  // namespace ballflow
