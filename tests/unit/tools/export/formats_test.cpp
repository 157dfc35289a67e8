// Every type in every format, read back by tests/support/check_exports.py, which shares nothing with the
// writers.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "ballflow/error.hpp"
#include "check_exports.hpp"
#include "export/export.hpp"
#include "io/load_balls.hpp"
#include "samples.hpp"
#include "sealed.hpp"
#include "test_data.hpp"

namespace ballflow {
namespace {

using namespace test;
using geometry::Vec3;

class ReadBack : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_python()) GTEST_SKIP() << "needs python3";
  }

  /// Writes the artifact in all formats of its type.
  template <class T>
  void write(const std::string& name, const T& value) {
    const ArtifactPtr artifact = sealed(value);
    for (const std::string& format : export_formats(*artifact)) {
      export_artifact(*artifact, folder.file(name + "." + format));
      ++files;
    }
    --files;  // the artifact itself is not compared
  }

  TempFolder folder;
  std::size_t files = 0;
};

geometry::CoverState sample_cover() {
  geometry::CoverState cover;
  cover.balls = 4;
  cover.samples = 3;
  cover.row_offsets = {0, 2, 3};
  cover.columns = {0, 1, 1};
  cover.row_ids = {0, 3};
  cover.column_ids = {0, 2};
  cover.chosen = {2};
  cover.chosen_how = {5};
  return cover;
}

geometry::MedialAxis axis_with_a_lone_vertex() {
  geometry::MedialAxis axis = sample_axis();
  std::vector<Vec3> vertices(axis.vertices.begin(), axis.vertices.end());
  std::vector<double> radii(axis.radii.begin(), axis.radii.end());
  vertices.push_back({9, 8, 7});
  radii.push_back(0);
  axis.vertices = std::move(vertices);
  axis.radii = std::move(radii);
  return axis;
}

TEST_F(ReadBack, every_type_holds_the_same_numbers_in_every_format) {
  write("points", sample_points(false));
  write("points_with_normals", sample_points(true));
  write("mesh", sample_mesh());
  write("balls", sample_balls());
  write("poles", sample_poles());
  write("feature_size", sample_feature_size());
  write("growth", sample_growth());
  write("prior", sample_prior());
  write("fit", sample_fit());
  write("surface_report", sample_surface_report());
  write("assignment", sample_assignment(true));
  write("assignment_without_surface", sample_assignment(false));
  write("complex", sample_complex());
  write("axis", axis_with_a_lone_vertex());
  write("cover", sample_cover());
  const ProcessResult result = check_exports(folder);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(count(result.out, "equal "), files) << result.out;
  EXPECT_GT(files, 50u);
}

TEST_F(ReadBack, an_artifact_without_elements_is_a_valid_file_in_every_format) {
  geometry::SimplicialComplex complex;
  geometry::MedialAxis axis;
  axis.polygon_offsets = {0};
  write("points", geometry::PointSet{});
  write("mesh", geometry::TriangleMesh{});
  write("balls", geometry::Balls{});
  write("feature_size", geometry::LocalFeatureSize{});
  write("growth", geometry::Growth{});
  write("complex", complex);
  write("axis", axis);
  const ProcessResult result = check_exports(folder);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_EQ(count(result.out, "equal "), files) << result.out;
}

TEST_F(ReadBack, the_last_bit_of_one_radius_is_noticed_in_every_format_with_doubles) {
  geometry::Balls balls = sample_balls();
  for (const std::string& format : export_formats("Balls")) {
    export_artifact(*sealed(balls), folder.file("balls." + format));
  }
  balls.radii = {std::nextafter(balls.radii[0], 1.0), balls.radii[1]};
  export_artifact(*sealed(balls), folder.file("balls.safetensors"));
  const ProcessResult result = check_exports(folder);
  EXPECT_EQ(result.exit_code, 1);
  // obj has no radii, json no arrays.
  EXPECT_EQ(count(result.out, "DIFFERENT "), export_formats("Balls").size() - 3) << result.out;
  EXPECT_EQ(count(result.out, "equal "), 2u) << result.out;
}

TEST_F(ReadBack, more_balls_than_a_scene_can_have_nodes_are_points_with_radii) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (int i = 0; i < 20001; ++i) {
    centers.push_back({1.0 * i, 0.5 * i, 1.0 / (i + 1)});
    radii.push_back(0.1 + i);
  }
  geometry::Balls balls;
  balls.centers = centers;
  balls.radii = radii;
  const ArtifactPtr artifact = sealed(balls);
  export_artifact(*artifact, folder.file("balls.safetensors"));
  export_artifact(*artifact, folder.file("balls.glb"));
  const ProcessResult result = check_exports(folder);
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  const std::string glb = read_file(folder.file("balls.glb"));
  EXPECT_NE(glb.find("\"_RADIUS\""), std::string::npos);
  EXPECT_EQ(glb.find("\"translation\""), std::string::npos);
}

TEST(glb, refuses_numbers_beyond_floats_and_leaves_no_file) {
  const TempFolder folder;
  const geometry::PointSet points{{{0, 0, 0}, {1e39, 0, 0}}, {}};
  try {
    export_artifact(*sealed(points), folder.file("a.glb"));
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::usage);
    EXPECT_NE(error.hint().find("vtp"), std::string::npos) << error.hint();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(glb, is_the_same_file_every_time) {
  const TempFolder folder;
  export_artifact(*sealed(sample_axis()), folder.file("a.glb"));
  export_artifact(*sealed(sample_axis()), folder.file("b.glb"));
  EXPECT_EQ(read_file(folder.file("a.glb")), read_file(folder.file("b.glb")));
}

TEST(balls, come_back_to_the_last_bit_from_every_format_that_LoadBalls_reads) {
  const TempFolder folder;
  for (const char* format : {"ply", "csv", "ma", "sph"}) {
    SCOPED_TRACE(format);
    const std::string file = folder.file(std::string("a.") + format);
    export_artifact(*sealed(sample_balls()), file);
    const geometry::LoadedBalls loaded = geometry::load_balls({file});
    EXPECT_EQ(loaded.balls.centers, sample_balls().centers);
    EXPECT_EQ(loaded.balls.radii, sample_balls().radii);
  }
}

TEST(ma, holds_a_medial_axis_that_comes_back_with_its_topology) {
  const TempFolder folder;
  const geometry::MedialAxis axis = axis_with_a_lone_vertex();
  export_artifact(*sealed(axis), folder.file("a.ma"));
  const geometry::MedialAxis back = geometry::load_balls({folder.file("a.ma")}).axis;
  EXPECT_EQ(back.vertices, axis.vertices);
  EXPECT_EQ(back.radii, axis.radii);
  EXPECT_EQ(back.edges, axis.edges);
  EXPECT_EQ(back.polygons(), 1u + 3u);  // the triangle, and the pentagon cut into three
  EXPECT_EQ(geometry::axis_topology(back).euler_characteristic,
            geometry::axis_topology(axis).euler_characteristic);
  EXPECT_EQ(geometry::axis_topology(back).components, geometry::axis_topology(axis).components);
  EXPECT_EQ(back.sheet_orientable.size(), axis.sheet_orientable.size());
  EXPECT_EQ(geometry::broken_invariant(back), "");
}

TEST(ma, cuts_polygons_without_changing_the_topology) {
  const TempFolder folder;
  const geometry::MedialAxis axis = axis_with_a_lone_vertex();
  export_artifact(*sealed(axis), folder.file("a.ma"));
  std::int64_t vertices = 0, edges = 0, triangles = 0;
  std::istringstream(read_file(folder.file("a.ma"))) >> vertices >> edges >> triangles;
  EXPECT_EQ(vertices - edges + triangles, geometry::axis_topology(axis).euler_characteristic);
}

}  // namespace
}  // namespace ballflow
