#include "prior/align.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "base/for_each_block.hpp"
#include "prior/closest_points.hpp"
#include "prior/cloud.hpp"

namespace ballflow::geometry {
namespace {

// Starts are tried with few points; what is promising goes on with all of them.
constexpr std::size_t coarse_points = 250;
// Variances along principal axes this near to each other (the smaller by the larger) leave their order open.
constexpr double equal_variances = 0.85;
// Optima this near are one, degrees. What few points tell is no finer, nor what a part of a shape does:
// closest points come to rest beside an optimum there.
constexpr double same_rotation = 5, same_rough_rotation = 15;
constexpr double same_distance = 0.1, same_rough_distance = 0.2;  // and by the target's radius
constexpr double exact_fit = 1e-4;                         // by the diagonal: residuals below this are one
constexpr std::size_t most_optima = 4, most_mirrored = 2;  // distinct ones that go on with all points
constexpr double smallest = 1e-100, largest = 1e100;       // sizes of shapes
constexpr double tiny_part = 0.1;                          // by the size of the target: such fits anywhere
constexpr double most_scale = 1.25;                        // of a part, whose size is not known
constexpr double hopeless = 2.5;  // times the best rough residual: no finer search would help
constexpr double flat = 1e-6;     // thickness of a set of points by its size

using Rotation = std::array<double, 9>;

Rotation product(const Rotation& a, const Rotation& b) {
  Rotation c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return c;
}

/// Permutations of the axes with all signs: the identity with its sign choices first, then the others.
std::vector<Rotation> axis_choices(bool permuted) {
  constexpr std::array<std::array<std::size_t, 3>, 6> orders{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}, {1, 2, 0}, {2, 0, 1}}};
  std::vector<Rotation> result;
  for (std::size_t p = 0; p < (permuted ? orders.size() : 1); ++p) {
    for (int signs = 0; signs < 8; ++signs) {
      Rotation r{};
      for (std::size_t k = 0; k < 3; ++k) r[3 * orders[p][k] + k] = (signs >> k & 1) != 0 ? -1 : 1;
      result.push_back(r);
    }
  }
  return result;
}

double determinant(const Rotation& r) {
  return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
         r[2] * (r[3] * r[7] - r[4] * r[6]);
}

/// No two further than about 45 degrees from one of them: the turns of a cube, and those of it turned by 45
/// degrees about each axis.
std::vector<Rotation> spread_turns() {
  const double h = std::sqrt(0.5);
  const std::array<Rotation, 4> cosets{{{1, 0, 0, 0, 1, 0, 0, 0, 1},
                                        {1, 0, 0, 0, h, -h, 0, h, h},
                                        {h, 0, h, 0, 1, 0, -h, 0, h},
                                        {h, -h, 0, h, h, 0, 0, 0, 1}}};
  std::vector<Rotation> result;
  for (const Rotation& coset : cosets)
    for (const Rotation& turn : axis_choices(true)) result.push_back(product(turn, coset));
  return result;
}

Rotation rows(const std::array<Vec3, 3>& axes) {
  return {axes[0].x, axes[0].y, axes[0].z, axes[1].x, axes[1].y, axes[1].z, axes[2].x, axes[2].y, axes[2].z};
}

Rotation columns(const std::array<Vec3, 3>& axes) {
  return {axes[0].x, axes[1].x, axes[2].x, axes[0].y, axes[1].y, axes[2].y, axes[0].z, axes[1].z, axes[2].z};
}

bool nearly_equal_axes(const PrincipalFrame& f) {
  return f.variances[0] > equal_variances * f.variances[1] ||
         f.variances[1] > equal_variances * f.variances[2];
}

bool nearly_isotropic(const PrincipalFrame& f) { return f.variances[0] > equal_variances * f.variances[2]; }

/// Poses to begin with, mirroring ones among them.
std::vector<ShapePose> starts_of(const PrincipalFrame& moved, const PrincipalFrame& target,
                                 const AlignOptions& options) {
  const bool part = options.extent == Extent::part;
  std::vector<Rotation> turns;
  if (part || nearly_isotropic(moved) || nearly_isotropic(target))
    turns = spread_turns();
  else
    turns = axis_choices(nearly_equal_axes(moved) || nearly_equal_axes(target));
  std::vector<Vec3> centers = {target.mean};
  if (part) {
    for (std::size_t k = 1; k < 3; ++k)
      for (const double sign : {-1.0, 1.0})
        centers.push_back(target.mean + sign * std::sqrt(target.variances[k]) * target.axes[k]);
  }
  std::vector<ShapePose> starts;
  for (const Vec3 center : centers) {
    for (const Rotation& turn : turns) {
      // Half a shape may fit a mirror image of another half: that would say nothing.
      if (part && options.reflections == Reflections::refuse && determinant(turn) < 0) continue;
      ShapePose pose;
      pose.rotation = product(columns(target.axes), product(turn, rows(moved.axes)));
      pose.mirrored = determinant(turn) < 0 ? 1 : 0;
      pose.similarity = options.similarity && !part ? 1 : 0;
      if (options.similarity && !part) pose.scale = target.radius / moved.radius;
      pose.translation = center - pose.scale * turned(pose, moved.mean);
      starts.push_back(pose);
    }
  }
  return starts;
}

/// Whether two poses of the same shape are one optimum.
struct Sameness {
  double degrees, distance;  // of the middle of what is moved
};

bool same(const ShapePose& a, const ShapePose& b, const Cloud& moved, Sameness limit) {
  return degrees_between(a, b) < limit.degrees &&
         distance(transformed(a, moved.frame.mean), transformed(b, moved.frame.mean)) < limit.distance;
}

/// Ascending by residual, of equal optima only the best.
std::vector<ShapePose> distinct(std::vector<ShapePose> poses, const Cloud& moved, Sameness limit) {
  std::stable_sort(poses.begin(), poses.end(),
                   [](const ShapePose& a, const ShapePose& b) { return residual_of(a) < residual_of(b); });
  std::vector<ShapePose> result;
  for (const ShapePose& pose : poses)
    if (std::none_of(result.begin(), result.end(),
                     [&](const ShapePose& other) { return same(pose, other, moved, limit); }))
      result.push_back(pose);
  return result;
}

void refuse_unusable(const PointSet& points, const char* which) {
  if (points.points.size() < 4)
    throw InputError(std::string(which) + " has " + std::to_string(points.points.size()) +
                         " samples, an alignment needs 4 or more",
                     "sample its surface: Sample with mode surface");
  const PrincipalFrame frame = principal_frame(points.points);
  if (frame.radius > 0 && !(frame.radius > smallest && frame.radius < largest))
    throw InputError("the samples of " + std::string(which) +
                         " are too large or too small: squares of their "
                         "distances leave the range of numbers",
                     "scale the model (Sample, scale)");
  if (!(frame.variances[0] > flat * flat * frame.radius * frame.radius))
    throw InputError(
        "all samples of " + std::string(which) + " lie in one plane: mirror images cannot be told",
        "give the surface of a solid");
}

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
  return text;
}

std::string rounded(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

/// Optima found with few points, ascending by residual, each far from the others.
std::vector<ShapePose> rough_optima(const Cloud& moved, const Cloud& target, const AlignOptions& options,
                                    std::vector<ShapePose> starts, Monitor& monitor) {
  const bool whole = options.extent == Extent::whole;
  const ClosestPointsOptions quick{options.similarity && whole, whole, options.keep, 30, 1e-3};
  for_each_block(starts.size(), 1, monitor, 0, 0.5, [&](std::size_t, std::size_t first, std::size_t) {
    starts[first] = iterate_closest_points(moved, target, starts[first], quick, monitor);
  });
  return distinct(std::move(starts), moved, {same_rough_rotation, same_rough_distance * target.frame.radius});
}

/// The pose of a part with its scale: from where it fits rigidly to the next minimum, as long as the scale
/// changes little. Farther away a part fits the better the smaller it is.
ShapePose scaled_part(const Cloud& moved, const Cloud& target, const ShapePose& rigid,
                      const AlignOptions& options, Monitor& monitor) {
  ShapePose pose =
      iterate_closest_points(moved, target, rigid, {true, false, options.keep, 60, 1e-5}, monitor);
  measure(pose, moved, target, options.keep, false);
  if (pose.scale > 1 / most_scale && pose.scale < most_scale && pose.forward <= rigid.forward) return pose;
  monitor.warn("the scale of the part is not to be told: it is left at 1");
  ShapePose same = rigid;
  same.similarity = 1;
  return same;
}

/// The first pose from `from` on that mirrors, or does not.
std::size_t next_of(const std::vector<ShapePose>& poses, bool mirrored, std::size_t from) {
  while (from < poses.size() && (poses[from].mirrored != 0) != mirrored) ++from;
  return from;
}

}  // namespace

double rough_residual(const PointSet& moved_points, const PointSet& target_points,
                      const AlignOptions& options, Monitor& monitor) {
  const Cloud moved(moved_points.points, {}, coarse_points, monitor);
  const Cloud target(target_points.points, {}, coarse_points, monitor);
  std::vector<ShapePose> starts = starts_of(moved.frame, target.frame, options);
  std::erase_if(starts, [](const ShapePose& start) { return start.mirrored != 0; });
  return residual_of(rough_optima(moved, target, options, std::move(starts), monitor).front()) /
         target.frame.radius;
}

ShapePose align(const PointSet& moved_points, const PointSet& target_points, const AlignOptions& options,
                Monitor& monitor) {
  refuse_unusable(moved_points, "what is to be aligned");
  refuse_unusable(target_points, "what it is aligned to");
  const auto count = static_cast<std::size_t>(options.points);
  const Cloud moved(moved_points.points, {}, count, monitor);
  const Cloud target(target_points.points, {}, count, monitor);
  const Cloud few_moved(moved.points, {}, coarse_points, monitor);
  const Cloud few_target(target.points, {}, coarse_points, monitor);
  const bool whole = options.extent == Extent::whole;
  const double size = moved.frame.radius / target.frame.radius;
  if (!whole && !(size > tiny_part && size < most_scale))
    monitor.warn("the part is " + rounded(size) + " times as large as the target: is it in another unit?");

  // The best few go on; then best, second best and best mirror image are told apart.
  std::vector<ShapePose> found = starts_of(moved.frame, target.frame, options);
  const auto starts = static_cast<std::int32_t>(found.size());
  std::vector<ShapePose> proper, mirrored;
  for (const ShapePose& pose : rough_optima(few_moved, few_target, options, std::move(found), monitor)) {
    if (pose.mirrored != 0 && mirrored.size() < most_mirrored) mirrored.push_back(pose);
    if (pose.mirrored == 0 && proper.size() < most_optima) proper.push_back(pose);
  }
  found = proper;
  found.insert(found.end(), mirrored.begin(), mirrored.end());
  const ClosestPointsOptions thorough{options.similarity && whole, whole, options.keep, 60, 1e-5};
  double best_rough = residual_of(found.front());
  for (const ShapePose& pose : found) best_rough = std::min(best_rough, residual_of(pose));
  for_each_block(found.size(), 1, monitor, 0.5, 1, [&](std::size_t, std::size_t first, std::size_t) {
    if (residual_of(found[first]) <= hopeless * best_rough)
      found[first] = iterate_closest_points(moved, target, found[first], thorough, monitor);
    // What decides is measured on all points: a small feature must not be trimmed away.
    measure(found[first], moved, target, whole ? 1 : options.keep, whole);
  });
  found = distinct(std::move(found), moved,
                   whole ? Sameness{same_rotation, same_distance * target.frame.radius}
                         : Sameness{same_rough_rotation, same_rough_distance * target.frame.radius});

  const Box box = bounding_box(target.points);
  const double diagonal = length(box.upper - box.lower), least = exact_fit * diagonal;
  const auto ratio_of = [&](std::size_t other, std::size_t one) {
    return other < found.size()
               ? std::max(residual_of(found[other]), least) / std::max(residual_of(found[one]), least)
               : 0.0;
  };
  std::size_t best = next_of(found, false, 0);
  const std::size_t mirror = next_of(found, true, 0);
  const double fits = ratio_of(best, mirror < found.size() ? mirror : best);  // how much better mirrored
  if (fits > options.sure) {
    if (options.reflections == Reflections::allow) {
      best = mirror;
    } else {
      throw InputError("the shape looks like a mirror image of the target: mirrored it fits " +
                           rounded(fits) + " times as well",
                       "leave it out, mirror its model, or allow it: reflections allow");
    }
  }
  if (!whole && options.similarity) found[best] = scaled_part(moved, target, found[best], options, monitor);
  ShapePose pose = found[best];
  pose.starts = starts;
  pose.diagonal = diagonal;
  const bool mirrors = pose.mirrored != 0;
  const std::size_t second = next_of(found, mirrors, best + 1);
  pose.second_best = second < found.size() ? std::max(1.0, ratio_of(second, best)) : 0;
  pose.mirror_image = ratio_of(next_of(found, !mirrors, 0), best);
  if (pose.second_best != 0 && pose.second_best < options.sure)
    monitor.warn("the pose is ambiguous: another one, turned by " +
                 std::to_string(static_cast<int>(degrees_between(pose, found[second]) + 0.5)) +
                 " degrees, fits nearly as well: its residual is " + rounded(pose.second_best) +
                 " times that of the best");
  const double alike = whole ? options.alike : options.alike / 2;  // a part has one of the two residuals
  if (relative_residual(pose) > alike)
    monitor.warn("the shape is not like the target: aligned, samples are " +
                 percent(relative_residual(pose)) + " of the diagonal apart, those of one kind at most " +
                 percent(alike));
  return pose;
}

}  // namespace ballflow::geometry
