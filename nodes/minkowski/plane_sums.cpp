#include "minkowski/plane_sums.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "base/index.hpp"
#include "exact/ball_predicates.hpp"
#include "power/contribution.hpp"
#include "power/regular_triangulation_2.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

PlaneSite plane_site(const Ball& ball) { return {{ball.center.x, ball.center.y}, ball.radius * ball.radius}; }
Site site_in_space(const PlaneSite& s) { return {in_space(s.center), s.weight}; }

/// Random lots that grow eightfold, each along a curve in the plane, of near ones the larger first: see
/// PowerTriangulation.
std::vector<Ball> in_plane_order(const std::vector<Ball>& balls, Monitor& monitor) {
  Box box;
  double largest = 0;
  for (const Ball& ball : balls) {
    box.add(ball.center);
    largest = std::max(largest, ball.radius);
  }
  const double scale = box.longest_edge() > 0 ? 2047 / box.longest_edge() : 0;
  const auto spread = [](std::uint64_t bits) {  // bit k goes to bit 2 k
    bits = (bits | bits << 8) & 0x00ff00ffu;
    bits = (bits | bits << 4) & 0x0f0f0f0fu;
    bits = (bits | bits << 2) & 0x33333333u;
    return (bits | bits << 1) & 0x55555555u;
  };
  // 3 bits for the lot, 11 for each coordinate, 7 for the size.
  constexpr std::uint64_t lots = 7;
  Lookout look(monitor);
  std::vector<std::uint64_t> keys(balls.size());
  for (std::size_t i = 0; i < balls.size(); ++i) {
    look(8);
    const Vec3 c = balls[i].center;
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const double x : {c.x, c.y}) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 31;
    }
    const auto lot = lots - std::min(static_cast<std::uint64_t>(std::countr_zero(hash)) / 3, lots);
    const auto smallness =
        static_cast<std::uint64_t>(largest > 0 ? (1 - balls[i].radius / largest) * 127 : 0);
    const auto x = static_cast<std::uint64_t>(scale * (c.x - box.lower.x)),
               y = static_cast<std::uint64_t>(scale * (c.y - box.lower.y));
    keys[i] = lot << 61 | (spread(x) << 1 | spread(y)) << 39 | smallness << 32 | i;
  }
  std::sort(keys.begin(), keys.end(), [&look](std::uint64_t a, std::uint64_t b) {
    look(1);
    return a < b;
  });
  std::vector<Ball> ordered(balls.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    look(8);
    ordered[i] = balls[keys[i] & 0xffffffffu];
  }
  return ordered;
}

}  // namespace

struct PlaneSums::Implementation {
  RegularTriangulation2 triangulation;
  std::vector<double> radii;  // of all that were ever vertices
  ContributionTest test;
  std::vector<std::int32_t> found;
  std::vector<Site> link;

  Implementation(const Ball& a, const Ball& b, const Ball& c)
      : triangulation(plane_site(a), plane_site(b), plane_site(c)), radii{a.radius, b.radius, c.radius} {}

  void insert(const Ball& ball) {
    if (triangulation.insert(plane_site(ball)) != RegularTriangulation2::hidden) radii.push_back(ball.radius);
  }
};

PlaneSums::PlaneSums(const Ball& a, const Ball& b, const Ball& c)
    : implementation_(std::make_unique<Implementation>(a, b, c)) {}
PlaneSums::~PlaneSums() = default;

std::size_t PlaneSums::vertices() const { return implementation_->triangulation.vertices(); }

void PlaneSums::insert(std::vector<Ball> balls, Monitor& monitor) {
  balls = in_plane_order(balls, monitor);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i % 4096 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(balls.size()));
    implementation_->insert(balls[i]);
  }
}

void PlaneSums::insert(const Ball& ball) { implementation_->insert(ball); }

bool PlaneSums::may_contribute(const Ball& ball) {
  Implementation& my = *implementation_;
  const PlaneSite site = plane_site(ball);
  const auto& near = my.triangulation.locate(site.center);
  // Most are quickly seen: one ball of those around contains it, or its center is in its own cell as far as
  // these can tell, which only costs a look at what is in it.
  bool center_free = true;
  for (const std::int32_t v : near.vertices) {
    if (v == RegularTriangulation2::infinite) return true;
    const double d = distance(my.triangulation.site(v).center, site.center), r = my.radii[at(v)];
    const double room = (r - ball.radius) - 0x1p-40 * r;
    if (room > 0 && d < room) return false;
    center_free = center_free && d * d - r * r > -site.weight;
  }
  if (center_free) return true;
  if (!my.triangulation.neighbours(site, my.found)) return false;
  my.link.clear();
  for (const std::int32_t v : my.found) my.link.push_back(site_in_space(my.triangulation.site(v)));
  return my.test.contributes({in_space(site.center), site.weight}, my.link);
}

Contributing PlaneSums::contributing(Monitor& monitor) {
  Implementation& my = *implementation_;
  const std::vector<RegularTriangulation2::Triangle> triangles = my.triangulation.take_triangles();
  const std::size_t n = my.triangulation.size();
  const PlaneLinks links(triangles, n);
  std::vector<std::uint8_t> contributes(n);
  Contributing result;
  for (std::size_t i = 0; i < n; ++i) {
    if (i % 4096 == 0) monitor.step(static_cast<double>(i) / static_cast<double>(n));
    const auto around = links.of(i);
    if (around.empty()) continue;  // hidden later
    my.link.clear();
    for (const std::int32_t v : around) {
      if (v >= 0) my.link.push_back(site_in_space(my.triangulation.site(v)));
    }
    const PlaneSite& site = my.triangulation.site(static_cast<std::int32_t>(i));
    contributes[i] = my.test.contributes(site_in_space(site), my.link);
    if (contributes[i]) result.balls.push_back({in_space(site.center), my.radii[i]});
  }
  std::vector<Vec3> centers(n);
  std::vector<double> weights(n);
  for (std::size_t i = 0; i < n; ++i) {
    const PlaneSite& site = my.triangulation.site(static_cast<std::int32_t>(i));
    centers[i] = in_space(site.center);
    weights[i] = site.weight;
  }
  const BallPredicates predicates(centers, weights);
  std::vector<std::uint8_t> open = contributes;  // 1: contributes, not known to touch
  Lookout look(monitor);
  for (const auto& t : triangles) {
    look(64);
    const auto is_open = [&open](std::int32_t v) { return v >= 0 && open[at(v)] != 0; };
    if (std::none_of(t.vertices.begin(), t.vertices.end(), is_open)) continue;
    const bool infinite = std::find(t.vertices.begin(), t.vertices.end(), -1) != t.vertices.end();
    if (!infinite && predicates.meets(t.vertices)) continue;
    for (const std::int32_t v : t.vertices) {
      if (!is_open(v)) continue;
      ++result.touching_boundary;
      open[at(v)] = 0;
    }
  }
  return result;
}

}  // namespace ballflow::geometry
