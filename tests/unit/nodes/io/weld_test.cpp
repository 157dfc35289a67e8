// Vertices that nearly coincide, gaps that are small, points that are far away, and scales.
#include "io/weld.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "io/lengths.hpp"
#include "io/load_balls.hpp"
#include "io/read_mesh.hpp"
#include "io/strays.hpp"
#include "mesh_files.hpp"
#include "test_data.hpp"

namespace ballflow::geometry {
namespace {

struct WeldListener final : Monitor {
  void warn(const std::string& warning) override { text += warning + "\n"; }
  std::string text;
};

double at_random(Random& random) { return static_cast<double>(random.bits() >> 11) * 0x1p-53; }

/// Facets whose corners are moved by up to `jitter` along each axis, each by itself.
std::string with_cracks(const TriangleMesh& m, double jitter, Random& random) {
  std::string out = "solid cracks\n";
  for (const Triangle& t : m.triangles) {
    out += "facet normal 0 0 0\nouter loop\n";
    for (const std::int32_t corner : t) {
      Vec3 p = m.vertices[static_cast<std::size_t>(corner)];
      for (double Vec3::*const axis : {&Vec3::x, &Vec3::y, &Vec3::z})
        p.*axis += jitter * (2 * at_random(random) - 1);
      out += "vertex " + test::text(p) + "\n";
    }
    out += "endloop\nendfacet\n";
  }
  return out + "endsolid\n";
}

/// The value that a warning proposes for a parameter.
std::string proposed(const std::string& warnings, const std::string& name) {
  const std::string before = "\"" + name + "\" of Sample, set to ";
  const std::size_t begin = warnings.find(before);
  if (begin == std::string::npos) return "";
  return warnings.substr(begin + before.size(),
                         warnings.find(',', begin + before.size()) - begin - before.size());
}

TEST(weld, joins_each_point_with_the_nearest_that_stands_for_itself) {
  Random random(7);
  for (int round = 0; round < 60; ++round) {
    std::vector<Vec3> points(1 + random.bits() % 120);
    const double size = round % 3 == 0 ? 1e-9 : round % 3 == 1 ? 1 : 1e12;
    // On a coarse lattice there are ties and points exactly at the tolerance.
    for (Vec3& p : points) {
      const auto coordinate = [&] {
        return size *
               (round % 2 == 0 ? static_cast<double>(random.bits() % 9) - 4 : 8 * at_random(random) - 4);
      };
      p = {coordinate(), coordinate(), coordinate()};
    }
    std::vector<std::int32_t> self(points.size());
    std::iota(self.begin(), self.end(), 0);
    const double tolerance = size * (round % 4 == 0 ? 1 : 0.7);
    const std::vector<std::int32_t> welded = weld(points, self, tolerance);
    std::vector<std::size_t> standing;
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::size_t best = i;
      for (const std::size_t s : standing) {
        const double d = distance(points[s], points[i]);
        if (d <= tolerance && (best == i || d < distance(points[best], points[i]))) best = s;
      }
      ASSERT_EQ(welded[i], static_cast<std::int32_t>(best)) << round << ": " << i;
      if (best == i) standing.push_back(i);
    }
  }
}

TEST(weld, closes_the_cracks_of_a_mesh_with_the_tolerance_that_a_warning_names) {
  const TriangleMesh m = test::small_mesh();
  Random random(3);
  for (const double jitter : {1e-12, 1e-7, 1e-3}) {
    const std::string content = with_cracks(m, jitter, random);
    WeldListener listener;
    const MeshFile open = parse_mesh(content, MeshFormat::stl, {}, listener);
    EXPECT_FALSE(mesh_topology(open.mesh).closed);
    EXPECT_NE(listener.text.find("open at 108 edges"), std::string::npos) << listener.text;
    EXPECT_NE(listener.text.find(", closes them"), std::string::npos) << listener.text;
    ReadOptions options;
    options.weld = parse_tolerance(proposed(listener.text, "weld"));
    EXPECT_LT(options.weld.value, 16 * jitter);
    WeldListener quiet;
    const MeshFile closed = parse_mesh(content, MeshFormat::stl, options, quiet);
    const MeshTopology t = mesh_topology(closed.mesh);
    EXPECT_TRUE(t.closed && t.manifold && t.oriented);
    EXPECT_EQ(closed.mesh.triangles.size(), m.triangles.size());
    EXPECT_EQ(closed.near_vertices, 108 - 20);
    EXPECT_EQ(quiet.text.find("is open"), std::string::npos);
    EXPECT_NE(quiet.text.find("88 vertices are welded to others at most"), std::string::npos) << quiet.text;
  }
  // A share of the longest edge of the bounding box, which is 3 and a bit.
  ReadOptions relative;
  relative.weld = parse_tolerance("0.1%");
  EXPECT_TRUE(mesh_topology(parse_mesh(with_cracks(m, 1e-4, random), MeshFormat::stl, relative).mesh).closed);
}

TEST(weld, is_not_proposed_for_holes_and_closed_meshes) {
  const TriangleMesh m = test::small_mesh();
  const auto warnings = [](const TriangleMesh& mesh) {
    WeldListener listener;
    parse_mesh(test::as_off(mesh), MeshFormat::off, {}, listener);
    return listener.text;
  };
  EXPECT_EQ(warnings(m), "");
  TriangleMesh hole = m;
  hole.triangles = std::vector<Triangle>(m.triangles.begin() + 3, m.triangles.end());
  EXPECT_EQ(warnings(hole), "");
  EXPECT_FALSE(mesh_topology(hole).closed);
  // A crack beside a hole.
  Random random(5);
  WeldListener listener;
  parse_mesh(with_cracks(hole, 1e-6, random), MeshFormat::stl, {}, listener);
  EXPECT_NE(listener.text.find(", closes all but "), std::string::npos) << listener.text;
}

TEST(strays, are_named_and_left_out_when_asked_for) {
  std::string cloud;
  Random random(11);
  for (int i = 0; i < 400; ++i) {
    cloud += test::text(Vec3{700 + at_random(random), 5300 + at_random(random), at_random(random)}) + "\n";
    if (i % 100 == 50) cloud += "0 0 0\n";
  }
  WeldListener listener;
  const MeshFile kept = parse_mesh(cloud, MeshFormat::xyz, {}, listener);
  EXPECT_EQ(kept.points.points.size(), 401u);
  EXPECT_NE(listener.text.find("1 point, (0, 0, 0), is 5347"), std::string::npos) << listener.text;
  EXPECT_EQ(proposed(listener.text, "strays"), "drop") << listener.text;
  ReadOptions options;
  options.strays = StrayPolicy::drop;
  const MeshFile rest = parse_mesh(cloud, MeshFormat::xyz, options);
  EXPECT_EQ(rest.points.points.size(), 400u);
  EXPECT_EQ(rest.stray_vertices, 1);
  EXPECT_GT(bounding_box(rest.points.points).lower.x, 699);
  // As many as a hundredth are few, more are a part of the model.
  for (const int count : {4, 8}) {
    std::vector<Vec3> points(kept.points.points.begin(), kept.points.points.end());
    for (int i = 1; i < count; ++i) points.push_back({-1e6 * i, 0, 0});
    EXPECT_EQ(find_strays(points, {}).points.size(), count == 4 ? 4u : 0u) << count;
  }
}

TEST(strays, of_a_mesh_are_parts_that_hang_on_nothing) {
  TriangleMesh m = test::small_mesh();
  std::vector<Vec3> vertices(m.vertices.begin(), m.vertices.end());
  std::vector<Triangle> triangles(m.triangles.begin(), m.triangles.end());
  const auto far = static_cast<std::int32_t>(vertices.size());
  vertices.push_back({1e5, 0, 0});
  // A spike: one far vertex on three triangles.
  std::vector<Triangle> spike = triangles;
  const Triangle cut = spike.back();
  spike.pop_back();
  for (std::size_t k = 0; k < 3; ++k) spike.push_back({cut[k], cut[(k + 1) % 3], far});
  EXPECT_TRUE(find_strays(vertices, spike).points.empty());
  EXPECT_EQ(find_strays(vertices, {}).points, (std::vector<std::int32_t>{far}));
  // A far tetrahedron beside two hundred copies.
  std::vector<Vec3> many;
  std::vector<Triangle> faces;
  for (int copy = 0; copy < 25; ++copy) {
    for (const Triangle& t : triangles) {
      faces.push_back({t[0] + 20 * copy, t[1] + 20 * copy, t[2] + 20 * copy});
    }
    for (std::size_t v = 0; v < 20; ++v) many.push_back(vertices[v] + Vec3{4.0 * copy, 0, 0});
  }
  for (const Vec3 p : {Vec3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) many.push_back(p + Vec3{0, 1e6, 0});
  for (const Triangle t : {Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    faces.push_back({t[0] + 500, t[1] + 500, t[2] + 500});
  }
  ReadOptions options;
  options.strays = StrayPolicy::drop;
  const MeshFile file = parse_mesh(test::as_off({many, faces}), MeshFormat::off, options);
  EXPECT_EQ(file.stray_vertices, 4);
  EXPECT_EQ(file.mesh.vertices.size(), 500u);
  EXPECT_EQ(file.points.points.size(), 500u);
  EXPECT_EQ(mesh_topology(file.mesh).components, 25);
  EXPECT_TRUE(mesh_topology(file.mesh).closed);
}

TEST(scale, is_a_factor_or_a_unit_that_becomes_metres) {
  EXPECT_EQ(parse_scale("2.5"), 2.5);
  EXPECT_EQ(parse_scale("mm"), 0.001);
  EXPECT_EQ(parse_scale("in"), 0.0254);
  EXPECT_EQ(parse_scale("m"), 1);
  for (const char* wrong : {"", "0", "-1", "inf", "nan", "parsec", "1 mm", "MM"}) {
    EXPECT_THROW(parse_scale(wrong), InputError) << wrong;
  }
  for (const char* wrong : {"", "-1", "nan", "100%", "%", "x", "1 %"})
    EXPECT_THROW(parse_tolerance(wrong), InputError) << wrong;
  EXPECT_EQ(parse_tolerance("0.5%").length(8), 0.04);
  EXPECT_EQ(parse_tolerance("0.5").length(8), 0.5);

  const TriangleMesh m = test::small_mesh();
  ReadOptions options;
  options.scale = 0.25;
  const MeshFile file = parse_mesh(test::as_obj(m, true), MeshFormat::obj, options);
  for (std::size_t v = 0; v < m.vertices.size(); ++v) EXPECT_EQ(file.mesh.vertices[v], 0.25 * m.vertices[v]);
  EXPECT_EQ(file.points.normals.size(), m.vertices.size());
  options.scale = 1e308;
  EXPECT_THROW(parse_mesh(test::as_obj(m), MeshFormat::obj, options), InputError);

  const LoadedBalls balls = load_balls({"balls:1 2 3 4; 0 0 0 1", "mm"});
  EXPECT_EQ(balls.balls.centers, (Array<Vec3>{{0.001, 0.002, 0.003}, {0, 0, 0}}));
  EXPECT_EQ(balls.balls.radii, (Array<double>{0.004, 0.001}));
  EXPECT_THROW(load_balls({"balls:0 0 0 1e308", "km"}), InputError);
}

TEST(weld, scale_and_strays_mend_the_reported_files) {
  const auto path = [](const char* name) { return test::data_file(std::string("reports/") + name); };
  if (path("README.md").empty()) GTEST_SKIP() << "no test data";
  WeldListener cracks;
  EXPECT_FALSE(mesh_topology(read_mesh_file(path("stl/cracks.stl.gz"), {}, cracks).mesh).closed);
  ReadOptions options;
  options.weld = parse_tolerance(proposed(cracks.text, "weld"));
  const MeshTopology torus = mesh_topology(read_mesh_file(path("stl/cracks.stl.gz"), options).mesh);
  EXPECT_TRUE(torus.closed && torus.manifold);
  EXPECT_EQ(torus.genus, 1);
  WeldListener zeros;
  read_mesh_file(path("points/zeros.xyz"), {}, zeros);
  EXPECT_NE(zeros.text.find("1 point, (0, 0, 0), is 5"), std::string::npos) << zeros.text;
  options = {};
  options.strays = StrayPolicy::drop;
  EXPECT_LT(bounding_box(read_mesh_file(path("points/zeros.xyz"), options).points.points).longest_edge(), 3);
  const Box millimetres = bounding_box(read_mesh_file(path("units/link_mm.stl")).points.points);
  options = {};
  options.scale = parse_scale("mm");
  const Box metres = bounding_box(read_mesh_file(path("units/link_mm.stl"), options).points.points);
  EXPECT_DOUBLE_EQ(metres.longest_edge(), 0.001 * millimetres.longest_edge());
}

}  // namespace
}  // namespace ballflow::geometry
