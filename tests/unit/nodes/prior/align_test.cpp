#include "prior/align.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "io/read_mesh.hpp"
#include "prior/cloud.hpp"
#include "prior/procrustes.hpp"
#include "prior_examples.hpp"
#include "sample/generate.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

TEST(align, a_turned_copy_comes_back_to_where_it_was) {
  const PointSet bracket = samples_of(generate({Shape::bracket, 2000}), 400, 1);
  Random random(2);
  for (const bool similarity : {false, true}) {
    const ShapePose away = random_pose(random, similarity ? 3.7 : 1, 100);
    const ShapePose found = align(moved(bracket, away), bracket, {.similarity = similarity});
    EXPECT_EQ(broken_invariant(found), "");
    EXPECT_LT(degrees_between(found, inverse(away)), 1e-5);
    EXPECT_NEAR(found.scale, 1 / away.scale, 1e-6);
    EXPECT_LT(relative_residual(found), 1e-6);
    EXPECT_GT(found.second_best, 2);
  }
}

TEST(align, two_samplings_of_one_surface_fit_as_well_as_their_spacing_allows) {
  const TriangleMesh mesh = generate({Shape::bracket, 2000});
  const PointSet one = samples_of(mesh, 400, 1), other = samples_of(mesh, 400, 2);
  Random random(3);
  const ShapePose away = random_pose(random);
  const ShapePose found = align(moved(one, away), other, {.similarity = false});
  EXPECT_LT(degrees_between(found, inverse(away)), 2);
  EXPECT_LT(relative_residual(found), 0.05);
}

TEST(align, symmetric_shapes_are_told_to_be_ambiguous) {
  const PointSet box = samples_of(generate({Shape::box, 1000, 1, 0.6}), 400, 1);
  Warnings warnings;
  const ShapePose found = align(box, box, {}, warnings);
  EXPECT_GE(found.second_best, 1);
  // Samples break the symmetry of the box: equal ones fit exactly, others do not.
  const PointSet other = samples_of(generate({Shape::box, 1000, 1, 0.6}), 400, 2);
  const ShapePose open = align(other, box, {}, warnings);
  EXPECT_LT(open.second_best, 1.1);
  EXPECT_NE(warnings.text.find("ambiguous"), std::string::npos) << warnings.text;
}

TEST(align, mirror_images_are_refused_unless_asked_for) {
  // A shape without any plane of symmetry.
  const PointSet shape = samples_of(handed_shape(), 400, 1);
  PointSet mirrored = shape;
  std::vector<Vec3> points(shape.points.begin(), shape.points.end());
  for (Vec3& p : points) p.x = -p.x;
  mirrored.points = std::move(points);
  Random random(4);
  const ShapePose away = random_pose(random);
  try {
    align(moved(mirrored, away), shape, {});
    FAIL() << "a mirror image was accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("mirror image"), std::string::npos) << error.what();
  }
  const ShapePose found = align(moved(mirrored, away), shape, {.reflections = Reflections::allow});
  EXPECT_EQ(found.mirrored, 1);
  EXPECT_EQ(broken_invariant(found), "");
  EXPECT_LT(relative_residual(found), 1e-6);
  EXPECT_GT(align(moved(shape, away), shape, {}).mirror_image, 1.1);
}

TEST(align, a_part_keeps_about_its_size_and_one_in_another_unit_is_told) {
  const PointSet shape = samples_of(handed_shape(), 500, 1), other = samples_of(handed_shape(), 500, 2);
  std::vector<Vec3> half;
  for (const Vec3& p : shape.points)
    if (p.x > 2.5) half.push_back(p);
  PointSet part;
  part.points = half;
  Random random(8);
  const ShapePose away = random_pose(random, 1.05);
  Warnings warnings;
  const ShapePose found = align(moved(part, away), other, {.extent = Extent::part}, warnings);
  EXPECT_EQ(broken_invariant(found), "");
  EXPECT_LT(degrees_between(found, inverse(away)), 10);
  EXPECT_NEAR(found.scale * 1.05, 1, 0.1);
  EXPECT_EQ(warnings.text.find("unit"), std::string::npos) << warnings.text;
  ShapePose to_metres;
  to_metres.scale = 0.001;
  const ShapePose tiny = align(moved(part, to_metres), other, {.extent = Extent::part}, warnings);
  EXPECT_EQ(broken_invariant(tiny), "");
  EXPECT_NE(warnings.text.find("unit"), std::string::npos) << warnings.text;
}

TEST(align, another_kind_of_shape_is_reported) {
  const PointSet bracket = samples_of(generate({Shape::bracket, 2000}), 300, 1),
                 torus = samples_of(generate({Shape::torus, 2000}), 300, 1);
  Warnings warnings;
  align(torus, bracket, {}, warnings);
  EXPECT_NE(warnings.text.find("not like the target"), std::string::npos) << warnings.text;
}

TEST(align, refuses_what_cannot_be_aligned) {
  const PointSet good = samples_of(generate({Shape::bracket, 2000}), 100, 1);
  PointSet few, flat;
  few.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  flat.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.5, 0.2, 0}};
  ShapePose blown_up, shrunk;
  blown_up.scale = 1e120;
  shrunk.scale = 1e-120;
  for (const PointSet& bad : {PointSet{}, few, flat, moved(good, blown_up), moved(good, shrunk)}) {
    EXPECT_THROW(align(bad, good, {}), InputError);
    EXPECT_THROW(align(good, bad, {}), InputError);
  }
}

struct Scapulae : testing::Test {
  void SetUp() override {
    for (const char* name : {"2", "23", "34", "48"}) {
      const std::string file = test::data_file("models/scapula_" + std::string(name) + ".stl.gz");
      if (file.empty()) GTEST_SKIP() << "no test data";
      meshes.push_back(read_mesh_file(file, {}).mesh);
      samples.push_back(samples_of(meshes.back(), 500, 5));
      // Corners welded by first occurrence: vertex i is the same place on every bone, which is the truth
      // here.
      ASSERT_TRUE(meshes.back().triangles == meshes.front().triangles);
    }
  }
  std::vector<TriangleMesh> meshes;
  std::vector<PointSet> samples;
};

TEST_F(Scapulae, every_pair_is_aligned_to_within_degrees_of_the_labelled_optimum) {
  Random random(6);
  double worst = 0;
  for (const bool similarity : {false, true}) {
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < 4; ++j) {
        if (i == j) continue;
        const ShapePose away = random_pose(random, similarity ? 0.7 + 0.7 * random.unit() : 1, 500);
        const ShapePose truth =
            labelled_pose(moved(meshes[i].vertices.span(), away), meshes[j].vertices, {}, {similarity});
        const ShapePose found = align(moved(samples[i], away), samples[j], {.similarity = similarity});
        worst = std::max(worst, degrees_between(found, truth));
        EXPECT_LT(degrees_between(found, truth), 5) << i << " on " << j;
        EXPECT_GT(found.second_best, 2) << i << " on " << j;
        EXPECT_GT(found.mirror_image, 1.3) << i << " on " << j;
        EXPECT_LT(relative_residual(found), 0.04) << i << " on " << j;
      }
    }
  }
  RecordProperty("worst_degrees", std::to_string(worst));
}

TEST_F(Scapulae, halves_are_aligned_or_told_to_be_ambiguous) {
  const bool all = std::getenv("BALLFLOW_TEST_LARGE") != nullptr;  // else one of 72
  Random random(7);
  for (std::size_t i = 0; i < (all ? 4 : 1); ++i) {
    const PrincipalFrame frame = principal_frame(meshes[i].vertices);
    for (std::size_t j = all ? 0 : 1; j < (all ? 4 : 2); ++j) {
      for (std::size_t cut = 0; cut < (all && i != j ? 6 : all ? 0 : 1); ++cut) {
        const Vec3 across = (cut < 3 ? 1.0 : -1.0) * frame.axes[cut % 3];
        const auto kept = [&](Vec3 p) { return dot(across, p - frame.mean) > 0; };
        const ShapePose away = random_pose(random, 1, 500);
        std::vector<Vec3> half, from, to;
        for (const Vec3& p : samples[i].points)
          if (kept(p)) half.push_back(transformed(away, p));
        for (std::size_t v = 0; v < meshes[i].vertices.size(); ++v) {
          if (!kept(meshes[i].vertices[v])) continue;
          from.push_back(transformed(away, meshes[i].vertices[v]));
          to.push_back(meshes[j].vertices[v]);
        }
        PointSet part;
        part.points = half;
        const ShapePose truth = labelled_pose(from, to, {}, {.similarity = false});
        Warnings warnings;
        const ShapePose found =
            align(part, samples[j], {.similarity = false, .extent = Extent::part}, warnings);
        if (warnings.text.find("ambiguous") == std::string::npos) {
          EXPECT_LT(degrees_between(found, truth), 12) << i << " on " << j << ", cut " << cut;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
