// GeoJSON (RFC 7946): the polygons of whatever the file has.
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "io/text_cursor.hpp"
#include "planar/polygon_formats.hpp"

namespace ballflow::geometry {
namespace {

using Json = nlohmann::json;

class GeoJson {
 public:
  explicit GeoJson(Monitor& monitor) : monitor_(monitor), look_(monitor) {}

  RawPolygon read(const Json& document) {
    object(document, 0);
    if (passed_over_ != 0) {
      monitor_.warn(std::to_string(passed_over_) + " geometr" + (passed_over_ == 1 ? "y" : "ies") +
                    " other than polygons " + (passed_over_ == 1 ? "is" : "are") + " passed over");
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] static void fail(const std::string& what) {
    throw InputError(
        "GeoJSON: " + what,
        "RFC 7946: {\"type\": \"Polygon\", \"coordinates\": [[[0, 0], [1, 0], [0, 1], [0, 0]]]}");
  }

  static const Json& member(const Json& object, const char* name) {
    const auto found = object.find(name);
    if (found == object.end()) fail(std::string("an object has no \"") + name + "\"");
    return *found;
  }
  static const Json& array(const Json& value, const std::string& what) {
    if (!value.is_array()) fail(what + " is no array");
    return value;
  }

  void object(const Json& value, int depth) {
    if (!value.is_object()) fail("there is a value where an object should be");
    if (depth == 50) fail("objects are nested more than 50 deep");
    const Json& type_value = member(value, "type");
    const std::string type = type_value.is_string() ? type_value.get<std::string>() : std::string();
    if (type == "FeatureCollection") {
      for (const Json& feature : array(member(value, "features"), "features")) object(feature, depth + 1);
    } else if (type == "Feature") {
      const Json& geometry = member(value, "geometry");
      if (!geometry.is_null()) object(geometry, depth + 1);
    } else if (type == "GeometryCollection") {
      for (const Json& geometry : array(member(value, "geometries"), "geometries"))
        object(geometry, depth + 1);
    } else if (type == "Polygon") {
      polygon(member(value, "coordinates"));
    } else if (type == "MultiPolygon") {
      for (const Json& part : array(member(value, "coordinates"), "coordinates")) polygon(part);
    } else if (type == "Point" || type == "MultiPoint" || type == "LineString" || type == "MultiLineString") {
      ++passed_over_;
    } else {
      fail("there is an object of type " + excerpt(type));
    }
  }

  void polygon(const Json& rings) {
    const std::string name = "polygon " + std::to_string(polygons_++);
    std::size_t number = 0;
    for (const Json& points : array(rings, "the rings of " + name)) {
      RawRing ring{{},
                   number == 0 ? RingRole::outer : RingRole::hole,
                   name + (number == 0 ? ", outer ring" : ", hole " + std::to_string(number))};
      for (const Json& point : array(points, ring.name)) {
        look_(64);
        if (!point.is_array() || point.size() < 2 || !point[0].is_number() || !point[1].is_number()) {
          fail("position " + std::to_string(ring.points.size()) + " of " + ring.name +
               " is not an array of two numbers or more");
        }
        ring.points.push_back({point[0].get<double>(), point[1].get<double>()});
      }
      result_.rings.push_back(std::move(ring));
      ++number;
    }
  }

  Monitor& monitor_;
  Lookout look_;
  RawPolygon result_{PolygonFormat::geojson, {}};
  int polygons_ = 0;
  std::int64_t passed_over_ = 0;
};

}  // namespace

RawPolygon parse_geojson(std::string_view content, Monitor& monitor) {
  try {
    return GeoJson(monitor).read(Json::parse(content));
  } catch (const Json::exception& error) {
    std::string what = error.what();  // "[json.exception...] parse error at line 1, column 2: ..."
    if (const std::size_t begin = what.find("] "); begin != std::string::npos) what.erase(0, begin + 2);
    throw InputError("the file begins like GeoJSON, and cannot be read as JSON: " + what, "correct the file");
  }
}

}  // namespace ballflow::geometry
