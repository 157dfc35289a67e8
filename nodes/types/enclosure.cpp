#include "types/enclosure.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace ballflow::geometry {

std::int64_t Enclosure::voids_that_matter() const {
  return std::count_if(void_places.begin(), void_places.end(), [](std::uint8_t place) {
    return place != static_cast<std::uint8_t>(VoidPlace::outside);
  });
}

namespace {

/// Two digits, at least those before the point.
std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, 100 * share >= 10 ? "%.0f" : "%.2g", 100 * share);
  return text;
}

}  // namespace

std::string describe(const Enclosure& e) {
  if (e.encloses()) return "everything inside the surface is in the balls";
  if (e.triangles == 0) return "there is no surface: points enclose nothing";
  std::string text;
  if (!e.covers()) {
    char more[96];
    std::snprintf(more, sizeof more, " (%s %% of the surface, up to %.3g away)",
                  percent(e.area > 0 ? e.open_area / e.area : 0).c_str(), e.gap);
    text = std::to_string(e.open_triangles.size()) + " of " + std::to_string(e.triangles) +
           " triangles are not covered" + (e.gap > 0 ? more : "");
  }
  if (const std::int64_t n = e.voids_that_matter(); n > 0) {
    text += (text.empty() ? "" : ", ") + std::to_string(n) + (n == 1 ? " void" : " voids") +
            (e.closed != 0 ? " inside" : " that the mesh, which is not closed, may have to hold");
  }
  return text;
}

std::string broken_invariant(const Enclosure& e) {
  if (e.balls < 0 || e.triangles < 0 || e.pieces < 0) return "a number is negative";
  if (e.meant > 1) return "meant is " + std::to_string(e.meant) + ", not 0 or 1";
  if (e.closed > 1) return "closed is " + std::to_string(e.closed) + ", not 0 or 1";
  if (e.open_points.size() != e.open_triangles.size() || e.open_why.size() != e.open_triangles.size())
    return "not as many points and reasons as open triangles";
  if (e.void_places.size() != e.void_points.size()) return "not as many places as voids";
  std::int64_t previous = -1;
  for (std::size_t i = 0; i < e.open_triangles.size(); ++i) {
    const std::int64_t triangle = e.open_triangles[i];
    const std::string place = "open_triangles[" + std::to_string(i) + "] = " + std::to_string(triangle);
    if (triangle < 0 || triangle >= e.triangles) return place + " is out of range";
    if (triangle <= previous) return place + " does not ascend";
    if (e.open_why[i] > 1) return "open_why[" + std::to_string(i) + "] is no reason";
    previous = triangle;
  }
  for (std::size_t i = 0; i < e.void_places.size(); ++i) {
    if (e.void_places[i] > 2) return "void_places[" + std::to_string(i) + "] is no place";
  }
  for (const double x : {e.area, e.open_area, e.gap, e.protrusion}) {
    if (!(x >= 0) || !std::isfinite(x)) return "an area or a distance is " + std::to_string(x);
  }
  if (!std::isfinite(e.gap_at_most) || (e.gap_at_most != -1 && e.gap_at_most < e.gap))
    return "gap_at_most is " + std::to_string(e.gap_at_most) + ", less than gap";
  return {};
}

}  // namespace ballflow::geometry
