// STL, ASCII and binary. Facet normals are not vertex normals and are passed over.
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "io/raw_model.hpp"
#include "io/stl_layout.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

double little_endian_f32(const char* p) {
  return static_cast<double>(std::bit_cast<float>(little_endian_u32(p)));
}

void add_facet(RawModel& model, const std::array<Vec3, 3>& facet) {
  const auto first = static_cast<std::int32_t>(model.vertices.size());
  for (const Vec3& p : facet) add_vertex(model, p);
  add_polygon(model, std::array<std::int32_t, 3>{first, first + 1, first + 2});
}

/// Binary files may begin with "solid", too: then the length, which follows from the number of facets, or a
/// zero byte gives them away.
bool is_binary(std::string_view content) {
  const auto layout = stl_layout(content);
  if (layout && layout->facets == layout->fitting && layout->extra == 0) return true;
  const std::size_t word = std::min(content.find_first_not_of(" \t\r\n"), content.size());
  std::string start(content.substr(word, 5));
  std::transform(start.begin(), start.end(), start.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  return start != "solid" || content.substr(0, 1024).find('\0') != std::string_view::npos;
}

RawModel parse_binary(std::string_view content, Monitor& monitor) {
  RawModel model;
  const auto layout = stl_layout(content);
  if (!layout) {
    throw InputError("the STL file has " + std::to_string(content.size()) +
                         " bytes, fewer than the header of a binary one",
                     "is it an STL file? A text file begins with \"solid\"");
  }
  if (content.substr(0, 1024).find('\0') == std::string_view::npos && layout->facets > layout->fitting) {
    TextCursor text(content);
    const std::string_view word = text.token();
    throw InputError("the STL file is a text that begins with " + excerpt(word) + text.place_of(word) +
                         " where \"solid\" should be",
                     "is it an STL file? Its extension says so");
  }
  std::int64_t facets = layout->facets;
  // Programs that write while they count leave 0 or the largest number.
  const bool unknown = facets == 0 || facets == std::numeric_limits<std::uint32_t>::max();
  if (layout->extra == 0 && facets != layout->fitting && (unknown || facets < layout->fitting)) {
    model.warnings.push_back("the header promises " + std::to_string(facets) +
                             " facets, the length of the file is that of " + std::to_string(layout->fitting) +
                             ": these are read");
    facets = layout->fitting;
  }
  const std::size_t left = content.size() - stl_header_bytes;
  require_room(facets, stl_facet_bytes, left, "facets");
  if (const std::size_t extra = left - static_cast<std::size_t>(facets) * stl_facet_bytes; extra != 0) {
    model.warnings.push_back(std::to_string(extra) + " bytes after the last of the " +
                             std::to_string(facets) + " facets that the header promises are passed over");
  }
  model.vertices.reserve(static_cast<std::size_t>(facets) * 3);
  model.triangles.reserve(static_cast<std::size_t>(facets));
  for (std::int64_t f = 0; f < facets; ++f) {
    if (f % elements_per_step == 0) monitor.step(static_cast<double>(f) / static_cast<double>(facets));
    const char* at = content.data() + stl_header_bytes + static_cast<std::size_t>(f) * stl_facet_bytes + 12;
    std::array<Vec3, 3> facet;
    for (Vec3& p : facet) {
      p = {little_endian_f32(at), little_endian_f32(at + 4), little_endian_f32(at + 8)};
      require_finite(p, "facet", f);
      at += 12;
    }
    add_facet(model, facet);
  }
  return model;
}

class AsciiParser {
 public:
  AsciiParser(std::string_view content, Monitor& monitor)
      : text_(content), size_(content.size()), monitor_(monitor) {}

  RawModel parse() {
    while (solid()) {
    }
    return std::move(model_);
  }

 private:
  bool is(std::string_view token, std::string_view keyword) const {
    return token.size() == keyword.size() &&
           std::equal(token.begin(), token.end(), keyword.begin(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
  }
  [[noreturn]] void refuse(const std::string& expected, std::string_view token) const {
    throw InputError("facet " + std::to_string(model_.faces) + ": " + expected + " expected, found " +
                         (token.empty() ? "the end of the file" : excerpt(token)) + text_.place_of(token),
                     "the file is cut off or damaged; fetch or write it again");
  }
  void expect(std::string_view keyword) {
    const std::string_view token = text_.token();
    if (!is(token, keyword)) refuse("\"" + std::string(keyword) + "\"", token);
  }
  /// "endloop", or in two words.
  void expect_end(std::string_view what) {
    const std::string_view token = text_.token();
    if (is(token, "end")) return expect(what);
    if (token.size() < 3 || !is(token.substr(0, 3), "end") || !is(token.substr(3), what)) {
      refuse("\"end" + std::string(what) + "\"", token);
    }
  }

  /// solid NAME facet... endsolid NAME; false at the end of the text.
  bool solid() {
    std::string_view token = text_.token();
    if (token.empty()) return false;
    if (!is(token, "solid")) {
      throw InputError(
          "\"solid\" expected after the last facet, found " + excerpt(token) + text_.place_of(token),
          "the file is damaged; fetch or write it again");
    }
    skip_name();
    for (;;) {
      token = text_.token();
      if (is(token, "endsolid")) break;
      if (is(token, "end")) {
        expect("solid");
        break;
      }
      if (token.empty()) {
        throw InputError("the STL file ends after facet " + std::to_string(model_.faces) +
                             " without \"endsolid\"" + text_.place_of(token),
                         "the file is cut off; fetch or write it again");
      }
      if (!is(token, "facet")) refuse("\"facet\" or \"endsolid\"", token);
      facet();
    }
    text_.next_line();
    return true;
  }

  /// The name of a solid takes the line, but a facet may follow on it.
  void skip_name() {
    TextCursor ahead = text_;
    for (std::string_view token = ahead.token_on_line(); !token.empty();) {
      const std::string_view next = ahead.token_on_line();
      if (is(token, "facet") && is(next, "normal")) return text_.go_to(token);
      token = next;
    }
    text_.next_line();
  }

  void facet() {
    if (model_.faces % elements_per_step == 0) {
      monitor_.step(static_cast<double>(text_.offset()) / static_cast<double>(size_));
    }
    // The normal, which some programs leave out or write as no numbers.
    std::string_view token = text_.token();
    for (int words = 0; words < 4 && !token.empty() && !is(token, "outer"); ++words) token = text_.token();
    if (!is(token, "outer")) refuse("\"outer\"", token);
    expect("loop");
    std::array<Vec3, 3> corners;
    for (Vec3& p : corners) {
      expect("vertex");
      const auto coordinate = [this](const char* name) {
        return parse_coordinate(text_, text_.token_on_line(), "facet", model_.faces, name);
      };
      p.x = coordinate("x");
      p.y = coordinate("y");
      p.z = coordinate("z");
    }
    expect_end("loop");
    expect_end("facet");
    add_facet(model_, corners);
  }

  TextCursor text_;
  std::size_t size_;
  Monitor& monitor_;
  RawModel model_;
};

}  // namespace

RawModel parse_stl(std::string_view content, Monitor& monitor) {
  RawModel model =
      is_binary(content) ? parse_binary(content, monitor) : AsciiParser(content, monitor).parse();
  model.own_corners = true;
  return model;
}

}  // namespace ballflow::geometry
