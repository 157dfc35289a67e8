// CGAL's exact Minkowski sums, one a process, for tools/bench_minkowski.
//
//   bench_minkowski_peers solids A.off B.off      # closed triangle meshes, Minkowski_sum_3
//   bench_minkowski_peers polygons A B            # files that ReadPolygon reads, or polygon:NAME;
//   minkowski_sum_2
//
// Prints CPU seconds without reading, the volume or area of the sum, and its facets or corners.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_set_2.h>
#include <CGAL/Polygon_with_holes_2.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/minkowski_sum_2.h>
#include <CGAL/minkowski_sum_3.h>

#include <cstdio>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "planar/read_polygon.hpp"

namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<Kernel>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;
using Ring = CGAL::Polygon_2<Kernel>;
using Part = CGAL::Polygon_with_holes_2<Kernel>;
using PartSet = CGAL::Polygon_set_2<Kernel>;

double cpu_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

Polyhedron read(const char* file) {
  Polyhedron surface;
  std::ifstream in(file);
  if (!(in >> surface) || !surface.is_closed())
    throw std::runtime_error(std::string(file) + " is no closed mesh");
  return surface;
}

void solids(const char* a, const char* b) {
  Polyhedron of_a = read(a), of_b = read(b);
  const double begin = cpu_seconds();
  Nef one(of_a), other(of_b);
  Nef sum = CGAL::minkowski_sum_3(one, other);
  Polyhedron surface;
  CGAL::convert_nef_polyhedron_to_polygon_mesh(sum, surface, true);
  const double end = cpu_seconds();
  double volume = 0;
  for (auto facet = surface.facets_begin(); facet != surface.facets_end(); ++facet) {
    const auto edge = facet->halfedge();
    const auto p = [](const auto& point) { return point - CGAL::ORIGIN; };
    volume +=
        CGAL::to_double(CGAL::determinant(p(edge->vertex()->point()), p(edge->next()->vertex()->point()),
                                          p(edge->next()->next()->vertex()->point()))) /
        6;
  }
  std::printf("%.6f %.9g %zu\n", end - begin, volume, surface.size_of_facets());
}

std::vector<Part> parts_of(const ballflow::geometry::Polygon2& polygon) {
  const auto ring = [&polygon](std::int64_t i) {
    Ring points;
    for (const auto p : polygon.ring(static_cast<std::size_t>(i))) points.push_back({p.x, p.y});
    return points;
  };
  std::vector<Part> parts;
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    std::vector<Ring> holes;
    for (std::int64_t i = polygon.component_offsets[k] + 1; i < polygon.component_offsets[k + 1]; ++i)
      holes.push_back(ring(i));
    parts.emplace_back(ring(polygon.component_offsets[k]), holes.begin(), holes.end());
  }
  return parts;
}

void polygons(const char* a, const char* b) {
  const std::vector<Part> of_a = parts_of(ballflow::geometry::read_polygon({a}).polygon),
                          of_b = parts_of(ballflow::geometry::read_polygon({b}).polygon);
  const double begin = cpu_seconds();
  PartSet sum;
  for (const Part& p : of_a) {
    for (const Part& q : of_b) sum.join(CGAL::minkowski_sum_2(p, q));
  }
  std::vector<Part> found;
  sum.polygons_with_holes(std::back_inserter(found));
  const double end = cpu_seconds();
  double area = 0;
  std::size_t corners = 0;
  const auto add = [&](const Ring& ring) {
    area += CGAL::to_double(ring.area());
    corners += ring.size();
  };
  for (const Part& part : found) {
    add(part.outer_boundary());
    for (auto hole = part.holes_begin(); hole != part.holes_end(); ++hole) add(*hole);
  }
  std::printf("%.6f %.9g %zu\n", end - begin, area, corners);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4 && std::strcmp(argv[1], "solids") == 0) {
      solids(argv[2], argv[3]);
      return 0;
    }
    if (argc == 4 && std::strcmp(argv[1], "polygons") == 0) {
      polygons(argv[2], argv[3]);
      return 0;
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  std::fprintf(stderr, "usage: bench_minkowski_peers solids|polygons A B\n");
  return 2;
}
