#include "homology/first_homology.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

/// The graph of the edges and a breadth-first forest in it.
struct FirstHomology::Skeleton {
  explicit Skeleton(const SimplicialComplex& complex) {
    const std::size_t n = complex.centers.size();
    first_edge.resize(n + 1);
    begin.resize(n + 2);
    for (const auto& [u, v] : complex.edges) {
      ++first_edge[at(u) + 1];
      ++begin[at(u) + 2];
      ++begin[at(v) + 2];
    }
    std::partial_sum(first_edge.begin(), first_edge.end(), first_edge.begin());
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    neighbors.resize(2 * complex.edges.size());
    // Edges ascend, so that every list does: first the smaller neighbours, then the larger ones.
    for (const auto& [u, v] : complex.edges) neighbors[begin[at(v) + 1]++] = u;
    for (const auto& [u, v] : complex.edges) neighbors[begin[at(u) + 1]++] = v;
    begin.pop_back();

    parent.assign(n, -1);
    depth.assign(n, 0);
    component.assign(n, -1);
    std::vector<std::int32_t> queue;
    for (const std::int32_t root : complex.vertices) {
      if (component[at(root)] >= 0) continue;
      queue.assign(1, root);
      component[at(root)] = components;
      for (std::size_t i = 0; i < queue.size(); ++i) {
        const std::int32_t u = queue[i];
        for (std::size_t k = begin[at(u)]; k < begin[at(u) + 1]; ++k) {
          const std::int32_t v = neighbors[k];
          if (component[at(v)] >= 0) continue;
          component[at(v)] = components;
          parent[at(v)] = u;
          depth[at(v)] = depth[at(u)] + 1;
          queue.push_back(v);
        }
      }
      outwards.insert(outwards.end(), queue.begin(), queue.end());
      ++components;
    }
  }

  std::int64_t edge(std::span<const std::array<std::int32_t, 2>> edges, std::int32_t u,
                    std::int32_t v) const {
    const auto first = edges.begin() + static_cast<std::ptrdiff_t>(first_edge[at(u)]);
    const auto last = edges.begin() + static_cast<std::ptrdiff_t>(first_edge[at(u) + 1]);
    const auto found = std::lower_bound(first, last, std::array{u, v});
    return found == last || (*found)[1] != v ? -1 : found - edges.begin();
  }

  std::vector<std::size_t> first_edge, begin;
  std::vector<std::int32_t> neighbors, parent, depth, component, outwards;
  std::int32_t components = 0;
};

namespace {

/// Cocycles that vanish on the forest: on every triangle they sum to 0.
template <class Skeleton>
BinarySystem cocycles(const Skeleton& skeleton, const SimplicialComplex& complex, Monitor& monitor) {
  Lookout look(monitor);
  const auto edges = complex.edges.span();
  std::vector<std::int32_t> zero;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [u, v] = edges[e];
    if (skeleton.parent[at(u)] == v || skeleton.parent[at(v)] == u)
      zero.push_back(static_cast<std::int32_t>(e));
  }
  std::vector<std::int64_t> offsets{0};
  std::vector<std::int32_t> terms;
  offsets.reserve(complex.triangles.size() + 1);
  terms.reserve(3 * complex.triangles.size());
  for (const auto& [i, j, k] : complex.triangles) {
    look(8);
    for (const auto& [u, v] : {std::pair(i, j), std::pair(i, k), std::pair(j, k)}) {
      terms.push_back(static_cast<std::int32_t>(skeleton.edge(edges, u, v)));
    }
    offsets.push_back(static_cast<std::int64_t>(terms.size()));
  }
  return {edges.size(), offsets, terms, zero, monitor};
}

}  // namespace

FirstHomology::FirstHomology(const SimplicialComplex& complex, Monitor& monitor)
    : FirstHomology(Skeleton(complex), complex, monitor) {}

FirstHomology::FirstHomology(Skeleton skeleton, const SimplicialComplex& complex, Monitor& monitor)
    : edges_(complex.edges), cocycles_(cocycles(skeleton, complex, monitor)) {
  first_edge_ = std::move(skeleton.first_edge);
  begin_ = std::move(skeleton.begin);
  neighbors_ = std::move(skeleton.neighbors);
  outwards_ = std::move(skeleton.outwards);
  parent_ = std::move(skeleton.parent);
  depth_ = std::move(skeleton.depth);
  component_ = std::move(skeleton.component);
  components_ = skeleton.components;
}

std::int64_t FirstHomology::edge(std::int32_t u, std::int32_t v) const {
  if (u > v) std::swap(u, v);
  const auto first = edges_.begin() + first_edge_[at(u)];
  const auto last = edges_.begin() + first_edge_[at(u) + 1];
  const auto found = std::lower_bound(first, last, std::array{u, v});
  return found == last || (*found)[1] != v ? -1 : found - edges_.begin();
}

std::span<const std::int32_t> FirstHomology::on_edge(std::int32_t u, std::int32_t v) const {
  const std::int64_t e = edge(u, v);
  if (e < 0) {
    throw std::logic_error("the walk from ball " + std::to_string(u) + " to ball " + std::to_string(v) +
                           " leaves the complex");
  }
  return cocycles_.value(static_cast<std::int32_t>(e));
}

std::vector<std::int32_t> FirstHomology::loop(std::size_t k) const {
  auto [u, v] = edges_[at(cocycles_.free_variable(k))];
  std::vector<std::int32_t> there, back;
  while (u != v) {
    if (depth_[at(u)] >= depth_[at(v)]) {
      there.push_back(u);
      u = parent_[at(u)];
    } else {
      back.push_back(v);
      v = parent_[at(v)];
    }
  }
  there.push_back(u);
  there.insert(there.end(), back.rbegin(), back.rend());
  return there;
}

std::span<const std::int32_t> FirstHomology::around(std::int32_t u) const {
  return {neighbors_.data() + begin_[at(u)], begin_[at(u) + 1] - begin_[at(u)]};
}

}  // namespace ballflow::geometry
