#include "prior/match.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "prior/cloud.hpp"
#include "prior/drift.hpp"
#include "prior/procrustes.hpp"
#include "search/neighbor_distances.hpp"

namespace ballflow::geometry {
namespace {

constexpr double least_radius = 0.05;   // by the median: smaller balls are no members
constexpr double too_many_alone = 0.2;  // of the balls, without partner
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Balls that are not tiny beside the others.
Balls members(const Balls& balls) {
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  if (radii.empty()) return {};
  const auto middle = radii.begin() + static_cast<std::ptrdiff_t>(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < balls.size(); ++i)
    if (balls.radii[i] > 0 && balls.radii[i] >= least_radius * *middle)
      ids.push_back(static_cast<std::int32_t>(i));
  Balls result = select(balls, ids);
  result.defining_offsets = {};
  result.defining_samples = {};
  return result;
}

/// Of balls, the one next to a ball in (x, y, z, r).
class BallTree {
 public:
  explicit BallTree(const Balls& balls) : balls_(balls), tree_(balls.centers.span()) {}

  struct Nearest {
    std::size_t index = 0;
    double distance = infinity;
  };
  Nearest nearest(Vec3 center, double radius) const {
    Nearest found;
    tree_.smallest(center, infinity, -1, [&](std::size_t i) {
      const double across = balls_.radii[i] - radius;
      const double d = std::sqrt(squared_distance(center, balls_.centers[i]) + across * across);
      if (d < found.distance || (d == found.distance && i < found.index)) found = {i, d};
      return std::max(d, distance(center, balls_.centers[i]));  // never below that of the box, rounded alike
    });
    return found;
  }

 private:
  const Balls& balls_;
  BoxTree tree_;
};

void require(bool holds, const std::string& cause, const std::string& hint) {
  if (!holds) throw InputError(cause, hint);
}

void refuse_unusable(const PointSet& points, const std::string& whose) {
  require(
      points.points.size() >= 4,
      "the " + whose + " has " + std::to_string(points.points.size()) + " samples, a match needs 4 or more",
      "sample its surface: Sample with mode surface");
  require(points.normals.size() == points.points.size(), "the samples of the " + whose + " have no normals",
          "sample the faces of a mesh: Sample with mode surface");
}

/// Radii of the template's balls where its points came to: each keeps its proportion to the mean distance of
/// the points that were nearest to its center. Smooth where the field is, as distances from another sampling
/// are not.
std::vector<double> carried_radii(const Balls& balls, std::span<const Vec3> points,
                                  std::span<const Vec3> moved_points, std::span<const Vec3> moved_centers) {
  constexpr std::size_t neighbours = 8;
  std::vector<double> radii;
  std::vector<std::pair<double, std::size_t>> near;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    near.clear();
    for (std::size_t j = 0; j < points.size(); ++j)
      near.emplace_back(squared_distance(balls.centers[i], points[j]), j);
    const std::size_t count = std::min(neighbours, near.size());
    std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
    double before = 0, after = 0;
    for (std::size_t q = 0; q < count; ++q) {
      before += std::sqrt(near[q].first);
      after += distance(moved_centers[i], moved_points[near[q].second]);
    }
    radii.push_back(before > 0 && after > 0 ? balls.radii[i] * (after / before) : balls.radii[i]);
  }
  return radii;
}

/// Distances from a surface that is known by samples: from small discs around them.
class SampledSurface {
 public:
  SampledSurface(const PointSet& samples, const Cloud& cloud, Monitor& monitor)
      : samples_(samples), cloud_(cloud) {
    std::vector<double> spacing = neighbor_distances(samples.points, 1, monitor);
    const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
    std::nth_element(spacing.begin(), middle, spacing.end());
    radius_ = *middle;
  }
  double distance_to(Vec3 p) const {
    const std::size_t i = cloud_.nearest(p).index;
    const Vec3 v = p - samples_.points[i];
    const double height = dot(v, samples_.normals[i]);
    const double along = std::sqrt(std::max(0.0, squared_length(v) - height * height));
    const double outside = std::max(0.0, along - radius_);
    return std::sqrt(height * height + outside * outside);
  }

 private:
  const PointSet& samples_;
  const Cloud& cloud_;
  double radius_ = 0;
};

}  // namespace

Balls template_balls(const Balls& balls, const Balls& inner) {
  require(balls.size() != 0, "the template has no balls", "prune its inner balls to some");
  require(inner.size() != 0, "the template has no inner balls", "its surface must enclose something");
  const BoxTree tree(inner.centers.span());
  std::vector<std::uint8_t> taken(inner.size(), 0);
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (!(balls.radii[i] > 0)) continue;
    std::size_t best = 0;
    double least = infinity;
    tree.smallest(balls.centers[i], infinity, -1, [&](std::size_t j) {
      const double d = distance(balls.centers[i], inner.centers[j]);
      if (d < least || (d == least && j < best)) {
        least = d;
        best = j;
      }
      return d;
    });
    if (taken[best] != 0) continue;
    taken[best] = 1;
    ids.push_back(static_cast<std::int32_t>(best));
  }
  Balls result = members(select(inner, ids));
  require(result.size() != 0, "all balls of the template have radius 0",
          "its surface must enclose something");
  return result;
}

MatchedBalls match(const Balls& balls, const PointSet& points, const PointSet& samples, const Balls& inner,
                   const ShapePose& pose, const MatchOptions& options, Monitor& monitor) {
  refuse_unusable(points, "template");
  refuse_unusable(samples, "instance");
  require(balls.size() != 0, "the template has no balls", "connect TemplateBalls");
  for (std::size_t i = 0; i < balls.size(); ++i)
    require(balls.radii[i] > 0, "ball " + std::to_string(i) + " of the template has radius 0",
            "connect TemplateBalls, which leaves such balls out");
  const Balls own = members(inner);
  require(own.size() != 0, "the instance has no inner balls", "its surface must enclose something");
  if (own.size() < balls.size())
    monitor.warn("the instance has " + std::to_string(own.size()) + " inner balls, fewer than the " +
                 std::to_string(balls.size()) + " of the template: some will share one");

  // In units of the template's radius, in its coordinates, about its middle.
  const PrincipalFrame frame = principal_frame(points.points);
  require(frame.radius > 0, "all samples of the template are at one place", "give the surface of a solid");
  const auto normalised = [&](Vec3 p) { return (1 / frame.radius) * (p - frame.mean); };
  std::vector<Vec3> template_points, sample_points, sample_normals, own_centers;
  for (const Vec3& p : points.points) template_points.push_back(normalised(p));
  const std::size_t m = template_points.size(), k = balls.size();
  for (const Vec3& c : balls.centers) template_points.push_back(normalised(c));
  for (const Vec3& p : samples.points) sample_points.push_back(normalised(transformed(pose, p)));
  for (const Vec3& n : samples.normals) sample_normals.push_back(turned(pose, n));
  for (const std::int32_t i :
       farthest_points(own.centers, static_cast<std::size_t>(options.centers), monitor))
    own_centers.push_back(normalised(transformed(pose, own.centers[static_cast<std::size_t>(i)])));

  const DriftGroup surface{
      0, m, points.normals, sample_points, sample_normals, options.to == MatchTo::planes};
  const DriftGroup middles{m, k, {}, own_centers, {}, false};
  DriftOptions drifting;
  drifting.width = options.width;
  drifting.stiffness = options.stiffness;
  drifting.outliers = options.outliers;
  drifting.start = options.start;
  PartMonitor most(monitor, 0, 0.9);
  const Drift carried = drift(template_points, std::vector<DriftGroup>{surface, middles}, drifting, most);

  // Back to the instance, by the pose that was; then the pose by the labels.
  const ShapePose back = inverse(pose);
  const auto to_instance = [&](Vec3 p) { return transformed(back, frame.radius * p + frame.mean); };
  MatchedBalls result;
  const Cloud cloud(samples.points, {}, samples.points.size(), monitor);
  PartMonitor rest(monitor, 0.9, 1);
  const SampledSurface shell(samples, cloud, rest);
  std::vector<Vec3> moved, normals;
  std::vector<double> point_residuals;
  for (std::size_t j = 0; j < m; ++j) {
    moved.push_back(to_instance(carried.points[j]));
    const bool known = squared_length(carried.normals[j]) > 0.5;
    normals.push_back(known ? turned(back, carried.normals[j])
                            : samples.normals[cloud.nearest(moved[j]).index]);
    point_residuals.push_back(shell.distance_to(moved[j]));
  }
  const ShapePose labelled = labelled_pose(
      moved, points.points, {}, {.similarity = pose.similarity != 0, .mirror = pose.mirrored != 0});

  std::vector<Vec3> moved_centers;
  for (std::size_t i = 0; i < k; ++i) moved_centers.push_back(to_instance(carried.points[m + i]));
  std::vector<double> smooth_radii = carried_radii(balls, points.points, moved, moved_centers);

  const Box box = bounding_box(samples.points);
  result.diagonal = length(box.upper - box.lower);
  const BallTree tree(own);
  std::vector<Vec3> centers;
  std::vector<double> radii, residuals;
  std::vector<std::uint8_t> partners, unique;
  std::vector<std::int32_t> partner, users(own.size(), 0);
  for (std::size_t i = 0; i < k; ++i) {
    const Vec3 center = moved_centers[i];
    const double radius = smooth_radii[i];
    const BallTree::Nearest near = tree.nearest(center, radius);
    const bool has = near.distance <= options.reach * result.diagonal;
    centers.push_back(has ? own.centers[near.index] : center);
    radii.push_back(has ? own.radii[near.index] : radius);
    residuals.push_back(has ? near.distance : 0);
    partners.push_back(has ? 1 : 0);
    partner.push_back(has ? static_cast<std::int32_t>(near.index) : -1);
    if (has) ++users[near.index];
  }
  std::size_t alone = 0;
  for (std::size_t i = 0; i < k; ++i) {
    unique.push_back(partner[i] >= 0 && users[static_cast<std::size_t>(partner[i])] == 1 ? 1 : 0);
    alone += partner[i] < 0 ? 1 : 0;
  }
  if (static_cast<double>(alone) > too_many_alone * static_cast<double>(k))
    monitor.warn(std::to_string(alone) + " of " + std::to_string(k) +
                 " balls have no partner: the shape is not like the template, or not well aligned");

  result.centers = std::move(centers);
  result.radii = std::move(radii);
  result.carried = std::move(moved_centers);
  result.carried_radii = std::move(smooth_radii);
  result.residuals = std::move(residuals);
  result.partners = std::move(partners);
  result.unique = std::move(unique);
  result.points = std::move(moved);
  result.normals = std::move(normals);
  result.point_residuals = std::move(point_residuals);
  result.samples = samples.points;
  result.sample_normals = samples.normals;
  result.rotation = labelled.rotation;
  result.scale = labelled.scale;
  result.translation = labelled.translation;
  result.similarity = labelled.similarity;
  result.mirrored = labelled.mirrored;
  monitor.step(1);
  return result;
}

}  // namespace ballflow::geometry
