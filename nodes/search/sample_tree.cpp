#include "search/sample_tree.hpp"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <bit>

#include "search/membership.hpp"

namespace ballflow::geometry {
namespace {

// Tuned on samples of 35 000 and 100 000 points: half as much makes too many nodes, twice as much tests too
// many samples.
constexpr int leaf_size = 32;  // the bits of SampleTree::Hit::samples

constexpr std::size_t max_depth = 64;  // the size halves at every level

/// How far a coordinate is outside an interval. Nested maxima are two instructions; std::max of a list is a
/// loop.
double outside(double low, double high) { return std::max(std::max(low, high), 0.0); }

}  // namespace

SampleTree::SampleTree(std::span<const Vec3> samples) : tree_(samples, leaf_size) {
  for (std::vector<double>* values : {&x_, &y_, &z_}) values->reserve(samples.size() + leaf_size);
  for (const std::int32_t id : order()) {
    const Vec3& p = samples[static_cast<std::size_t>(id)];
    x_.push_back(p.x);
    y_.push_back(p.y);
    z_.push_back(p.z);
  }
  // Whole leaves are read, also where the last one is shorter.
  for (std::vector<double>* values : {&x_, &y_, &z_}) values->resize(samples.size() + leaf_size);
}

std::uint32_t SampleTree::in_leaf(const BoxTree::Node& leaf, Vec3 c, double squared_reach) const {
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
  const std::span<const BoxTree::Node> nodes = tree_.nodes();
  if (nodes.empty()) return 0;
  std::int64_t found = 0;
  std::array<std::int32_t, max_depth> stack;
  std::size_t depth = 0;
  std::int32_t at = 0;
  for (;;) {
    const BoxTree::Node& node = nodes[static_cast<std::size_t>(at)];
    // Differences to the lower and to the upper corner bound those to every sample between them.
    const Vec3 low = node.box.lower - c, high = c - node.box.upper;
    const double nearest =
        squared_norm(outside(low.x, high.x), outside(low.y, high.y), outside(low.z, high.z));
    if (nearest <= squared_reach) {
      const double farthest =
          squared_norm(std::min(low.x, high.x), std::min(low.y, high.y), std::min(low.z, high.z));
      if (farthest <= squared_reach) {
        hits.push_back({node.first, static_cast<std::uint32_t>(node.last - node.first)});
        found += node.last - node.first;
      } else if (node.second == 0) {
        if (const std::uint32_t mask = in_leaf(node, c, squared_reach); mask != 0) {
          hits.push_back({~node.first, mask});
          found += std::popcount(mask);
        }
      } else {
        stack[depth++] = node.second;
        ++at;
        continue;
      }
    }
    if (depth == 0) return found;
    at = stack[--depth];
  }
}

}  // namespace ballflow::geometry
