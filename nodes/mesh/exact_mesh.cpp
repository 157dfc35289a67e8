#include "mesh/exact_mesh.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/for_each_block.hpp"
#include "base/index.hpp"
#include "mesh/arc_net.hpp"
#include "mesh/sphere_patch.hpp"

namespace ballflow::geometry {
namespace {

// Five rounds were the most that balls in general position needed.
constexpr std::int32_t most_rounds = 8;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

class Builder {
 public:
  Builder(const SimplicialComplex& complex, ArcNet net, double error, std::int64_t most_faces,
          Monitor& monitor)
      : complex_(complex),
        net_(std::move(net)),
        error_(error),
        most_faces_(most_faces),
        monitor_(monitor),
        patches_(complex.centers.size()) {}

  std::optional<ExactMesh> run() {
    std::vector<std::int32_t> waiting;
    for (std::size_t k = 0; k < complex_.vertices.size(); ++k) {
      const std::int32_t ball = complex_.vertices[k];
      if (!net_.arcs_of(ball).empty()) {
        waiting.push_back(ball);
      } else if (complex_.vertex_classes[k] == static_cast<std::uint8_t>(SimplexClass::singular)) {
        if (!(complex_.weights[at(ball)] > 0)) return {};  // a point has no surface
        waiting.push_back(ball);
      }
    }
    const std::size_t points = net_.points().size();
    for (std::int32_t round = 0; round <= most_rounds; ++round) {
      triangulate(waiting);
      if (failed_) return {};
      std::vector<std::pair<std::int32_t, std::int32_t>> cut;
      for (const std::int32_t ball : waiting) {
        const SpherePatch& patch = patches_[at(ball)];
        cut.insert(cut.end(), patch.cut.begin(), patch.cut.end());
      }
      // Of balls in general position few chords are too long; where many are, rounding decides where they
      // lie.
      if (cut.size() > 1000 + net_.points().size() / 4) return {};
      if (cut.empty()) return assemble(round);
      waiting = bisect(cut);
      if (net_.points().size() > 1000 + 4 * points) return {};  // it runs away
    }
    return {};
  }

 private:
  void triangulate(const std::vector<std::int32_t>& balls) {
    faces_ = 0;
    for_each_block(balls.size(), 8, monitor_, 0, 0.9, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) {
        if (failed_) return;
        SpherePatch& patch = patches_[at(balls[k])] = patch_of(balls[k]);
        if (patch.state == SpherePatch::State::degenerate) failed_ = true;
        faces_ += static_cast<std::int64_t>(patch.triangles.size());
        if (faces_ > most_faces_) throw too_many_faces(most_faces_);
      }
    });
  }

  SpherePatch patch_of(std::int32_t ball) const {
    const Vec3 center = complex_.centers[at(ball)];
    const double weight = complex_.weights[at(ball)], radius = std::sqrt(weight);
    // The largest cap inside another ball is the one whose plane is farthest on the side of the center.
    double least = 0;
    Vec3 pole;
    bool none = true;
    for (const std::int32_t arc : net_.arcs_of(ball)) {
      const auto& pair = net_.balls_of_arc(arc);
      const std::int32_t other = pair[0] == ball ? pair[1] : pair[0];
      const Vec3 to = complex_.centers[at(other)] - center;
      const double d = length(to), height = (d + (weight - complex_.weights[at(other)]) / d) / 2;
      if (!none && height >= least) continue;
      none = false;
      least = height;
      pole = 1 / d * to;
    }
    // The fewest triangles that a whole sphere can have: equilateral ones, as far away as is allowed.
    const double fewest = 4.8 * radius / error_;
    if (none) {
      if (fewest > static_cast<double>(most_faces_)) throw too_many_faces(most_faces_);
      return whole_sphere(center, radius, error_);
    }
    return sphere_patch(net_, ball, center, radius, pole, error_,
                        1000 + static_cast<std::size_t>(std::min(20 * fewest, 1e9)), monitor_);
  }

  /// Cuts chords, each named by its arc and knot; returns the balls that see them, ascending.
  std::vector<std::int32_t> bisect(std::vector<std::pair<std::int32_t, std::int32_t>>& cut) {
    std::sort(cut.begin(), cut.end());
    cut.erase(std::unique(cut.begin(), cut.end()), cut.end());
    std::vector<std::int32_t> balls;
    // From the end of an arc, so that the numbers of the others stay.
    for (auto chord = cut.rbegin(); chord != cut.rend(); ++chord) {
      net_.bisect(chord->first, chord->second);
      for (const std::int32_t ball : net_.balls_of_arc(chord->first)) balls.push_back(ball);
    }
    std::sort(balls.begin(), balls.end());
    balls.erase(std::unique(balls.begin(), balls.end()), balls.end());
    return balls;
  }

  std::optional<ExactMesh> assemble(std::int32_t rounds) const {
    ExactMesh result;
    result.rounds = rounds;
    std::vector<Vec3> vertices = net_.points();
    std::size_t points = vertices.size(), faces = 0;
    for (const SpherePatch& patch : patches_) {
      points += patch.inside.size();
      faces += patch.triangles.size();
    }
    index_of(points, "vertices of a mesh");
    vertices.reserve(points);
    std::vector<Triangle> triangles;
    triangles.reserve(faces);
    Lookout look(monitor_);
    for (const SpherePatch& patch : patches_) {
      look(16 + patch.triangles.size());
      const auto first = static_cast<std::int32_t>(vertices.size());
      vertices.insert(vertices.end(), patch.inside.begin(), patch.inside.end());
      for (Triangle t : patch.triangles) {
        for (std::int32_t& v : t) {
          if (v < 0) v = first - 1 - v;
        }
        triangles.push_back(t);
      }
      result.error = std::max(result.error, patch.error);
    }
    result.mesh = {std::move(vertices), std::move(triangles)};
    return result;
  }

  const SimplicialComplex& complex_;
  ArcNet net_;
  const double error_;
  const std::int64_t most_faces_;
  std::atomic<std::int64_t> faces_{0};  // of this round
  std::atomic<bool> failed_{false};
  Monitor& monitor_;
  std::vector<SpherePatch> patches_;  // by ball
};

}  // namespace

std::optional<ExactMesh> exact_mesh(const PowerDiagram& diagram, const SimplicialComplex& complex,
                                    double error, double extent, std::int64_t most_faces, Monitor& monitor) {
  PartMonitor netting(monitor, 0, 0.2), patching(monitor, 0.2, 1);
  std::optional<ArcNet> net = ArcNet::of(diagram, complex, error, extent, netting);
  if (!net) return {};
  return Builder(complex, *std::move(net), error, most_faces, patching).run();
}

InputError too_many_faces(std::int64_t most) {
  return {"a mesh as near as was asked for has more than " + std::to_string(most) + " faces",
          "allow a larger error or more faces"};
}

}  // namespace ballflow::geometry
