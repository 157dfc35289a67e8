#include "enclose/solid_lattice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "enclose/surface_patches.hpp"
#include "search/surface_chain.hpp"

namespace ballflow::geometry {
namespace {

using Index3 = std::array<std::int64_t, 3>;

class Lattice {
 public:
  Lattice(const Box& box, double spacing) : lower_(box.lower), spacing_(spacing) {
    const Vec3 size = box.upper - box.lower;
    count_ = {1 + static_cast<std::int64_t>(size.x / spacing),
              1 + static_cast<std::int64_t>(size.y / spacing),
              1 + static_cast<std::int64_t>(size.z / spacing)};
  }
  const Index3& count() const { return count_; }
  std::size_t size() const { return static_cast<std::size_t>(count_[0] * count_[1] * count_[2]); }
  std::size_t number(const Index3& i) const {
    return static_cast<std::size_t>((i[2] * count_[1] + i[1]) * count_[0] + i[0]);
  }
  Vec3 point(const Index3& i) const {
    return lower_ +
           spacing_ * Vec3{static_cast<double>(i[0]), static_cast<double>(i[1]), static_cast<double>(i[2])};
  }
  double spacing() const { return spacing_; }
  Vec3 lower() const { return lower_; }

 private:
  Vec3 lower_;
  double spacing_;
  Index3 count_{};
};

std::array<double, 3> coordinates(Vec3 p) { return {p.x, p.y, p.z}; }

/// Where lines along one axis meet the surface.
struct Crossing {
  std::int64_t line;
  double at;  // in units of the lattice
  int sign;
  friend bool operator<(const Crossing& a, const Crossing& b) {
    return a.line != b.line ? a.line < b.line : (a.at != b.at ? a.at < b.at : a.sign < b.sign);
  }
};

/// Twice the area of (a, b, p) in the plane (u, v), the same but for the sign when a and b change places.
double side(std::array<double, 2> a, std::array<double, 2> b, std::array<double, 2> p) {
  const bool swapped = b < a;
  if (swapped) std::swap(a, b);
  const double area = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  return swapped ? -area : area;
}

/// Crossings with the lines of the lattice along `axis`, in order.
std::vector<Crossing> crossings_along(std::size_t axis, const Lattice& lattice,
                                      std::span<const Vec3> vertices, std::span<const Triangle> triangles,
                                      Lookout& look) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Crossing> result;
  std::vector<std::array<double, 3>> scaled;  // in units of the lattice
  for (const Vec3& p : vertices)
    scaled.push_back(coordinates(1.0 / lattice.spacing() * (p - lattice.lower())));
  for (const Triangle& triangle : triangles) {
    std::array<std::array<double, 3>, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = scaled[static_cast<std::size_t>(triangle[k])];
    const auto low = [&](std::size_t c) { return std::min({p[0][c], p[1][c], p[2][c]}); };
    const auto high = [&](std::size_t c) { return std::max({p[0][c], p[1][c], p[2][c]}); };
    const auto first = [&](std::size_t c) {
      return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(low(c))));
    };
    const auto last = [&](std::size_t c) {
      return std::min<std::int64_t>(lattice.count()[c] - 1, static_cast<std::int64_t>(std::floor(high(c))));
    };
    const auto flat = [&](std::size_t k) { return std::array<double, 2>{p[k][u], p[k][v]}; };
    look(static_cast<std::size_t>(
        std::max<std::int64_t>(1, (last(u) - first(u) + 1) * (last(v) - first(v) + 1))));
    for (std::int64_t j = first(v); j <= last(v); ++j) {
      for (std::int64_t i = first(u); i <= last(u); ++i) {
        const std::array<double, 2> q{static_cast<double>(i), static_cast<double>(j)};
        const double a = side(flat(1), flat(2), q), b = side(flat(2), flat(0), q),
                     c = side(flat(0), flat(1), q);
        const bool left = a > 0 && b > 0 && c > 0, right = a < 0 && b < 0 && c < 0;
        if (!left && !right) continue;
        const double at = (a * p[0][axis] + b * p[1][axis] + c * p[2][axis]) / (a + b + c);
        result.push_back({j * lattice.count()[u] + i, at, left ? 1 : -1});
      }
    }
  }
  std::sort(result.begin(), result.end());
  return result;
}

struct Classes {
  std::vector<std::int8_t> votes;  // of lines that see the point inside, less those that see it outside
  std::vector<std::uint8_t> near;  // 1: a crossing is nearest to the point
};

void vote(std::size_t axis, const Lattice& lattice, const std::vector<Crossing>& crossings,
          Classes& classes) {
  const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  const std::int64_t count = lattice.count()[axis];
  std::size_t begin = 0;
  for (std::int64_t line = 0; line < lattice.count()[u] * lattice.count()[v]; ++line) {
    std::size_t end = begin;
    int total = 0;
    for (; end < crossings.size() && crossings[end].line == line; ++end) total += crossings[end].sign;
    Index3 i{};
    i[u] = line % lattice.count()[u];
    i[v] = line / lattice.count()[u];
    int winding = 0;
    std::size_t next = begin;
    for (i[axis] = 0; i[axis] < count; ++i[axis]) {
      for (; next < end && crossings[next].at < static_cast<double>(i[axis]); ++next)
        winding += crossings[next].sign;
      if (total == 0)
        classes.votes[lattice.number(i)] =
            static_cast<std::int8_t>(classes.votes[lattice.number(i)] + (winding != 0 ? 1 : -1));
    }
    for (std::size_t c = begin; c < end; ++c) {
      i[axis] =
          std::clamp<std::int64_t>(static_cast<std::int64_t>(std::lround(crossings[c].at)), 0, count - 1);
      classes.near[lattice.number(i)] = 1;
    }
    begin = end;
  }
}

/// Steps of a king to the nearest point that is marked, at most `most`.
std::vector<std::uint8_t> king_distances(const Lattice& lattice, const std::vector<std::uint8_t>& marked,
                                         std::uint8_t most, Lookout& look) {
  std::vector<std::uint8_t> result(marked.size());
  for (std::size_t i = 0; i < marked.size(); ++i) result[i] = marked[i] != 0 ? 0 : most;
  // A king's distance is the greatest of three along the axes: spread along one axis after another.
  std::vector<std::uint8_t> line, spread;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    const auto count = static_cast<std::size_t>(lattice.count()[axis]);
    const std::size_t stride =
        axis == 0 ? 1
                  : static_cast<std::size_t>(axis == 1 ? lattice.count()[0]
                                                       : lattice.count()[0] * lattice.count()[1]);
    line.resize(count);
    spread.resize(count);
    for (std::int64_t j = 0; j < lattice.count()[v]; ++j) {
      for (std::int64_t i = 0; i < lattice.count()[u]; ++i) {
        Index3 first{};
        first[u] = i;
        first[v] = j;
        const std::size_t begin = lattice.number(first);
        bool any = false;
        for (std::size_t k = 0; k < count; ++k) {
          line[k] = result[begin + k * stride];
          any = any || line[k] < most;
        }
        look(count);
        if (!any) continue;
        // least over j of max(|k - j|, line[j]): a window that is as wide as its value.
        for (std::size_t k = 0; k < count; ++k) {
          std::size_t least = line[k];
          for (std::size_t d = 1; d < least; ++d) {
            if (k >= d) least = std::min(least, std::max<std::size_t>(d, line[k - d]));
            if (k + d < count) least = std::min(least, std::max<std::size_t>(d, line[k + d]));
          }
          spread[k] = static_cast<std::uint8_t>(least);
        }
        for (std::size_t k = 0; k < count; ++k) result[begin + k * stride] = spread[k];
      }
    }
  }
  return result;
}

Box widened(const Box& box, double by) {
  return {box.lower - Vec3{by, by, by}, box.upper + Vec3{by, by, by}};
}

double spacing_for(const Box& box, double area, const SolidLatticeOptions& options) {
  // Shares of the band at the densities 1, 1/8 and 1/64; surfaces have two sides where they are open.
  const double volume = area * options.band * (0.22 + 0.33 / 8 + 0.45 / 64);
  const Vec3 size = box.upper - box.lower;
  constexpr double most_points = 1.5e6;
  return std::max({std::cbrt(volume / static_cast<double>(options.points)),
                   std::cbrt(size.x * size.y * size.z / most_points), options.band / 100});
}

}  // namespace

OutsidePoints outside_points(const TriangleMesh& mesh, const SolidLatticeOptions& options, Monitor& monitor) {
  const SurfaceChain chain = surface_chain(mesh);
  const std::span<const Vec3> vertices = mesh.vertices.span();
  const Box box = widened(bounding_box(vertices), 1.5 * options.band);
  const Lattice lattice(box, spacing_for(box, surface_area(vertices, mesh.triangles.span()), options));
  Lookout look(monitor);
  Classes classes{std::vector<std::int8_t>(lattice.size(), 0), std::vector<std::uint8_t>(lattice.size(), 0)};
  for (std::size_t axis = 0; axis < 3; ++axis)
    vote(axis, lattice, crossings_along(axis, lattice, vertices, chain.triangles, look), classes);

  OutsidePoints result;
  result.spacing = lattice.spacing();
  result.unit = lattice.spacing() * lattice.spacing() * lattice.spacing();
  std::vector<std::uint8_t> solid(lattice.size());
  for (std::size_t i = 0; i < solid.size(); ++i) {
    const bool inside = classes.votes[i] > 0;
    result.solid += inside ? 1 : 0;
    solid[i] = inside || classes.near[i] != 0 ? 1 : 0;
  }
  const double steps = options.band / lattice.spacing();
  const auto most = static_cast<std::uint8_t>(std::min(250.0, std::ceil(steps) + 1));
  const std::vector<std::uint8_t> distance = king_distances(lattice, solid, most, look);
  std::int64_t between = 1;  // of the points inside
  while ((between + 1) * (between + 1) * (between + 1) * options.inside <= result.solid) ++between;
  Index3 i{};
  for (i[2] = 0; i[2] < lattice.count()[2]; ++i[2]) {
    for (i[1] = 0; i[1] < lattice.count()[1]; ++i[1]) {
      for (i[0] = 0; i[0] < lattice.count()[0]; ++i[0]) {
        const std::size_t n = lattice.number(i);
        const auto every = [&](std::int64_t step) {
          return i[0] % step == 0 && i[1] % step == 0 && i[2] % step == 0;
        };
        if (classes.votes[n] > 0) {
          if (every(between)) result.inside.push_back(lattice.point(i));
          continue;
        }
        const double d = distance[n];
        const std::int64_t step = d <= 0.22 * steps ? 1 : d <= 0.55 * steps ? 2 : d <= steps ? 4 : 8;
        if (!every(step)) continue;
        result.points.push_back(lattice.point(i));
        result.weights.push_back(static_cast<std::int32_t>(step * step * step));
      }
    }
  }
  return result;
}

}  // namespace ballflow::geometry
