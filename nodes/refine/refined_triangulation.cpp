#include "refine/refined_triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "exact/circumcenter.hpp"

namespace ballflow::geometry {
namespace {

// A ray that leaves the surface starts so far from it, in box edges: narrower gaps are not seen.
constexpr double skin = 1e-7;

/// The corners of an icosahedron, far enough away that no ball inside the box reaches them.
std::array<Vec3, 12> far_points(const Box& box) {
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  const double distance = 10 * box.longest_edge();
  constexpr double golden = 1.618, norm = 1.902;
  std::array<Vec3, 12> points;
  for (std::size_t k = 0; k < 12; ++k) {
    const double u = (k & 1) != 0 ? 1 : -1, v = (k & 2) != 0 ? golden : -golden;
    const Vec3 direction = k < 4 ? Vec3{0, u, v} : k < 8 ? Vec3{u, v, 0} : Vec3{v, 0, u};
    // Not quite regular, so that no five points are on a sphere for all samples.
    points[k] = middle + (distance * (1 + 0.01 * static_cast<double>(k)) / norm) * direction;
  }
  return points;
}

}  // namespace

RefinedTriangulation::RefinedTriangulation(const SurfaceTree& surface, const WindingNumber& winding,
                                           const Box& box, double widest)
    : surface_(surface), winding_(winding), size_(box.longest_edge()), widest_(widest) {
  for (const Vec3& p : far_points(box)) delaunay_.insert({p.x, p.y, p.z});
}

bool RefinedTriangulation::insert(const SurfacePoint& at, double floor, Cell hint) {
  const std::size_t before = delaunay_.number_of_vertices();
  const Vertex vertex = delaunay_.insert({at.point.x, at.point.y, at.point.z}, hint == Cell() ? last_ : hint);
  if (delaunay_.number_of_vertices() == before) return false;
  vertex->info() = {index_of(samples_.size(), "samples of a surface"), at.triangle, floor};
  samples_.push_back(vertex);
  last_ = vertex->cell();
  return true;
}

double RefinedTriangulation::floor_of(Cell cell) {
  double floor = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) {
    const RefinedSample& sample = cell->vertex(k)->info();
    if (sample.number >= 0) floor = std::min(floor, sample.floor);
  }
  return floor;
}

std::vector<RefinedTriangulation::Cell> RefinedTriangulation::evaluate(Monitor& monitor) {
  std::vector<Cell> fresh, around;
  for (; evaluated_ < samples_.size(); ++evaluated_) {  // every new cell has a new sample
    around.clear();
    delaunay_.finite_incident_cells(samples_[evaluated_], std::back_inserter(around));
    for (const Cell& cell : around) {
      if (cell->info().side != Side::unknown) continue;
      cell->info().side = Side::outer;  // once is enough
      fresh.push_back(cell);
    }
  }
  for_each_block(fresh.size(), 256, monitor, 0, 0, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) evaluate(fresh[i]);
  });
  return fresh;
}

void RefinedTriangulation::evaluate(Cell cell) const {
  RefinedCell& info = cell->info();
  std::array<Vec3, 4> corners;
  for (int k = 0; k < 4; ++k) {
    corners[static_cast<std::size_t>(k)] = position(cell->vertex(k));
    if (cell->vertex(k)->info().number < 0) info.far = true;
  }
  std::sort(corners.begin(), corners.end());  // rounding must not depend on the order
  info.center = circumcenter(corners);
  const RefinedTriangulation::Vertex* sample = nullptr;  // any of them
  for (int k = 0; k < 4; ++k) {
    const Vertex vertex = cell->vertex(k);
    info.radius = std::max(info.radius, distance(info.center, position(vertex)));
    if (vertex->info().number < 0 || sample != nullptr) continue;
    sample = &samples_[static_cast<std::size_t>(vertex->info().number)];
  }
  info.side = Side::outer;
  if (!info.far) {
    const WindingNumber::Value value = winding_.around(info.center);
    if (value.number > 0.5 && !value.on_surface) info.side = Side::inner;
  }
  if (sample == nullptr) return;  // far-away points only
  // Its samples are on the surface, so only nearer points matter.
  const auto found = surface_.nearest(info.center, info.radius);
  if (!found) {
    info.nearest = position(*sample);
    info.triangle = (*sample)->info().triangle;
    return;
  }
  info.nearest = found->point;
  info.triangle = found->triangle;
  info.depth = info.radius - found->distance;
  Vec3 direction = info.nearest - info.center;
  const double norm = length(direction);
  direction = norm > skin * size_ ? (1 / norm) * direction : surface_.normal(info.triangle);
  if (const auto hit = surface_.first_hit(info.nearest, direction, skin * size_, widest_)) {
    info.gap = hit->distance;
  }
}

}  // namespace ballflow::geometry
