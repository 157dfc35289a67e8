#include "search/sampling_ratio.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "search/box_tree.hpp"

namespace ballflow::geometry {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = 1e6;
constexpr double tolerance = 1.03;
constexpr std::size_t most_parts = 20'000'000, most_at_once = 4'000'000;

using Part = std::array<Vec3, 3>;

struct Bounds {
  double at_least, at_most;
  Vec3 at;
};

}  // namespace

SamplingRatio sampling_ratio(std::span<const Vec3> samples, const TriangleMesh& mesh,
                             const std::function<double(Vec3)>& feature_size, Monitor& monitor) {
  SamplingRatio result;
  if (mesh.triangles.empty()) return result;
  if (samples.empty()) throw InputError("the surface has no samples", "connect the samples of the surface");
  const BoxTree tree(samples, BoxTree::default_leaf_size, monitor);
  const auto bounds_of = [&](const Part& part) {
    const auto& [a, b, c] = part;
    const Vec3 at = 1.0 / 3 * (a + b + c);
    // With room for the rounding of the centre and of the distances.
    const double reach = std::max({distance(at, a), distance(at, b), distance(at, c)}) * (1 + 1e-12);
    const double gap =
        tree.smallest(at, infinity, -infinity, [&](std::size_t i) { return distance(at, samples[i]); });
    const double size = feature_size(at);
    const double here = gap > 0 ? std::min(gap / size, largest) : 0;
    return Bounds{here, size > reach ? (gap + reach) / (size - reach) : infinity, at};
  };

  std::vector<Part> parts;
  parts.reserve(mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    parts.push_back({mesh.vertices[static_cast<std::size_t>(a)], mesh.vertices[static_cast<std::size_t>(b)],
                     mesh.vertices[static_cast<std::size_t>(c)]});
  }
  // All parts of one size at once: what is split then depends on no thread.
  std::size_t looked_at = 0;
  result.at = parts.front()[0];
  for (int level = 0; !parts.empty(); ++level) {
    looked_at += parts.size();
    std::vector<Bounds> bounds(parts.size());
    PartMonitor part(monitor, 1 - 1.0 / (1 + level), 1 - 1.0 / (2 + level));
    for_each_block(parts.size(), 256, part, 0, 1, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) bounds[i] = bounds_of(parts[i]);
    });
    for (const Bounds& b : bounds) {
      if (b.at_least <= result.at_least) continue;
      result.at_least = b.at_least;
      result.at = b.at;
    }
    if (result.at_least >= 1 || looked_at > most_parts ||
        parts.size() > std::max(most_at_once, mesh.triangles.size())) {
      result.at_most = infinity;
      return result;
    }
    std::vector<Part> finer;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (bounds[i].at_most <= result.at_least * tolerance) {
        result.at_most = std::max(result.at_most, bounds[i].at_most);
        continue;
      }
      const auto& [a, b, c] = parts[i];
      const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    parts = std::move(finer);
  }
  result.at_most = std::max(result.at_most, result.at_least);
  return result;
}

}  // namespace ballflow::geometry
