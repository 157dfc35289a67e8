#include "shape/inclusion_homology.hpp"

#include <algorithm>

#include "shape/alpha_shape.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::int64_t distinct(std::vector<std::int32_t> values) {
  std::sort(values.begin(), values.end());
  return std::unique(values.begin(), values.end()) - values.begin();
}

}  // namespace

UnionOfBalls::UnionOfBalls(const Balls& balls, Monitor& monitor)
    : balls_(balls), complex_(alpha_shape(balls, {}, monitor)) {
  loops_ = std::make_unique<FirstHomology>(complex_, monitor);
}

const RegularCells& UnionOfBalls::cells() const {
  if (!cells_) {
    cells_ = std::make_unique<RegularCells>(regular_cells(complex_.centers, complex_.weights, no_monitor()));
  }
  return *cells_;
}

const Voids& UnionOfBalls::voids(Monitor& monitor) const {
  if (!voids_) voids_ = std::make_unique<Voids>(complex_, cells(), monitor);
  return *voids_;
}

const PowerWalk& UnionOfBalls::walk() const {
  if (!walk_) walk_ = std::make_unique<PowerWalk>(complex_.centers, complex_.weights, cells());
  return *walk_;
}

std::int32_t UnionOfBalls::vertex_at(std::int32_t ball) const {
  const std::int32_t start = walk().contains(ball) ? ball : walk().any();
  return walk().cell_of(complex_.centers[at(ball)], start);
}

InclusionHomology UnionOfBalls::inclusion_of(std::span<const std::int32_t> part, Monitor& monitor) const {
  return Inclusion(*this, part, monitor).homology();
}

Inclusion::Inclusion(const UnionOfBalls& whole, std::span<const std::int32_t> ids, Monitor& monitor)
    : whole_(whole), ids_(ids.begin(), ids.end()), part_(select(whole.balls(), ids), monitor) {
  homology_.part = part_.complex().betti;
  homology_.whole = whole.complex().betti;

  component_image_.assign(at(part_.loops().components()), -1);
  for (const std::int32_t v : part_.complex().vertices) {
    std::int32_t& image = component_image_[at(part_.loops().component(v))];
    if (image >= 0) continue;
    // A vertex of K+ is enough where the ball is one; only hidden or swallowed balls have to be located.
    image = whole.loops().component(id(v));
    if (image < 0) image = whole.loops().component(whole.vertex_at(id(v)));
  }
  homology_.rank[0] = distinct(component_image_);

  for (std::size_t k = 0; k < part_.loops().dimension(); ++k) {
    monitor.step(0.5);
    loop_image_.push_back(image_of(part_.loops().loop(k)));
  }
  homology_.rank[1] = static_cast<std::int64_t>(binary_rank(loop_image_));

  void_image_ = {Voids::outer};
  if (homology_.part[2] > 0 || homology_.whole[2] > 0)
    void_image_ = whole.voids(monitor).inside(part_.voids(monitor));
  homology_.rank[2] = distinct(void_image_) - 1;
}

std::vector<std::int32_t> Inclusion::image_of(const std::vector<std::int32_t>& loop) const {
  const auto center = [&](std::int32_t v) { return part_.balls().centers[at(v)]; };
  std::vector<std::int32_t> sum;
  const auto visit = [&](std::int32_t u, std::int32_t v) {
    sum = binary_sum(sum, whole_.loops().on_edge(u, v));
  };
  const std::int32_t start = whole_.vertex_at(id(loop.front()));
  std::int32_t here = start;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    here = whole_.walk().along(center(loop[i]), center(loop[(i + 1) % loop.size()]), here, visit);
  }
  whole_.walk().around_point(center(loop.front()), here, start, visit);
  return sum;
}

}  // namespace ballflow::geometry
