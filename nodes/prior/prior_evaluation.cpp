#include "prior/prior_evaluation.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "base/random.hpp"
#include "exact/exponential.hpp"
#include "search/box_tree.hpp"
#include "search/surface_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 vec(const Eigen::Vector3d& p) { return {p[0], p[1], p[2]}; }

/// The distance of points from one surface.
class SurfaceDistance {
 public:
  SurfaceDistance(const InstanceSurface& surface, Monitor& monitor)
      : points_(surface.matched->samples.empty() ? surface.matched->points : surface.matched->samples),
        normals_(surface.matched->samples.empty() ? surface.matched->normals
                                                  : surface.matched->sample_normals),
        mirrored_(surface.matched->mirrored != 0) {
    if (surface.mesh != nullptr) {
      mesh_ = std::make_unique<SurfaceTree>(*surface.mesh, monitor);
    } else {
      tree_ = BoxTree(points_.span());
    }
  }

  double operator()(Vec3 p) const {
    if (mirrored_) p.x = -p.x;
    if (mesh_) {
      const auto nearest = mesh_->nearest(p, infinity);
      return nearest ? nearest->distance : 0;
    }
    double least = infinity;
    std::size_t at = 0;
    tree_.smallest(p, infinity, -infinity, [&](std::size_t i) {
      const double d = distance(p, points_[i]);
      if (d < least || (d == least && i < at)) least = d, at = i;
      return d;
    });
    return std::abs(dot(p - points_[at], normals_[at]));
  }

 private:
  Array<Vec3> points_, normals_;
  bool mirrored_;
  std::unique_ptr<SurfaceTree> mesh_;
  BoxTree tree_;
};

double labelled_distance(const LabelledPoints& a, const LabelledPoints& b) {
  double sum = 0;
  for (Eigen::Index i = 0; i < a.cols(); ++i) sum += (a.col(i) - b.col(i)).norm();
  return sum / static_cast<double>(a.cols());
}

/// What distances of shapes are taken of.
const LabelledPoints& compared(const LabelledShape& shape) {
  return shape.points.cols() > 0 ? shape.points : shape.centers;
}

ModeCurve curve_of(const std::vector<std::vector<double>>& rows) {
  ModeCurve curve;
  std::size_t length = rows.empty() ? 0 : rows[0].size();
  for (const auto& row : rows) length = std::min(length, row.size());
  const double n = static_cast<double>(rows.size());
  for (std::size_t j = 0; j < length; ++j) {
    double sum = 0, squares = 0;
    for (const auto& row : rows) sum += row[j];
    const double mean = sum / n;
    for (const auto& row : rows) squares += (row[j] - mean) * (row[j] - mean);
    curve.mean.push_back(mean);
    curve.deviation.push_back(rows.size() < 2 ? 0 : std::sqrt(squares / (n - 1)));
  }
  return curve;
}

/// Standard normal numbers, by Marsaglia's polar method.
class Normal {
 public:
  explicit Normal(std::uint64_t seed) : random_(seed) {}
  double operator()() {
    if (second_ready_) {
      second_ready_ = false;
      return second_;
    }
    for (;;) {
      const double x = 2 * random_.unit() - 1, y = 2 * random_.unit() - 1, square = x * x + y * y;
      if (square >= 1 || square == 0) continue;
      const double factor = std::sqrt(-2 * logarithm(square) / square);
      second_ = y * factor;
      second_ready_ = true;
      return x * factor;
    }
  }

 private:
  Random random_;
  double second_ = 0;
  bool second_ready_ = false;
};

}  // namespace

SurfaceMeasure measure_of(std::span<const InstanceSurface> surfaces) {
  const bool meshes = std::all_of(surfaces.begin(), surfaces.end(), [](const InstanceSurface& surface) {
    return surface.mesh != nullptr && !surface.mesh->triangles.empty();
  });
  if (surfaces.empty() || surfaces[0].matched->points.empty()) return SurfaceMeasure::labels;
  return meshes ? SurfaceMeasure::meshes : SurfaceMeasure::planes;
}

ModeCurve generalization(std::span<const LabelledShape> instances, std::span<const InstanceSurface> surfaces,
                         const ShapeModelOptions& options, Monitor& monitor) {
  const std::size_t n = instances.size();
  const SurfaceMeasure measure = measure_of(surfaces);
  std::vector<std::vector<double>> rows(n);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, n, [&](std::size_t left_out) {
    std::vector<LabelledShape> rest;
    for (std::size_t i = 0; i < n; ++i) {
      if (i != left_out) rest.push_back(instances[i]);
    }
    monitor.step(static_cast<double>(done) / static_cast<double>(n));
    const ShapeModel model = shape_model(rest, options);
    InstanceSurface surface = surfaces[left_out];
    if (measure != SurfaceMeasure::meshes) surface.mesh = nullptr;
    std::unique_ptr<SurfaceDistance> from_surface;
    const double part = static_cast<double>(done) / static_cast<double>(n);
    PartMonitor building(monitor, part, part);
    if (measure != SurfaceMeasure::labels)
      from_surface = std::make_unique<SurfaceDistance>(surface, building);
    for (Eigen::Index modes = 0; modes <= model.linear.size(); ++modes) {
      monitor.step(static_cast<double>(done) / static_cast<double>(n));
      const Projection projection = project(model, instances[left_out], modes);
      const LabelledShape nearest = transformed(
          inverse(projection.pose), shape_of(vector_of(model.linear, projection.scores), model.balls));
      if (!from_surface) {
        rows[left_out].push_back(labelled_distance(compared(nearest), compared(instances[left_out])));
        continue;
      }
      double sum = 0;
      for (Eigen::Index i = 0; i < nearest.points.cols(); ++i)
        sum += (*from_surface)(vec(nearest.points.col(i)));
      rows[left_out].push_back(sum / static_cast<double>(nearest.points.cols()));
    }
    ++done;
  });
  return curve_of(rows);
}

ModeCurve specificity(std::span<const LabelledShape> instances, const ShapeModel& model, std::int64_t draws,
                      Monitor& monitor) {
  std::vector<LabelledShape> known;
  for (std::size_t i = 0; i < instances.size(); ++i)
    known.push_back(transformed(model.poses[i], instances[i]));
  std::vector<Eigen::VectorXd> scores;
  Normal normal(0);
  for (std::int64_t draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd row(model.linear.size());
    for (Eigen::Index mode = 0; mode < row.size(); ++mode) row[mode] = normal();
    scores.push_back(std::move(row));
  }
  std::vector<std::vector<double>> rows(scores.size());
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t{0}, scores.size(), [&](std::size_t draw) {
    Eigen::VectorXd vector = model.linear.mean;
    for (Eigen::Index mode = 0; mode < model.linear.size(); ++mode) {
      monitor.step(static_cast<double>(done) / static_cast<double>(scores.size()));
      vector += scores[draw][mode] * model.linear.modes.col(mode);
      const LabelledShape shape = shape_of(vector, model.balls);
      double least = infinity;
      for (const LabelledShape& one : known)
        least = std::min(least, labelled_distance(compared(shape), compared(one)));
      rows[draw].push_back(least);
    }
    ++done;
  });
  return curve_of(rows);
}

}  // namespace ballflow::geometry
