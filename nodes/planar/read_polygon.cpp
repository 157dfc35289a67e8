#include "planar/read_polygon.hpp"

#include <utility>

#include "io/file_content.hpp"
#include "io/lengths.hpp"
#include "io/text_cursor.hpp"
#include "planar/generated_polygon.hpp"
#include "planar/polygon_formats.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t max_bytes = std::int64_t{2} << 30;
constexpr std::string_view generated_scheme = "polygon:";

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool begins_number(char c) { return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.'; }

RawPolygon parse_poly2d(std::string_view content, Monitor& monitor) {
  Lookout look(monitor);
  TextCursor text(content, '#');
  const auto count = [&](const std::string& what) {
    const std::string_view token = text.token();
    const auto number = parse_integer(token);
    if (!number || *number < 0) {
      throw InputError(what + " is " + (token.empty() ? "missing" : excerpt(token)) + text.place_of(token),
                       "a .poly2d file has the number of rings, then of each the number of its points and "
                       "\"x y\" of each point");
    }
    return *number;
  };
  RawPolygon polygon{PolygonFormat::poly2d, {}};
  const std::int64_t rings = count("the number of rings");
  for (std::int64_t r = 0; r < rings; ++r) {
    const std::string name = "ring " + std::to_string(r);
    const std::int64_t points = count("the number of points of " + name);
    RawRing ring{{}, RingRole::open, name};
    for (std::int64_t i = 0; i < points; ++i) {
      look(16);
      const std::string_view x = text.token();
      const double first = parse_coordinate(text, x, "point", i, "x");
      ring.points.push_back({first, parse_coordinate(text, text.token(), "point", i, "y")});
    }
    polygon.rings.push_back(std::move(ring));
  }
  if (const std::string_view more = text.token(); !more.empty()) {
    throw InputError("after the last ring comes " + excerpt(more) + text.place_of(more),
                     "correct the number of rings or of points");
  }
  return polygon;
}

}  // namespace

const char* name_of(PolygonFormat format) {
  switch (format) {
    case PolygonFormat::wkt:
      return "WKT";
    case PolygonFormat::geojson:
      return "GeoJSON";
    case PolygonFormat::svg:
      return "SVG";
    default:
      return "poly2d";
  }
}

RawPolygon parse_polygon(std::string_view content, Monitor& monitor) {
  TextCursor text(content, '#');
  const std::string_view first = text.token();
  const char c = first.empty() ? '\0' : first[0];
  RawPolygon polygon;
  if (c == '{') {
    polygon = parse_geojson(content, monitor);
  } else if (c == '<') {
    polygon = parse_svg(content, monitor);
  } else if (is_letter(c)) {
    polygon = parse_wkt(content, monitor);
  } else if (begins_number(c)) {
    polygon = parse_poly2d(content, monitor);
  } else {
    throw InputError("the content begins with " + excerpt(first) + ", as no format of polygons does",
                     "readable are .poly2d, WKT, GeoJSON and SVG");
  }
  if (polygon.rings.empty()) {
    throw InputError(std::string("the ") + name_of(polygon.format) + " has no polygon",
                     "points and lines bound nothing; export the shape as polygons");
  }
  return polygon;
}

NestedRings read_polygon(const ReadPolygonOptions& options, Monitor& monitor) {
  const double scale = parse_scale(options.scale);
  RawPolygon polygon;
  const bool generated = options.file.starts_with(generated_scheme);
  if (generated) {
    polygon.rings = generated_rings(std::string_view(options.file).substr(generated_scheme.size()));
  } else {
    const FileContent content = read_file_content(options.file, max_bytes);
    polygon = parse_polygon(content.view(), monitor);
  }
  const bool down = options.y == YAxis::down ||
                    (options.y == YAxis::automatic && !generated && polygon.format == PolygonFormat::svg);
  for (RawRing& ring : polygon.rings) {
    for (Vec2& p : ring.points) p = {scale * p.x, (down ? -scale : scale) * p.y};
  }
  return nest(std::move(polygon.rings), monitor);
}

}  // namespace ballflow::geometry
