// Well-known text: POLYGON ((0 0, 1 0, 0 1, 0 0)).
#include <algorithm>
#include <string>
#include <utility>

#include "io/text_cursor.hpp"
#include "planar/polygon_formats.hpp"

namespace ballflow::geometry {
namespace {

class Wkt {
 public:
  Wkt(std::string_view text, Monitor& monitor) : text_(text), monitor_(monitor), look_(monitor) {}

  RawPolygon read() {
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) {
      if (text_[at_] == ';' || text_[at_] == ',') {
        ++at_;
        continue;
      }
      geometry();
    }
    if (dimensions_left_out_) monitor_.warn("the WKT has a third coordinate or a measure, which is left out");
    return std::move(result_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(what + " (line " + std::to_string(line) + ")",
                     "WKT is read as in POLYGON ((0 0, 1 0, 0 1, 0 0))");
  }

  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  static bool ends_word(char c) { return is_blank(c) || c == '(' || c == ')' || c == ',' || c == ';'; }

  std::string_view word() {
    skip_blanks();
    const std::size_t first = at_;
    while (at_ < text_.size() && !ends_word(text_[at_])) ++at_;
    return text_.substr(first, at_ - first);
  }
  std::string upper_word() {
    std::string found(word());
    for (char& c : found) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return found;
  }
  bool next_is(char c) {
    skip_blanks();
    return at_ < text_.size() && text_[at_] == c;
  }
  void expect(char c) {
    if (!next_is(c)) {
      fail(std::string("\"") + c + "\" is missing before " +
           (at_ < text_.size() ? excerpt(text_.substr(at_, 20)) : std::string("the end")));
    }
    ++at_;
  }

  /// Reads one geometry, of which the collection's depth is limited: text may nest as deep as it likes.
  void geometry(int depth = 0) {
    std::string type = upper_word();
    if (type.starts_with("SRID=")) {
      if (next_is(';')) ++at_;
      type = upper_word();
    }
    const std::string full = type;
    for (const char* suffix : {"ZM", "Z", "M"}) {
      if (type.ends_with(suffix) && type.size() > std::string_view(suffix).size() + 5) {
        type.erase(type.size() - std::string_view(suffix).size());
        break;
      }
    }
    const std::size_t before = at_;
    std::string next = upper_word();
    if (next == "Z" || next == "M" || next == "ZM") {
      next = upper_word();
    } else if (next != "EMPTY") {
      at_ = before;
    }
    if (next == "EMPTY") return;
    if (type == "POLYGON") {
      polygon();
    } else if (type == "MULTIPOLYGON") {
      list([this] { polygon(); });
    } else if (type == "GEOMETRYCOLLECTION") {
      if (depth == 50) fail("collections are nested more than 50 deep");
      list([this, depth] { geometry(depth + 1); });
    } else {
      fail("there is " + (full.empty() ? std::string("no geometry") : excerpt(full)) +
           ", not POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION");
    }
  }

  template <class Item>
  void list(const Item& item) {
    expect('(');
    for (;;) {
      item();
      if (!next_is(',')) break;
      ++at_;
    }
    expect(')');
  }

  void polygon() {
    const std::string name = "polygon " + std::to_string(polygons_++);
    int rings = 0;
    list([&] {
      ring(name + (rings == 0 ? ", outer ring" : ", hole " + std::to_string(rings)),
           rings == 0 ? RingRole::outer : RingRole::hole);
      ++rings;
    });
  }

  void ring(std::string name, RingRole role) {
    RawRing ring{{}, role, std::move(name)};
    list([&] {
      look_(16);
      const double x = coordinate(ring, "x"), y = coordinate(ring, "y");
      ring.points.push_back({x, y});
      for (int more = 0; !next_is(',') && !next_is(')'); ++more) {
        if (more == 2) fail("a point of " + ring.name + " has more than four numbers");
        coordinate(ring, more == 0 ? "z" : "m");
        dimensions_left_out_ = true;
      }
    });
    result_.rings.push_back(std::move(ring));
  }

  double coordinate(const RawRing& ring, const char* name) {
    const std::string_view token = word();
    const auto value = parse_real(token);
    if (!value) {
      fail(std::string(name) + " of point " + std::to_string(ring.points.size()) + " of " + ring.name +
           " is " + (token.empty() ? std::string("missing") : excerpt(token)));
    }
    return *value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  Monitor& monitor_;
  Lookout look_;
  RawPolygon result_{PolygonFormat::wkt, {}};
  int polygons_ = 0;
  bool dimensions_left_out_ = false;
};

}  // namespace

RawPolygon parse_wkt(std::string_view content, Monitor& monitor) { return Wkt(content, monitor).read(); }

}  // namespace ballflow::geometry
