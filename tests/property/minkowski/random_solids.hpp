// Small solids of every kind, random, and few balls for them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "balls/enlarge.hpp"
#include "balls/select_balls.hpp"
#include "base/random.hpp"
#include "cover/cover_matrix.hpp"
#include "cover/greedy.hpp"
#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "sample/block_mesh.hpp"
#include "sample/generate.hpp"
#include "sample/surface_sample.hpp"

namespace ballflow::geometry {

inline double between(Random& random, double low, double high) { return low + (high - low) * random.unit(); }
inline std::size_t below(Random& random, std::size_t n) {
  return static_cast<std::size_t>(random.bits() % static_cast<std::uint64_t>(n));
}

/// A sphere whose vertices are nearer or farther than they were.
inline TriangleMesh potato(Random& random) {
  const TriangleMesh sphere = generate(parse_shape("sphere?n=60"));
  std::vector<Vec3> vertices;
  for (const Vec3 p : sphere.vertices) vertices.push_back(between(random, 0.5, 1.2) * p);
  return {std::move(vertices), sphere.triangles};
}

/// Some cells of a lattice of 3 x 3 x 3: in pieces, touching in edges and corners, with tunnels.
inline TriangleMesh cells(Random& random) {
  std::vector<bool> solid(27);
  for (std::size_t k = 0; k < solid.size(); ++k) solid[k] = random.unit() < 0.4;
  solid[below(random, 27)] = true;
  Blocks blocks;
  for (auto& planes : blocks.planes) {
    planes = {0};
    for (int k = 0; k < 3; ++k) planes.push_back(planes.back() + between(random, 0.2, 0.8));
  }
  blocks.solid = [solid](int i, int j, int k) {
    return i >= 0 && j >= 0 && k >= 0 && i < 3 && j < 3 && k < 3 &&
           solid[static_cast<std::size_t>(9 * i + 3 * j + k)];
  };
  return block_mesh(blocks, 10);
}

/// Turned about a random axis, scaled, moved.
inline TriangleMesh placed(const TriangleMesh& mesh, double scale, Random& random) {
  // Two reflections are a rotation.
  std::vector<Vec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  for (int mirror = 0; mirror < 2; ++mirror) {
    Vec3 n;
    do {
      n = {between(random, -1, 1), between(random, -1, 1), between(random, -1, 1)};
    } while (!(length(n) > 0.1));
    n = 1 / length(n) * n;
    for (Vec3& p : vertices) p = p - 2 * dot(p, n) * n;
  }
  const Vec3 by{between(random, -2, 2), between(random, -2, 2), between(random, -2, 2)};
  for (Vec3& p : vertices) p = scale * p + by;
  return {std::move(vertices), mesh.triangles};
}

inline TriangleMesh random_solid(Random& random) {
  const double scale = below(random, 2) == 0 ? 1 : between(random, 0.1, 0.6);
  switch (below(random, 6)) {
    case 0:
      return placed(generate(parse_shape("torus?n=90")), scale, random);
    case 1:
      return placed(generate(parse_shape("3cross?n=120")), scale, random);
    case 2:
      return placed(generate(parse_shape("box?n=50")), scale, random);
    case 3:
      return placed(cells(random), scale, random);
    default:
      return placed(potato(random), scale, random);
  }
}

/// Few balls, as graphs/prune.json makes them with growth=additive, strategy=greedy, cover=samples.
inline Balls few_balls(const TriangleMesh& mesh, const PointSet& points, double epsilon) {
  VoronoiPolesOptions candidates;
  candidates.vertices = Vertices::all;
  LabelPolesOptions labels;
  labels.vertices = Vertices::all;
  const LabelledPoles poles = label_poles(voronoi_poles(points, candidates, no_monitor()), mesh, labels);
  EnlargeOptions grow;
  grow.epsilon = epsilon;
  const CoverMatrix matrix = cover_matrix(enlarge(poles.inner, points, {}, grow).balls, points);
  GreedyOptions all;
  all.mode = GreedyMode::until_covered;
  return select_balls(greedy(matrix.cover, all), matrix.balls, {});
}

/// Of samples spread over the surface.
inline Balls few_balls(const TriangleMesh& mesh, std::int64_t samples, double epsilon, std::uint64_t seed) {
  SurfaceSampleOptions spread;
  spread.count = samples;
  spread.seed = seed;
  return few_balls(mesh, sample_surface(mesh, spread), epsilon);
}

}  // namespace ballflow::geometry
