#include "prior/shape_fit.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "exact/exponential.hpp"
#include "prior/fit_expectation.hpp"
#include "prior/generalized_procrustes.hpp"
#include "prior/shape_instance.hpp"

namespace ballflow::geometry {
namespace {

constexpr double along_plane = 0.1;  // weight of distances along tangent planes, against those from them
constexpr double narrowest = 1e-3;   // width, in root mean square radii
constexpr double standstill = 1e-3;  // of the squared width from step to step
constexpr double at_rest = 3e-3;     // of scores, turns and shifts by radii
constexpr double slowest = 0.7;      // of the squared width, from step to step
constexpr int steps_of_pose = 6;     // in which scores are held
constexpr double held = 1e6;         // precision of a score that is held
constexpr double most_outliers = 0.7, fewest_outliers = 0.01;
constexpr double tiny_ball = 0.05;  // of the median radius
constexpr double far_residual = 3, far_scores = 3;

/// The parts of the model that are observed: surface points, or centers of balls with logarithms of radii.
struct Parts {
  OrientedPoints mean;
  Eigen::VectorXd values, value_unit;  // logarithms of radii; a length for each
  Eigen::MatrixXd modes;               // 3 rows for each part, a column for each mode
  Eigen::MatrixXd value_modes;         // a row for each part
  double radius = 0;                   // root mean square distance from the middle
};

struct Observation {
  OrientedPoints points;
  Eigen::VectorXd values;
};

Eigen::Vector3d eigen(Vec3 p) { return {p.x, p.y, p.z}; }
Vec3 vec(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

Eigen::Matrix3Xd columns(std::span<const Vec3> points) {
  Eigen::Matrix3Xd result(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = eigen(points[i]);
  return result;
}

Eigen::Index modes_used(const ShapePrior& prior, const ShapeFitOptions& options) {
  const auto known = static_cast<std::int64_t>(prior.mode_count());
  return static_cast<Eigen::Index>(options.modes > 0 ? std::min(options.modes, known) : known);
}

double root_mean_square_radius(const Eigen::Matrix3Xd& points) {
  const Eigen::Vector3d middle = points.rowwise().mean();
  double sum = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i) sum += (points.col(i) - middle).squaredNorm();
  return std::sqrt(sum / static_cast<double>(points.cols()));
}

Parts surface_of(const ShapePrior& prior, Eigen::Index modes) {
  Parts parts;
  parts.mean = {columns(prior.points), columns(prior.normals)};
  const Eigen::Index m = parts.mean.points.cols();
  parts.modes.resize(3 * m, modes);
  for (Eigen::Index mode = 0; mode < modes; ++mode) {
    for (Eigen::Index i = 0; i < m; ++i)
      parts.modes.block<3, 1>(3 * i, mode) = eigen(prior.point_modes[static_cast<std::size_t>(mode * m + i)]);
  }
  parts.radius = root_mean_square_radius(parts.mean.points);
  return parts;
}

Parts balls_of_model(const ShapePrior& prior, Eigen::Index modes) {
  Parts parts;
  parts.mean.points = columns(prior.centers);
  const Eigen::Index k = parts.mean.points.cols();
  parts.modes.resize(3 * k, modes);
  parts.value_modes.resize(k, modes);
  parts.values.resize(k);
  for (Eigen::Index i = 0; i < k; ++i) parts.values[i] = logarithm(prior.radii[static_cast<std::size_t>(i)]);
  parts.value_unit = Eigen::VectorXd::Constant(k, prior.radius_unit);
  for (Eigen::Index mode = 0; mode < modes; ++mode) {
    for (Eigen::Index i = 0; i < k; ++i) {
      const auto& [x, y, z, growth] = prior.modes[static_cast<std::size_t>(mode * k + i)];
      parts.modes.block<3, 1>(3 * i, mode) = Eigen::Vector3d(x, y, z);
      parts.value_modes(i, mode) = growth;
    }
  }
  parts.radius = root_mean_square_radius(parts.mean.points);
  return parts;
}

/// The rotation by about this vector; exactly one, without sine and cosine.
Eigen::Matrix3d turn(const Eigen::Vector3d& by) {
  const double w = 1, length = std::sqrt(w + by.squaredNorm() / 4);
  return Eigen::Quaterniond(w / length, by[0] / (2 * length), by[1] / (2 * length), by[2] / (2 * length))
      .toRotationMatrix();
}

Eigen::Matrix3d crossing(const Eigen::Vector3d& v) {
  Eigen::Matrix3d matrix;
  matrix << 0, -v[2], v[1], v[2], 0, -v[0], -v[1], v[0], 0;
  return matrix;
}

/// Scores b and a pose, to the coordinates of the observation, by turns of expectation and least squares.
class Fitter {
 public:
  Fitter(const Parts& parts, const Observation& observation, const ShapeFitOptions& options)
      : parts_(parts), observation_(observation), options_(options), shape_(parts.mean) {
    scores_ = Eigen::VectorXd::Zero(parts.modes.cols());
    const double start = options.width / 100 * parts.radius;
    noise_.squared_width = start * start;
  }

  void start(const Superposition& to_observation) {
    pose_ = to_observation;
    const Eigen::Matrix3Xd points = in_model().points;
    const Eigen::Vector3d low = points.rowwise().minCoeff().cwiseMin(shape_.points.rowwise().minCoeff());
    const Eigen::Vector3d high = points.rowwise().maxCoeff().cwiseMax(shape_.points.rowwise().maxCoeff());
    noise_.volume = ((high - low).array() + narrowest * parts_.radius).prod();
  }

  void run(Monitor& monitor) {
    for (iterations_ = 0; iterations_ < options_.iterations && !converged_; ++iterations_) {
      monitor.step(static_cast<double>(iterations_) / options_.iterations);
      const Correspondence pairs = expect(monitor);
      if (!(pairs.total > 0)) break;
      solve(pairs);
      update_noise(expect(monitor));
    }
  }

  /// Fills what is known of scores, pose and distances.
  void tell(ShapeFit& fit, Monitor& monitor);

  const Superposition& pose() const { return pose_; }
  const Eigen::VectorXd& scores() const { return scores_; }
  /// Of scores, rotation, translation and scale, from the last system.
  const Eigen::MatrixXd& covariance() const { return covariance_; }
  const std::vector<double>& explained() const { return explained_; }

 private:
  OrientedPoints in_model() const {
    const Superposition back = inverse(pose_);
    OrientedPoints result;
    result.points = transformed(back, observation_.points.points);
    result.normals = back.rotation * observation_.points.normals;
    return result;
  }

  Correspondence expect(Monitor& monitor) {
    Correspondence pairs = expectation(shape_, in_model(), observation_.values, noise_, monitor);
    explained_ = pairs.explained;
    return pairs;
  }

  /// One Gauss-Newton step from the present shape: the derivative of part i is that of its modes, of a turn,
  /// a shift and a growth of the whole.
  void solve(const Correspondence& pairs) {
    const Eigen::Index q = scores_.size(), unknowns = q + 6 + (options_.scale ? 1 : 0);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(unknowns, unknowns);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    Eigen::MatrixXd row(3, unknowns);
    const double temper = std::min(1.0, options_.effective / pairs.total);
    const double precision = temper / noise_.squared_width;
    const double log_scale = logarithm(pose_.scale);
    for (Eigen::Index i = 0; i < pairs.mass.size(); ++i) {
      const double mass = pairs.mass[i];
      if (!(mass > 0)) continue;
      const Eigen::Vector3d here = shape_.points.col(i);
      row.leftCols(q) = parts_.modes.middleRows<3>(3 * i);
      row.middleCols<3>(q) = -crossing(here);
      row.middleCols<3>(q + 3) = Eigen::Matrix3d::Identity();
      if (options_.scale) row.col(q + 6) = here;
      Eigen::Matrix3d weight = Eigen::Matrix3d::Identity();
      if (shape_.normals.cols() > 0) {
        const Eigen::Vector3d n = shape_.normals.col(i);
        weight = along_plane * weight + (1 - along_plane) * (n * n.transpose());
      }
      const Eigen::Vector3d residual = pairs.sums.col(i) - mass * here;
      const Eigen::MatrixXd weighted = (precision * weight) * row;
      normal.noalias() += mass * weighted.transpose().lazyProduct(row);
      right += weighted.transpose().lazyProduct(residual);
      if (parts_.values.size() == 0) continue;
      Eigen::VectorXd values = Eigen::VectorXd::Zero(unknowns);
      values.head(q) = parts_.value_modes.row(i).transpose();
      if (options_.scale) values[q + 6] = 1;
      const double unit = parts_.value_unit[i] * parts_.value_unit[i] * precision;
      const double expected = parts_.values[i] + parts_.value_modes.row(i).dot(scores_);
      normal += (mass * unit) * values * values.transpose();
      right += unit * (pairs.value_sums[i] - mass * (log_scale + expected)) * values;
    }
    // Before the pose is found, scores would explain what is wrong with it.
    const double beforehand = iterations_ < steps_of_pose ? held : 1;
    for (Eigen::Index mode = 0; mode < q; ++mode) {
      normal(mode, mode) += beforehand;
      right[mode] -= beforehand * scores_[mode];
    }
    // A turn around an axis of the observation may be free: nothing is drawn there then.
    const double little = 1e-9 * normal.diagonal().tail(unknowns - q).maxCoeff();
    for (Eigen::Index i = q; i < unknowns; ++i)
      normal(i, i) += little * (i < q + 3 || i == q + 6 ? parts_.radius * parts_.radius : 1);
    const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
    const Eigen::VectorXd step = factors.solve(right);
    covariance_ = factors.solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();

    scores_ += step.head(q);
    moved_ = std::max(step.segment<3>(q).norm(), step.segment<3>(q + 3).norm() / parts_.radius);
    if (q > 0) moved_ = std::max(moved_, step.head(q).cwiseAbs().maxCoeff());
    const Eigen::Matrix3d rotation = turn(step.segment<3>(q));
    const double growth = options_.scale ? std::clamp(1 + step[q + 6], 0.5, 2.0) : 1;
    // Turned, grown and shifted in the coordinates of the model, then as before.
    pose_.translation += pose_.scale * (pose_.rotation * step.segment<3>(q + 3));
    pose_.rotation = (pose_.rotation * rotation).eval();
    pose_.scale *= growth;
    for (Eigen::Index i = 0; i < shape_.points.cols(); ++i) {
      shape_.points.col(i) = parts_.mean.points.col(i);
      for (Eigen::Index mode = 0; mode < q; ++mode)
        shape_.points.col(i) += scores_[mode] * parts_.modes.block<3, 1>(3 * i, mode);
    }
  }

  void update_noise(const Correspondence& pairs) {
    const double least = narrowest * narrowest * parts_.radius * parts_.radius;
    const double width =
        pairs.total > 0 ? std::max(least, pairs.squares / (3 * pairs.total)) : noise_.squared_width;
    converged_ = iterations_ > steps_of_pose && moved_ <= at_rest &&
                 std::abs(width - noise_.squared_width) <= standstill * noise_.squared_width;
    // It may only become narrower: a shape that has lost its observation does not look for it everywhere. And
    // not at once: pairs that are decided early are wrong.
    noise_.squared_width = std::max(slowest * noise_.squared_width, std::min(width, noise_.squared_width));
    const double count = static_cast<double>(observation_.points.points.cols());
    noise_.outliers = std::clamp(1 - pairs.total / count, fewest_outliers, most_outliers);
  }

  const Parts& parts_;
  const Observation& observation_;
  const ShapeFitOptions& options_;
  OrientedPoints shape_;
  Superposition pose_;  // from the model to the observation
  Eigen::VectorXd scores_;
  Eigen::MatrixXd covariance_;
  FitNoise noise_;
  std::vector<double> explained_;
  double moved_ = 0;  // by the last step: scores, radians, radii
  int iterations_ = 0;
  bool converged_ = false;
};

void Fitter::tell(ShapeFit& fit, Monitor& monitor) {
  const Correspondence pairs = expect(monitor);
  const OrientedPoints observed = in_model();
  double squares = 0, total = 0;
  for (Eigen::Index j = 0; j < observed.points.cols(); ++j) {
    Eigen::Index nearest = 0;
    (shape_.points.colwise() - observed.points.col(j)).colwise().squaredNorm().minCoeff(&nearest);
    const Eigen::Vector3d difference = observed.points.col(j) - shape_.points.col(nearest);
    const double distance =
        shape_.normals.cols() > 0 ? difference.dot(shape_.normals.col(nearest)) : difference.norm();
    const double weight = pairs.explained[static_cast<std::size_t>(j)];
    squares += weight * distance * distance;
    total += weight;
  }
  const Eigen::Index q = scores_.size();
  fit.scores = std::vector<double>(scores_.begin(), scores_.end());
  std::vector<double> covariance;
  for (Eigen::Index i = 0; i < q; ++i) {
    for (Eigen::Index j = 0; j < q; ++j) covariance.push_back(covariance_(i, j));
  }
  fit.covariance = std::move(covariance);
  for (Eigen::Index r = 0; r < 3; ++r) {
    for (Eigen::Index c = 0; c < 3; ++c)
      fit.pose[static_cast<std::size_t>(4 * r + c)] = pose_.scale * pose_.rotation(r, c);
    fit.pose[static_cast<std::size_t>(4 * r + 3)] = pose_.translation[r];
  }
  fit.residual = total > 0 ? pose_.scale * std::sqrt(squares / total) : 0;
  fit.outliers = std::clamp(1 - total / static_cast<double>(observed.points.cols()), 0.0, 1.0);
  fit.mahalanobis = q > 0 ? std::sqrt(scores_.squaredNorm() / static_cast<double>(q)) : 0;
  fit.noise = pose_.scale * std::sqrt(noise_.squared_width);
  fit.observed = observed.points.cols();
  fit.iterations = iterations_;
  fit.converged = converged_ ? 1 : 0;
}

void place_balls(const ShapePrior& prior, const Fitter& fitter, ShapeFit& fit) {
  const Eigen::Index q = fitter.scores().size(), unknowns = fitter.covariance().cols();
  const Balls balls = shape_instance(prior, fit.scores);
  const Superposition& pose = fitter.pose();
  std::vector<Vec3> centers;
  std::vector<double> radii, deviations;
  Eigen::MatrixXd row(3, unknowns);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Eigen::Vector3d center = eigen(balls.centers[i]);
    for (Eigen::Index mode = 0; mode < q; ++mode) {
      const auto& [x, y, z, growth] = prior.modes[static_cast<std::size_t>(mode) * balls.size() + i];
      row.col(mode) = Eigen::Vector3d(x, y, z);
    }
    row.middleCols<3>(q) = -crossing(center);
    row.middleCols<3>(q + 3) = Eigen::Matrix3d::Identity();
    if (unknowns > q + 6) row.col(q + 6) = center;
    const double variance = row.lazyProduct(fitter.covariance()).eval().cwiseProduct(row).sum();
    centers.push_back(vec(pose.scale * (pose.rotation * center) + pose.translation));
    radii.push_back(pose.scale * balls.radii[i]);
    deviations.push_back(pose.scale * std::sqrt(std::max(0.0, variance)));
  }
  fit.centers = std::move(centers);
  fit.radii = std::move(radii);
  fit.deviations = std::move(deviations);
}

void warn_where_far(const ShapePrior& prior, const ShapeFit& fit, Monitor& monitor) {
  const auto part = [](double x) { return std::to_string(std::lround(100 * x)) + " %"; };
  if (fit.outliers > 0.5) {
    monitor.warn(
        part(fit.outliers) +
        " of the observation are explained by no part of the shape: it lies elsewhere, or is another "
        "shape. Look at the pose it starts from");
  }
  if (fit.expected > 0 && fit.residual > far_residual * fit.expected) {
    monitor.warn("the observation is " + std::to_string(fit.residual / fit.expected) +
                 " times as far from the fitted shape as unknown instances are from their models: another "
                 "shape, or a wrong pose");
  }
  for (std::size_t mode = 0; mode < fit.scores.size(); ++mode) {
    if (std::abs(fit.scores[mode]) > far_scores) {
      monitor.warn("mode " + std::to_string(mode) + " has the score " + std::to_string(fit.scores[mode]) +
                   ", beyond the instances of the model: the shape is an extrapolation");
    }
  }
  if (fit.converged == 0)
    monitor.warn("the fit has not come to rest after " + std::to_string(fit.iterations) +
                 " steps: raise iterations");
  (void)prior;
}

ShapeFit fitted(const ShapePrior& prior, const Parts& parts, const Observation& observation,
                const std::optional<ShapePose>& start, const ShapeFitOptions& options, Monitor& monitor) {
  if (observation.points.points.cols() < 4) {
    throw InputError(std::to_string(observation.points.points.cols()) + " points or balls do not tell a pose",
                     "give at least 4, better some hundreds");
  }
  Superposition pose;
  if (start) {
    if (start->mirrored != 0)
      throw InputError("the start mirrors the observation", "mirror the observation before it is fitted");
    Superposition to_model;
    for (Eigen::Index r = 0; r < 3; ++r) {
      for (Eigen::Index c = 0; c < 3; ++c)
        to_model.rotation(r, c) = start->rotation[static_cast<std::size_t>(3 * r + c)];
    }
    to_model.scale = start->scale;
    to_model.translation = eigen(start->translation);
    pose = inverse(to_model);
  }
  Fitter fitter(parts, observation, options);
  fitter.start(pose);
  fitter.run(monitor);
  ShapeFit fit;
  if (fitter.covariance().size() == 0) {
    throw InputError("no part of the observation is near the model, as it lies",
                     "align it first, and connect the pose; or raise width");
  }
  fitter.tell(fit, monitor);
  place_balls(prior, fitter, fit);
  const auto modes = static_cast<std::size_t>(fitter.scores().size());
  if (!prior.generalization.empty())
    fit.expected = prior.generalization[std::min(modes, prior.generalization.size() - 1)];
  warn_where_far(prior, fit, monitor);
  return fit;
}

}  // namespace

ShapeFit shape_fit(const ShapePrior& prior, const PointSet& observation,
                   const std::optional<ShapePose>& start, const ShapeFitOptions& options, Monitor& monitor) {
  if (prior.points.size() < 4) {
    throw InputError("the model has " + std::to_string(prior.points.size()) + " surface points",
                     "match with surface points when the model is made, or fit it to balls");
  }
  const std::size_t n = observation.points.size();
  const std::size_t most = std::min(n, static_cast<std::size_t>(options.points));
  std::vector<Vec3> points, normals;
  for (std::size_t i = 0; i < most; ++i) {
    const std::size_t at = i * n / most;
    points.push_back(observation.points[at]);
    if (!observation.normals.empty()) normals.push_back(observation.normals[at]);
  }
  return fitted(prior, surface_of(prior, modes_used(prior, options)),
                {{columns(points), columns(normals)}, {}}, start, options, monitor);
}

ShapeFit shape_fit(const ShapePrior& prior, const Balls& observation, const std::optional<ShapePose>& start,
                   const ShapeFitOptions& options, Monitor& monitor) {
  std::vector<double> sorted(observation.radii.begin(), observation.radii.end());
  std::sort(sorted.begin(), sorted.end());
  const double least = sorted.empty() ? 0 : tiny_ball * sorted[sorted.size() / 2];
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (std::size_t i = 0; i < observation.size(); ++i) {
    if (!(observation.radii[i] > 0) || observation.radii[i] < least) continue;
    centers.push_back(observation.centers[i]);
    radii.push_back(logarithm(observation.radii[i]));
  }
  Observation observed;
  observed.points.points = columns(centers);
  observed.values = Eigen::Map<const Eigen::VectorXd>(radii.data(), static_cast<Eigen::Index>(radii.size()));
  return fitted(prior, balls_of_model(prior, modes_used(prior, options)), observed, start, options, monitor);
}

Balls balls_of(const ShapeFit& fit) {
  Balls balls;
  balls.centers = fit.centers;
  balls.radii = fit.radii;
  return balls;
}

PointSet points_of(const ShapePrior& prior, const ShapeFit& fit) {
  const PointSet own = instance_points(prior, fit.scores);
  std::vector<Vec3> points;
  const auto& t = fit.pose;
  for (const Vec3& p : own.points) {
    points.push_back({t[0] * p.x + t[1] * p.y + t[2] * p.z + t[3],
                      t[4] * p.x + t[5] * p.y + t[6] * p.z + t[7],
                      t[8] * p.x + t[9] * p.y + t[10] * p.z + t[11]});
  }
  PointSet result;
  result.points = std::move(points);
  return result;
}

}  // namespace ballflow::geometry
