#include "mesh/ball_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "mesh/boundary_gap.hpp"
#include "mesh/exact_mesh.hpp"
#include "mesh/grid_mesh.hpp"
#include "mesh/near_splits.hpp"
#include "mesh/simplified_mesh.hpp"
#include "mesh/skin_mesh.hpp"
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

// Corners of a grid, 8 bytes each.
constexpr std::size_t most_corners = std::size_t{1} << 25;

/// Every radius grown by its own part of `most`, which is negative to shrink them.
Balls grown(const Balls& balls, double most) {
  std::vector<double> radii;
  radii.reserve(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i)
    radii.push_back(std::max(0.0, balls.radii[i] + most * Random(i).unit()));
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
    if (options_.method == BallMeshMethod::skin) {
      skin();
    } else if (options_.method != BallMeshMethod::exact || !exact()) {
      grid();
    }
    if (options_.keep_faces < 100) simplify();
    if (options_.self_intersections) count_self_intersections();
    return std::move(result_);
  }

 private:
  /// A union, and what is known about it.
  struct Looked {
    Balls balls;
    double growth = 0;
    PowerDiagram diagram;
    SimplicialComplex complex;
  };

  Looked look_at(double growth, Monitor& monitor) const {
    Looked looked{growth != 0 ? grown(balls_, growth) : balls_, growth, {}, {}};
    looked.diagram = power_diagram(looked.balls, {}, monitor);
    looked.complex = alpha_shape(looked.diagram, monitor);
    return looked;
  }

  bool exact() {
    PartMonitor first(monitor_, 0, 0.5), others(monitor_, 0.5, 0.6);
    const Looked given = look_at(0, first);
    result_.report.euler_given = given.complex.euler_characteristic();
    if (made_from(given, first)) return true;
    // Growth joins balls that touch, as they are in the complex. But it joins others too where balls were
    // grown before until they all but touch; there radii that shrink keep the topology.
    std::vector<double> growths;
    for (const int bits : {30, 20}) {
      const double growth = std::ldexp(extent_, -bits);
      growths.push_back(growth);
      for (const double g : {growth, -growth}) {
        const Looked looked = look_at(g, others);
        if (looked.complex.betti == given.complex.betti && made_from(looked, others)) return true;
      }
    }
    return std::any_of(growths.begin(), growths.end(),
                       [&](double growth) { return made_from(look_at(growth, others), others); });
  }

  bool made_from(const Looked& looked, Monitor& monitor) {
    MeshReport& report = result_.report;
    if (!(report.error_asked > 2 * std::abs(looked.growth))) return false;
    std::optional<ExactMesh> mesh =
        exact_mesh(looked.diagram, looked.complex, 0.98 * report.error_asked - std::abs(looked.growth),
                   extent_, options_.most_faces, monitor);
    if (!mesh) return false;
    result_.mesh = std::move(mesh->mesh);
    report.made_by = static_cast<std::uint8_t>(looked.growth != 0 ? MeshedBy::exact_grown : MeshedBy::exact);
    report.error = mesh->error + std::abs(looked.growth);
    report.growth = looked.growth;
    report.rounds = mesh->rounds;
    report.set_union(looked.complex.betti);
    describe();
    return report.right_topology();
  }

  /// Refines a grid until the mesh is near enough and has the topology of the union, or memory ends it.
  void grid() {
    PartMonitor counting(monitor_, 0.6, 0.65), meshing(monitor_, 0.65, 1);
    MeshReport& report = result_.report;
    const Looked given = look_at(0, counting);
    report.euler_given = given.complex.euler_characteristic();
    report.set_union(given.complex.betti);
    report.made_by = static_cast<std::uint8_t>(MeshedBy::grid);
    report.growth = 0;
    // Thin parts want smaller cells, but in the bottom of sharp notches there are bubbles at every size: two
    // rounds without progress are enough.
    std::optional<BallMesh> best;
    std::int32_t best_split = 0;
    double cell = 2.5 * report.error_asked;
    for (std::int64_t round = 0, in_vain = 0; in_vain < 2; ++round) {
      std::optional<GridMesh> mesh =
          grid_mesh(balls_, cell, most_corners, static_cast<std::size_t>(options_.most_faces), meshing);
      if (!mesh && best) break;
      if (!mesh) {
        // Coarser, so that there is a mesh at all; the report says how far off it is.
        cell *= 1.5;
        if (cell > extent_) throw too_many_faces(options_.most_faces);
        continue;
      }
      result_.mesh = std::move(mesh->mesh);
      first_split_ = mesh->first_split;
      // Between the places that were looked at it may be a little larger.
      report.error = 1.05 * mesh->error;
      report.cell = cell;
      report.rounds = round;
      report.error_back = -1;
      describe();
      if (options_.refine_notches && !(report.error > report.error_asked)) measure_back(given);
      if (what_differs(report).empty()) break;
      if (best && !better(report, best->report)) {
        ++in_vain;
      } else {
        in_vain = 0;
        best = result_;
        best_split = first_split_;
      }
      const double off = std::max(report.error, report.error_back);
      cell *= off > report.error_asked ? std::clamp(0.9 * report.error_asked / off, 0.5, 0.8) : 0.7;
    }
    if (best && !what_differs(report).empty()) {
      result_ = *std::move(best);
      first_split_ = best_split;
    }
    if (report.error_back < 0) measure_back(given);
  }

  void skin() {
    MeshReport& report = result_.report;
    PartMonitor counting(monitor_, 0, 0.1), meshing(monitor_, 0.1, 0.9);
    const Looked given = look_at(0, counting);
    report.euler_given = given.complex.euler_characteristic();
    report.growth = std::ldexp(extent_, -30);
    const Balls generic = grown(balls_, report.growth);
    std::vector<double> radii;
    radii.reserve(generic.size());
    for (const double r : generic.radii) radii.push_back(r / std::sqrt(options_.shrink));
    report.set_union(
        alpha_shape(power_diagram({generic.centers, std::move(radii), {}, {}}, {}, counting), counting)
            .betti);
    report.made_by = static_cast<std::uint8_t>(MeshedBy::skin);
    result_.mesh =
        skin_mesh(generic, options_.shrink, static_cast<std::size_t>(options_.most_faces), meshing);
    describe();
    // Triangles are as large as cells of the complex: between the places it was a tenth more.
    report.error = 1.2 * mesh_gap(balls_, result_.mesh, monitor_) + report.growth;
    measure_back(given);
  }
  void simplify() {
    MeshReport& report = result_.report;
    report.faces_before = report.faces;
    const auto wanted =
        static_cast<std::size_t>(std::ceil(options_.keep_faces / 100 * static_cast<double>(report.faces)));
    PartMonitor collapsing(monitor_, 0.6, 0.9);
    result_.mesh = simplified_mesh(result_.mesh, wanted, collapsing);
    describe();
    const bool skin = options_.method == BallMeshMethod::skin;
    const Looked given = look_at(skin ? 0 : report.growth, monitor_);
    report.error = 1.05 * mesh_gap(balls_, result_.mesh, monitor_);
    measure_back(given);
  }
  void measure_back(const Looked& given) {
    MeshReport& report = result_.report;
    if (result_.mesh.triangles.empty()) return;  // all that there is lies between the corners of the grid
    report.error_back = boundary_gap(balls_, given.diagram, given.complex, result_.mesh, report.error_asked,
                                     report.error, monitor_);
  }
  /// Whether a is nearer to what was asked for: first the distance, then the topology.
  static bool better(const MeshReport& a, const MeshReport& b) {
    const auto off = [](const MeshReport& r) {
      return std::abs(r.euler - 2 * r.euler_meshed) + 2 * std::abs(r.components - r.surfaces);
    };
    const double there = std::max(a.error, a.error_back), other = std::max(b.error, b.error_back);
    if (there > a.error_asked || other > b.error_asked) return there < other;
    return off(a) < off(b);
  }

  void count_self_intersections() {
    const bool grid =
        result_.report.cell > 0 && options_.keep_faces == 100 && !result_.mesh.triangles.empty();
    const SelfIntersections found =
        self_intersections(grid ? near_splits(result_.mesh, first_split_, result_.report.cell) : result_.mesh,
                           static_cast<std::size_t>(-1), monitor_);
    result_.report.self_intersections = static_cast<std::int64_t>(found.pairs.size());
  }

  void describe() {
    MeshReport& report = result_.report;
    const MeshTopology topology = mesh_topology(result_.mesh, monitor_);
    report.vertices = topology.vertices;
    report.faces = topology.faces;
    report.components = topology.components;
    report.closed = topology.closed ? 1 : 0;
    report.manifold = topology.manifold ? 1 : 0;
    report.oriented = topology.oriented ? 1 : 0;
    report.euler = topology.vertices - topology.faces / 2;
  }

  const Balls balls_;
  const BallMeshOptions& options_;
  Monitor& monitor_;
  double extent_ = 0;
  BallMesh result_;
  std::int32_t first_split_ = 0;  // of a grid
};

}  // namespace

BallMesh ball_mesh(const Balls& balls, const BallMeshOptions& options, Monitor& monitor) {
  if (const std::string broken = broken_invariant(balls); !broken.empty())
    throw InputError(broken, "repair or remove the ball");
  if (!(options.error > 0 && options.error <= 100))
    throw InputError("the error is not above 0 and at most 100 %", "0.2 is a good start");
  if (!(options.keep_faces > 0 && options.keep_faces <= 100))
    throw InputError("the share of triangles to keep is not above 0 and at most 100 %", "100 keeps all");
  if (!(options.shrink >= 0.05 && options.shrink <= 0.95))
    throw InputError("shrink is not from 0.05 to 0.95",
                     "0.5 is a good start; method exact is what 1 would be");
  return Mesher(balls, options, monitor).run();
}

}  // namespace ballflow::geometry
