#include "types/simplicial_complex.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace ballflow::geometry {
namespace {

template <std::size_t K>
using Simplex = std::array<std::int32_t, K>;

template <std::size_t K>
std::string name(const Simplex<K>& simplex) {
  constexpr const char* kinds[] = {"", "vertex", "edge", "triangle", "tetrahedron"};
  std::string text = kinds[K];
  text += " (";
  for (std::size_t k = 0; k < K; ++k) text += (k == 0 ? "" : ", ") + std::to_string(simplex[k]);
  return text + ")";
}

/// Vertices as one-element simplices, so that every list is checked by the same code.
std::vector<Simplex<1>> as_simplices(std::span<const std::int32_t> vertices) {
  std::vector<Simplex<1>> simplices;
  simplices.reserve(vertices.size());
  for (const std::int32_t v : vertices) simplices.push_back({v});
  return simplices;
}

template <std::size_t K>
std::string broken_list(std::span<const Simplex<K>> list, std::size_t balls) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    for (std::size_t k = 0; k < K; ++k) {
      const std::int32_t ball = list[i][k];
      if (ball < 0 || static_cast<std::size_t>(ball) >= balls) {
        return name(list[i]) + " names a ball that is not among the " + std::to_string(balls);
      }
      if (k > 0 && ball <= list[i][k - 1]) return name(list[i]) + " does not ascend";
    }
    if (i > 0 && !(list[i - 1] < list[i])) return name(list[i]) + " is listed twice or out of order";
  }
  return {};
}

/// Checks that the facets of `list` are in `faces`, and that a face is called singular if and only if it
/// is the facet of nothing.
template <std::size_t K>
std::string broken_faces(std::span<const Simplex<K>> list, std::span<const Simplex<K - 1>> faces,
                         std::span<const std::uint8_t> classes, std::size_t balls) {
  if (classes.size() != faces.size()) {
    return std::to_string(faces.size()) + " simplices of dimension " + std::to_string(K - 2) + " but " +
           std::to_string(classes.size()) + " classes";
  }
  // Where the faces that begin with a ball begin: a face is then searched among few.
  std::vector<std::size_t> begin(balls + 1);
  for (const Simplex<K - 1>& face : faces) ++begin[static_cast<std::size_t>(face[0]) + 1];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<bool> has_coface(faces.size());
  for (const Simplex<K>& simplex : list) {
    for (std::size_t omitted = 0; omitted < K; ++omitted) {
      Simplex<K - 1> face{};
      for (std::size_t k = 0; k + 1 < K; ++k) face[k] = simplex[k < omitted ? k : k + 1];
      const auto first = static_cast<std::size_t>(face[0]);
      const auto last = faces.begin() + static_cast<std::ptrdiff_t>(begin[first + 1]);
      const auto at = std::lower_bound(faces.begin() + static_cast<std::ptrdiff_t>(begin[first]), last, face);
      if (at == last || *at != face) {
        return name(simplex) + " is listed, its face " + name(face) + " is not";
      }
      has_coface[static_cast<std::size_t>(at - faces.begin())] = true;
    }
  }
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (classes[i] > static_cast<std::uint8_t>(SimplexClass::singular)) {
      return name(faces[i]) + " has the unknown class " + std::to_string(classes[i]);
    }
    const bool singular = classes[i] == static_cast<std::uint8_t>(SimplexClass::singular);
    if (singular == has_coface[i]) {
      return name(faces[i]) +
             (singular ? " is called singular but has a coface" : " has no coface but is not singular");
    }
  }
  return {};
}

}  // namespace

std::string broken_invariant(const SimplicialComplex& complex) {
  const std::size_t n = complex.centers.size();
  if (complex.weights.size() != n) {
    return std::to_string(n) + " centers but " + std::to_string(complex.weights.size()) + " weights";
  }
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_finite(complex.centers[i])) return "the center of ball " + std::to_string(i) + " is not finite";
    if (!std::isfinite(complex.weights[i]) || complex.weights[i] < 0) {
      return "ball " + std::to_string(i) + " has weight " + std::to_string(complex.weights[i]);
    }
  }
  if (!std::isfinite(complex.delta) || complex.delta < 0) return "delta is " + std::to_string(complex.delta);

  const std::vector<Simplex<1>> vertices = as_simplices(complex.vertices);
  const std::span<const Simplex<1>> points(vertices);
  std::string broken = broken_list(points, n);
  if (broken.empty()) broken = broken_list(complex.edges.span(), n);
  if (broken.empty()) broken = broken_list(complex.triangles.span(), n);
  if (broken.empty()) broken = broken_list(complex.tetrahedra.span(), n);
  if (broken.empty()) broken = broken_faces(complex.edges.span(), points, complex.vertex_classes, n);
  if (broken.empty())
    broken = broken_faces(complex.triangles.span(), complex.edges.span(), complex.edge_classes, n);
  if (broken.empty())
    broken = broken_faces(complex.tetrahedra.span(), complex.triangles.span(), complex.triangle_classes, n);
  if (!broken.empty()) return broken;

  const auto [b0, b1, b2] = complex.betti;
  if (b0 < 0 || b1 < 0 || b2 < 0 || b0 - b1 + b2 != complex.euler_characteristic()) {
    return "Betti numbers " + std::to_string(b0) + ", " + std::to_string(b1) + ", " + std::to_string(b2) +
           " do not fit the Euler characteristic " + std::to_string(complex.euler_characteristic());
  }
  return {};
}

}  // namespace ballflow::geometry
