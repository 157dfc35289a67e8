// SVG: the straight shapes of a drawing, with the transforms above them.
#include <tinyxml2.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "base/circle.hpp"
#include "io/text_cursor.hpp"
#include "planar/polygon_formats.hpp"

namespace ballflow::geometry {
namespace {

using tinyxml2::XMLElement;

/// x' = a x + c y + e, y' = b x + d y + f.
struct Affine {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;

  Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
  Affine operator*(const Affine& o) const {
    return {a * o.a + c * o.b, b * o.a + d * o.b,     a * o.c + c * o.d,
            b * o.c + d * o.d, a * o.e + c * o.f + e, b * o.e + d * o.f + f};
  }
};

[[noreturn]] void fail(const XMLElement& element, const std::string& what, const char* hint) {
  throw InputError("SVG: " + std::string(element.Name()) + " " + what + " (line " +
                       std::to_string(element.GetLineNum()) + ")",
                   hint);
}

/// Numbers of attributes: after each may come blanks and a comma, or at once the sign of the next.
class Numbers {
 public:
  Numbers(const XMLElement& element, std::string_view text) : element_(element), text_(text) {}

  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == ',')) ++at_;
  }
  bool at_end() {
    skip();
    return at_ == text_.size();
  }
  char peek() {
    skip();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  char take() {
    const char c = peek();
    at_ += c != '\0';
    return c;
  }
  bool at_number() {
    const char c = peek();
    return (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
  }
  double number() {
    skip();
    const std::size_t first = at_;
    const auto digits = [this] {
      const std::size_t begin = at_;
      while (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9') ++at_;
      return at_ != begin;
    };
    if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) ++at_;
    bool some = digits();
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      some = digits() || some;
    }
    if (some && at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      const std::size_t mark = at_++;
      if (at_ < text_.size() && (text_[at_] == '+' || text_[at_] == '-')) ++at_;
      if (!digits()) at_ = mark;
    }
    std::string_view token = text_.substr(first, at_ - first);
    if (!token.empty() && token[0] == '+') token.remove_prefix(1);
    const auto value = some ? parse_real(token) : std::nullopt;
    if (!value) {
      fail(element_, "has " + excerpt(text_.substr(first, 20)) + " where a number should be",
           "correct the attribute");
    }
    return *value;
  }
  Vec2 point() {
    const double x = number();
    return {x, number()};
  }
  std::string_view word() {
    skip();
    const std::size_t first = at_;
    while (at_ < text_.size() && ((text_[at_] | 32) >= 'a' && (text_[at_] | 32) <= 'z')) ++at_;
    return text_.substr(first, at_ - first);
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f'; }
  const XMLElement& element_;
  std::string_view text_;
  std::size_t at_ = 0;
};

Affine transform_of(const XMLElement& element) {
  Affine result;
  const char* const text = element.Attribute("transform");
  if (text == nullptr) return result;
  Numbers numbers(element, text);
  while (!numbers.at_end()) {
    const std::string name(numbers.word());
    std::vector<double> v;
    if (numbers.take() != '(') fail(element, "has a transform without parentheses", "correct the attribute");
    while (numbers.at_number()) v.push_back(numbers.number());
    if (numbers.take() != ')') fail(element, "has a transform without parentheses", "correct the attribute");
    const std::size_t n = v.size();
    if (name == "matrix" && n == 6) {
      result = result * Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
    } else if (name == "translate" && (n == 1 || n == 2)) {
      result = result * Affine{1, 0, 0, 1, v[0], n == 2 ? v[1] : 0};
    } else if (name == "scale" && (n == 1 || n == 2)) {
      result = result * Affine{v[0], 0, 0, n == 2 ? v[1] : v[0], 0, 0};
    } else if (name == "rotate" && (n == 1 || n == 3)) {
      const auto [c, s] = on_circle(v[0] / 360);
      const Vec2 o = n == 3 ? Vec2{v[1], v[2]} : Vec2{};
      result =
          result * Affine{1, 0, 0, 1, o.x, o.y} * Affine{c, s, -s, c, 0, 0} * Affine{1, 0, 0, 1, -o.x, -o.y};
    } else {
      fail(element, "has the transform " + excerpt(name) + " with " + std::to_string(n) + " numbers",
           "matrix, translate, scale and rotate are known; apply the transform in the drawing program");
    }
  }
  return result;
}

constexpr const char* flatten =
    "convert curves to straight segments first (Inkscape: Extensions, Modify Path, Flatten Beziers)";

class Svg {
 public:
  Svg(Monitor& monitor) : look_(monitor) {}

  RawPolygon read(const XMLElement& root) {
    if (local_name(root) != "svg") {
      fail(root, "is the root element, not svg", "readable are .poly2d, WKT, GeoJSON and SVG");
    }
    children(root, {}, 0);
    return std::move(result_);
  }

 private:
  static std::string_view local_name(const XMLElement& element) {
    const std::string_view name = element.Name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
  }

  void children(const XMLElement& parent, const Affine& above, int depth) {
    if (depth == 200) fail(parent, "is nested more than 200 deep", "simplify the drawing");
    for (const XMLElement* e = parent.FirstChildElement(); e != nullptr; e = e->NextSiblingElement()) {
      look_(64);
      const std::string_view name = local_name(*e);
      if (name == "g" || name == "svg" || name == "a" || name == "switch") {
        children(*e, above * transform_of(*e), depth + 1);
      } else if (name == "path") {
        path(*e, above * transform_of(*e));
      } else if (name == "polygon") {
        polygon(*e, above * transform_of(*e));
      } else if (name == "rect") {
        rect(*e, above * transform_of(*e));
      } else if (name == "circle" || name == "ellipse" || name == "line" || name == "polyline" ||
                 name == "use") {
        fail(*e, "is no polygon", "leave it out, or convert it to a path of straight segments");
      }
    }
  }

  void add(const XMLElement& element, const Affine& map, std::vector<Vec2> points) {
    for (Vec2& p : points) p = map(p);
    result_.rings.push_back({std::move(points), RingRole::open,
                             "ring " + std::to_string(result_.rings.size()) + " (" + element.Name() +
                                 ", line " + std::to_string(element.GetLineNum()) + ")"});
  }

  void polygon(const XMLElement& element, const Affine& map) {
    const char* const text = element.Attribute("points");
    if (text == nullptr) fail(element, "has no points", "correct the drawing");
    Numbers numbers(element, text);
    std::vector<Vec2> points;
    while (!numbers.at_end()) points.push_back(numbers.point());
    add(element, map, std::move(points));
  }

  void rect(const XMLElement& element, const Affine& map) {
    const auto length = [&](const char* name, bool needed) {
      const char* const text = element.Attribute(name);
      if (text == nullptr) {
        if (needed) fail(element, std::string("has no ") + name, "correct the drawing");
        return 0.0;
      }
      Numbers numbers(element, text);
      const double value = numbers.number();
      if (!numbers.at_end())
        fail(element, std::string("has a unit or more in ") + name, "use user units, without a unit");
      return value;
    };
    if (length("rx", false) != 0 || length("ry", false) != 0) fail(element, "has round corners", flatten);
    const double x = length("x", false), y = length("y", false), w = length("width", true),
                 h = length("height", true);
    add(element, map, {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}});
  }

  void path(const XMLElement& element, const Affine& map) {
    const char* const text = element.Attribute("d");
    if (text == nullptr) return;
    Numbers numbers(element, text);
    std::vector<Vec2> points;
    Vec2 here, start;
    const auto finish = [&] {
      if (points.size() > 1) add(element, map, std::move(points));
      points.clear();
    };
    char command = 0;
    while (!numbers.at_end()) {
      look_(64);
      if (!numbers.at_number()) {
        command = numbers.take();
      } else if (command == 'M' || command == 'm') {
        command = command == 'M' ? 'L' : 'l';  // further points of a move are lines
      } else if (command == 0 || command == 'Z' || command == 'z') {
        fail(element, "has a number without a command before it", "correct the drawing");
      }
      const bool relative = command >= 'a' && command <= 'z';
      switch (command) {
        case 'M':
        case 'm': {
          finish();
          const Vec2 p = numbers.point();
          here = start = relative ? here + p : p;
          points = {here};
          break;
        }
        case 'L':
        case 'l': {
          const Vec2 p = numbers.point();
          here = relative ? here + p : p;
          break;
        }
        case 'H':
        case 'h': {
          const double x = numbers.number();
          here.x = relative ? here.x + x : x;
          break;
        }
        case 'V':
        case 'v': {
          const double y = numbers.number();
          here.y = relative ? here.y + y : y;
          break;
        }
        case 'Z':
        case 'z':
          finish();
          here = start;
          break;
        default:
          fail(element,
               std::string("has the command ") + excerpt(std::string_view(&command, 1)) +
                   ", not a straight segment",
               flatten);
      }
      if (command == 'M' || command == 'm' || command == 'Z' || command == 'z') continue;
      if (points.empty()) points.push_back(start);  // after Z without M
      points.push_back(here);
    }
    finish();
  }

  Lookout look_;
  RawPolygon result_{PolygonFormat::svg, {}};
};

}  // namespace

RawPolygon parse_svg(std::string_view content, Monitor& monitor) {
  tinyxml2::XMLDocument document;
  if (document.Parse(content.data(), content.size()) != tinyxml2::XML_SUCCESS ||
      document.RootElement() == nullptr) {
    throw InputError("the file begins like XML, and is damaged: " + std::string(document.ErrorName()) +
                         " (line " + std::to_string(document.ErrorLineNum()) + ")",
                     "correct the file; readable are .poly2d, WKT, GeoJSON and SVG");
  }
  return Svg(monitor).read(*document.RootElement());
}

}  // namespace ballflow::geometry
