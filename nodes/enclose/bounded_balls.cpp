#include "enclose/bounded_balls.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "enclose/ball_cover.hpp"
#include "enclose/solid_lattice.hpp"
#include "enclose/start_balls.hpp"
#include "enclose/surface_patches.hpp"
#include "search/generic_frame.hpp"
#include "search/surface_tree.hpp"
#include "search/winding_number.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t fewest_points = 2000;

void look(Monitor& monitor) {
  if (monitor.cancelled()) throw Cancelled();
}

/// What is to be covered: points that stand for a volume or an area.
struct Demand {
  FloatPoints points;  // padded with points far away
  std::vector<float> weights;
  std::size_t count = 0;

  double total() const {
    double result = 0;
    for (const float weight : weights) result += weight;
    return result;
  }
  void add(Vec3 p, double weight) {
    points.push_back(p);
    weights.push_back(static_cast<float>(weight));
    ++count;
  }
  void pad() {
    while (points.size() % 64 != 0) {
      points.push_back(1e9F, 1e9F, 1e9F);
      weights.push_back(0);
    }
  }
};

/// The largest ball around a centre that stands out by no more than allowed; none where the centre is
/// outside.
class Bound {
 public:
  Bound(const TriangleMesh& mesh, double within, Monitor& monitor)
      : winding_(mesh, monitor),
        surface_(mesh, monitor),
        within_(within),
        rounding_(1e-9 * bounding_box(mesh.vertices.span()).longest_edge()) {}

  const WindingNumber& winding() const { return winding_; }
  std::optional<double> radius(Vec3 center) const {
    const auto nearest = surface_.nearest(center, std::numeric_limits<double>::infinity());
    const double r = (nearest ? nearest->distance : 0) + within_ - rounding_;
    if (!(r > 0)) return std::nullopt;
    const WindingNumber::Value value = winding_.around(center);
    if (value.number == 0) return std::nullopt;
    return r;
  }

 private:
  WindingNumber winding_;
  SurfaceTree surface_;
  double within_, rounding_;
};

using Words = std::vector<std::uint64_t>;

class Search {
 public:
  Search(const Demand& demand, const Bound& bound, std::vector<FloatBall> candidates, Monitor& monitor)
      : demand_(demand),
        bound_(bound),
        candidates_(std::move(candidates)),
        words_(demand.points.size() / 64),
        counts_(demand.points.size(), 0) {
    for (const FloatBall& ball : candidates_) {
      look(monitor);
      sets_.push_back(set_of(ball));
    }
  }

  /// The candidates that cover most, one after another.
  void choose(std::size_t count) {
    std::vector<std::pair<float, std::size_t>> queue;
    for (std::size_t c = 0; c < candidates_.size(); ++c)
      queue.emplace_back(gain(sets_[c]), candidates_.size() - c);
    std::make_heap(queue.begin(), queue.end());
    while (chosen_.size() < count && !queue.empty()) {
      std::pop_heap(queue.begin(), queue.end());
      auto& [found, place] = queue.back();
      const std::size_t c = candidates_.size() - place;
      const float now = gain(sets_[c]);  // never more than it was
      if (now == 0) {
        queue.pop_back();
        continue;
      }
      if (now == found) {
        add(candidates_[c], sets_[c]);
        queue.pop_back();
        continue;
      }
      found = now;
      std::push_heap(queue.begin(), queue.end());
    }
  }

  /// Every ball once: moved, or exchanged for a candidate, where that covers more. False when nothing
  /// changed.
  bool improve(Random& random, Monitor& monitor) {
    bool any = false;
    for (std::size_t i = 0; i < chosen_.size(); ++i) {
      look(monitor);
      remove(i);
      FloatBall best = chosen_[i];
      float most = gain(chosen_sets_[i]);
      const float before = most;
      for (std::size_t c = 0; c < candidates_.size(); ++c) {
        const float found = gain(sets_[c]);
        if (found <= most) continue;
        most = found;
        best = candidates_[c];
      }
      best = moved(best, most, random);
      if (most > before) {
        any = true;
        chosen_[i] = best;
        chosen_sets_[i] = set_of(best);
      }
      put(i);
    }
    return any;
  }

  const std::vector<FloatBall>& balls() const { return chosen_; }
  double uncovered() const {
    double result = 0;
    for (std::size_t p = 0; p < demand_.count; ++p) result += counts_[p] == 0 ? demand_.weights[p] : 0;
    return result;
  }

 private:
  Words set_of(const FloatBall& ball) const {
    Words result(words_, 0);
    const Lanes x = all(ball.x), y = all(ball.y), z = all(ball.z), limit = all(ball.r * ball.r);
    for (std::size_t p = 0; p < demand_.points.size(); p += lanes)
      result[p / 64] |= static_cast<std::uint64_t>(bits(demand_.points.squared_from(p, x, y, z) <= limit))
                        << (p % 64);
    return result;
  }
  /// The weight of points in the set that no ball holds.
  float gain(const Words& set) const {
    float result = 0;
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t rest = set[w] & ~covered_word(w); rest != 0; rest &= rest - 1)
        result += demand_.weights[64 * w + static_cast<std::size_t>(std::countr_zero(rest))];
    }
    return result;
  }
  std::uint64_t covered_word(std::size_t w) const { return covered_.empty() ? 0 : covered_[w]; }
  void add(const FloatBall& ball, const Words& set) {
    chosen_.push_back(ball);
    chosen_sets_.push_back(set);
    put(chosen_.size() - 1);
  }
  void put(std::size_t i) { count(chosen_sets_[i], 1); }
  void remove(std::size_t i) { count(chosen_sets_[i], -1); }
  void count(const Words& set, int by) {
    covered_.resize(words_, 0);
    for (std::size_t w = 0; w < words_; ++w) {
      for (std::uint64_t rest = set[w]; rest != 0; rest &= rest - 1) {
        const int bit = std::countr_zero(rest);
        const std::size_t p = 64 * w + static_cast<std::size_t>(bit);
        counts_[p] = static_cast<std::uint16_t>(counts_[p] + by);
        const std::uint64_t mask = std::uint64_t{1} << bit;
        if (counts_[p] != 0)
          covered_[w] |= mask;
        else
          covered_[w] &= ~mask;
      }
    }
  }

  /// Pattern search along the axes, which are parallel to nothing here.
  FloatBall moved(FloatBall best, float& most, Random& random) const {
    const float scale = best.r;
    constexpr float coarse = 0.2F, fine = 0.01F;
    for (float step = coarse * (0.75F + 0.5F * static_cast<float>(random.unit())); step > fine;
         step *= 0.5F) {
      for (bool better = true; better;) {
        better = false;
        for (int direction = 0; direction < 6; ++direction) {
          FloatBall tried = best;
          (direction / 2 == 0   ? tried.x
           : direction / 2 == 1 ? tried.y
                                : tried.z) += (direction % 2 == 0 ? step : -step) * scale;
          const std::optional<double> r = bound_.radius({tried.x, tried.y, tried.z});
          if (!r) continue;
          tried.r = static_cast<float>(*r);
          const float found = gain(set_of(tried));
          if (found <= most) continue;
          most = found;
          best = tried;
          better = true;
        }
      }
    }
    return best;
  }

  const Demand& demand_;
  const Bound& bound_;
  std::vector<FloatBall> candidates_;
  std::size_t words_;
  std::vector<std::uint16_t> counts_;  // of balls that hold a point
  Words covered_;
  std::vector<Words> sets_;
  std::vector<FloatBall> chosen_;
  std::vector<Words> chosen_sets_;
};

void check(const TriangleMesh& mesh, const BoundedBallsOptions& options) {
  if (const std::string broken = broken_invariant(mesh); !broken.empty())
    throw InputError("the mesh is damaged: " + broken, "repair the mesh, or read it again");
  if (mesh.triangles.empty())
    throw InputError("there are no triangles, so nothing is inside",
                     "give a mesh; clouds of points become one by graphs/reconstruct.json");
  if (options.balls < 1)
    throw InputError("balls is " + std::to_string(options.balls), "ask for one ball at least");
  if (!(options.within >= 0))
    throw InputError("balls would have to stand out by " + std::to_string(options.within),
                     "give a distance of 0 or more");
}

Demand demand_of(const SurfacePatches& patches, const OutsidePoints& lattice, BallGoal goal) {
  Demand result;
  if (goal == BallGoal::volume) {
    for (const Vec3 p : lattice.inside) result.add(p, 1);
  } else {
    for (const auto& corners : patches.corners) {
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) p[k] = patches.vertices[static_cast<std::size_t>(corners[k])];
      result.add(1.0 / 3 * (p[0] + p[1] + p[2]), 0.5 * length(cross(p[1] - p[0], p[2] - p[0])));
    }
  }
  result.pad();
  return result;
}

}  // namespace

BoundedBalls bounded_balls(const TriangleMesh& mesh, const BoundedBallsOptions& options, Monitor& monitor) {
  check(mesh, options);
  const GenericFrame frame(mesh.vertices.span());
  const bool flat = !(frame.size() > 0);
  std::vector<Vec3> vertices;
  for (const Vec3 p : mesh.vertices) vertices.push_back(flat ? p : frame.into(p));
  const TriangleMesh turned{vertices, mesh.triangles};
  PartMonitor reading(monitor, 0, 0.1), seeding(monitor, 0.1, 0.3), searching(monitor, 0.3, 1);
  const Bound bound(turned, flat ? 0 : options.within / frame.size(), reading);
  if (!bound.winding().chain().closed() || flat) {
    throw InputError("nothing is inside: " + (flat ? std::string("all points of the mesh are one")
                                                   : why_not_closed(bound.winding().chain(), turned)),
                     "close the mesh, or wrap it: node Wrap; EncloseBalls takes it as it is");
  }
  const double area = surface_area(vertices, mesh.triangles.span());
  const SurfacePatches patches =
      surface_patches(vertices, mesh.triangles.span(), std::max(1.9 * std::sqrt(area / 6000), 0.004));
  constexpr double pi = 3.14159265358979323846;
  const double radius = std::max(std::sqrt(area / (pi * static_cast<double>(options.balls))), 0.01);
  const OutsidePoints lattice =
      outside_points(turned, {.band = 1.2 * radius, .points = 20000, .inside = 20000}, reading);
  Demand demand = demand_of(patches, lattice, options.goal);

  const BallCover cover(patches, {}, lattice);
  std::vector<FloatBall> candidates;
  const std::size_t tries = std::min<std::size_t>(patches.corners.size(), 2500);
  for (const FloatBall& ball : inner_balls(cover, static_cast<float>(lattice.unit), tries, seeding)) {
    look(seeding);
    const std::optional<double> r = bound.radius({ball.x, ball.y, ball.z});
    if (r) candidates.push_back({ball.x, ball.y, ball.z, static_cast<float>(*r)});
  }
  if (options.goal == BallGoal::volume && demand.count < fewest_points) {
    demand = {};  // thinner than the lattice
    for (const FloatBall& ball : candidates) demand.add({ball.x, ball.y, ball.z}, ball.r);
    demand.pad();
  }
  Search search(demand, bound, std::move(candidates), searching);
  search.choose(static_cast<std::size_t>(options.balls));
  Random random(static_cast<std::uint64_t>(options.seed));
  for (std::int64_t round = 0; round < options.rounds; ++round) {
    searching.step(static_cast<double>(round) / static_cast<double>(options.rounds));
    if (!search.improve(random, searching)) break;
  }

  if (search.balls().empty()) {
    throw InputError("no ball that stands out by at most " + std::to_string(options.within) +
                         " covers anything of the " +
                         (options.goal == BallGoal::surface ? "surface" : "volume"),
                     "raise within, or let balls cover the volume (goal)");
  }

  // Once more where the model is, and in doubles.
  const Bound exact(mesh, options.within, searching);
  BoundedBalls result;
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const FloatBall& ball : search.balls()) {
    const Vec3 center = frame.out_of({ball.x, ball.y, ball.z});
    const std::optional<double> r = exact.radius(center);
    if (!r) continue;
    centers.push_back(center);
    radii.push_back(*r);
  }
  const double size = frame.size(), unit = lattice.unit * size * size * size;
  result.fit.wanted = options.balls;
  result.fit.balls = static_cast<std::int64_t>(radii.size());
  result.balls = {std::move(centers), std::move(radii), {}, {}};
  result.fit.area = area * size * size;
  result.fit.solid = static_cast<double>(lattice.solid) * unit;
  BallCover outside(patches, {}, lattice);
  outside.resize(search.balls().size());
  for (std::size_t i = 0; i < search.balls().size(); ++i) outside.set(i, search.balls()[i]);
  result.fit.outside = options.within > 0 ? static_cast<double>(outside.waste()) * unit : 0;
  if (options.goal == BallGoal::surface) {
    result.fit.kind = static_cast<std::uint8_t>(FitKind::uncovered_area);
    result.fit.loss = search.uncovered() * size * size;
  } else {
    result.fit.kind = static_cast<std::uint8_t>(FitKind::uncovered_volume);
    result.fit.loss = search.uncovered() / demand.total() * result.fit.solid;
  }
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
