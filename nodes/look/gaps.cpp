#include "look/gaps.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;  // the smaller vertex first

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of the mesh that are there once, ascending.
std::vector<Edge> single_edges(std::vector<Edge>& edges) {
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> single;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end == i + 1) single.push_back(edges[i]);
    i = end;
  }
  return single;
}

std::vector<Rim> rims_of(const TriangleMesh& mesh, const std::vector<Edge>& open) {
  DisjointSets connected(mesh.vertices.size());
  for (const Edge& e : open) connected.join(e[0], e[1]);
  std::vector<std::int32_t> number(mesh.vertices.size(), -1);
  std::vector<Rim> rims;
  std::vector<Box> boxes;
  for (const Edge& e : open) {
    std::int32_t& rim = number[at(connected.root(e[0]))];
    if (rim < 0) {
      rim = static_cast<std::int32_t>(rims.size());
      rims.emplace_back();
      boxes.emplace_back();
    }
    ++rims[at(rim)].edges;
    rims[at(rim)].length += distance(mesh.vertices[at(e[0])], mesh.vertices[at(e[1])]);
    for (const std::int32_t v : e) boxes[at(rim)].add(mesh.vertices[at(v)]);
  }
  for (std::size_t i = 0; i < rims.size(); ++i) {
    rims[i].middle = 0.5 * (boxes[i].lower + boxes[i].upper);
    rims[i].size = boxes[i].longest_edge();
  }
  std::stable_sort(rims.begin(), rims.end(), [](const Rim& a, const Rim& b) { return a.length > b.length; });
  return rims;
}

}  // namespace

std::vector<Edge> open_edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) edges.push_back(edge_of(t[k], t[(k + 1) % 3]));
  }
  return single_edges(edges);
}

Gaps gaps_of(const TriangleMesh& mesh, Monitor& monitor) {
  const std::vector<Edge> open = open_edges(mesh);
  Gaps gaps;
  gaps.open_edges = static_cast<std::int64_t>(open.size());
  gaps.rims = rims_of(mesh, open);
  if (!open.empty()) gaps.small = small_gaps(mesh, monitor);
  return gaps;
}

}  // namespace ballflow::geometry
