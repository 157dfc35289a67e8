// The readers of read_polygon.hpp that have a file of their own.
#pragma once

#include <string_view>

#include "planar/read_polygon.hpp"

namespace ballflow::geometry {

RawPolygon parse_wkt(std::string_view content, Monitor& monitor);
RawPolygon parse_geojson(std::string_view content, Monitor& monitor);
RawPolygon parse_svg(std::string_view content, Monitor& monitor);

}  // namespace ballflow::geometry
