// Shapes in the plane as other programs draw and map them: svg, geojson, wkt, poly2d.
#include <algorithm>

#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {
namespace {

using geometry::Polygon2;
using geometry::Vec2;

/// A drawing around the box with y upwards: in SVG y points down.
void begin_svg(const geometry::Box& box, OutputFile& out) {
  const geometry::Vec3 low = box.empty() ? geometry::Vec3{} : box.lower, high = box.empty() ? low : box.upper;
  out << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"" << low.x << ' ' << -high.y << ' '
      << std::max(high.x - low.x, 0.0) << ' ' << std::max(high.y - low.y, 0.0) << "\">\n";
}

template <class Ring>
void for_each_component(const Polygon2& polygon, OutputFile& out, const char* begin, const char* end,
                        const Ring& ring) {
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    out << (k == 0 ? "" : ", ") << begin;
    for (std::int64_t r = polygon.component_offsets[k]; r < polygon.component_offsets[k + 1]; ++r) {
      out << (r == polygon.component_offsets[k] ? "" : ", ");
      ring(polygon.ring(static_cast<std::size_t>(r)));
    }
    out << end;
  }
}

}  // namespace

void write_svg(const Polygon2& polygon, OutputFile& out) {
  begin_svg(bounding_box(polygon), out);
  out << "<g transform=\"scale(1 -1)\" fill=\"#7a9cc6\" fill-rule=\"evenodd\">\n";
  for (std::size_t k = 0; k < polygon.components(); ++k) {
    out << "<path d=\"";
    for (std::int64_t r = polygon.component_offsets[k]; r < polygon.component_offsets[k + 1]; ++r) {
      char command = 'M';
      for (const Vec2 p : polygon.ring(static_cast<std::size_t>(r))) {
        out << command << p.x << ' ' << p.y;
        command = 'L';
      }
      out << 'Z';
    }
    out << "\"/>\n";
  }
  out << "</g>\n</svg>\n";
}

void write_svg(const PolyData& data, OutputFile& out) {
  geometry::Box box;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const double r = (*data.radii)[i];
    box.add(data.points[i] - geometry::Vec3{r, r, r});
    box.add(data.points[i] + geometry::Vec3{r, r, r});
  }
  begin_svg(box, out);
  out << "<g transform=\"scale(1 -1)\" fill=\"#7a9cc6\" fill-opacity=\"0.5\">\n";
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    out << "<circle cx=\"" << data.points[i].x << "\" cy=\"" << data.points[i].y << "\" r=\""
        << (*data.radii)[i] << "\"/>\n";
  }
  out << "</g>\n</svg>\n";
}

void write_geojson(const Polygon2& polygon, OutputFile& out) {
  out << "{\"type\": \"MultiPolygon\", \"coordinates\": [";
  for_each_component(polygon, out, "[", "]", [&out](std::span<const Vec2> ring) {
    out << '[';
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Vec2 p = ring[i % ring.size()];
      out << (i == 0 ? "[" : ", [") << p.x << ", " << p.y << ']';
    }
    out << ']';
  });
  out << "]}\n";
}

void write_wkt(const Polygon2& polygon, OutputFile& out) {
  if (polygon.components() == 0) {
    out << "MULTIPOLYGON EMPTY\n";
    return;
  }
  out << "MULTIPOLYGON (";
  for_each_component(polygon, out, "(", ")", [&out](std::span<const Vec2> ring) {
    out << '(';
    for (std::size_t i = 0; i <= ring.size(); ++i) {
      const Vec2 p = ring[i % ring.size()];
      out << (i == 0 ? "" : ", ") << p.x << ' ' << p.y;
    }
    out << ')';
  });
  out << ")\n";
}

void write_poly2d(const Polygon2& polygon, OutputFile& out) {
  out << polygon.rings() << '\n';
  for (std::size_t r = 0; r < polygon.rings(); ++r) {
    out << polygon.ring(r).size() << '\n';
    for (const Vec2 p : polygon.ring(r)) out << p.x << ' ' << p.y << '\n';
  }
}

}  // namespace ballflow
