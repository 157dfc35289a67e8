#include "search/surface_chain.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/lists.hpp"

namespace ballflow::geometry {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A side of a triangle, kept with the smaller of its two vertices.
struct Side {
  std::int32_t larger;  // vertex
  std::int32_t triangle;
  bool forward;  // the triangle runs through the edge from the smaller to the larger vertex

  friend bool operator<(const Side& a, const Side& b) {
    return std::pair(a.larger, a.triangle) < std::pair(b.larger, b.triangle);
  }
};

class Edges {
 public:
  Edges(const std::vector<Triangle>& triangles, std::size_t vertices)
      : sides_(lists_of<Side>(vertices, [&](auto&& put) {
          for (std::size_t t = 0; t < triangles.size(); ++t) {
            for (std::size_t k = 0; k < 3; ++k) {
              const std::int32_t u = triangles[t][k], v = triangles[t][(k + 1) % 3];
              put(at(std::min(u, v)), Side{std::max(u, v), static_cast<std::int32_t>(t), u < v});
            }
          }
        })) {
    for (std::size_t v = 0; v < vertices; ++v) {
      const std::span<Side> sides = sides_[v];
      std::sort(sides.begin(), sides.end());
    }
  }

  // Calls visit(smaller vertex, larger vertex, sides) for every edge, ascending.
  template <class Visit>
  void for_each(Visit visit) {
    for (std::size_t v = 0; v < sides_.size(); ++v) {
      const std::span<Side> sides = sides_[v];
      for (std::size_t i = 0; i < sides.size();) {
        std::size_t j = i + 1;
        while (j < sides.size() && sides[j].larger == sides[i].larger) ++j;
        visit(static_cast<std::int32_t>(v), sides[i].larger, sides.subspan(i, j - i));
        i = j;
      }
    }
  }

 private:
  Lists<Side> sides_;  // of each vertex, the smaller one of the edge
};

std::int64_t balance(std::span<const Side> sides) {
  std::int64_t sum = 0;
  for (const Side& side : sides) sum += side.forward ? 1 : -1;
  return sum;
}

// Turns triangles over so that neighbours at edges of two triangles agree; returns how many.
std::int64_t make_consistent(std::vector<Triangle>& triangles, Edges& edges) {
  struct Neighbour {
    std::int32_t triangle = -1;
    bool agrees = true;
  };
  std::vector<std::array<Neighbour, 3>> neighbours(triangles.size());
  const auto link = [&](std::int32_t from, std::int32_t to, bool agrees) {
    for (Neighbour& slot : neighbours[at(from)]) {
      if (slot.triangle >= 0) continue;
      slot = {to, agrees};
      return;
    }
  };
  edges.for_each([&](std::int32_t, std::int32_t, std::span<Side> sides) {
    if (sides.size() != 2) return;
    const bool agrees = sides[0].forward != sides[1].forward;
    link(sides[0].triangle, sides[1].triangle, agrees);
    link(sides[1].triangle, sides[0].triangle, agrees);
  });
  enum : std::uint8_t { unseen, kept, turn };
  std::vector<std::uint8_t> state(triangles.size(), unseen);
  std::vector<std::int32_t> piece;
  std::int64_t turned = 0;
  for (std::size_t seed = 0; seed < triangles.size(); ++seed) {
    if (state[seed] != unseen) continue;
    state[seed] = kept;
    piece.assign(1, static_cast<std::int32_t>(seed));
    std::size_t turns = 0;
    for (std::size_t head = 0; head < piece.size(); ++head) {
      const std::int32_t t = piece[head];
      for (const Neighbour& n : neighbours[at(t)]) {
        if (n.triangle < 0 || state[at(n.triangle)] != unseen) continue;
        state[at(n.triangle)] = (state[at(t)] == kept) == n.agrees ? kept : turn;
        turns += state[at(n.triangle)] == turn ? 1U : 0U;
        piece.push_back(n.triangle);
      }
    }
    const bool minority = 2 * turns <= piece.size();  // turn the fewer ones
    for (const std::int32_t t : piece) {
      if ((state[at(t)] == turn) != minority) continue;
      std::swap(triangles[at(t)][1], triangles[at(t)][2]);
      ++turned;
    }
  }
  return turned;
}

void number_components(SurfaceChain& chain, Edges& edges) {
  DisjointSets connected(chain.triangles.size());
  edges.for_each([&](std::int32_t, std::int32_t, std::span<Side> sides) {
    for (std::size_t k = 1; k < sides.size(); ++k) connected.join(sides[0].triangle, sides[k].triangle);
  });
  chain.component.assign(chain.triangles.size(), -1);
  for (std::int32_t t = 0; t < static_cast<std::int32_t>(chain.triangles.size()); ++t) {
    const std::int32_t r = connected.root(t);
    chain.component[at(t)] = r == t ? chain.components++ : chain.component[at(r)];
  }
}

}  // namespace

SurfaceChain surface_chain(const TriangleMesh& mesh) {
  SurfaceChain chain;
  chain.triangles.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) chain.triangles.push_back(t);
  }
  Edges edges(chain.triangles, mesh.vertices.size());
  bool balanced = true;
  edges.for_each([&](std::int32_t, std::int32_t, std::span<Side> sides) {
    if (sides.size() == 1) ++chain.boundary_edges;
    if (sides.size() > 2) ++chain.nonmanifold_edges;
    if (balance(sides) != 0) balanced = false;
  });
  number_components(chain, edges);
  if (balanced) return chain;

  chain.turned = make_consistent(chain.triangles, edges);
  if (chain.turned > 0) edges = Edges(chain.triangles, mesh.vertices.size());
  edges.for_each([&](std::int32_t u, std::int32_t v, std::span<Side> sides) {
    const std::int64_t sum = balance(sides);
    if (sides.size() == 2 && sum != 0) ++chain.contradictions;
    for (std::int64_t k = 0; k < sum; ++k) chain.boundary.push_back({u, v});
    for (std::int64_t k = 0; k < -sum; ++k) chain.boundary.push_back({v, u});
  });
  return chain;
}

std::string why_not_closed(const SurfaceChain& chain, const TriangleMesh& mesh) {
  if (chain.triangles.empty()) return "the mesh has only triangles with a repeated corner";
  if (chain.boundary_edges > 0) {
    const std::int64_t loops = mesh_topology(mesh).boundary_loops;
    return "the mesh is open: " + std::to_string(chain.boundary_edges) + " boundary edges in " +
           std::to_string(loops) + " loops";
  }
  if (chain.contradictions > 0) {
    return "the mesh is not orientable: at " + std::to_string(chain.contradictions) +
           " edges the two triangles face opposite ways however they are turned";
  }
  return "the mesh is not closed: " + std::to_string(chain.nonmanifold_edges) +
         " edges belong to more than two triangles, which face one way more often than the other";
}

}  // namespace ballflow::geometry
