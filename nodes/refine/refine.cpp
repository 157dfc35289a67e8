#include "refine/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "power/union_betti.hpp"
#include "refine/foreign_simplices.hpp"
#include "refine/inner_cells.hpp"
#include "refine/mirror_images.hpp"
#include "refine/narrow_ends.hpp"
#include "refine/refined_triangulation.hpp"
#include "refine/start_points.hpp"
#include "search/shells.hpp"

namespace ballflow::geometry {
namespace {

using Cell = RefinedTriangulation::Cell;
using Vertex = RefinedTriangulation::Vertex;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

/// The options in model units.
struct Lengths {
  double delta, floor, lowest, wall_fraction;
};

/// A sample of no inner ball may be so far from all of them, as a share of delta.
constexpr double end_share = 0.7;

class Refinery {
 public:
  Refinery(const TriangleMesh& mesh, const WindingNumber& winding, const RefineOptions& options,
           Monitor& monitor)
      : box_(bounding_box(mesh.vertices.span())),
        surface_(mesh, monitor),
        lengths_{options.delta / 100 * box_.longest_edge(), options.floor / 100 * box_.longest_edge(),
                 options.lowest_floor / 100 * box_.longest_edge(), options.wall_fraction},
        max_samples_(static_cast<std::size_t>(options.max_samples)),
        monitor_(monitor),
        triangulation_(surface_, winding, box_, lengths_.delta / lengths_.wall_fraction) {}

  void start(const TriangleMesh& mesh, const PointSet& kept, const RefineOptions& options) {
    // The points are on the surface, or so near that it does not matter which triangle is theirs.
    for (const Vec3& p : kept.points) {
      const auto near = surface_.nearest(p, std::numeric_limits<double>::infinity());
      insert({p, near ? near->triangle : -1, 0}, lengths_.floor, Cell());
    }
    StartPointsOptions start;
    start.sharp = options.sharp;
    start.thinning = options.delta / 100;
    for (const SurfacePoint& p : start_points(mesh, start)) insert(p, lengths_.floor, Cell());
    triangulation_.evaluate(monitor_);
  }

  /// Step 2, of all cells.
  void refine_balls();
  /// Step 3, and what comes out of it.
  InnerCells refine_cells(const std::optional<Betti>& wanted);
  /// Step 4: samples ends that are far from all inner balls; false where there are none.
  bool reach_narrow_ends(const InnerCells& cells);
  /// Step 5: inserts points where balls meet that should not; false where there are none.
  bool separate_balls();

  std::array<std::int64_t, 3> betti_of_balls() {
    return union_betti(inner_balls().balls, AlphaTolerance::polar, monitor_);
  }
  bool full() const { return triangulation_.samples() >= max_samples_; }
  Refined result(const InnerCells& cells);

 private:
  struct Proposal {
    Cell cell;
    std::array<Vertex, 4> corners;  // the cell may be gone, and its handle another cell's
    std::vector<SurfacePoint> points;
  };
  struct InnerBalls {
    Balls balls;
    std::vector<Cell> cells;
    std::vector<std::array<Vec3, 4>> samples;
  };

  bool insert(const SurfacePoint& point, double floor, Cell hint) {
    return !full() && triangulation_.insert(point, floor, hint);
  }
  Proposal propose(Cell cell) const;
  bool needs_points(const RefinedCell& cell, double floor) const {
    return cell.depth > lengths_.delta ||
           (cell.depth > lengths_.wall_fraction * cell.gap && cell.depth > floor);
  }
  bool is_limited(const RefinedCell& cell, double floor) const {
    return cell.depth <= lengths_.delta && cell.depth > lengths_.wall_fraction * cell.gap &&
           cell.depth <= floor && cell.depth > lengths_.lowest;
  }
  /// Inserts the points of proposals whose cells are still there, in their order; the cells that are new.
  std::vector<Cell> insert_all(std::vector<Proposal>& proposals);
  /// Lowers the floor at samples and adds crossings of dual edges around them.
  void refine_at(const std::vector<std::int32_t>& samples, const InnerCells& cells);
  std::vector<std::int32_t> samples_of_limited_cells();
  InnerBalls inner_balls();

  Box box_;
  SurfaceTree surface_;
  Lengths lengths_;
  std::size_t max_samples_;
  Monitor& monitor_;
  RefinedTriangulation triangulation_;
  std::int64_t rounds_ = 0;
};

Refinery::Proposal Refinery::propose(Cell cell) const {
  Proposal proposal{cell, {}, {}};
  for (int k = 0; k < 4; ++k) proposal.corners[static_cast<std::size_t>(k)] = cell->vertex(k);
  const RefinedCell& info = cell->info();
  if (info.depth <= lengths_.delta) proposal.points = mirror_images(triangulation_, cell, lengths_.lowest);
  if (proposal.points.empty()) proposal.points.push_back({info.nearest, info.triangle, 0});
  return proposal;
}

std::vector<Cell> Refinery::insert_all(std::vector<Proposal>& proposals) {
  Lookout look(monitor_);
  for (const Proposal& proposal : proposals) {
    look(4096);
    Cell cell;
    const auto& [a, b, c, d] = proposal.corners;
    if (!triangulation_.delaunay().is_cell(a, b, c, d, cell)) continue;
    const double floor = RefinedTriangulation::floor_of(cell);
    for (const SurfacePoint& point : proposal.points) {
      insert(point, floor, cell);
      cell = Cell();
    }
  }
  ++rounds_;
  monitor_.note("round " + std::to_string(rounds_) + ": " + std::to_string(triangulation_.samples()) +
                " samples");
  return triangulation_.evaluate(monitor_);
}

void Refinery::refine_balls() {
  // A cell that needs points does not survive them, so later rounds look at new cells only.
  const auto all = triangulation_.delaunay().finite_cell_handles();
  std::vector<Cell> deep(all.begin(), all.end());
  while (!full()) {
    std::erase_if(deep, [&](const Cell& cell) {
      return !needs_points(cell->info(), RefinedTriangulation::floor_of(cell));
    });
    if (deep.empty()) return;
    const auto corners = [](const Cell& cell) {
      std::array<std::int32_t, 4> numbers;
      for (int k = 0; k < 4; ++k) numbers[static_cast<std::size_t>(k)] = cell->vertex(k)->info().number;
      std::sort(numbers.begin(), numbers.end());
      return numbers;
    };
    std::sort(deep.begin(), deep.end(), [&](const Cell& a, const Cell& b) {
      const RefinedCell &u = a->info(), &v = b->info();
      if (u.depth != v.depth) return u.depth > v.depth;
      if (u.center != v.center) return u.center < v.center;
      return corners(a) < corners(b);
    });
    std::vector<Proposal> proposals(deep.size());
    for_each_block(deep.size(), 64, monitor_, 0, 0, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) proposals[i] = propose(deep[i]);
    });
    deep = insert_all(proposals);
  }
}

void Refinery::refine_at(const std::vector<std::int32_t>& samples, const InnerCells& cells) {
  std::vector<std::uint8_t> wanted(triangulation_.samples(), 0);
  for (const std::int32_t s : samples) {
    wanted[at(s)] = 1;
    double& floor = triangulation_.vertices()[at(s)]->info().floor;
    floor = std::max(floor / 3, lengths_.lowest);
  }
  // Per sample the crossing farthest from it, of all dual edges of its facets.
  std::vector<SurfacePoint> farthest(triangulation_.samples(), SurfacePoint{{}, -1, 0});
  Lookout look(monitor_);
  for (const BoundaryFacet& facet : cells.boundary) {
    const auto bad = [&](std::int32_t s) { return wanted[at(s)] == 1; };
    if (std::none_of(facet.samples.begin(), facet.samples.end(), bad)) continue;
    if (triangulation_.delaunay().is_infinite(facet.outer)) continue;
    look(1024);
    const Vec3 from = facet.inner->info().center, along = facet.outer->info().center - from;
    for (const SurfacePoint& hit : surface_.hits(from, along, 0, 1)) {
      for (const std::int32_t s : facet.samples) {
        if (!bad(s)) continue;
        const double reach = distance(hit.point, position(triangulation_.vertices()[at(s)]));
        if (reach < lengths_.lowest || reach <= farthest[at(s)].distance) continue;
        farthest[at(s)] = {hit.point, hit.triangle, reach};
      }
    }
  }
  for (const std::int32_t s : samples) {
    if (farthest[at(s)].triangle < 0) continue;
    const Vertex vertex = triangulation_.vertices()[at(s)];
    insert(farthest[at(s)], vertex->info().floor, vertex->cell());
  }
  ++rounds_;
  triangulation_.evaluate(monitor_);
}

std::vector<std::int32_t> Refinery::samples_of_limited_cells() {
  std::vector<std::int32_t> samples;
  for (Cell cell : triangulation_.delaunay().finite_cell_handles()) {
    if (!is_limited(cell->info(), RefinedTriangulation::floor_of(cell))) continue;
    for (int k = 0; k < 4; ++k) {
      const std::int32_t number = cell->vertex(k)->info().number;
      if (number >= 0) samples.push_back(number);
    }
  }
  return samples;
}

InnerCells Refinery::refine_cells(const std::optional<Betti>& wanted) {
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  int since = 0;  // rounds that did not lower the number of bad samples
  // Where the surface crosses itself the boundary stays bad at every scale.
  constexpr int most_of_unknown = 3;
  for (int round = 0;; ++round) {
    InnerCells cells = inner_cells(triangulation_);
    std::vector<std::int32_t> bad = cells.bad;
    if (bad.empty()) {
      if (!wanted || cells.betti == wanted) return cells;
      bad = samples_of_limited_cells();
      bad.insert(bad.end(), cells.off_boundary.begin(), cells.off_boundary.end());
      std::sort(bad.begin(), bad.end());
      bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
    }
    if (bad.size() < fewest) {
      fewest = bad.size();
      since = 0;
    } else {
      ++since;
    }
    if (bad.empty() || since == 3 || full() || (!wanted && round == most_of_unknown)) return cells;
    refine_at(bad, cells);
    refine_balls();
  }
}

Refinery::InnerBalls Refinery::inner_balls() {
  InnerBalls result;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (Cell cell : triangulation_.delaunay().finite_cell_handles()) {
    const RefinedCell& info = cell->info();
    if (info.side != Side::inner) continue;
    centers.push_back(info.center);
    radii.push_back(info.radius);
    result.cells.push_back(cell);
    auto& samples = result.samples.emplace_back();
    for (int k = 0; k < 4; ++k) samples[static_cast<std::size_t>(k)] = position(cell->vertex(k));
  }
  result.balls.centers = std::move(centers);
  result.balls.radii = std::move(radii);
  return result;
}

bool Refinery::reach_narrow_ends(const InnerCells& cells) {
  if (cells.uncovered.empty() || full()) return false;
  const Balls balls = inner_balls().balls;
  std::vector<SurfacePoint> rings;
  for (const std::int32_t s : cells.uncovered)
    add_rings(position(triangulation_.vertices()[at(s)]), balls, end_share * lengths_.delta, lengths_.lowest,
              surface_, rings);
  if (rings.empty()) return false;
  bool inserted = false;
  for (const SurfacePoint& point : rings) inserted = insert(point, lengths_.lowest, Cell()) || inserted;
  ++rounds_;
  triangulation_.evaluate(monitor_);
  return inserted;
}

bool Refinery::separate_balls() {
  const InnerBalls inner = inner_balls();
  std::vector<Cell> meeting;
  for (const std::int32_t ball : foreign_balls(inner.balls, inner.samples, monitor_)) {
    if (inner.cells[at(ball)]->info().depth > lengths_.lowest) meeting.push_back(inner.cells[at(ball)]);
  }
  std::stable_sort(meeting.begin(), meeting.end(),
                   [](const Cell& a, const Cell& b) { return a->info().depth > b->info().depth; });
  std::vector<Proposal> proposals;
  for (const Cell& cell : meeting) {
    const RefinedCell& info = cell->info();
    proposals.push_back({cell,
                         {cell->vertex(0), cell->vertex(1), cell->vertex(2), cell->vertex(3)},
                         {{info.nearest, info.triangle, 0}}});
  }
  return !insert_all(proposals).empty();
}

Refined Refinery::result(const InnerCells& cells) {
  Refined result;
  std::vector<Vec3> points;
  points.reserve(triangulation_.samples());
  for (const Vertex& vertex : triangulation_.vertices()) points.push_back(position(vertex));
  std::vector<Triangle> triangles;
  for (const BoundaryFacet& facet : cells.boundary) {
    Triangle triangle = facet.samples;  // the handles of cells, and so the order, are those of no run
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    triangles.push_back(triangle);
  }
  std::sort(triangles.begin(), triangles.end());
  result.surface = {points, std::move(triangles)};
  result.points.points = std::move(points);
  Refinement& report = result.report;
  report.refined = 1;
  report.complete = full() ? 0 : 1;
  report.samples = static_cast<std::int64_t>(triangulation_.samples());
  report.rounds = rounds_;
  std::vector<std::pair<Vec3, double>> limited;
  for (Cell cell : triangulation_.delaunay().finite_cell_handles()) {
    const RefinedCell& info = cell->info();
    if (is_limited(info, RefinedTriangulation::floor_of(cell))) limited.emplace_back(info.nearest, info.gap);
  }
  std::sort(limited.begin(), limited.end(), [](const auto& a, const auto& b) {
    return std::tie(a.second, a.first) < std::tie(b.second, b.first);
  });
  std::vector<Vec3> places;
  std::vector<double> widths;
  for (const auto& [place, width] : limited) {
    places.push_back(place);
    widths.push_back(width);
  }
  report.limited = std::move(places);
  report.widths = std::move(widths);
  report.uncovered = cells.uncovered;
  if (cells.betti) report.cells = *cells.betti;
  return result;
}

/// Without shells that have the inside on both sides. Of a surface with edges of four and more triangles
/// nobody knows which triangles belong together: it is taken as it is.
TriangleMesh boundary_of_solid(const TriangleMesh& mesh, const SurfaceChain& chain, Monitor& monitor) {
  if (chain.nonmanifold_edges > 0 || chain.triangles.size() != mesh.triangles.size()) return mesh;
  const Shells shells = shells_of({mesh.vertices, chain.triangles}, monitor);
  std::vector<Triangle> triangles;
  for (std::size_t t = 0; t < chain.triangles.size(); ++t) {
    if (shells.shells[at(shells.shell[t])].bounds) triangles.push_back(chain.triangles[t]);
  }
  return {mesh.vertices, std::move(triangles)};
}

/// % of the box: the lowest floor of the first try.
constexpr double first_lowest_floor = 0.0005;

/// Steps 1 to 5 with one lowest floor, step 4 at most `most_ends` times; `ends` becomes true where it did
/// anything.
Refined refine_once(const TriangleMesh& boundary, const WindingNumber& winding, const PointSet& points,
                    const std::optional<Betti>& wanted, const RefineOptions& options, int most_ends,
                    bool& ends, Monitor& monitor) {
  Refinery refinery(boundary, winding, options, monitor);
  refinery.start(boundary, options.keep_points ? points : PointSet{}, options);
  refinery.refine_balls();
  InnerCells cells = refinery.refine_cells(wanted);
  if (!wanted) most_ends = 0;
  for (int i = 0; i < most_ends && refinery.reach_narrow_ends(cells); ++i) {
    ends = true;
    refinery.refine_balls();
    cells = refinery.refine_cells(wanted);
  }
  std::array<std::int64_t, 3> balls = refinery.betti_of_balls();
  constexpr int most_separations = 4;
  for (int i = 0; i < most_separations; ++i) {
    const std::optional<Betti> aim = wanted ? wanted : cells.betti;
    if (!aim || balls == *aim || refinery.full() || !refinery.separate_balls()) break;
    refinery.refine_balls();
    cells = refinery.refine_cells(wanted);
    balls = refinery.betti_of_balls();
  }
  Refined result = refinery.result(cells);
  if (wanted) result.report.wanted = *wanted;
  result.report.balls = balls;
  return result;
}

void check(const RefineOptions& options) {
  const auto require = [](bool right, const char* name, double value, const char* range) {
    if (!right) throw InputError(std::string(name) + " is " + std::to_string(value), range);
  };
  require(options.delta > 0 && options.delta <= 10, "delta", options.delta,
          "use more than 0 and at most 10 %");
  require(options.floor > 0 && options.floor <= 10, "floor", options.floor,
          "use more than 0 and at most 10 %");
  require(options.lowest_floor >= 1e-5 && options.lowest_floor <= 10, "lowest_floor", options.lowest_floor,
          "use from 0.00001 to 10 %");
  require(options.wall_fraction >= 0.05 && options.wall_fraction <= 0.5, "wall_fraction",
          options.wall_fraction, "use from 0.05 to 0.5");
  require(options.sharp >= 1 && options.sharp <= 180, "sharp", options.sharp, "use from 1 to 180 degrees");
  require(options.max_samples >= 1000, "max_samples", static_cast<double>(options.max_samples),
          "allow at least 1000");
}

}  // namespace

Refined refine(const TriangleMesh& mesh, const PointSet& points, const std::optional<Betti>& wanted,
               const RefineOptions& options, Monitor& monitor) {
  check(options);
  if (const std::string broken = broken_invariant(mesh); !broken.empty()) {
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  }
  const auto as_it_is = [&] {
    Refined result{points, {points.points, {}}, {}};
    result.report.samples = static_cast<std::int64_t>(points.points.size());
    return result;
  };
  if (options.when == RefineWhen::never || (mesh.triangles.empty() && options.when == RefineWhen::closed)) {
    return as_it_is();
  }
  if (mesh.triangles.empty()) {
    throw InputError("there are no triangles, so there is no surface to sample",
                     "give a mesh, or take the points as they are (sampling: vertices)");
  }
  const WindingNumber winding(mesh, monitor);
  if (!winding.chain().closed()) {
    if (options.when == RefineWhen::closed) return as_it_is();
    throw InputError(why_not_closed(winding.chain(), mesh),
                     "close the mesh, or take the points as they are (sampling: vertices)");
  }
  const TriangleMesh boundary = boundary_of_solid(mesh, winding.chain(), monitor);
  const auto failed = [](const Refined& tried) {
    return !tried.report.reached() && tried.report.aim() != Refinement::unknown && tried.report.complete == 1;
  };
  constexpr int most_ends = 3;
  bool ends = false;
  RefineOptions attempt = options;
  attempt.lowest_floor = std::max(options.lowest_floor, first_lowest_floor);
  Refined result = refine_once(boundary, winding, points, wanted, attempt, most_ends, ends, monitor);
  if (failed(result) && options.lowest_floor < attempt.lowest_floor)
    result = refine_once(boundary, winding, points, wanted, options, most_ends, ends, monitor);
  if (failed(result) && ends) {  // balls in a very narrow end may not hang together
    Refined left = refine_once(boundary, winding, points, wanted, options, 0, ends, monitor);
    if (left.report.reached()) result = std::move(left);
  }
  result.report.left_out = static_cast<std::int64_t>(mesh.triangles.size() - boundary.triangles.size());
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
