#include "mesh/ball_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "mesh/exact_mesh.hpp"
#include "power/alpha_shape.hpp"
#include "power/power_diagram.hpp"
#include "power/union_vertices.hpp"
#include "search/self_intersection.hpp"

namespace ballflow::geometry {
namespace {

/// Balls in an order that depends on nothing but them, and on their mirror images in the same way.
Balls in_order(const Balls& balls) {
  std::vector<std::size_t> ids(balls.size());
  std::iota(ids.begin(), ids.end(), std::size_t{0});
  std::sort(ids.begin(), ids.end(), [&](std::size_t a, std::size_t b) {
    const Vec3 p = balls.centers[a], q = balls.centers[b];
    return p != q ? before(p, q) : balls.radii[a] < balls.radii[b];
  });
  std::vector<Vec3> centers;
  std::vector<double> radii;
  centers.reserve(ids.size());
  radii.reserve(ids.size());
  for (const std::size_t i : ids) {
    centers.push_back(balls.centers[i]);
    radii.push_back(balls.radii[i]);
  }
  return {std::move(centers), std::move(radii), {}, {}};
}

/// Every radius grown by its own part of `most`.
Balls grown(const Balls& balls, double most) {
  std::vector<double> radii;
  radii.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) radii.push_back(balls.radii[i] + most * Random(i).unit());
  return {balls.centers, std::move(radii), {}, {}};
}

class Mesher {
 public:
  Mesher(const Balls& balls, const BallMeshOptions& options, Monitor& monitor)
      : balls_(in_order(balls)), options_(options), monitor_(monitor) {
    extent_ = bounding_box(balls_).longest_edge();
    result_.report.error_asked = options.error / 100 * extent_;
  }

  BallMesh run() {
    if (balls_.size() == 0) {
      describe();
      return std::move(result_);
    }
    if (!(extent_ > 0))
      throw InputError("the union of the balls is a single point, which has no surface",
                       "give the ball a radius, or leave it out");
    if (!made()) throw InputError("not made", "");
    describe();
    if (options_.self_intersections) {
      result_.report.self_intersections = static_cast<std::int64_t>(
          self_intersections(result_.mesh, static_cast<std::size_t>(-1), monitor_).pairs.size());
    }
    return std::move(result_);
  }

 private:
  bool made() {
    if (attempt(0, 0, 0.4)) return true;
    for (const int bits : {30, 25, 20}) {
      if (attempt(std::ldexp(extent_, -bits), 0.4, 0.6)) return true;
    }
    return false;
  }

  /// Meshes the balls, each grown by at most `growth`.
  bool attempt(double growth, double begin, double end) {
    PartMonitor part(monitor_, begin, end);
    PartMonitor looking(part, 0, 0.4), meshing(part, 0.4, 1);
    const Balls balls = growth > 0 ? grown(balls_, growth) : balls_;
    const PowerDiagram diagram = power_diagram(balls, {}, looking);
    const SimplicialComplex complex = alpha_shape(diagram, looking);
    MeshReport& report = result_.report;
    report.euler_meshed = complex.euler_characteristic();
    if (growth == 0) report.euler_given = report.euler_meshed;
    // A mesh of f triangles has half as many vertices.
    std::optional<ExactMesh> mesh = exact_mesh(diagram, complex, report.error_asked, extent_,
                                               static_cast<std::size_t>(options_.most_faces) / 2, meshing);
    if (!mesh) return false;
    result_.mesh = std::move(mesh->mesh);
    report.made_by = static_cast<std::uint8_t>(growth > 0 ? MeshedBy::exact_grown : MeshedBy::exact);
    report.error = mesh->error;
    report.growth = growth;
    report.rounds = mesh->rounds;
    describe();
    return report.right_topology();
  }

  void describe() {
    MeshReport& report = result_.report;
    const MeshTopology topology = mesh_topology(result_.mesh);
    report.vertices = topology.vertices;
    report.faces = topology.faces;
    report.components = topology.components;
    report.closed = topology.closed ? 1 : 0;
    report.manifold = topology.manifold ? 1 : 0;
    report.oriented = topology.oriented ? 1 : 0;
    report.euler = topology.closed ? topology.vertices - topology.faces / 2 : 0;
  }

  const Balls balls_;
  const BallMeshOptions& options_;
  Monitor& monitor_;
  double extent_ = 0;
  BallMesh result_;
};

}  // namespace

BallMesh ball_mesh(const Balls& balls, const BallMeshOptions& options, Monitor& monitor) {
  if (const std::string broken = broken_invariant(balls); !broken.empty())
    throw InputError(broken, "repair or remove the ball");
  if (!(options.error > 0 && options.error <= 100))
    throw InputError("the error is not above 0 and at most 100 %", "0.2 is a good start");
  return Mesher(balls, options, monitor).run();
}

}  // namespace ballflow::geometry
