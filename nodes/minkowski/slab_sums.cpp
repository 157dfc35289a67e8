#include "minkowski/slab_sums.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <utility>

namespace ballflow::geometry {
namespace {

/// Walls between slabs, across one axis.
class Slabs {
 public:
  Slabs(const std::vector<Ball>& sums, std::size_t count, Monitor& monitor) {
    Lookout look(monitor);
    Box box;
    for (const Ball& sum : sums) {
      look(4);
      box.add(sum.center);
    }
    const Vec3 edges = box.upper - box.lower;
    if (edges.y > edges.x) axis_ = &Vec3::y;
    if (edges.z > std::max(edges.x, edges.y)) axis_ = &Vec3::z;
    // Some thousands are enough to part them evenly.
    std::vector<double> places;
    for (std::size_t i = 0; i < sums.size(); i += sums.size() / 4096 + 1)
      places.push_back(sums[i].center.*axis_);
    std::sort(places.begin(), places.end());
    for (std::size_t k = 1; k < count; ++k) walls_.push_back(places[k * places.size() / count]);
  }

  std::size_t size() const { return walls_.size() + 1; }

  /// The slabs that the ball reaches into, first and last, whatever is rounded.
  std::pair<std::size_t, std::size_t> of(const Ball& ball) const {
    const double x = ball.center.*axis_, reach = ball.radius + 0x1p-40 * (std::abs(x) + ball.radius);
    return {slab(x - reach), slab(x + reach)};
  }

 private:
  std::size_t slab(double x) const {
    return static_cast<std::size_t>(std::lower_bound(walls_.begin(), walls_.end(), x) - walls_.begin());
  }

  double Vec3::*axis_ = &Vec3::x;
  std::vector<double> walls_;
};

bool by_center(const Ball& a, const Ball& b) { return a.center < b.center; }
bool same_center(const Ball& a, const Ball& b) { return a.center == b.center; }

/// The balls that contribute in every slab that they reach into, ascending by center, and all around these.
/// Balls of one center are one ball: of two the smaller is no vertex anywhere.
std::pair<std::vector<Ball>, std::vector<Ball>> astride(const std::vector<Shared>& found,
                                                        const Slabs& slabs) {
  std::vector<Ball> parts;
  for (const Shared& slab : found) parts.insert(parts.end(), slab.parts.begin(), slab.parts.end());
  std::sort(parts.begin(), parts.end(), by_center);
  std::vector<Ball> open;
  for (std::size_t i = 0, next = 0; i < parts.size(); i = next) {
    while (next < parts.size() && same_center(parts[next], parts[i])) ++next;
    const auto [first, last] = slabs.of(parts[i]);
    if (next - i == last - first + 1) open.push_back(parts[i]);
  }
  std::vector<Ball> all = open;
  for (const Shared& slab : found) {
    for (std::size_t i = 0; i < slab.parts.size(); ++i) {
      if (!std::binary_search(open.begin(), open.end(), slab.parts[i], by_center)) continue;
      all.insert(all.end(), slab.around.begin() + static_cast<std::ptrdiff_t>(slab.around_offsets[i]),
                 slab.around.begin() + static_cast<std::ptrdiff_t>(slab.around_offsets[i + 1]));
    }
  }
  std::sort(all.begin(), all.end(), by_center);
  all.erase(std::unique(all.begin(), all.end(), same_center), all.end());
  return {std::move(open), std::move(all)};
}

}  // namespace

// Balls that reach through a wall are triangulated three times: of a million and less, with few balls inside
// a slab, up to two in five.
std::size_t slabs_for(std::size_t sums) {
  return std::clamp<std::size_t>(
      std::min(sums >> 19, static_cast<std::size_t>(tbb::this_task_arena::max_concurrency())), 1, 8);
}

Contributing contributing_in_slabs(std::vector<Ball> sums, std::size_t count, Monitor& monitor) {
  if (count < 2 || sums.empty()) {
    PowerTriangulation triangulation;
    PartMonitor most(monitor, 0, 0.9), rest(monitor, 0.9, 1);
    triangulation.insert(std::move(sums), most);
    return triangulation.contributing(rest);
  }
  const Slabs slabs(sums, count, monitor);
  std::vector<std::vector<Ball>> in_slab(slabs.size());
  {
    Lookout look(monitor);
    for (const Ball& sum : sums) {
      look(8);
      const auto [first, last] = slabs.of(sum);
      for (std::size_t k = first; k <= last; ++k) in_slab[k].push_back(sum);
    }
  }
  std::vector<Ball>().swap(sums);
  std::vector<Shared> found(slabs.size());
  PartMonitor side_by_side(monitor, 0.02, 0.8);
  tbb::parallel_for(
      std::size_t{0}, slabs.size(),
      [&](std::size_t k) {
        PartMonitor most(side_by_side, 0, 0.8), rest(side_by_side, 0.8, 1);
        PowerTriangulation triangulation;
        triangulation.insert(std::move(in_slab[k]), most);
        found[k] = triangulation.contributing(
            [&slabs](const Ball& ball) {
              const auto [first, last] = slabs.of(ball);
              return first == last ? Share::whole : Share::part;
            },
            rest);
      },
      tbb::simple_partitioner());
  monitor.step(0.8);
  auto [open, all] = astride(found, slabs);
  PartMonitor most(monitor, 0.82, 0.95), rest(monitor, 0.95, 1);
  PowerTriangulation triangulation;
  triangulation.insert(std::move(all), most);
  Contributing result = triangulation.contributing(
      [&open = open](const Ball& ball) {
        return std::binary_search(open.begin(), open.end(), ball, by_center) ? Share::whole : Share::none;
      },
      rest);
  for (Shared& slab : found) {
    result.balls.insert(result.balls.end(), slab.balls.begin(), slab.balls.end());
    result.touching_boundary += slab.touching_boundary;
    slab = {};
  }
  return result;
}

}  // namespace ballflow::geometry
