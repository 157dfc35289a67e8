#include "sample/generate.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/circle.hpp"
#include "exact/exponential.hpp"
#include "io/text_cursor.hpp"
#include "sample/block_mesh.hpp"
#include "sample/frame_mesh.hpp"
#include "sample/implicit_mesh.hpp"
#include "sample/tube_mesh.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t fewest = 50, most = 5'000'000;
constexpr double smallest_size = 1e-100, largest_size = 1e100;

constexpr std::array table = {
    ShapeInfo{Shape::sphere, "sphere", "R: radius; r is not used", 0, 10000, 1, 0, 0},
    ShapeInfo{Shape::torus, "torus", "R: radius of the core circle, r: of the tube", 1, 20000, 1, 0.3, 1},
    ShapeInfo{Shape::double_torus, "doubleTorus",
              "(x^2 (1 - x^2) - y^2)^2 + (z^2 - r^2) / 2 = 0 times R: r is half its height", 2, 85237, 1,
              0.158, 0.35},
    ShapeInfo{Shape::torus_balls, "torusBalls",
              "a torus with six balls of radius 2.1 r smoothly joined; R: radius of the core circle, r: of "
              "the tube",
              1, 40000, 1, 0.18, 0.22},
    ShapeInfo{Shape::cross, "3cross", "three rounded bars of length 2 R and width 2 r, smoothly joined", 0,
              53570, 1, 0.2, 0.5},
    ShapeInfo{Shape::knot, "knot", "a tube of radius r around a trefoil of radius 3 R", 1, 496, 1, 0.45, 0.6},
    ShapeInfo{Shape::s_tube, "sTube", "a tube of radius r with round ends around a sine of length 4 R", 0,
              252, 1, 0.35, 0.45},
    ShapeInfo{Shape::box, "box", "a sharp-edged box of 2 R by 2 R by 2 r", 0, 10000, 1, 0.6, 1e3},
    ShapeInfo{
        Shape::bracket, "bracket",
        "a sharp-edged L of two plates of length R, width 0.8 R and thickness r, with a square hole in one",
        1, 10000, 1, 0.2, 0.4},
    ShapeInfo{Shape::frame, "frame",
              "a cube of edge 2 R less a ball of radius r above R around its middle: its edges", 5, 10000, 1,
              1.2, 1.4},
    ShapeInfo{Shape::bump_box, "bumpBox",
              "a box of 2 R by 0.8 R by 0.6 R with a bump on its top, r from one of its ends: a family of "
              "shapes that differ in one number",
              0, 10000, 1, 0.56, 1}};

std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

template <class T>
T square(const T& x) {
  return x * x;
}
template <class T>
T larger(const T& a, const T& b) {
  return a < b ? b : a;
}
template <class T>
T magnitude(const T& a) {
  return a < T(0) ? T(0) - a : a;
}

/// The smaller of a and b, rounded where they differ by less than k: a parabola with horizontal tangents.
template <class T>
T smooth_min(const T& a, const T& b, double k) {
  const T difference = magnitude(a - b);
  const T& smaller = a < b ? a : b;
  if (!(difference < T(k))) return smaller;
  return smaller - T(0.25 / k) * square(T(k) - difference);
}

/// Signed distance to a box with half edges h, rounded with radius r.
template <class T>
T rounded_box(const std::array<T, 3>& p, const std::array<double, 3>& h, double r) {
  std::array<T, 3> q;
  T outside = T(0);
  for (std::size_t i = 0; i < 3; ++i) {
    q[i] = magnitude(p[i]) - T(h[i] - r);
    outside = outside + square(larger(q[i], T(0)));
  }
  const T inside = larger(q[0], larger(q[1], q[2]));
  using std::sqrt;
  return (inside < T(0) ? inside : sqrt(outside)) - T(r);
}

Box centered(double x, double y, double z) { return {{-x, -y, -z}, {x, y, z}}; }

TriangleMesh sphere(std::int64_t n, Monitor& monitor) {
  const auto f = [](auto x, auto y, auto z) {
    using std::sqrt;
    return sqrt(square(x) + square(y) + square(z)) - 1.0;
  };
  return implicit_mesh({f, centered(1, 1, 1), 1}, n, monitor);
}

TriangleMesh torus(double r, std::int64_t n, Monitor& monitor) {
  const auto f = [r](auto x, auto y, auto z) {
    using std::sqrt;
    return sqrt(square(sqrt(square(x) + square(y)) - 1.0) + square(z)) - r;
  };
  return implicit_mesh({f, centered(1 + r, 1 + r, r), 1}, n, monitor);
}

TriangleMesh double_torus(double r, std::int64_t n, Monitor& monitor) {
  const auto f = [r](auto x, auto y, auto z) {
    const auto xx = square(x);
    return square(xx * (1.0 - xx) - square(y)) + 0.5 * (square(z) - r * r);
  };
  // On the axes: x^4 - x^2 = c and y^2 <= c + 1/4, with c the root of r^2 / 2.
  const double c = r * std::sqrt(0.5);
  return implicit_mesh({f, centered(std::sqrt(0.5 + std::sqrt(0.25 + c)), std::sqrt(0.25 + c), r), 0}, n,
                       monitor);
}

TriangleMesh torus_balls(double r, std::int64_t n, Monitor& monitor) {
  const double ball = 2.1 * r, blend = 0.5 * r;
  std::array<std::array<double, 2>, 6> centers;
  for (std::size_t i = 0; i < 6; ++i) centers[i] = on_circle(static_cast<double>(i) / 6);
  const auto f = [r, ball, blend, centers](auto x, auto y, auto z) {
    using std::sqrt;
    auto d = sqrt(square(sqrt(square(x) + square(y)) - 1.0) + square(z)) - r;
    for (const auto& [c, s] : centers) {
      d = smooth_min(d, sqrt(square(x - c) + square(y - s) + square(z)) - ball, blend);
    }
    return d;
  };
  const double reach = ball + blend;
  return implicit_mesh({f, centered(1 + reach, 1 + reach, reach), 1}, n, monitor);
}

TriangleMesh cross_of_bars(double r, std::int64_t n, Monitor& monitor) {
  const auto f = [r](auto x, auto y, auto z) {
    const std::array p = {x, y, z};
    auto d = rounded_box(p, {1, r, r}, 0.5 * r);
    d = smooth_min(d, rounded_box(p, {r, 1, r}, 0.5 * r), r);
    return smooth_min(d, rounded_box(p, {r, r, 1}, 0.5 * r), r);
  };
  return implicit_mesh({f, centered(1 + r, 1 + r, 1 + r), 1}, n, monitor);
}

TriangleMesh knot(double r, std::int64_t n) {
  TubeCurve curve;
  curve.closed = true;
  curve.point = [](double t) {
    const auto [c1, s1] = on_circle(t);
    const auto [c2, s2] = on_circle(2 * t);
    return Vec3{s1 + 2 * s2, c1 - 2 * c2, -on_circle(3 * t)[1]};
  };
  curve.tangent = [](double t) {
    const auto [c1, s1] = on_circle(t);
    const auto [c2, s2] = on_circle(2 * t);
    return Vec3{c1 + 4 * c2, 4 * s2 - s1, -3 * on_circle(3 * t)[0]};
  };
  curve.side = [point = curve.point](double t) {
    const Vec3 p = point(t);
    return Vec3{p.x, p.y, 0};
  };
  return tube_mesh(curve, r, n);
}

TriangleMesh s_tube(double r, std::int64_t n) {
  constexpr double two_pi = 6.283185307179586476925;
  TubeCurve curve;
  curve.point = [](double t) { return Vec3{0.8 * on_circle(t)[1], 4 * t - 2, 0}; };
  curve.tangent = [](double t) { return Vec3{0.8 * two_pi * on_circle(t)[0], 4, 0}; };
  curve.side = [](double) { return Vec3{0, 0, 1}; };
  return tube_mesh(curve, r, n);
}

/// A closed quad mesh has about as many vertices as faces.
TriangleMesh of_blocks(const Blocks& blocks, std::int64_t n) {
  return block_mesh(blocks, std::sqrt(block_area(blocks) / static_cast<double>(n)));
}

TriangleMesh box(double r, std::int64_t n) {
  return of_blocks({{{{-1, 1}, {-1, 1}, {-r, r}}}, [](int, int, int) { return true; }}, n);
}

TriangleMesh bump_box(double r, std::int64_t n) {
  constexpr double height = 0.32, width = 0.2, top = 0.3;
  TriangleMesh mesh =
      of_blocks({{{{-1, 1}, {-0.4, 0.4}, {-top, top}}}, [](int, int, int) { return true; }}, n);
  std::vector<Vec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  for (Vec3& p : vertices) {
    const double x = p.x - (r - 1);
    if (p.z == top) p.z += height * exponential(-(x * x + p.y * p.y) / (2 * width * width));
  }
  mesh.vertices = std::move(vertices);
  return mesh;
}

TriangleMesh bracket(double r, std::int64_t n) {
  constexpr double width = 0.8;
  const double middle = 0.5 * (1 + r), hole = 0.25 * (1 - r);  // of the lying plate beside the standing one
  const Blocks blocks = {{{{0, r, middle - hole, middle + hole, 1},
                           {0, 0.5 * width - hole, 0.5 * width + hole, width},
                           {0, r, 1}}},
                         [](int i, int j, int k) { return k == 0 ? !(i == 2 && j == 1) : i == 0; }};
  return of_blocks(blocks, n);
}

TriangleMesh frame(double r, std::int64_t n) {
  if (!(r > 1.01))
    throw InputError("frame: r is " + number_text(r) + " R",
                     "r is above 1.01 R, so that the ball opens all sides of the cube");
  return frame_mesh(r, n);
}

TriangleMesh unit_mesh(Shape shape, double r, std::int64_t n, Monitor& monitor) {
  switch (shape) {
    case Shape::sphere:
      return sphere(n, monitor);
    case Shape::torus:
      return torus(r, n, monitor);
    case Shape::double_torus:
      return double_torus(r, n, monitor);
    case Shape::torus_balls:
      return torus_balls(r, n, monitor);
    case Shape::cross:
      return cross_of_bars(r, n, monitor);
    case Shape::knot:
      return knot(r, n);
    case Shape::s_tube:
      return s_tube(r, n);
    case Shape::box:
      return box(r, n);
    case Shape::bracket:
      return bracket(r, n);
    case Shape::frame:
      return frame(r, n);
    case Shape::bump_box:
      return bump_box(r, n);
  }
  throw std::logic_error("a shape without a formula");
}

std::string shape_names() {
  std::string names;
  for (const ShapeInfo& info : table) names += (names.empty() ? "" : ", ") + std::string(info.name);
  return names;
}

}  // namespace

std::span<const ShapeInfo> shapes() { return table; }

const ShapeInfo& shape_info(Shape shape) {
  return *std::find_if(table.begin(), table.end(),
                       [shape](const ShapeInfo& info) { return info.shape == shape; });
}

ShapeOptions parse_shape(std::string_view text) {
  const std::string_view name = text.substr(0, text.find('?'));
  const auto info =
      std::find_if(table.begin(), table.end(), [name](const ShapeInfo& i) { return i.name == name; });
  if (info == table.end())
    throw InputError("there is no shape " + excerpt(name), "the shapes are " + shape_names());
  ShapeOptions options;
  options.shape = info->shape;
  std::string_view rest = name.size() < text.size() ? text.substr(name.size() + 1) : std::string_view();
  while (!rest.empty()) {
    const std::string_view setting = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), setting.size() + 1));
    const std::size_t equals = std::min(setting.find('='), setting.size());
    const std::string_view key = setting.substr(0, equals),
                           value = setting.substr(std::min(equals + 1, setting.size()));
    const std::string place = std::string(info->name) + ": ";
    if (key == "n") {
      const auto count = parse_integer(value);
      if (!count)
        throw InputError(place + "n is " + excerpt(value) + ", not a whole number", "write n=20000");
      options.n = *count;
    } else if (key == "R" || key == "r") {
      const auto size = parse_real(value);
      if (!size)
        throw InputError(place + std::string(key) + " is " + excerpt(value) + ", not a number",
                         "write R=1.5");
      (key == "R" ? options.R : options.r) = *size;
    } else {
      throw InputError(place + "there is no parameter " + excerpt(key),
                       std::string("the parameters are n, R and r; ") + info->doc);
    }
  }
  return options;
}

TriangleMesh generate(const ShapeOptions& options, Monitor& monitor) {
  const ShapeInfo& info = shape_info(options.shape);
  const std::string place = std::string(info.name) + ": ";
  const std::int64_t n = options.n == 0 ? info.n : options.n;
  if (n < fewest || n > most) {
    throw InputError(place + "n is " + std::to_string(n), "n is from " + std::to_string(fewest) + " to " +
                                                              std::to_string(most) +
                                                              ", or 0 for the shape's own number");
  }
  const double R = options.R == 0 ? info.R : options.R;
  if (!(R >= smallest_size && R <= largest_size)) {
    throw InputError(place + "R is " + number_text(R),
                     "R is a positive number, or 0 for the shape's own size");
  }
  if (options.r != 0 && info.r_per_R == 0) throw InputError(place + "r is not used", info.doc);
  const double r = options.r == 0 ? info.r_per_R : options.r / R;
  if (info.r_per_R != 0 && !(r > 0 && r < info.max_r_per_R)) {
    throw InputError(place + "r is " + number_text(options.r),
                     "r is positive and below " + number_text(info.max_r_per_R) + " R; " + info.doc);
  }

  TriangleMesh mesh = unit_mesh(options.shape, r, n, monitor);
  const MeshTopology topology = mesh_topology(mesh);
  if (!topology.closed || !topology.manifold || topology.components != 1 || topology.genus != info.genus) {
    throw InputError(place + std::to_string(n) + " vertices are too few for r = " + number_text(r) + " R",
                     "take a larger n or a larger r");
  }
  std::vector<Vec3> vertices(mesh.vertices.begin(), mesh.vertices.end());
  for (Vec3& p : vertices) p = R * p + Vec3{0, 0, 0};  // no -0
  mesh.vertices = std::move(vertices);
  return mesh;
}

}  // namespace ballflow::geometry
