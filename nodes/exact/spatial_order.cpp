#include "exact/spatial_order.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <cstddef>
#include <numeric>

namespace ballflow::geometry {

std::vector<std::int32_t> spatial_order(std::span<const Vec3> points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Map = CGAL::Pointer_property_map<Kernel::Point_3>::type;
  std::vector<Kernel::Point_3> sites;
  sites.reserve(points.size());
  for (const Vec3& p : points) sites.emplace_back(p.x, p.y, p.z);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  CGAL::spatial_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>(CGAL::make_property_map(sites)));
  return {order.begin(), order.end()};
}

}  // namespace ballflow::geometry
