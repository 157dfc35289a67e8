#include "prior/drift.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/arctangent.hpp"
#include "base/for_each_block.hpp"
#include "exact/exponential.hpp"
#include "prior/kernel_basis.hpp"

namespace ballflow::geometry {
namespace {

constexpr double kernel_tolerance = 1e-5;  // remainder of the kernel beside its diagonal, 1
constexpr double negligible = 36;          // e^-36: what is less than this of a weight of 1 is none
constexpr double least_deviation = 1e-4;   // equal shapes come as near as this
constexpr std::size_t fewest_targets = 64, most_blocks = 64;  // every block has sums for all points

/// What the targets tell of every point of the template.
struct Expectation {
  explicit Expectation(std::size_t n) : weight(n), target(n), normal(n) {}
  std::vector<double> weight;  // sum of the probabilities of its pairs
  std::vector<Vec3> target;    // sum of probability * target
  std::vector<Vec3> normal;    // the same of the targets' normals
  double squares = 0;          // sum of probability * |target - point|^2
};

void expect(const DriftGroup& group, std::span<const Vec3> points, double variance,
            const DriftOptions& options, Monitor& monitor, double done, Expectation& sum) {
  const std::size_t n = group.count, m = group.targets.size();
  if (n == 0 || m == 0) return;
  const bool normals = !group.normals.empty() && !group.target_normals.empty();
  const double two_pi_variance = 2 * pi * variance;
  const double noise = two_pi_variance * std::sqrt(two_pi_variance) * options.outliers /
                       (1 - options.outliers) * static_cast<double>(n) / static_cast<double>(m);
  const double by_distance = 1 / (2 * variance), by_normal = 1 / (options.normals * options.normals);
  const std::size_t block = std::max(fewest_targets, blocks_of(m, most_blocks));
  std::vector<Expectation> parts(blocks_of(m, block), Expectation(0));
  for_each_block(m, block, monitor, done, done, [&](std::size_t b, std::size_t first, std::size_t last) {
    Expectation part(n);
    std::vector<std::pair<std::size_t, double>> near;
    for (std::size_t j = first; j < last; ++j) {
      const Vec3 x = group.targets[j];
      near.clear();
      double total = noise;
      for (std::size_t i = 0; i < n; ++i) {
        double exponent = by_distance * squared_distance(points[group.first + i], x);
        if (exponent > negligible) continue;
        if (normals) {
          exponent += by_normal * (1 - dot(group.normals[i], group.target_normals[j]));
          if (exponent > negligible) continue;
        }
        const double p = exponential(-exponent);
        total += p;
        near.emplace_back(i, p);
      }
      if (!(total > 0)) continue;
      for (const auto& [i, weight] : near) {
        const double p = weight / total;
        part.weight[i] += p;
        part.target[i] = part.target[i] + p * x;
        if (!group.target_normals.empty()) part.normal[i] = part.normal[i] + p * group.target_normals[j];
        part.squares += p * squared_distance(points[group.first + i], x);
      }
    }
    parts[b] = std::move(part);
  });
  for (const Expectation& part : parts) {
    sum.squares += part.squares;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = group.first + i;
      sum.weight[at] += part.weight[i];
      sum.target[at] = sum.target[at] + part.target[i];
      sum.normal[at] = sum.normal[at] + part.normal[i];
    }
  }
}

/// A field L a that makes sum w |L_i a - d_i|^2 + stiffness |a|^2 smallest, d_i = target_i / w_i - start_i.
std::vector<Vec3> solve_points(const KernelBasis& basis, std::span<const Vec3> start, const Expectation& e,
                               double stiffness) {
  const auto r = static_cast<Eigen::Index>(basis.rank());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(r, r);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(r, 3);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double w = e.weight[i];
    if (!(w > 0)) continue;
    const std::span<const double> row = basis.row(i);
    const Vec3 d = e.target[i] - w * start[i];
    for (Eigen::Index c = 0; c < r; ++c) {
      const double l = row[static_cast<std::size_t>(c)], wl = w * l;
      double* const column = &a(0, c);
      for (Eigen::Index k = c; k < r; ++k) column[k] += wl * row[static_cast<std::size_t>(k)];
      b(c, 0) += l * d.x;
      b(c, 1) += l * d.y;
      b(c, 2) += l * d.z;
    }
  }
  for (Eigen::Index c = 0; c < r; ++c) a(c, c) += stiffness;
  const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(a);
  const Eigen::MatrixXd x = factor.solve(b);
  std::vector<Vec3> moved(start.begin(), start.end());
  for (std::size_t i = 0; i < start.size(); ++i) {
    const std::span<const double> row = basis.row(i);
    Vec3 v;
    for (Eigen::Index k = 0; k < r; ++k) {
      const double l = row[static_cast<std::size_t>(k)];
      v = v + Vec3{l * x(k, 0), l * x(k, 1), l * x(k, 2)};
    }
    moved[i] = moved[i] + v;
  }
  return moved;
}

/// The same where distances count by matrices: of a point in a group with planes, along its plane `across`
/// times as much as across.
std::vector<Vec3> solve_planes(const KernelBasis& basis, std::span<const Vec3> start, const Expectation& e,
                               std::span<const std::uint8_t> plane, double across, double stiffness) {
  const auto r = static_cast<Eigen::Index>(basis.rank());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(3 * r, 3 * r);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(3 * r);
  std::vector<double> scaled(static_cast<std::size_t>(3 * r));
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double w = e.weight[i];
    if (!(w > 0)) continue;
    const double length_of_normal = length(e.normal[i]);
    const bool flat = plane[i] != 0 && length_of_normal > 1e-9 * w;
    const Vec3 n = flat ? (1 / length_of_normal) * e.normal[i] : Vec3{};
    const double along = flat ? across : 1, extra = flat ? 1 - across : 0;
    const double nn[3] = {n.x, n.y, n.z};
    const Vec3 d = e.target[i] - w * start[i];
    const double dn = dot(d, n);
    const double rhs[3] = {along * d.x + extra * dn * n.x, along * d.y + extra * dn * n.y,
                           along * d.z + extra * dn * n.z};
    const std::span<const double> row = basis.row(i);
    // The block of axes (p, q) is w L_i' L_i times this number.
    for (int q = 0; q < 3; ++q) {
      for (int p = q; p < 3; ++p) {
        const double m = w * ((p == q ? along : 0) + extra * nn[p] * nn[q]);
        if (m == 0) continue;
        for (Eigen::Index c = 0; c < r; ++c) {
          const double ml = m * row[static_cast<std::size_t>(c)];
          double* const column = &a(p * r, q * r + c);
          const Eigen::Index from = p == q ? c : 0;
          for (Eigen::Index k = from; k < r; ++k) column[k] += ml * row[static_cast<std::size_t>(k)];
        }
      }
      for (Eigen::Index c = 0; c < r; ++c) b(q * r + c) += row[static_cast<std::size_t>(c)] * rhs[q];
    }
  }
  for (Eigen::Index c = 0; c < 3 * r; ++c) a(c, c) += stiffness;
  const Eigen::LLT<Eigen::MatrixXd, Eigen::Lower> factor(a);
  const Eigen::VectorXd x = factor.solve(b);
  std::vector<Vec3> moved(start.begin(), start.end());
  for (std::size_t i = 0; i < start.size(); ++i) {
    const std::span<const double> row = basis.row(i);
    Vec3 v;
    for (Eigen::Index k = 0; k < r; ++k) {
      const double l = row[static_cast<std::size_t>(k)];
      v = v + Vec3{l * x(k), l * x(r + k), l * x(2 * r + k)};
    }
    moved[i] = moved[i] + v;
  }
  return moved;
}

}  // namespace

Drift drift(std::span<const Vec3> points, std::span<const DriftGroup> groups, const DriftOptions& options,
            Monitor& monitor) {
  const KernelBasis basis(points, options.width, kernel_tolerance, options.most_rank, monitor);
  std::vector<std::uint8_t> plane(points.size(), 0);
  bool planes = false;
  for (const DriftGroup& group : groups) {
    if (!group.planes || group.target_normals.empty()) continue;
    planes = true;
    std::fill_n(plane.begin() + static_cast<std::ptrdiff_t>(group.first), group.count, std::uint8_t{1});
  }
  Drift result;
  result.points.assign(points.begin(), points.end());
  double variance = options.start * options.start;
  Expectation e(points.size());
  for (; result.steps < options.most_steps; ++result.steps) {
    const double done = static_cast<double>(result.steps) / options.most_steps;
    monitor.step(done);
    e = Expectation(points.size());
    for (const DriftGroup& group : groups) expect(group, result.points, variance, options, monitor, done, e);
    double weight = 0;
    for (const double w : e.weight) weight += w;
    if (!(weight > 0)) break;  // nothing is near anything
    const double stiffness = options.stiffness * variance;
    const std::vector<Vec3> moved = planes ? solve_planes(basis, points, e, plane, options.across, stiffness)
                                           : solve_points(basis, points, e, stiffness);
    // sum p |x - t'|^2 = sum p |x - t|^2 - 2 sum (t' - t) . (P x - p t) + sum p |t' - t|^2.
    double squares = e.squares;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      const Vec3 step = moved[i] - result.points[i];
      squares +=
          e.weight[i] * squared_length(step) - 2 * dot(step, e.target[i] - e.weight[i] * result.points[i]);
    }
    result.points = moved;
    const double next = std::max(squares / (3 * weight), least_deviation * least_deviation);
    const bool settled = std::abs(next - variance) <= options.stop * variance;
    variance = next;
    if (settled) break;
  }
  result.deviation = std::sqrt(variance);
  result.normals = e.normal;
  for (Vec3& n : result.normals) {
    const double l = length(n);
    n = l > 0 ? (1 / l) * n : Vec3{};
  }
  return result;
}

}  // namespace ballflow::geometry
