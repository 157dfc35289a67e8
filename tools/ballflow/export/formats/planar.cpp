// Shapes in the plane as other programs draw and map them: svg, geojson, wkt, poly2d.
#include <algorithm>

#include "base/arctangent.hpp"
#include "base/circle.hpp"
#include "export/formats.hpp"
#include "export/formats/text.hpp"

namespace ballflow {
namespace {

using geometry::DiscOutline;
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

void write_svg(const DiscOutline& outline, OutputFile& out) {
  begin_svg(bounding_box(outline), out);
  out << "<g transform=\"scale(1 -1)\" fill=\"#7a9cc6\" fill-rule=\"evenodd\">\n";
  for (std::size_t k = 0; k < outline.components(); ++k) {
    out << "<path d=\"";
    for (std::int64_t r = outline.component_offsets[k]; r < outline.component_offsets[k + 1]; ++r) {
      const std::int64_t first = outline.ring_offsets[static_cast<std::size_t>(r)],
                         last = outline.ring_offsets[static_cast<std::size_t>(r) + 1];
      for (std::int64_t i = first; i < last; ++i) {
        const auto arc = static_cast<std::size_t>(i);
        const auto disc = static_cast<std::size_t>(outline.arc_discs[arc]);
        const Vec2 center = outline.centers[disc], begin = outline.arc_begins[arc],
                   end = outline.arc_begins[static_cast<std::size_t>(i + 1 < last ? i + 1 : first)];
        const double radius = outline.radii[disc];
        const auto to = [&](Vec2 p) {
          out << 'A' << radius << ' ' << radius << " 0 0 1 " << p.x << ' ' << p.y;
        };
        if (i == first) out << 'M' << begin.x << ' ' << begin.y;
        // A path cannot go all around at once: more than a quarter becomes pieces over the same circle.
        const int pieces = 1 + static_cast<int>(outline.arc_angles[arc] / 1.6);
        const double from = geometry::arctangent(begin.y - center.y, begin.x - center.x);
        for (int piece = 1; piece < pieces; ++piece) {
          const auto [c, s] = geometry::on_circle(
              (from + outline.arc_angles[arc] * (static_cast<double>(piece) / pieces)) / (2 * geometry::pi));
          to(center + radius * Vec2{c, s});
        }
        to(end);
      }
      out << 'Z';
    }
    out << "\"/>\n";
  }
  out << "</g>\n</svg>\n";
}

void write_csv(const DiscOutline& outline, OutputFile& out) {
  out << "ring,x,y,r,begin_x,begin_y,angle\n";
  for (std::size_t r = 0; r < outline.rings(); ++r) {
    for (std::int64_t i = outline.ring_offsets[r]; i < outline.ring_offsets[r + 1]; ++i) {
      const auto arc = static_cast<std::size_t>(i);
      const auto disc = static_cast<std::size_t>(outline.arc_discs[arc]);
      out << r << ',' << outline.centers[disc].x << ',' << outline.centers[disc].y << ','
          << outline.radii[disc] << ',' << outline.arc_begins[arc].x << ',' << outline.arc_begins[arc].y
          << ',' << outline.arc_angles[arc] << '\n';
    }
  }
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
