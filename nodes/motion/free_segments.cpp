#include "motion/free_segments.hpp"

#include <CGAL/Gmpzf.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "exact/separation.hpp"

namespace ballflow::geometry {
namespace {

using Ring = CGAL::Gmpzf;  // sums and products of doubles, exactly
using RingVector = std::array<Ring, 3>;

RingVector between(Vec3 from, Vec3 to) {
  return {Ring(to.x) - Ring(from.x), Ring(to.y) - Ring(from.y), Ring(to.z) - Ring(from.z)};
}
Ring scalar(const RingVector& a, const RingVector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The segment has no point in the ball or on it.
bool misses(Vec3 from, Vec3 to, Vec3 center, double radius) {
  const RingVector way = between(from, to), arm = between(from, center);
  const Ring along = scalar(arm, way), all = scalar(way, way), squared_radius = Ring(radius) * Ring(radius);
  const auto positive = [](const Ring& a) { return CGAL::sign(a) == CGAL::POSITIVE; };
  if (!positive(along)) return positive(scalar(arm, arm) - squared_radius);
  if (!positive(all - along)) {
    const RingVector end = between(to, center);
    return positive(scalar(end, end) - squared_radius);
  }
  return positive(scalar(arm, arm) * all - along * along - squared_radius * all);
}

double distance_to_segment(Vec3 from, Vec3 to, Vec3 p) {
  const Vec3 way = to - from, arm = p - from;
  const double all = squared_length(way);
  const double t = all > 0 ? std::clamp(dot(arm, way) / all, 0.0, 1.0) : 0;
  return length(arm - t * way);
}

/// What rounding may be wrong by when a length of the scene is computed, generously.
double slack_of(Vec3 from, Vec3 to, Vec3 center, double radius) {
  double size = radius;
  for (const Vec3 p : {from, to, center})
    size = std::max({size, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return 0x1p-44 * size;
}

/// No ball of the node is nearer to the segment, but for rounding.
double least_clearance(const BallBoxes::Node& node, Vec3 from, Vec3 to) {
  const Vec3 middle = 0.5 * (node.box.lower + node.box.upper);
  const double half = 0.5 * std::sqrt(node.size());
  return distance_to_segment(from, to, middle) - half - node.largest -
         slack_of(from, to, middle, half + node.largest);
}

/// Calls visit(ball) for balls that may be nearer to the segment than bound(), which visits may lower,
/// nearest nodes first, until it returns false.
template <class Bound, class Visit>
void for_near_balls(const BallBoxes& balls, Vec3 from, Vec3 to, const Bound& bound, const Visit& visit) {
  std::vector<std::pair<double, std::int32_t>> stack{{least_clearance(balls.node(0), from, to), 0}};
  while (!stack.empty()) {
    const auto [least, at] = stack.back();
    stack.pop_back();
    if (least > bound()) continue;
    const BallBoxes::Node& node = balls.node(at);
    if (node.leaf()) {
      for (const BallBoxes::Ball& ball : balls.balls_of(node)) {
        if (!visit(ball)) return;
      }
      continue;
    }
    std::pair<double, std::int32_t> near{least_clearance(balls.node(at + 1), from, to), at + 1},
        far{least_clearance(balls.node(node.second), from, to), node.second};
    if (far.first < near.first) std::swap(near, far);
    stack.push_back(far);
    stack.push_back(near);
  }
}

}  // namespace

double FreeSegments::clearance(Vec3 from, Vec3 to, double enough) const {
  double least = std::numeric_limits<double>::infinity();
  for_near_balls(
      balls_, from, to, [&] { return least; },
      [&](const BallBoxes::Ball& ball) {
        least = std::min(least, distance_to_segment(from, to, ball.center) - ball.radius);
        return least >= enough;
      });
  return least;
}

bool FreeSegments::free(Vec3 from, Vec3 to) const {
  bool is_free = true;
  for_near_balls(
      balls_, from, to, [] { return 0.0; },
      [&](const BallBoxes::Ball& ball) {
        const double gap = distance_to_segment(from, to, ball.center) - ball.radius;
        const double slack = slack_of(from, to, ball.center, ball.radius);
        is_free = gap > slack || (gap >= -slack && misses(from, to, ball.center, ball.radius));
        return is_free;
      });
  return is_free;
}

std::int32_t FreeSegments::ball_at(Vec3 point) const {
  double deepest = std::numeric_limits<double>::infinity();
  std::int32_t index = -1;
  for_near_balls(
      balls_, point, point, [&] { return std::min(deepest, 0.0); },
      [&](const BallBoxes::Ball& ball) {
        const double gap = distance(point, ball.center) - ball.radius;
        const bool better = gap < deepest || (gap == deepest && ball.index < index);
        if (better && compare_separation({point, ball.center, 0, ball.radius}, 0) <= 0) {
          deepest = gap;
          index = ball.index;
        }
        return true;
      });
  return index;
}

}  // namespace ballflow::geometry
