// What pruning, repair and the medial axis do to the topology of models of known genus.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <ostream>
#include <string>
#include <vector>

#include "axis/medial_axis.hpp"
#include "balls/enlarge.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "gudhi_oracle.hpp"
#include "homology/axis_betti.hpp"
#include "homology/inclusion_homology.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "power/alpha_shape.hpp"
#include "sample/sample.hpp"
#include "test_data.hpp"
#include "topology/solid_topology.hpp"
#include "topology/topology.hpp"
#include "topology/topology_repair.hpp"
#include "topology/union_topology.hpp"

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

struct Model {
  std::string file;  // a generated one, or a file of the folder of test data
  std::int64_t genus;
  bool well_sampled;  // the union of its balls has the topology of the solid
};

void PrintTo(const Model& model, std::ostream* out) { *out << model.file; }

struct Pipeline {
  TriangleMesh mesh;
  Balls inner, enlarged, all;  // all: with a ball of radius 0 for every sample that no ball covers
  CoverState cover;
  Ids kept;
};

Pipeline prune(const std::string& file, double epsilon) {
  const MeshFile model = sample({.file = file}, 1, no_monitor());
  const LabelledPoles labelled = label_poles(voronoi_poles(model.points, {}, no_monitor()), model.mesh, {});
  EnlargeOptions grow;
  grow.epsilon = epsilon;
  Pipeline p{model.mesh, labelled.inner, enlarge(labelled.inner, model.points, {}, grow).balls, {}, {}, {}};
  const CoverMatrix matrix = cover_matrix(p.enlarged, model.points);
  p.all = matrix.balls;
  GreedyOptions until_covered;
  until_covered.mode = GreedyMode::until_covered;
  p.cover = greedy(matrix.cover, until_covered);
  p.kept.assign(p.cover.chosen.begin(), p.cover.chosen.end());
  std::sort(p.kept.begin(), p.kept.end());
  return p;
}

std::string path_of(const Model& model) {
  return model.file.rfind("shape:", 0) == 0 ? model.file : test::data_file("models/" + model.file);
}

Ids merged(Ids a, const Ids& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  return a;
}

/// GUDHI needs four balls.
Betti gudhi_betti(const SimplicialComplex& complex) {
  return test::gudhi_complex(complex.centers, complex.weights).betti;
}

class EveryModel : public testing::TestWithParam<Model> {};

TEST_P(EveryModel, keeps_its_topology_from_the_surface_to_the_medial_axis) {
  const std::string file = path_of(GetParam());
  if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
  const Pipeline p = prune(file, 0.3);
  const Betti solid{1, GetParam().genus, 0};
  EXPECT_EQ(solid_topology(p.mesh, no_monitor()).betti, solid);

  const TopologyRepair repair = repair_topology(p.all, p.cover, {}, no_monitor());
  const Ids ids = merged(p.kept, repair.returned);
  const Balls kept = select(p.all, ids);
  const SimplicialComplex complex = alpha_shape(kept, {}, no_monitor());
  const MedialAxis axis = medial_axis(complex, {}, no_monitor());
  const auto counted = [](const Balls& balls, TopologyStage stage) {
    return union_row(balls, {stage}, no_monitor());
  };
  const TopologyTable surface = solid_row(p.mesh, no_monitor()),
                      inner = counted(p.inner, TopologyStage::inner),
                      enlarged = counted(p.enlarged, TopologyStage::enlarged),
                      chosen = counted(kept, TopologyStage::kept);
  const TopologyTable table = topology({&surface, &inner, &enlarged, &chosen, &complex, &axis}, no_monitor());
  const Betti after = table.betti[*table.row(TopologyStage::kept)];
  if (GetParam().well_sampled) {
    for (const Betti& row : table.betti) EXPECT_EQ(row, solid);
  }
  const UnionOfBalls whole(p.all, no_monitor());
  EXPECT_EQ(after, whole.complex().betti);
  EXPECT_EQ(after, gudhi_betti(kept.size() < 4 ? whole.complex() : complex));
  EXPECT_EQ(after, table.betti[*table.row(TopologyStage::axis)]);
  EXPECT_EQ(complex.euler_characteristic(), axis_topology(axis).euler_characteristic);
  EXPECT_TRUE(whole.inclusion_of(ids).isomorphism());
}

TEST_P(EveryModel, is_repaired_when_every_third_kept_ball_is_missing) {
  const std::string file = path_of(GetParam());
  if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
  Pipeline p = prune(file, 0.3);
  // The balls of U+ are few here, so that there are many defects and little to choose from.
  const Balls few = select(p.all, p.kept);
  Ids kept;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(few.size()); ++i) {
    if (i % 3 != 0) kept.push_back(i);
  }
  const TopologyRepair repair = repair_topology(few, kept, {}, no_monitor());
  const UnionOfBalls whole(few, no_monitor());
  EXPECT_EQ(whole.inclusion_of(kept), repair.check.inclusion_before());
  const Ids after = merged(kept, repair.returned);
  EXPECT_TRUE(whole.inclusion_of(after).isomorphism());
  const Balls balls = select(few, after);
  const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
  if (few.size() >= 4) {
    EXPECT_EQ(gudhi_betti(complex), gudhi_betti(whole.complex()));
  }
}

TEST_P(EveryModel, has_the_same_topology_when_it_is_rotated_and_scaled) {
  const std::string file = path_of(GetParam());
  if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
  const Pipeline p = prune(file, 0.3);
  const UnionOfBalls whole(p.all, no_monitor());
  const InclusionHomology expected = whole.inclusion_of(p.kept);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < p.all.size(); ++i) {
    const Vec3 c = 0.7 * p.all.centers[i];
    centers.push_back({0.6 * c.x - 0.8 * c.y, 0.8 * c.x + 0.6 * c.y, c.z});
    radii.push_back(0.7 * p.all.radii[i]);
  }
  EXPECT_EQ(UnionOfBalls({centers, radii, {}, {}}, no_monitor()).inclusion_of(p.kept), expected);
}

std::string name_of(const testing::TestParamInfo<Model>& info) {
  std::string name = info.param.file.substr(info.param.file.find(':') + 1);
  name = name.substr(0, name.find_first_of(".?"));
  return name[0] >= '0' && name[0] <= '9' ? "shape_" + name : name;
}

INSTANTIATE_TEST_SUITE_P(
    Generated, EveryModel,
    testing::Values(Model{"shape:sphere?n=1500", 0, true}, Model{"shape:torus?n=2500", 1, true},
                    Model{"shape:doubleTorus?n=4000", 2, true}, Model{"shape:knot?n=2500", 1, true},
                    Model{"shape:3cross?n=4000", 0, true}, Model{"shape:torusBalls?n=6000", 1, true}),
    name_of);
INSTANTIATE_TEST_SUITE_P(Files, EveryModel,
                         testing::Values(Model{"three_holes.off.gz", 3, true}, Model{"eight.off.gz", 2, true},
                                         Model{"fertility.off.gz", 4, true},
                                         Model{"rocker_arm.obj.gz", 1, true},
                                         Model{"cheese.off.gz", 133, false}),
                         name_of);

TEST(Reports, of_boxes_on_a_grid_lose_no_part_of_their_medial_axis) {
  class Listener final : public Monitor {
   public:
    void warn(const std::string& text) override { ADD_FAILURE() << text; }
    void note(const std::string& text) override { notes.push_back(text); }
    std::vector<std::string> notes;
  };
  for (const char* name : {"rod.off", "15.off"}) {
    SCOPED_TRACE(name);
    const std::string file = test::data_file("reports/axis/" + std::string(name));
    if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
    const Pipeline p = prune(file, 0.3);
    Listener listener;
    for (const Balls& balls : {select(p.all, p.kept), p.inner}) {
      const SimplicialComplex complex = alpha_shape(balls, {}, no_monitor());
      EXPECT_EQ(axis_betti(medial_axis(complex, {}, listener), no_monitor()), complex.betti);
    }
    EXPECT_FALSE(listener.notes.empty()) << "doubles are enough for these balls: the test needs others";
  }
}

/// Scans, for tools/nightly: BALLFLOW_TEST_LARGE=1.
TEST(LargeModels, are_repaired_after_heavy_and_light_pruning) {
  if (std::getenv("BALLFLOW_TEST_LARGE") == nullptr) GTEST_SKIP() << "BALLFLOW_TEST_LARGE is not set";
  for (const char* name :
       {"stanford_bunny.obj.gz", "stanford_dragon_50k.obj.gz", "stanford_dragon_res2.ply.gz"}) {
    const std::string file = test::data_file("models/" + std::string(name));
    if (file.empty()) GTEST_SKIP() << "the folder of test models is absent";
    for (const double epsilon : {0.05, 0.3}) {
      SCOPED_TRACE(std::string(name) + ", " + std::to_string(epsilon));
      const Pipeline p = prune(file, epsilon);
      const TopologyRepair repair = repair_topology(p.all, p.cover, {}, no_monitor());
      EXPECT_EQ(repair.check.everything, 0);
      const Ids ids = merged(p.kept, repair.returned);
      const SimplicialComplex complex = alpha_shape(select(p.all, ids), {}, no_monitor());
      EXPECT_EQ(gudhi_betti(complex), repair.check.whole);
      EXPECT_TRUE(UnionOfBalls(p.all, no_monitor()).inclusion_of(ids).isomorphism());
      std::printf("%s, epsilon %g: %s\n", name, epsilon, describe(repair.check).c_str());
    }
  }
}

}  // namespace
}  // namespace ballflow::geometry
