#include "search/winding_number.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/disjoint_sets.hpp"

namespace ballflow::geometry {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

struct Soup {
  std::vector<Vec3> vertices;
  std::vector<Triangle> triangles;
};

// Cones over the connected pieces of the boundary, oriented so that mesh and cones together are closed.
Soup make_caps(const TriangleMesh& mesh, const SurfaceChain& chain) {
  Soup caps;
  if (chain.boundary.empty()) return caps;
  caps.vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
  DisjointSets loops(mesh.vertices.size());
  for (const auto& [u, v] : chain.boundary) loops.join(u, v);
  struct Mean {
    Vec3 sum;
    double count = 0;
    std::int32_t apex = -1;
  };
  std::vector<Mean> means(mesh.vertices.size());
  for (const auto& edge : chain.boundary) {
    Mean& mean = means[at(loops.root(edge[0]))];
    mean.sum = mean.sum + mesh.vertices[at(edge[0])];  // a cycle: its first ends are all its vertices
    mean.count += 1;
  }
  for (const auto& [u, v] : chain.boundary) {
    Mean& mean = means[at(loops.root(u))];
    if (mean.apex < 0) {
      mean.apex = static_cast<std::int32_t>(caps.vertices.size());
      caps.vertices.push_back(1 / mean.count * mean.sum);
    }
    caps.triangles.push_back({mean.apex, v, u});
  }
  return caps;
}

}  // namespace

WindingNumber::WindingNumber(const TriangleMesh& mesh, Monitor& monitor)
    : chain_(surface_chain(mesh)),
      sign_(chain_.triangles.size(), 1),
      turned_(chain_.turned),
      crossings_({}, {}, monitor),
      caps_({}, {}, monitor) {
  if (monitor.cancelled()) throw Cancelled();
  if (chain_.boundary.empty()) {
    crossings_ = SignedCrossings(mesh.vertices.span(), chain_.triangles, monitor);
    turn_outwards(mesh);
    return;
  }
  const Soup caps = make_caps(mesh, chain_);
  std::vector<Triangle> all = chain_.triangles;
  all.insert(all.end(), caps.triangles.begin(), caps.triangles.end());
  crossings_ = SignedCrossings(caps.vertices, all, monitor);
  caps_ = SolidAngles(caps.vertices, caps.triangles, monitor);
  sign_.resize(all.size(), 1);
}

void WindingNumber::turn_outwards(const TriangleMesh& mesh) {
  const Box box = bounding_box(mesh.vertices.span());
  const Vec3 middle = 0.5 * (box.lower + box.upper);
  std::vector<double> volume(at(chain_.components), 0);  // times 6
  std::vector<std::size_t> size(volume.size(), 0), first(volume.size());
  for (std::size_t t = chain_.triangles.size(); t-- > 0;) {
    const auto [a, b, c] = chain_.triangles[t];
    const std::size_t component = at(chain_.component[t]);
    volume[component] += dot(mesh.vertices[at(a)] - middle,
                             cross(mesh.vertices[at(b)] - middle, mesh.vertices[at(c)] - middle));
    ++size[component];
    first[component] = t;
  }
  std::vector<std::int8_t> sign(volume.size(), 1);
  if (std::accumulate(volume.begin(), volume.end(), 0.0) < 0)
    std::fill(sign.begin(), sign.end(), std::int8_t{-1});
  const auto positive = [&](std::size_t component) { return sign[component] * volume[component] > 0; };
  std::vector<std::size_t> inside_out;
  for (std::size_t c = 0; c < volume.size(); ++c) {
    if (positive(c) || volume[c] == 0) continue;
    std::int64_t winding = 0;  // of the other components around a point of this one
    crossings_.for_each_above(mesh.vertices[at(chain_.triangles[first[c]][0])],
                              [&](std::int32_t t, int crossing, bool) {
                                const std::size_t other = at(chain_.component[at(t)]);
                                if (other != c && positive(other)) winding += crossing * sign[other];
                              });
    if (winding < 1) inside_out.push_back(c);
  }
  for (const std::size_t c : inside_out) sign[c] = static_cast<std::int8_t>(-sign[c]);
  for (std::size_t t = 0; t < sign_.size(); ++t) sign_[t] = sign[at(chain_.component[t])];
  for (std::size_t c = 0; c < size.size(); ++c) {
    if (sign[c] < 0) turned_ += static_cast<std::int64_t>(size[c]);
    enclosed_volume_ += sign[c] * volume[c] / 6;
  }
}

WindingNumber::Value WindingNumber::around(Vec3 point) const {
  Value value;
  std::int64_t crossings = 0;
  const auto own = static_cast<std::int32_t>(chain_.triangles.size());
  crossings_.for_each_above(point, [&](std::int32_t t, int sign, bool on) {
    crossings += sign * sign_[static_cast<std::size_t>(t)];
    if (on && t < own) value.on_surface = true;
  });
  value.number = static_cast<double>(crossings);
  if (chain_.boundary.empty()) return value;
  for (const double tolerance : {0.2, 1e-2, 1e-4, 0.0}) {
    const SolidAngles::Sum caps = caps_.sum(point, tolerance);
    value.number = static_cast<double>(crossings) - caps.value;
    const auto near = [&](double threshold) {
      return std::abs(std::abs(value.number) - threshold) <= caps.error + 1e-9;
    };
    if (!near(0.25) && !near(0.5) && !near(0.75)) break;
  }
  return value;
}

}  // namespace ballflow::geometry
