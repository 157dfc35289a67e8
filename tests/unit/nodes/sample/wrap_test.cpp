#include "sample/wrap.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "search/surface_tree.hpp"
#include "shapes.hpp"
#include "topology/solid_topology.hpp"

namespace ballflow::geometry {
namespace {

TEST(wrap, an_open_cube_is_closed_at_the_offset) {
  test::Mesh open = test::cube();
  open.triangles.pop_back();
  // The hole is as wide as the cube, so only a large alpha closes it.
  const TriangleMesh mesh = open.mesh();
  WrapOptions options;
  options.alpha = 50;
  options.offset = 1;
  const TriangleMesh wrapped = wrap(mesh, options);
  const MeshTopology topology = mesh_topology(wrapped);
  EXPECT_TRUE(topology.closed && topology.manifold && topology.oriented);
  EXPECT_EQ(solid_topology(wrapped, no_monitor()).betti, (Betti{1, 0, 0}));
  const SurfaceTree tree(mesh);
  double nearest = 1e300;
  for (const Vec3& v : wrapped.vertices) {
    nearest = std::min(nearest, tree.nearest(v, std::numeric_limits<double>::infinity())->distance);
  }
  EXPECT_NEAR(nearest, 0.02, 1e-3);  // 1 % of an edge of 2
}

TEST(wrap, a_sheet_becomes_a_shell_around_it) {
  const TriangleMesh sheet{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const TriangleMesh wrapped = wrap(sheet, {});
  EXPECT_EQ(solid_topology(wrapped, no_monitor()).betti, (Betti{1, 0, 0}));
  const Box box = bounding_box(wrapped.vertices.span());
  EXPECT_NEAR(box.upper.z - box.lower.z, 0.004, 1e-4);  // twice the offset
}

TEST(wrap, what_cannot_be_wrapped_is_refused) {
  EXPECT_THROW(wrap({}, {}), InputError);
  EXPECT_THROW(wrap({{{1, 2, 3}}, {{0, 0, 0}}}, {}), InputError);
  const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(wrap(triangle, {0, 1}), InputError);
  EXPECT_THROW(wrap(triangle, {1, 99}), InputError);
}

}  // namespace
}  // namespace ballflow::geometry
