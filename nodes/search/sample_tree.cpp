#include "search/sample_tree.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

// Tuned on samples of 35 000 and 100 000 points: half as much makes too many nodes, twice as much tests too
// many samples.
constexpr std::int32_t leaf_size = 32;  // the bits of SampleTree::Hit::samples

constexpr std::size_t max_depth = 64;  // the size halves at every level

/// How far a coordinate is outside an interval. Nested maxima are two instructions; std::max of a list is a
/// loop.
double outside(double low, double high) { return std::max(std::max(low, high), 0.0); }

}  // namespace

SampleTree::SampleTree(std::span<const Vec3> samples) : ids_(samples.size()) {
  std::iota(ids_.begin(), ids_.end(), 0);
  if (samples.empty()) return;
  nodes_.reserve(4 * samples.size() / static_cast<std::size_t>(leaf_size) + 1);
  build(samples, 0, static_cast<std::int32_t>(samples.size()));
  x_.reserve(samples.size() + leaf_size);
  y_.reserve(samples.size() + leaf_size);
  z_.reserve(samples.size() + leaf_size);
  for (const std::int32_t id : ids_) {
    const Vec3& p = samples[static_cast<std::size_t>(id)];
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
  // Whole leaves are read, also where the last one is shorter.
  for (std::vector<double>* values : {&x_, &y_, &z_}) values->resize(samples.size() + leaf_size);
}

void SampleTree::build(std::span<const Vec3> samples, std::int32_t first, std::int32_t last) {
  Box box;
  for (std::int32_t i = first; i < last; ++i) {
    box.add(samples[static_cast<std::size_t>(ids_[static_cast<std::size_t>(i)])]);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back({box.lower, box.upper, first, last, 0});
  if (last - first <= leaf_size) return;
  const Vec3 extent = box.upper - box.lower;
  double Vec3::*axis = &Vec3::x;
  if (extent.y > extent.*axis) axis = &Vec3::y;
  if (extent.z > extent.*axis) axis = &Vec3::z;
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(
      ids_.begin() + first, ids_.begin() + middle, ids_.begin() + last, [&](std::int32_t a, std::int32_t b) {
        return samples[static_cast<std::size_t>(a)].*axis < samples[static_cast<std::size_t>(b)].*axis;
      });
  build(samples, first, middle);
  nodes_[self].right = static_cast<std::int32_t>(nodes_.size());
  build(samples, middle, last);
}

std::uint32_t SampleTree::in_leaf(const Node& leaf, Vec3 c, double squared_reach) const {
  const double* const x = x_.data() + leaf.first;
  const double* const y = y_.data() + leaf.first;
  const double* const z = z_.data() + leaf.first;
  std::uint32_t mask = 0;
#if defined(__SSE2__)
  // The operations of in_reach, in its order, on two samples at once: the same bits, in half the time.
  const __m128d cx = _mm_set1_pd(c.x), cy = _mm_set1_pd(c.y), cz = _mm_set1_pd(c.z);
  const __m128d reach = _mm_set1_pd(squared_reach);
  for (int k = 0; k < leaf_size; k += 2) {
    const __m128d dx = _mm_sub_pd(cx, _mm_loadu_pd(x + k));
    const __m128d dy = _mm_sub_pd(cy, _mm_loadu_pd(y + k));
    const __m128d dz = _mm_sub_pd(cz, _mm_loadu_pd(z + k));
    const __m128d norm = _mm_add_pd(_mm_add_pd(_mm_mul_pd(dx, dx), _mm_mul_pd(dy, dy)), _mm_mul_pd(dz, dz));
    mask |= static_cast<std::uint32_t>(_mm_movemask_pd(_mm_cmple_pd(norm, reach))) << k;
  }
#else
  for (int k = 0; k < leaf_size; ++k) {
    mask |= std::uint32_t{in_reach(c, squared_reach, {x[k], y[k], z[k]})} << k;
  }
#endif
  return mask & ~std::uint32_t{0} >> (leaf_size - (leaf.last - leaf.first));
}

std::int64_t SampleTree::query(Vec3 c, double squared_reach, std::vector<Hit>& hits) const {
  if (nodes_.empty()) return 0;
  std::int64_t found = 0;
  std::array<std::int32_t, max_depth> stack;
  std::size_t depth = 0;
  std::int32_t at = 0;
  for (;;) {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    // Differences to the lower and to the upper corner bound those to every sample between them.
    const Vec3 low = node.lower - c, high = c - node.upper;
    const double nearest =
        squared_norm(outside(low.x, high.x), outside(low.y, high.y), outside(low.z, high.z));
    if (nearest <= squared_reach) {
      const double farthest =
          squared_norm(std::min(low.x, high.x), std::min(low.y, high.y), std::min(low.z, high.z));
      if (farthest <= squared_reach) {
        hits.push_back({node.first, static_cast<std::uint32_t>(node.last - node.first)});
        found += node.last - node.first;
      } else if (node.right == 0) {
        if (const std::uint32_t mask = in_leaf(node, c, squared_reach); mask != 0) {
          hits.push_back({~node.first, mask});
          found += std::popcount(mask);
        }
      } else {
        stack[depth++] = node.right;
        ++at;
        continue;
      }
    }
    if (depth == 0) return found;
    at = stack[--depth];
  }
}

}  // namespace ballflow::geometry
