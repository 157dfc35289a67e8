#include "enclose/one_sided_balls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "enclose/grow_over.hpp"
#include "enclose/union_voids.hpp"
#include "power/power_diagram.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

void check(const TriangleMesh& mesh, const Balls& balls) {
  if (const std::string broken = broken_invariant(mesh); !broken.empty())
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  if (const std::string broken = broken_invariant(balls); !broken.empty())
    throw InputError(broken, "repair or remove the ball");
  if (mesh.triangles.empty())
    throw InputError("there are no triangles, so there is no solid for balls to be inside of, or around",
                     "give a mesh; clouds of points become one by graphs/reconstruct.json");
  if (balls.size() == 0) throw InputError("there are no balls", "give one at least");
}

/// Where a centre is.
struct Standing {
  double distance = 0;  // from the surface
  bool inside = false;  // of a closed mesh
};

class Solid {
 public:
  Solid(const TriangleMesh& mesh, const Balls& balls, Monitor& monitor)
      : winding_(mesh, monitor), surface_(mesh, monitor) {
    const Box box = bounding_box(mesh.vertices.span()), of_balls = bounding_box(balls);
    edge_ = box.longest_edge();
    double largest = 0;
    for (const Vec3 p : {box.lower, box.upper, of_balls.lower, of_balls.upper})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    rounding_ = 1e-9 * edge_ + 0x1p-40 * largest;
  }

  const WindingNumber& winding() const { return winding_; }
  bool closed() const { return winding_.chain().closed(); }
  double edge() const { return edge_; }
  double rounding() const { return rounding_; }

  Standing of(Vec3 p) const {
    const auto nearest = surface_.nearest(p, std::numeric_limits<double>::infinity());
    const WindingNumber::Value value = closed() ? winding_.around(p) : WindingNumber::Value{};
    return {nearest ? nearest->distance : 0, value.number != 0 && !value.on_surface};
  }
  std::vector<Standing> of(std::span<const Vec3> points, Monitor& monitor, double begin, double end) const {
    std::vector<Standing> result(points.size());
    for_each_block(points.size(), 64, monitor, begin, end,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     for (std::size_t i = first; i < last; ++i) result[i] = of(points[i]);
                   });
    return result;
  }

 private:
  WindingNumber winding_;
  SurfaceTree surface_;
  double edge_ = 0, rounding_ = 0;
};

Balls inner_side(const TriangleMesh& mesh, const Balls& balls, const Solid& solid, Monitor& monitor) {
  if (!solid.closed())
    throw InputError("nothing is inside: " + why_not_closed(solid.winding().chain(), mesh),
                     "close the mesh, or wrap it (sampling=wrap); the outer side takes it as it is");
  const std::vector<Standing> standing = solid.of(balls.centers.span(), monitor, 0.2, 1);
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double r = standing[i].distance - solid.rounding();
    if (!standing[i].inside || !(r > 0)) continue;
    centers.push_back(balls.centers[i]);
    radii.push_back(r);
  }
  if (radii.empty())
    throw InputError("the centre of no ball is inside the surface",
                     "give balls of the same model, in the same frame and unit");
  return {std::move(centers), std::move(radii), {}, {}};
}

/// Fills voids that matter with balls that touch the surface.
void fill_voids(const Solid& solid, std::vector<Vec3>& centers, std::vector<double>& radii,
                Monitor& monitor) {
  constexpr int most_rounds = 64;
  for (int round = 0;; ++round) {
    const Balls balls{centers, radii, {}, {}};
    std::vector<UnionVoid> voids = union_voids(power_diagram(balls, {}, monitor), solid.winding(), monitor);
    std::erase_if(voids, [](const UnionVoid& v) { return !v.matters(); });
    if (voids.empty()) return;
    if (round == most_rounds)
      throw InputError(std::to_string(voids.size()) + " voids inside are not filled by 64 balls each",
                       "let balls grow less before (epsilon), so that more of them are left");
    for (const UnionVoid& v : voids) {
      centers.push_back(v.deepest);
      radii.push_back(solid.of(v.deepest).distance + solid.rounding());
    }
  }
}

Balls outer_side(const TriangleMesh& mesh, const Balls& balls, const Solid& solid, Monitor& monitor) {
  const std::vector<Standing> standing = solid.of(balls.centers.span(), monitor, 0.1, 0.3);
  std::vector<Vec3> centers(balls.centers.begin(), balls.centers.end());
  std::vector<double> radii(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const double d = standing[i].distance;
    radii[i] = !solid.closed() ? std::min(d, balls.radii[i]) : standing[i].inside ? d : 0;
  }
  PartMonitor growing(monitor, 0.3, 0.8), filling(monitor, 0.8, 1);
  const double tolerance = 2e-4 * solid.edge();
  grow_over(mesh, centers, radii, std::max(tolerance, solid.rounding()), growing);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    if (radii[i] == 0) continue;  // around a centre outside, and not asked for
    centers[kept] = centers[i];
    radii[kept++] = radii[i] + solid.rounding();
  }
  centers.resize(kept);
  radii.resize(kept);
  fill_voids(solid, centers, radii, filling);
  return {std::move(centers), std::move(radii), {}, {}};
}

}  // namespace

Balls one_sided_balls(const TriangleMesh& mesh, const Balls& balls, const OneSidedBallsOptions& options,
                      Monitor& monitor, const TriangleMesh* closed) {
  check(mesh, balls);
  if (closed != nullptr) check(*closed, balls);
  PartMonitor reading(monitor, 0, 0.1);
  const TriangleMesh& around = closed != nullptr ? *closed : mesh;
  const Solid solid(around, balls, reading);
  Balls result = options.side == BallSide::inner ? inner_side(around, balls, solid, monitor)
                                                 : outer_side(mesh, balls, solid, monitor);
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
