#include "types/shape_prior.hpp"

#include <cmath>
#include <span>

namespace ballflow::geometry {
namespace {

std::string not_finite(std::span<const double> numbers, const char* name) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!std::isfinite(numbers[i])) return std::string(name) + " " + std::to_string(i) + " is not finite";
  }
  return {};
}

std::string not_finite(std::span<const Vec3> points, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) return std::string(name) + " " + std::to_string(i) + " is not finite";
  }
  return {};
}

std::string negative(std::span<const double> numbers, const char* name) {
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!(numbers[i] >= 0)) return std::string(name) + " " + std::to_string(i) + " is negative";
  }
  return not_finite(numbers, name);
}

template <std::size_t N>
std::span<const double> flat(const Array<std::array<double, N>>& rows) {
  return {rows.empty() ? nullptr : rows.data()->data(), rows.size() * N};
}

std::string wrong_sizes(const ShapePrior& v) {
  const std::size_t k = v.balls(), m = v.points.size(), q = v.mode_count(), n = v.instances();
  if (k == 0) return "a model without balls";
  if (v.centers.size() != k) return "not as many centers as radii";
  if (v.normals.size() != m) return "not as many normals as points";
  if (std::string wrong = broken_invariant(TriangleMesh{v.vertices, v.triangles}); !wrong.empty())
    return "the mesh of the mean: " + wrong;
  if (v.modes.size() != q * k) return "the modes are not modes x balls";
  if (v.point_modes.size() != q * m) return "the modes of the points are not modes x points";
  if (v.scores.size() != n * q) return "the scores are not instances x modes";
  if (v.poses.size() != n) return "not as many poses as instances";
  if (v.generalization_deviation.size() != v.generalization.size() || v.specificity.size() != q ||
      v.specificity_deviation.size() != q)
    return "not as many deviations as means of the evaluation, or not one for each mode";
  return {};
}

}  // namespace

const char* in_words(SurfaceMeasure measure) {
  switch (measure) {
    case SurfaceMeasure::planes:
      return "tangent planes";
    case SurfaceMeasure::meshes:
      return "meshes";
    case SurfaceMeasure::labels:
      break;
  }
  return "the balls of the instance";
}

std::string broken_invariant(const ShapePrior& v) {
  if (std::string wrong = wrong_sizes(v); !wrong.empty()) return wrong;
  for (std::size_t i = 0; i < v.balls(); ++i) {
    if (!(v.radii[i] > 0)) return "the radius of ball " + std::to_string(i) + " is not above 0";
  }
  for (std::size_t j = 0; j < v.mode_count(); ++j) {
    if (!(v.variances[j] > 0)) return "the variance of mode " + std::to_string(j) + " is not above 0";
    if (j > 0 && v.variances[j] > v.variances[j - 1])
      return "mode " + std::to_string(j) + " has more variance than the one before it";
  }
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    if (!(std::abs(length(v.normals[i]) - 1) < 1e-6))
      return "normal " + std::to_string(i) + " is not of length 1";
  }
  if (!(v.point_share >= 0 && v.point_share <= 1)) return "the share of the points is not in [0, 1]";
  if (!(v.along >= 0 && v.along <= 1)) return "the weight along the surface is not in [0, 1]";
  if (!(v.radius_unit >= 0) || !std::isfinite(v.radius_unit)) return "the unit of radii is negative";
  if (!(v.total_variance >= 0) || !std::isfinite(v.total_variance)) return "the total variance is negative";
  if (v.measure > 2 || v.scaled > 1) return "measure or scaled is no choice";
  for (const std::string& wrong :
       {not_finite(v.centers, "center"), not_finite(v.radii, "radius"), not_finite(v.points, "point"),
        not_finite(flat(v.modes), "number of a mode"), not_finite(v.point_modes, "point of a mode"),
        not_finite(v.variances, "variance"), not_finite(v.scores, "score"),
        not_finite(flat(v.poses), "number of a pose"), negative(v.distances, "distance"),
        negative(v.generalization, "generalization"),
        negative(v.generalization_deviation, "deviation of the generalization"),
        negative(v.specificity, "specificity"),
        negative(v.specificity_deviation, "deviation of the specificity")}) {
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace ballflow::geometry
