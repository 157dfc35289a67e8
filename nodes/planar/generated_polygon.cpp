#include "planar/generated_polygon.hpp"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/circle.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

using Rings = std::vector<RawRing>;
using Points = std::vector<Vec2>;

RawRing ring(Points points, const char* name) { return {std::move(points), RingRole::open, name}; }

/// The direction of `part` of `whole` turns.
Vec2 direction(double part, double whole) {
  const auto [c, s] = on_circle(part / whole);
  return {c, s};
}

Points square(double half) { return {{-half, -half}, {half, -half}, {half, half}, {-half, half}}; }

Rings make_square(std::int64_t, double R, double) { return {ring(square(R), "the square")}; }

Rings make_regular(std::int64_t n, double R, double) {
  Points points;
  for (std::int64_t i = 0; i < n; ++i)
    points.push_back(R * direction(static_cast<double>(i), static_cast<double>(n)));
  return {ring(std::move(points), "the regular polygon")};
}

Rings make_star(std::int64_t n, double R, double r) {
  Points points;
  for (std::int64_t i = 0; i < 2 * n; ++i)
    points.push_back((i % 2 == 0 ? R : r) * direction(static_cast<double>(i), static_cast<double>(2 * n)));
  return {ring(std::move(points), "the star")};
}

/// Teeth that fill half of each step; a square hole.
Rings make_gear(std::int64_t n, double R, double r) {
  Points points;
  for (std::int64_t i = 0; i < n; ++i) {
    for (const auto& [quarter, size] : {std::pair(0, r), std::pair(1, R), std::pair(2, R), std::pair(3, r)}) {
      points.push_back(size * direction(static_cast<double>(4 * i + quarter), static_cast<double>(4 * n)));
    }
  }
  return {ring(std::move(points), "the gear"), ring(square(r / 2), "its hole")};
}

/// Frames inside each other, the width of each a third of its half edge.
Rings make_frames(std::int64_t n, double R, double r) {
  Rings rings;
  double half = R;
  for (std::int64_t i = 0; i < n; ++i, half *= r / R) {
    rings.push_back(ring(square(half), i % 2 == 0 ? "a frame" : "a hole"));
  }
  return rings;
}

/// A back of thickness r along x from which n teeth of width r stand up, r apart.
Rings make_comb(std::int64_t n, double R, double r) {
  Points points{{0, 0}, {static_cast<double>(2 * n - 1) * r, 0}};
  for (std::int64_t i = n - 1; i >= 0; --i) {
    const double left = static_cast<double>(2 * i) * r;
    points.push_back({left + r, R});
    points.push_back({left, R});
    if (i > 0) {
      points.push_back({left, r});
      points.push_back({left - r, r});
    }
  }
  return {ring(std::move(points), "the comb")};
}

/// A radical sign of stroke r.
Rings make_sqroot(std::int64_t, double R, double r) {
  return {ring({{R, R},
                {0.05 * R, R},
                {-0.35 * R, -0.55 * R},
                {-0.65 * R, 0.15 * R},
                {-R, 0},
                {-R + 0.3 * r, -r},
                {-0.75 * R, -0.9 * r},
                {-0.4 * R, -R},
                {-0.25 * R, -R},
                {0.05 * R + 0.8 * r, R - r},
                {R, R - r}},
               "the radical sign")};
}

/// An arc of width r, open to the right, and two bars across its left side.
Rings make_euro(std::int64_t n, double R, double r) {
  const double inner = R - r, left = -1.25 * R, right = 0.3 * inner;
  const double edges[] = {0.9 * r, 0.3 * r, -0.3 * r, -0.9 * r};  // of the bars, from above
  Points points;
  // The part of an arc above or below the bars, from its end on the right to the bars or back.
  const auto arc = [&](double radius, bool above, bool to_bars) {
    for (std::int64_t i = 0; i <= n; ++i) {
      const double along = static_cast<double>(above == to_bars ? i : n - i) / static_cast<double>(n);
      const Vec2 p = radius * direction(0.13 + 0.74 * along, 1);
      if (p.x < 0 && (above ? p.y : -p.y) < edges[0] * 1.01) continue;
      if ((p.y > 0) == above) points.push_back(p);
    }
  };
  // A bar from the arc to `end` and back; its edges in the order in which the outline meets them.
  const auto bar = [&](double radius, double end, double first, double second) {
    points.push_back({-std::sqrt(radius * radius - first * first), first});
    points.push_back({end, first});
    points.push_back({end, second});
    points.push_back({-std::sqrt(radius * radius - second * second), second});
  };
  arc(R, true, true);
  bar(R, left, edges[0], edges[1]);
  bar(R, left, edges[2], edges[3]);
  arc(R, false, false);
  arc(inner, false, true);
  bar(inner, right, edges[3], edges[2]);
  bar(inner, right, edges[1], edges[0]);
  arc(inner, true, false);
  return {ring(std::move(points), "the euro sign")};
}

constexpr std::array table = {
    PolygonInfo{"square", "a square of edge 2 R", 4, 4, 0.5, make_square},
    PolygonInfo{"regular", "a regular polygon of n corners on a circle of radius R", 64, 3, 0.5,
                make_regular},
    PolygonInfo{"star", "n points at R and n notches at r, in turn", 5, 2, 0.4, make_star},
    PolygonInfo{"gear", "n teeth from r to R, and a square hole", 12, 3, 0.8, make_gear},
    PolygonInfo{"frames",
                "n squares inside each other, from R on by r / R smaller: frames and what lies in them", 3, 1,
                0.6, make_frames},
    PolygonInfo{"comb", "n teeth of length R, width r and distance r on a back", 5, 1, 0.15, make_comb},
    PolygonInfo{"sqroot", "a radical sign of size 2 R and stroke r", 11, 11, 0.08, make_sqroot},
    PolygonInfo{"euro", "an arc of radius R and width r with n edges a side, and two bars across it", 70, 8,
                0.16, make_euro}};

}  // namespace

std::span<const PolygonInfo> generated_polygons() { return table; }

std::vector<RawRing> generated_rings(std::string_view text) {
  const std::size_t question = text.find('?');
  const std::string name(text.substr(0, question));
  const PolygonInfo* info = nullptr;
  std::string names;
  for (const PolygonInfo& known : table) {
    if (known.name == name) info = &known;
    names += (names.empty() ? "" : ", ") + std::string(known.name);
  }
  if (info == nullptr)
    throw InputError("no generated polygon is called \"" + name + "\"", "there are " + names);
  double n = static_cast<double>(info->n), R = 1, r = 0;
  std::string_view rest = question == std::string_view::npos ? "" : text.substr(question + 1);
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find('&'));
    rest = part.size() == rest.size() ? "" : rest.substr(part.size() + 1);
    const std::size_t equal = part.find('=');
    const std::string_view key = part.substr(0, equal);
    double* const value = key == "n" ? &n : key == "R" ? &R : key == "r" ? &r : nullptr;
    if (value == nullptr) {
      throw InputError("polygon:" + name + " has no parameter " + excerpt(key),
                       "write " + name + "?n=...&R=...&r=..., or fewer of these");
    }
    const auto number = equal == std::string_view::npos ? std::nullopt : parse_real(part.substr(equal + 1));
    if (!number) {
      throw InputError("polygon:" + name + ": " + excerpt(part) + " is no number",
                       "write " + name + "?" + std::string(key) + "=1, say");
    }
    *value = *number;
  }
  if (r == 0) r = info->r_per_R * R;
  // Written so that nan fails.
  if (!(R >= 1e-90 && R <= 1e90 && r > 0 && r < R)) {
    throw InputError("polygon:" + name + ": R is " + std::to_string(R) + " and r is " + std::to_string(r),
                     "0 < r < R, and R from 1e-90 to 1e90");
  }
  if (!(n >= static_cast<double>(info->fewest) && n <= 1e6 &&
        n == static_cast<double>(static_cast<std::int64_t>(n)))) {
    throw InputError("polygon:" + name + ": n is " + std::to_string(n),
                     "a whole number from " + std::to_string(info->fewest) + " to 1000000");
  }
  return info->rings(static_cast<std::int64_t>(n), R, r);
}

}  // namespace ballflow::geometry
