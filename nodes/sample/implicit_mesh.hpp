// Meshes of smooth implicit surfaces { f = 0 } with f < 0 inside.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>

#include "base/monitor.hpp"
#include "types/triangle_mesh.hpp"

namespace ballflow::geometry {

/// A value with its gradient: forward differentiation of formulae made of + - * sqrt, min and max.
struct Dual {
  double value = 0;
  Vec3 gradient;

  Dual() = default;
  Dual(double constant) : value(constant) {}  // NOLINT(google-explicit-constructor): a number is a constant
  Dual(double v, Vec3 g) : value(v), gradient(g) {}

  friend Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.gradient + b.gradient}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.gradient - b.gradient}; }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return {a.value * b.value, a.value * b.gradient + b.value * a.gradient};
  }
  friend bool operator<(const Dual& a, const Dual& b) { return a.value < b.value; }
  friend Dual sqrt(const Dual& a) {
    const double root = std::sqrt(a.value);
    return {root, root > 0 ? (0.5 / root) * a.gradient : Vec3{}};
  }
};

/// A function of space for implicit_mesh, from a callable that takes three double or three Dual.
struct ImplicitSurface {
  std::function<double(const Vec3&)> value;
  std::function<Dual(const Vec3&)> value_and_gradient;
  Box box;  // contains the surface
  double lipschitz =
      0;  // |f(p) - f(q)| <= lipschitz |p - q|, which saves evaluations; 0 when there is no bound

  template <class F>
  ImplicitSurface(F f, Box bounds, double lipschitz_bound)
      : value([f](const Vec3& p) { return f(p.x, p.y, p.z); }),
        value_and_gradient([f](const Vec3& p) {
          return f(Dual(p.x, {1, 0, 0}), Dual(p.y, {0, 1, 0}), Dual(p.z, {0, 0, 1}));
        }),
        box(bounds),
        lipschitz(lipschitz_bound) {}
};

/// A triangle mesh with about n vertices on the surface, by dual contouring of a grid (one vertex per cut
/// cell, one quad per cut edge; Gibson 1998), Newton steps onto the surface, and relaxation in the surface.
/// Outward oriented. Where the grid resolves the surface the mesh is closed and manifold; the caller checks
/// that.
TriangleMesh implicit_mesh(const ImplicitSurface& surface, std::int64_t n, Monitor& monitor);

}  // namespace ballflow::geometry
