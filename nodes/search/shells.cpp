#include "search/shells.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/disjoint_sets.hpp"
#include "search/signed_crossings.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

void number(const TriangleMesh& surface, Shells& result) {
  const std::size_t n = surface.vertices.size();
  DisjointSets connected(n);
  for (const Triangle& t : surface.triangles) {
    for (const std::int32_t v : {t[1], t[2]}) connected.join(t[0], v);
  }
  std::vector<std::int32_t> shell(n, -1);
  result.shell.reserve(surface.triangles.size());
  for (const Triangle& t : surface.triangles) {
    const auto r = at(connected.root(t[0]));
    if (shell[r] < 0) {
      shell[r] = static_cast<std::int32_t>(result.shells.size());
      result.shells.emplace_back().corner = t[0];
    }
    result.shell.push_back(shell[r]);
  }
}

void measure(const TriangleMesh& surface, Shells& result) {
  std::vector<bool> seen(surface.vertices.size());
  for (std::size_t f = 0; f < result.shell.size(); ++f) {
    Shell& shell = result.shells[at(result.shell[f])];
    ++shell.triangles;
    for (const std::int32_t v : surface.triangles[f]) {
      if (seen[at(v)]) continue;
      seen[at(v)] = true;
      ++shell.vertices;
      shell.box.add(surface.vertices[at(v)]);
    }
    const auto [a, b, c] = surface.triangles[f];
    const Vec3 origin = surface.vertices[at(shell.corner)];
    const Vec3 p = surface.vertices[at(a)] - origin, q = surface.vertices[at(b)] - origin,
               r = surface.vertices[at(c)] - origin;
    shell.volume += dot(p, cross(q, r)) / 6;
    shell.area += length(cross(q - p, r - p)) / 2;
  }
  // Euler characteristic of a closed surface: vertices - faces / 2.
  for (Shell& shell : result.shells) shell.genus = (2 - shell.vertices + shell.triangles / 2) / 2;
}

/// How often every shell winds around a corner of every other one.
void wind(const TriangleMesh& surface, Shells& result, Monitor& monitor) {
  Lookout look(monitor);
  double whole = 0;
  for (const Shell& shell : result.shells) whole += shell.volume;
  result.inside_out = whole < 0;
  const int turn = result.inside_out ? -1 : 1;
  for (Shell& shell : result.shells) shell.faces_outwards = !(turn * shell.volume < 0);
  if (result.shells.size() == 1) return;
  const SignedCrossings crossings(surface.vertices, surface.triangles, monitor);
  for (std::size_t i = 0; i < result.shells.size(); ++i) {
    Shell& shell = result.shells[i];
    std::vector<std::pair<std::int32_t, std::int64_t>> crossed;
    crossings.for_each_above(surface.vertices[at(shell.corner)], [&](std::int32_t f, int sign, bool) {
      look(64);
      const std::int32_t other = result.shell[at(f)];
      if (other != static_cast<std::int32_t>(i)) crossed.emplace_back(other, turn * sign);
    });
    std::sort(crossed.begin(), crossed.end());
    for (const auto& [other, sign] : crossed) {
      if (shell.winding.empty() || shell.winding.back().first != other) shell.winding.emplace_back(other, 0);
      shell.winding.back().second += sign;
    }
    std::erase_if(shell.winding, [](const auto& w) { return w.second == 0; });
    for (const auto& [other, sign] : shell.winding) {
      const auto size = [&](std::int32_t s) { return std::abs(result.shells[at(s)].volume); };
      if (shell.parent < 0 || size(other) < size(shell.parent)) shell.parent = other;
    }
  }
}

/// A shell that faces inwards bounds a cavity inside another one, or else faces the wrong way.
void turn_outwards(Shells& result) {
  std::vector<Shell>& shells = result.shells;
  std::vector<bool> faced;
  for (const Shell& shell : shells) faced.push_back(shell.faces_outwards);
  for (std::size_t i = 0; i < shells.size(); ++i) {
    const bool inside = std::any_of(shells[i].winding.begin(), shells[i].winding.end(),
                                    [&](const auto& w) { return faced[at(w.first)]; });
    shells[i].turned = !faced[i] && !inside;
    if (shells[i].turned) shells[i].faces_outwards = true;
  }
  for (Shell& shell : shells) {
    std::int64_t outside = 0;
    for (const auto& [other, times] : shell.winding) outside += shells[at(other)].turned ? -times : times;
    const std::int64_t inside = outside + (shell.faces_outwards ? 1 : -1);
    shell.bounds =
        (outside > 0) != (inside > 0);  // else it is inside of the solid, or outside, on both sides
  }
}

}  // namespace

Betti Shells::betti() const {
  Betti betti{0, 0, 0};
  for (const Shell& one : shells) {
    if (!one.bounds) continue;
    ++betti[one.faces_outwards ? 0 : 2];
    betti[1] += one.genus;
  }
  return betti;
}

double Shells::volume() const {
  double sum = 0;
  for (const Shell& one : shells) {
    if (one.bounds) sum += one.faces_outwards ? std::abs(one.volume) : -std::abs(one.volume);
  }
  return sum;
}

double Shells::area() const {
  double sum = 0;
  for (const Shell& one : shells) sum += one.area;
  return sum;
}

Shells shells_of(const TriangleMesh& surface, Monitor& monitor) {
  Shells result;
  number(surface, result);
  measure(surface, result);
  wind(surface, result, monitor);
  turn_outwards(result);
  return result;
}

}  // namespace ballflow::geometry
