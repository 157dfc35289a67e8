#include "prior/fit_expectation.hpp"

#include <cmath>

#include "base/arctangent.hpp"
#include "base/for_each_block.hpp"
#include "exact/exponential.hpp"

namespace ballflow::geometry {
namespace {

constexpr double farthest = 49;             // squared widths
constexpr double squared_turn = 0.7 * 0.7;  // of normals, as 1 - cosine

}  // namespace

Correspondence expectation(const OrientedPoints& parts, const OrientedPoints& observed,
                           const Eigen::VectorXd& values, const FitNoise& noise, Monitor& monitor) {
  constexpr std::size_t block_size = 64;
  const Eigen::Index m = parts.points.cols();
  const auto n = static_cast<std::size_t>(observed.points.cols());
  const bool turned = parts.normals.cols() > 0 && observed.normals.cols() > 0;
  // The density of outliers against that of a part, without the factor of the Gaussians.
  const double width = std::sqrt(2 * pi * noise.squared_width);
  const double anywhere =
      noise.outliers / (1 - noise.outliers) * width * width * width * static_cast<double>(m) / noise.volume;

  Correspondence all;
  all.explained.resize(n);
  std::vector<Correspondence> blocks(blocks_of(n, block_size));
  for_each_block(n, block_size, monitor, 0, 0, [&](std::size_t b, std::size_t first, std::size_t last) {
    Correspondence& block = blocks[b];
    block.mass = Eigen::VectorXd::Zero(m);
    block.sums = Eigen::Matrix3Xd::Zero(3, m);
    block.value_sums = Eigen::VectorXd::Zero(values.size() > 0 ? m : 0);
    std::vector<std::pair<Eigen::Index, double>> near;
    for (std::size_t i = first; i < last; ++i) {
      const auto point = static_cast<Eigen::Index>(i);
      const Eigen::Vector3d x = observed.points.col(point);
      near.clear();
      double sum = anywhere;
      for (Eigen::Index part = 0; part < m; ++part) {
        const double squared = (x - parts.points.col(part)).squaredNorm();
        if (squared > farthest * noise.squared_width) continue;
        double exponent = -squared / (2 * noise.squared_width);
        if (turned) exponent -= (1 - observed.normals.col(point).dot(parts.normals.col(part))) / squared_turn;
        near.emplace_back(part, exponential(exponent));
        sum += near.back().second;
      }
      double explained = 0;
      for (const auto& [part, density] : near) {
        const double probability = density / sum;
        explained += probability;
        block.mass[part] += probability;
        block.sums.col(part) += probability * x;
        if (values.size() > 0) block.value_sums[part] += probability * values[point];
        block.squares += probability * (x - parts.points.col(part)).squaredNorm();
      }
      all.explained[i] = explained;
      block.total += explained;
    }
  });
  all.mass = Eigen::VectorXd::Zero(m);
  all.sums = Eigen::Matrix3Xd::Zero(3, m);
  all.value_sums = Eigen::VectorXd::Zero(values.size() > 0 ? m : 0);
  for (const Correspondence& block : blocks) {
    all.mass += block.mass;
    all.sums += block.sums;
    all.value_sums += block.value_sums;
    all.total += block.total;
    all.squares += block.squares;
  }
  return all;
}

}  // namespace ballflow::geometry
