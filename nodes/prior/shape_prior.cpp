#include "prior/shape_prior.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <numeric>
#include <string>
#include <vector>

#include "exact/exponential.hpp"
#include "prior/prior_evaluation.hpp"
#include "prior/shape_model.hpp"

namespace ballflow::geometry {
namespace {

constexpr double same_shape = 1e-9;  // of the size: rounding
constexpr double far_away = 2.2;     // times what is usual; the ends of an even row of shapes are 1.7
constexpr double clearly_better = 0.5;

std::string name_of(std::size_t instance, std::size_t count) {
  return "instance " + std::to_string(instance) + " (of 0 to " + std::to_string(count - 1) + ")";
}

template <class T>
std::partial_ordering order_of(const Array<T>& a, const Array<T>& b) {
  return std::lexicographical_compare_three_way(a.begin(), a.end(), b.begin(), b.end());
}

/// The instances in an order that depends on what they are alone.
std::vector<std::size_t> canonical_order(std::span<const MatchedBalls> instances,
                                         std::span<const TriangleMesh> meshes) {
  std::vector<std::size_t> order(instances.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    for (const auto member : {&MatchedBalls::centers, &MatchedBalls::points, &MatchedBalls::samples}) {
      const auto which = order_of(instances[a].*member, instances[b].*member);
      if (which != 0) return which < 0;
    }
    const auto which = order_of(instances[a].radii, instances[b].radii);
    if (which != 0 || meshes.empty()) return which < 0;
    return order_of(meshes[a].vertices, meshes[b].vertices) < 0;
  });
  return order;
}

void refuse(std::span<const MatchedBalls> instances, std::span<const TriangleMesh> meshes) {
  const std::size_t n = instances.size();
  if (n < 2) {
    throw InputError(
        std::to_string(n) + (n == 1 ? " instance does" : " instances do") + " not tell how a shape varies",
        "give two instances at least, better ten: each adds one mode");
  }
  if (!meshes.empty() && meshes.size() != n) {
    throw InputError(std::to_string(meshes.size()) + " meshes for " + std::to_string(n) + " instances",
                     "connect the mesh of every instance in the order of the instances, or none");
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (instances[i].size() == 0)
      throw InputError(name_of(i, n) + " has no balls", "match it to the template that the others have");
    if (instances[i].size() != instances[0].size() ||
        instances[i].points.size() != instances[0].points.size()) {
      throw InputError(name_of(i, n) + " has " + std::to_string(instances[i].size()) + " balls and " +
                           std::to_string(instances[i].points.size()) + " points, instance 0 has " +
                           std::to_string(instances[0].size()) + " and " +
                           std::to_string(instances[0].points.size()),
                       "match all instances to one template");
    }
  }
}

/// Their squares must be numbers.
void refuse_huge(std::span<const LabelledShape> shapes, std::span<const std::size_t> given) {
  constexpr double largest = 1e100;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    for (const LabelledPoints* points : {&shapes[i].centers, &shapes[i].points}) {
      if (points->cols() == 0 || points->cwiseAbs().maxCoeff() <= largest) continue;
      throw InputError(name_of(given[i], shapes.size()) + " has coordinates beyond 1e100",
                       "scale the shapes, all by one factor");
    }
  }
}

/// The mirror image, for instances that were mirrored on their way to the template.
LabelledShape as_matched(const MatchedBalls& matched, ModelBalls balls) {
  LabelledShape shape = labelled_shape(matched, balls == ModelBalls::carried);
  if (matched.mirrored != 0) {
    for (LabelledPoints* points : {&shape.centers, &shape.points, &shape.normals})
      points->row(0) = -points->row(0);
  }
  return shape;
}

/// Warns of instances that do not belong to the others. `given`: their numbers.
void look_at_instances(std::span<const LabelledShape> instances, const ShapeModel& model,
                       std::span<const std::size_t> given, double size, Monitor& monitor) {
  const std::size_t n = instances.size();
  std::vector<Eigen::VectorXd> vectors;
  for (std::size_t i = 0; i < n; ++i) vectors.push_back(vector_of(transformed(model.poses[i], instances[i])));
  std::vector<double> usual(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> distances;
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j) continue;
      distances.push_back(model_distance(model, vectors[i], vectors[j]));
      if (i < j && distances.back() <= same_shape * size) {
        monitor.warn("instances " + std::to_string(std::min(given[i], given[j])) + " and " +
                     std::to_string(std::max(given[i], given[j])) +
                     " are the same shape: it counts twice in the mean and the variances");
      }
    }
    std::sort(distances.begin(), distances.end());
    usual[i] = distances[(distances.size() - 1) / 2];
  }
  std::vector<double> sorted = usual;
  std::sort(sorted.begin(), sorted.end());
  const double common = sorted[n / 2];
  for (std::size_t i = 0; i < n; ++i) {
    if (common > same_shape * size && usual[i] > far_away * common) {
      monitor.warn(name_of(given[i], n) + " is " + std::to_string(usual[i] / common) +
                   " times as far from the others as they are from each other: another shape, or a wrong "
                   "match. Leave it out, or look at its pose and its residuals");
    }
  }
  const LabelledShape mean = shape_of(model.linear.mean, model.balls);
  const Eigen::VectorXd weights = Eigen::VectorXd::Constant(model.balls, 1.0);
  for (std::size_t i = 0; i < n; ++i) {
    const LabelledShape shape = transformed(model.poses[i], instances[i]);
    const Superposition pose = superimpose(shape.centers, mean.centers, weights, false);
    const LabelledPoints laid = transformed(pose, shape.centers);
    double residual = 0;
    for (Eigen::Index ball = 0; ball < model.balls; ++ball)
      residual += weights[ball] * (laid.col(ball) - mean.centers.col(ball)).squaredNorm();
    if (mirrored_residual(shape.centers, mean.centers, weights) <
        clearly_better * clearly_better * residual) {
      monitor.warn(name_of(given[i], n) +
                   " is more like the others as its mirror image: a left one among right ones? Mirror it, or "
                   "allow reflections when it is aligned");
    }
  }
}

std::array<double, 12> rows_of(const Superposition& pose, bool mirrored) {
  std::array<double, 12> rows{};
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c)
      rows[static_cast<std::size_t>(4 * r + c)] =
          (mirrored && c == 0 ? -pose.scale : pose.scale) * pose.rotation(r, c);
    rows[static_cast<std::size_t>(4 * r + 3)] = pose.translation[r];
  }
  return rows;
}

std::vector<Vec3> points_of(const LabelledPoints& points) {
  std::vector<Vec3> result;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    result.push_back({points(0, i), points(1, i), points(2, i)});
  return result;
}

void keep_modes(const ShapeModel& model, ShapePrior& prior) {
  const Eigen::Index k = model.balls, m = model.points, q = model.linear.size();
  std::vector<std::array<double, 4>> modes;
  std::vector<Vec3> point_modes;
  std::vector<double> variances;
  for (Eigen::Index mode = 0; mode < q; ++mode) {
    const auto column = model.linear.modes.col(mode);
    for (Eigen::Index i = 0; i < k; ++i)
      modes.push_back({column[3 * i], column[3 * i + 1], column[3 * i + 2], column[3 * k + i]});
    for (Eigen::Index i = 0; i < m; ++i)
      point_modes.push_back({column[4 * k + 3 * i], column[4 * k + 3 * i + 1], column[4 * k + 3 * i + 2]});
    variances.push_back(model.linear.variances[mode]);
  }
  prior.modes = std::move(modes);
  prior.point_modes = std::move(point_modes);
  prior.variances = std::move(variances);
}

}  // namespace

ShapePrior shape_prior(std::span<const MatchedBalls> instances, std::span<const TriangleMesh> meshes,
                       const ShapePriorOptions& options, Monitor& monitor) {
  refuse(instances, meshes);
  const std::size_t n = instances.size();
  const std::vector<std::size_t> order = canonical_order(instances, meshes);
  std::vector<LabelledShape> shapes;
  std::vector<InstanceSurface> surfaces;
  for (const std::size_t i : order) {
    shapes.push_back(as_matched(instances[i], options.balls));
    surfaces.push_back({&instances[i], meshes.empty() ? nullptr : &meshes[i]});
  }
  refuse_huge(shapes, order);
  ShapeModelOptions wanted;
  wanted.scale = options.scale;
  wanted.radius_weight = options.radius_weight;
  wanted.point_share = options.point_share;
  wanted.along = options.along;
  PartMonitor learning(monitor, 0, 0.2);
  const ShapeModel all = shape_model(shapes, wanted, learning);

  const LabelledShape mean = shape_of(all.linear.mean, all.balls);
  Box box = bounding_box(points_of(mean.centers));
  for (const Vec3& p : points_of(mean.points)) box.add(p);
  const double size = std::max(box.longest_edge(), all.metric.radius_unit);
  double total = 0;
  for (const double variance : all.linear.variances) total += variance;
  if (!(total > same_shape * same_shape * size * size)) {
    throw InputError("the " + std::to_string(n) + " instances are all the same shape",
                     "give instances that differ; is one file in the list twice?");
  }
  look_at_instances(shapes, all, order, size, monitor);

  ShapeModel model = all;
  if (options.modes > 0 && options.modes < all.linear.size()) {
    const auto kept = static_cast<Eigen::Index>(options.modes);
    model.linear.modes = all.linear.modes.leftCols(kept);
    model.linear.feature_modes = all.linear.feature_modes.leftCols(kept);
    model.linear.variances = all.linear.variances.head(kept);
    model.linear.scores = all.linear.scores.leftCols(kept);
    wanted.modes = static_cast<int>(kept);
  }
  const auto q = static_cast<std::size_t>(model.linear.size());

  ShapePrior prior;
  prior.centers = points_of(mean.centers);
  std::vector<double> radii;
  for (const double log_radius : mean.log_radii) radii.push_back(exponential(log_radius));
  prior.radii = std::move(radii);
  prior.points = points_of(mean.points);
  prior.normals = points_of(model.metric.normals);
  prior.point_share = model.points == 0 ? 0 : options.point_share;
  prior.along = options.along;
  prior.radius_unit = model.metric.radius_unit;
  prior.total_variance = total;
  prior.scaled = options.scale ? 1 : 0;
  keep_modes(model, prior);

  std::vector<double> scores(n * q), distances(n);
  std::vector<std::array<double, 12>> poses(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = order[i];
    for (std::size_t mode = 0; mode < q; ++mode)
      scores[at * q + mode] =
          model.linear.scores(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(mode));
    poses[at] = rows_of(model.poses[i], instances[at].mirrored != 0);
    distances[at] =
        model_distance(model, vector_of(transformed(model.poses[i], shapes[i])), model.linear.mean);
  }
  prior.scores = std::move(scores);
  prior.distances = std::move(distances);
  prior.poses = std::move(poses);

  std::vector<double> none(q, 0.0);
  prior.specificity = none;
  prior.specificity_deviation = none;
  if (options.draws > 0) {
    PartMonitor general(monitor, 0.2, 0.8), specific(monitor, 0.8, 1);
    ModeCurve curve = generalization(shapes, surfaces, wanted, general);
    prior.measure = static_cast<std::uint8_t>(measure_of(surfaces));
    prior.generalization = std::move(curve.mean);
    prior.generalization_deviation = std::move(curve.deviation);
    curve = specificity(shapes, model, options.draws, specific);
    prior.specificity = std::move(curve.mean);
    prior.specificity_deviation = std::move(curve.deviation);
  }
  return prior;
}

}  // namespace ballflow::geometry
