#include "volume/label_surface.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "base/index.hpp"

namespace ballflow::geometry {
namespace {

using Place = std::array<std::int64_t, 3>;

/// Which voxels are inside, also beyond the image.
class Inside {
 public:
  Inside(const LabelVolume& volume, std::int32_t label) : volume_(volume), label_(label) {}
  bool operator()(const Place& p) const {
    for (std::size_t a = 0; a < 3; ++a)
      if (p[a] < 0 || p[a] >= volume_.size[a]) return false;
    const auto at = static_cast<std::size_t>((p[2] * volume_.size[1] + p[1]) * volume_.size[0] + p[0]);
    return label_ == 0 ? volume_.labels[at] != 0 : volume_.labels[at] == label_;
  }

 private:
  const LabelVolume& volume_;
  std::int32_t label_;
};

Place corner(const Place& cell, unsigned bits) {
  return {cell[0] + (bits & 1U), cell[1] + (bits >> 1 & 1U), cell[2] + (bits >> 2 & 1U)};
}
Vec3 vec(const Place& p) {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

// The tetrahedra of a cube: corners as bits, from 0 to 7, each one axis more than the one before.
constexpr std::array<std::array<unsigned, 4>, 6> tetrahedra{
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};

/// Cells layer by layer; a vertex is known by the lower corner of its edge and where that leads to (1 to 7).
class Builder {
 public:
  Builder(const LabelVolume& volume, const Inside& inside, const Place& low, const Place& high)
      : volume_(volume), inside_(inside), low_(low) {
    for (std::size_t a = 0; a < 3; ++a) count_[a] = high[a] - low[a] + 2;  // one cell more below
    for (auto& layer : ids_)
      layer.assign(static_cast<std::size_t>(7 * (count_[0] + 1) * (count_[1] + 1)), -1);
    const auto& [a, b, c] = volume.steps;
    turned_ = dot(cross(a, b), c) < 0;
    layer_ = low[2] - 1;
  }

  TriangleMesh build(Monitor& monitor) {
    for (std::int64_t z = 0; z < count_[2]; ++z) {
      monitor.step(static_cast<double>(z) / static_cast<double>(count_[2]));
      for (std::int64_t y = 0; y < count_[1]; ++y)
        for (std::int64_t x = 0; x < count_[0]; ++x)
          cell({low_[0] - 1 + x, low_[1] - 1 + y, low_[2] - 1 + z});
      std::swap(ids_[0], ids_[1]);
      std::fill(ids_[1].begin(), ids_[1].end(), -1);
      layer_ = low_[2] + z;
    }
    return {std::move(vertices_), std::move(triangles_)};
  }

 private:
  void cell(const Place& at) {
    unsigned in = 0;
    for (unsigned k = 0; k < 8; ++k) in |= static_cast<unsigned>(inside_(corner(at, k))) << k;
    if (in == 0 || in == 255) return;
    for (const auto& corners : tetrahedra) {
      std::vector<unsigned>& one = here_;
      std::vector<unsigned>& other = there_;
      one.clear();
      other.clear();
      for (const unsigned k : corners) ((in >> k & 1U) != 0 ? one : other).push_back(k);
      if (one.empty() || other.empty()) continue;
      if (one.size() == 2) {
        quad(at, one, other);
      } else {
        const bool alone = one.size() == 1;
        const unsigned tip = alone ? one[0] : other[0];
        const std::vector<unsigned>& base = alone ? other : one;
        add(at, {std::pair{tip, base[0]}, {tip, base[1]}, {tip, base[2]}}, one[0]);
      }
    }
  }

  void quad(const Place& at, const std::vector<unsigned>& in, const std::vector<unsigned>& out) {
    const std::pair<unsigned, unsigned> a{in[0], out[0]}, b{in[0], out[1]}, c{in[1], out[1]},
        d{in[1], out[0]};
    add(at, {a, b, c}, in[0]);
    add(at, {a, c, d}, in[1]);
  }

  /// A triangle between the middles of three edges, which turns its back on a corner inside.
  void add(const Place& at, const std::array<std::pair<unsigned, unsigned>, 3>& edges, unsigned within) {
    std::array<Vec3, 3> p;
    Triangle t;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = 0.5 * (vec(corner({}, edges[k].first)) + vec(corner({}, edges[k].second)));
      t[k] = vertex(at, std::min(edges[k].first, edges[k].second), std::max(edges[k].first, edges[k].second));
    }
    // Halves of small integers: exact. Never 0: an inner corner is in no plane that separates it.
    const double side = dot(cross(p[1] - p[0], p[2] - p[0]), vec(corner({}, within)) - p[0]);
    if ((side > 0) != turned_) std::swap(t[1], t[2]);
    triangles_.push_back(t);
  }

  /// `from` is a subset of the bits of `to`.
  std::int32_t vertex(const Place& at, unsigned from, unsigned to) {
    const Place low = corner(at, from);
    const auto layer = static_cast<std::size_t>(low[2] - layer_);
    const auto place = static_cast<std::size_t>(
        7 * ((low[1] - low_[1] + 1) * (count_[0] + 1) + (low[0] - low_[0] + 1)) + (to - from) - 1);
    std::int32_t& id = ids_[layer][place];
    if (id < 0) {
      id = index_of(vertices_.size(), "vertices of the surface");
      vertices_.push_back(volume_.place(0.5 * (vec(low) + vec(corner(at, to)))));
    }
    return id;
  }

  const LabelVolume& volume_;
  const Inside& inside_;
  Place low_, count_{};
  bool turned_ = false;
  std::int64_t layer_ = 0;  // z of ids_[0]
  std::array<std::vector<std::int32_t>, 2> ids_;
  std::vector<unsigned> here_, there_;
  std::vector<Vec3> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace

TriangleMesh label_surface(const LabelVolume& volume, const LabelSurfaceOptions& options, Monitor& monitor) {
  const Inside inside(volume, options.label);
  Place low = volume.size, high{-1, -1, -1};
  Lookout look(monitor);
  for (std::int64_t z = 0; z < volume.size[2]; ++z)
    for (std::int64_t y = 0; y < volume.size[1]; ++y)
      for (std::int64_t x = 0; x < volume.size[0]; ++x) {
        look(1);
        const Place p{x, y, z};
        if (!inside(p)) continue;
        for (std::size_t a = 0; a < 3; ++a) {
          low[a] = std::min(low[a], p[a]);
          high[a] = std::max(high[a], p[a]);
        }
      }
  if (high[0] < 0) {
    std::string there;
    for (const std::int32_t label : labels_in(volume, 10))
      there += (there.empty() ? "" : ", ") + std::to_string(label);
    throw InputError(
        options.label == 0 ? "every voxel is 0" : "no voxel has the label " + std::to_string(options.label),
        there.empty() ? "take an image with labels" : "labels there are: " + there);
  }
  Builder builder(volume, inside, low, high);
  TriangleMesh mesh = builder.build(monitor);
  monitor.step(1);
  return mesh;
}

}  // namespace ballflow::geometry
