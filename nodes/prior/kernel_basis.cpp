#include "prior/kernel_basis.hpp"

#include <cmath>

#include "exact/exponential.hpp"

namespace ballflow::geometry {

KernelBasis::KernelBasis(std::span<const Vec3> points, double width, double tolerance, std::size_t most_rank,
                         Monitor& monitor) {
  const std::size_t n = points.size();
  std::vector<double> rest(n, 1.0);
  std::vector<std::vector<double>> columns;
  const double factor = -1 / (2 * width * width);
  Lookout look(monitor);
  while (columns.size() < std::min(n, most_rank)) {
    std::size_t pivot = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (rest[i] > rest[pivot]) pivot = i;
    if (!(rest[pivot] > tolerance)) break;
    look(n * (columns.size() + 8));
    const double root = std::sqrt(rest[pivot]);
    std::vector<double> column(n);
    for (std::size_t i = 0; i < n; ++i)
      column[i] = exponential(factor * squared_distance(points[i], points[pivot]));
    for (const std::vector<double>& earlier : columns) {
      const double at_pivot = earlier[pivot];
      for (std::size_t i = 0; i < n; ++i) column[i] -= earlier[i] * at_pivot;
    }
    for (std::size_t i = 0; i < n; ++i) column[i] /= root;
    column[pivot] = root;
    for (const std::size_t taken : pivots_) column[taken] = 0;  // as it is but for rounding
    for (std::size_t i = 0; i < n; ++i) rest[i] -= column[i] * column[i];
    rest[pivot] = 0;
    pivots_.push_back(pivot);
    columns.push_back(std::move(column));
  }
  rank_ = columns.size();
  values_.resize(n * rank_);
  for (std::size_t k = 0; k < rank_; ++k)
    for (std::size_t i = 0; i < n; ++i) values_[i * rank_ + k] = columns[k][i];
}

}  // namespace ballflow::geometry
