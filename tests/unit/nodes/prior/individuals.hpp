// Shapes as the graphs of shape priors see them: samples, inner balls, and both matched to a template.
#pragma once

#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "poles/label_poles.hpp"
#include "poles/voronoi_poles.hpp"
#include "prior/align.hpp"
#include "prior/match.hpp"
#include "prior_examples.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A number from the environment, for tests that are longer at night.
inline std::int64_t from_environment(const char* name, std::int64_t usual) {
  const char* const text = std::getenv(name);
  return text == nullptr ? usual : std::atoll(text);
}

struct Individual {
  Individual(TriangleMesh surface, std::int64_t sample_count, std::int64_t point_count,
             std::uint64_t seed = 1)
      : mesh(std::move(surface)), samples(samples_of(mesh, sample_count, seed)) {
    inner = label_poles(voronoi_poles(samples_of(mesh, point_count, seed + 1), {}), mesh, {}).inner;
  }
  TriangleMesh mesh;
  PointSet samples;
  Balls inner;
};

inline TriangleMesh moved(const TriangleMesh& mesh, const ShapePose& pose) {
  return {moved(mesh.vertices.span(), pose), mesh.triangles};
}

/// About `count` of the balls of a template, evenly from their list.
inline Balls template_of(const Individual& individual, std::size_t count) {
  const Balls members = template_balls(individual.inner, individual.inner);
  std::vector<std::int32_t> ids;
  for (std::size_t i = 0; i < count && i < members.size(); ++i)
    ids.push_back(static_cast<std::int32_t>(i * members.size() / count));
  return select(members, ids);
}

/// All individuals matched to the balls of one of them.
inline std::vector<MatchedBalls> matched(const std::vector<Individual>& individuals, const Balls& balls,
                                         const Individual& to, const MatchOptions& options = {},
                                         bool similarity = false) {
  std::vector<MatchedBalls> result;
  for (const Individual& one : individuals) {
    AlignOptions alignment;
    alignment.similarity = similarity;
    const ShapePose pose = align(one.samples, to.samples, alignment);
    result.push_back(match(balls, to.samples, one.samples, one.inner, pose, options));
  }
  return result;
}

}  // namespace ballflow::geometry
