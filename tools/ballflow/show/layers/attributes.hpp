// Attributes that several types have.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "show/scene.hpp"

namespace ballflow::show {

inline Attribute radius_attribute(std::span<const double> radii) {
  return {"radius", "model units", {}, true, {radii.begin(), radii.end()}};
}

/// The position of a vertex in its array: balls that were chosen one after the other show their order.
inline Attribute order_attribute(std::size_t n) {
  Attribute order{"order", "", {}, true, std::vector<double>(n)};
  for (std::size_t i = 0; i < n; ++i) order.values[i] = static_cast<double>(i);
  return order;
}

inline Attribute category_attribute(std::string name, std::vector<std::string> categories, bool per_vertex,
                                    std::span<const std::uint8_t> values) {
  return {std::move(name), "", std::move(categories), per_vertex, {values.begin(), values.end()}};
}

}  // namespace ballflow::show
