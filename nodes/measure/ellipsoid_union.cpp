#include "measure/ellipsoid_union.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t faces = 8;  // of the octahedron that a sphere is split from

Vec3 unit(Vec3 v) { return (1 / length(v)) * v; }

/// Splits the faces of one sphere, whose image is the ellipsoid.
class EllipsoidSampler {
 public:
  EllipsoidSampler(const EllipsoidUnion& all, double spacing, double tolerance, Budget& budget,
                   Monitor& monitor, std::size_t i)
      : all_(all),
        spacing_(spacing),
        tolerance_(tolerance),
        budget_(budget),
        look_(monitor),
        own_(all[i]),
        i_(i) {
    const Vec3 r = own_.radii();
    volume_ = r.x * r.y * r.z;
    all.for_neighbours(i, [&](std::size_t j) {
      if (j != i) near_.push_back(j);
    });
    // The large ones first: most of what is deep inside another is so in one of these.
    std::sort(near_.begin(), near_.end(), [&](std::size_t j, std::size_t k) {
      const double one = all[j].shortest(), other = all[k].shortest();
      return one != other ? one > other : j < k;
    });
  }

  std::size_t ellipsoid() const { return i_; }

  void sample(std::size_t face, BoundarySamples& samples) {
    samples_ = &samples;
    const auto sign = [face](std::size_t bit) { return (face & bit) != 0 ? 1.0 : -1.0; };
    split({sign(4), 0, 0}, {0, sign(2), 0}, {0, 0, sign(1)}, 0.5, 0, near_.size());
    budget_.spend(unpaid_);
    unpaid_ = 0;
  }

 private:
  /// A triangle of a face |x| + |y| + |z| = 1; the ellipsoids that may contain some of its image are in
  /// near_[first .. last), the end of near_.
  void split(Vec3 a, Vec3 b, Vec3 c, double weight, std::size_t first, std::size_t last) {
    look_(64 * (1 + last - first));
    const Vec3 centroid = (1.0 / 3) * (a + b + c), direction = unit(centroid);
    const double reach =
        own_.longest() *
        std::max({distance(unit(a), direction), distance(unit(b), direction), distance(unit(c), direction)});
    const Vec3 position = own_.at(direction);
    const double deep = -reach - tolerance_;
    double depth = infinity;
    for (std::size_t k = first; k < last && depth >= deep; ++k) {
      const Ellipsoid& other = all_[near_[k]];
      if (!other.contains(position)) {
        // It is not in it, and how far it is from it matters for the parts alone.
        if (other.distance_at_least(position) < reach + tolerance_) near_.push_back(near_[k]);
        continue;
      }
      depth = std::min(depth, other.signed_distance(position));
      near_.push_back(near_[k]);
    }
    const std::size_t end = near_.size();
    if (depth >= deep) {
      if (++unpaid_ == 256) {
        budget_.spend(unpaid_);
        unpaid_ = 0;
      }
      if (reach <= spacing_) {
        add(position, direction, weight, length(centroid), depth);
      } else {
        const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
        split(a, ab, ca, weight / 4, last, end);
        split(ab, b, bc, weight / 4, last, end);
        split(ca, bc, c, weight / 4, last, end);
        split(ab, bc, ca, weight / 4, last, end);
      }
    }
    near_.resize(last);
  }

  void add(Vec3 position, Vec3 direction, double weight, double norm, double depth) {
    const Vec3 r = own_.radii();
    // A linear map A takes an element of area with the normal n to one of det A |A^-T n| times its area.
    const double stretch = volume_ * length({direction.x / r.x, direction.y / r.y, direction.z / r.z});
    samples_->positions.push_back(position);
    samples_->areas.push_back(stretch * weight / (norm * norm * norm));
    samples_->on_boundary.push_back(depth >= -tolerance_ ? 1 : 0);
  }

  const EllipsoidUnion& all_;
  double spacing_, tolerance_;
  Budget& budget_;
  Lookout look_;
  const Ellipsoid& own_;
  std::size_t i_;
  double volume_ = 0;
  std::vector<std::size_t> near_;  // a stack: the lists of all parts from the whole to the one that is split
  BoundarySamples* samples_ = nullptr;
  std::int64_t unpaid_ = 0;
};

}  // namespace

EllipsoidUnion::EllipsoidUnion(const Ellipsoids& ellipsoids) {
  std::vector<double> slacks;
  for (std::size_t i = 0; i < ellipsoids.size(); ++i) {
    items_.emplace_back(ellipsoids, i);
    boxes_.push_back(bounding_box(ellipsoids, i));
    slacks.push_back(items_.back().shortest() + 0x1p-40 * items_.back().longest());
  }
  tree_ = BoxTree(std::span<const Box>(boxes_));
  tree_.set_slacks(slacks);
}

double EllipsoidUnion::depth(Vec3 p, double enough, std::size_t except) const {
  double best = infinity;
  return tree_.smallest(p, infinity, enough, [&](std::size_t i) {
    if (i == except || items_[i].distance_at_least(p) > best) return infinity;
    // Not below what its box says, so that the order of looking does not matter.
    return best = std::min(best, std::max(items_[i].signed_distance(p), distance_to_box(boxes_[i], p) -
                                                                            items_[i].shortest() -
                                                                            0x1p-40 * items_[i].longest()));
  });
}

BoundarySamples boundary_samples(const EllipsoidUnion& all, double spacing, double tolerance, Budget& budget,
                                 Monitor& monitor) {
  const auto parts = by_blocks<BoundarySamples>(
      faces * all.size(), faces, monitor, [&](std::size_t first, std::size_t last, BoundarySamples& part) {
        EllipsoidSampler sampler(all, spacing, tolerance, budget, monitor, first / faces);
        for (; first < last; ++first) sampler.sample(first % faces, part);
      });
  BoundarySamples samples;
  for (const BoundarySamples& part : parts) {
    samples.positions.insert(samples.positions.end(), part.positions.begin(), part.positions.end());
    samples.areas.insert(samples.areas.end(), part.areas.begin(), part.areas.end());
    samples.on_boundary.insert(samples.on_boundary.end(), part.on_boundary.begin(), part.on_boundary.end());
  }
  return samples;
}

double union_volume(const EllipsoidUnion& all, const Ellipsoids& ellipsoids, int lines, Monitor& monitor) {
  const Box box = bounding_box(ellipsoids);
  const Vec3 size = box.upper - box.lower;
  const std::array<Vec3, 3> e = Frame{}.axes;
  const std::array<double, 3> edges{size.x, size.y, size.z};
  const auto along = static_cast<std::size_t>(std::min_element(edges.begin(), edges.end()) - edges.begin());
  const std::size_t u = (along + 1) % 3, v = (along + 2) % 3;
  const auto n = static_cast<std::size_t>(lines);
  // The ellipsoids whose boxes a row of lines meets.
  const auto rows = by_blocks<double>(n, 1, monitor, [&](std::size_t row, std::size_t, double& sum) {
    const double at_u = (static_cast<double>(row) + 0.5) / static_cast<double>(n) * edges[u];
    std::vector<std::pair<std::size_t, Box>> met;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Box one = bounding_box(ellipsoids, i);
      if (dot(one.lower - box.lower, e[u]) <= at_u && at_u <= dot(one.upper - box.lower, e[u]))
        met.emplace_back(i, one);
    }
    std::vector<std::pair<double, double>> pieces;
    for (std::size_t column = 0; column < n; ++column) {
      const double at_v = (static_cast<double>(column) + 0.5) / static_cast<double>(n) * edges[v];
      const Vec3 origin = box.lower + at_u * e[u] + at_v * e[v];
      pieces.clear();
      for (const auto& [i, one] : met) {
        if (dot(one.lower - box.lower, e[v]) > at_v || at_v > dot(one.upper - box.lower, e[v])) continue;
        const Vec3 from = all[i].relative(origin), step = all[i].relative(origin + e[along]) - from;
        // |from + t step|^2 = 1, from the point of the line nearest to the center on: nothing cancels there.
        const double a = squared_length(step), middle = -dot(from, step) / a;
        const double rest = 1 - squared_length(from + middle * step);
        if (rest > 0) pieces.emplace_back(middle - std::sqrt(rest / a), middle + std::sqrt(rest / a));
      }
      std::sort(pieces.begin(), pieces.end());
      double end = -infinity;
      for (const auto& [first, last] : pieces) {
        sum += std::max(0.0, last - std::max(first, end));
        end = std::max(end, last);
      }
    }
  });
  double sum = 0;
  for (const double row : rows) sum += row;
  return sum * edges[u] * edges[v] / static_cast<double>(n * n);
}

}  // namespace ballflow::geometry
