#include "types/triangle_mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {
namespace {

using Index = std::int32_t;

/// A directed edge of a triangle, filed under its smaller vertex.
struct HalfEdge {
  Index larger;    // the other vertex
  Index corner;    // 3 * triangle + position of the vertex where the half-edge begins
  bool ascending;  // from the smaller to the larger vertex
};

Index next_corner(Index corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

bool degenerate(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

}  // namespace

MeshTopology mesh_topology(const TriangleMesh& mesh, Monitor& monitor) {
  MeshTopology result;
  Lookout look(monitor);
  const std::size_t n = mesh.vertices.size();
  const std::size_t m = mesh.triangles.size();
  result.vertices = static_cast<std::int64_t>(n);
  result.faces = static_cast<std::int64_t>(m);
  if (m == 0) return result;

  // All half-edges, sorted by their smaller vertex (counting sort).
  std::size_t degenerate_faces = 0;
  std::vector<std::uint32_t> begin(n + 1, 0);
  for (const Triangle& t : mesh.triangles) {
    look(8);
    if (degenerate(t)) {
      ++degenerate_faces;
      continue;
    }
    for (std::size_t k = 0; k < 3; ++k) ++begin[static_cast<std::size_t>(std::min(t[k], t[(k + 1) % 3])) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<HalfEdge> half_edges(begin[n]);
  std::vector<std::uint32_t> fill(begin.begin(), begin.end() - 1);
  DisjointSets vertices(n);
  std::vector<bool> used(n, false);
  for (std::size_t f = 0; f < m; ++f) {
    look(32);
    const Triangle& t = mesh.triangles[f];
    for (const Index v : t) used[static_cast<std::size_t>(v)] = true;
    vertices.join(t[0], t[1]);
    vertices.join(t[0], t[2]);
    if (degenerate(t)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const Index a = t[k], b = t[(k + 1) % 3];
      half_edges[fill[static_cast<std::size_t>(std::min(a, b))]++] = {std::max(a, b),
                                                                      static_cast<Index>(3 * f + k), a < b};
    }
  }

  // One pass over the edges. Two corners at a vertex belong to one fan when their triangles share an edge
  // there: where no edge has three triangles, a fan is a disk or a half disk.
  std::int64_t edges = 0, fans = static_cast<std::int64_t>(half_edges.size());
  DisjointSets corners(3 * m);
  DisjointSets boundary(n);
  std::vector<bool> on_boundary(n, false);
  bool oriented = true;
  for (std::size_t v = 0; v < n; ++v) {
    const auto first = half_edges.begin() + begin[v], last = half_edges.begin() + begin[v + 1];
    look(16 + 16 * static_cast<std::size_t>(last - first));
    std::sort(first, last, [](const HalfEdge& a, const HalfEdge& b) {
      return std::pair(a.larger, a.corner) < std::pair(b.larger, b.corner);
    });
    for (auto edge = first; edge != last;) {
      auto end = edge + 1;
      while (end != last && end->larger == edge->larger) ++end;
      ++edges;
      const auto triangles = end - edge;
      if (triangles == 1) {
        ++result.boundary_edges;
        on_boundary[v] = on_boundary[static_cast<std::size_t>(edge->larger)] = true;
        boundary.join(static_cast<Index>(v), edge->larger);
      } else if (triangles > 2) {
        ++result.nonmanifold_edges;
      }
      for (auto other = edge + 1; other != end; ++other) {
        if (triangles == 2 && other->ascending == edge->ascending) oriented = false;
        const auto ends = [](const HalfEdge& h) {  // corners at the smaller and at the larger vertex
          return h.ascending ? std::pair(h.corner, next_corner(h.corner))
                             : std::pair(next_corner(h.corner), h.corner);
        };
        const auto [smaller_a, larger_a] = ends(*edge);
        const auto [smaller_b, larger_b] = ends(*other);
        fans -= corners.join(smaller_a, smaller_b);
        fans -= corners.join(larger_a, larger_b);
      }
      // Three and more triangles: some two of them must run the same way.
      if (triangles > 2) oriented = false;
      edge = end;
    }
  }

  std::int64_t used_vertices = 0;
  for (std::size_t v = 0; v < n; ++v) {
    const auto id = static_cast<Index>(v);
    if (used[v]) {
      ++used_vertices;
      result.components += vertices.root(id) == id;
    }
    if (on_boundary[v]) result.boundary_loops += boundary.root(id) == id;
  }
  result.closed = degenerate_faces == 0 && result.boundary_edges == 0 && result.nonmanifold_edges == 0;
  result.manifold = degenerate_faces == 0 && result.nonmanifold_edges == 0 && fans == used_vertices;
  result.oriented = degenerate_faces == 0 && oriented;
  if (result.manifold && result.oriented) {
    const std::int64_t euler = used_vertices - edges + result.faces;
    result.genus = result.components - (euler + result.boundary_loops) / 2;
  }
  return result;
}

std::string broken_invariant(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (!is_finite(mesh.vertices[i])) return "vertex " + std::to_string(i) + " is not finite";
  }
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (const Index v : mesh.triangles[f]) {
      if (v < 0 || static_cast<std::size_t>(v) >= mesh.vertices.size()) {
        return "face " + std::to_string(f) + ": vertex index " + std::to_string(v) + " is out of range (" +
               std::to_string(mesh.vertices.size()) + " vertices)";
      }
    }
  }
  return {};
}

}  // namespace ballflow::geometry
