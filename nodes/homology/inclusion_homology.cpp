#include "homology/inclusion_homology.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "power/alpha_shape.hpp"
#include "power/union_betti.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::int64_t distinct(std::vector<std::int32_t> values) {
  std::sort(values.begin(), values.end());
  return std::unique(values.begin(), values.end()) - values.begin();
}

}  // namespace

UnionOfBalls::UnionOfBalls(const Balls& balls, Monitor& monitor)
    : UnionOfBalls(balls, power_diagram(balls, {}, monitor), monitor) {}

UnionOfBalls::UnionOfBalls(const Balls& balls, PowerDiagram diagram, Monitor& monitor)
    : UnionOfBalls(balls, diagram, alpha_shape(diagram, monitor), monitor) {}

UnionOfBalls::UnionOfBalls(const Balls& balls, PowerDiagram diagram, SimplicialComplex complex,
                           Monitor& monitor)
    : monitor_(monitor),
      balls_(balls),
      diagram_(std::make_unique<const PowerDiagram>(std::move(diagram))),
      complex_(std::make_unique<const SimplicialComplex>(std::move(complex))),
      loops_(std::make_unique<FirstHomology>(*complex_, monitor)) {
  // Two computations that have nothing in common: linear algebra here, components and cavities there.
  if (static_cast<std::int64_t>(loops_->dimension()) != complex_->betti[1]) {
    throw std::logic_error("the complex has " + std::to_string(loops_->dimension()) +
                           " independent loops, but its Betti number says " +
                           std::to_string(complex_->betti[1]));
  }
}

const Voids& UnionOfBalls::voids() const {
  if (!voids_) voids_ = std::make_unique<Voids>(*diagram_, monitor_);
  return *voids_;
}

const PowerWalk& UnionOfBalls::walk() const {
  if (!walk_) walk_ = std::make_unique<PowerWalk>(*diagram_);
  return *walk_;
}

std::int32_t UnionOfBalls::vertex_at(std::int32_t ball) const {
  if (vertex_at_.empty()) vertex_at_.assign(balls_.size(), -1);
  std::int32_t& known = vertex_at_[at(ball)];
  if (known < 0) {
    const std::int32_t start = walk().contains(ball) ? ball : walk().any();
    known = walk().cell_of(complex_->centers[at(ball)], start);
  }
  return known;
}

InclusionHomology UnionOfBalls::inclusion_of(std::span<const std::int32_t> part) const {
  return Inclusion(*this, part).homology();
}

bool UnionOfBalls::isomorphic_to(std::span<const std::int32_t> part) const {
  const Balls balls = select(balls_, part);
  PowerDiagram diagram = power_diagram(balls, {}, monitor_);
  if (union_betti(diagram, monitor_) != complex_->betti) return false;
  return Inclusion(*this, part, UnionOfBalls(balls, std::move(diagram), monitor_)).homology().isomorphism();
}

Inclusion::Inclusion(const UnionOfBalls& whole, std::span<const std::int32_t> ids)
    : Inclusion(whole, ids, UnionOfBalls(select(whole.balls(), ids), whole.monitor_)) {}

Inclusion::Inclusion(const UnionOfBalls& whole, std::span<const std::int32_t> ids, UnionOfBalls part)
    : whole_(whole), ids_(ids.begin(), ids.end()), part_(std::move(part)) {
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
    whole.monitor_.step(0.5);
    loop_image_.push_back(image_of(part_.loops().loop(k)));
  }
  homology_.rank[1] = static_cast<std::int64_t>(binary_rank(loop_image_));

  void_image_ = {Voids::Place()};
  if (homology_.part[2] > 0 || homology_.whole[2] > 0) void_image_ = whole.voids().inside(part_.voids());
  std::vector<std::int32_t> voids;
  for (const Voids::Place& place : void_image_) voids.push_back(place.number);
  homology_.rank[2] = distinct(voids) - 1;
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

std::vector<std::int32_t> Inclusion::along_edge(std::int32_t u, std::int32_t v) const {
  const Vec3 p = part_.balls().centers[at(u)], q = part_.balls().centers[at(v)];
  std::vector<std::int32_t> sum;
  const auto visit = [&](std::int32_t a, std::int32_t b) {
    sum = binary_sum(sum, whole_.loops().on_edge(a, b));
  };
  const std::int32_t there = whole_.walk().along(p, q, whole_.vertex_at(id(u)), visit);
  whole_.walk().around_point(q, there, whole_.vertex_at(id(v)), visit);
  return sum;
}

}  // namespace ballflow::geometry
