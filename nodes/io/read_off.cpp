// Object File Format (Geomview): one vertex per line, then one face per line.
#include <string>

#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

struct Header {
  bool normals = false;
  std::int64_t vertices = 0, faces = 0;
};

std::int64_t count(TextCursor& text, const char* what) {
  const std::string_view token = text.token();
  if (const auto value = parse_integer(token); value && *value >= 0) return *value;
  throw InputError(
      "the OFF header gives " + excerpt(token) + " as the number of " + what + text.place_of(token),
      "the header is: OFF, number of vertices, faces and edges");
}

/// [ST][C][N]OFF, then the numbers of vertices, faces and edges. Geomview allows the keyword to be absent.
Header parse_header(TextCursor& text) {
  Header header;
  TextCursor after_keyword = text;
  std::string_view keyword = after_keyword.token();
  if (!parse_integer(keyword)) {
    const std::string_view whole = keyword;
    const auto strip = [&keyword](std::string_view prefix) {
      if (!keyword.starts_with(prefix)) return false;
      keyword.remove_prefix(prefix.size());
      return true;
    };
    strip("ST");
    strip("C");
    header.normals = strip("N");
    if (keyword != "OFF") {
      throw InputError("the OFF file begins with " + excerpt(whole) + text.place_of(whole),
                       "readable are OFF, COFF, NOFF, CNOFF and their ST variants, in three dimensions");
    }
    text = after_keyword;
    if (after_keyword.token() == "BINARY") {
      throw InputError("binary OFF files are not readable", "write the model as text, or as PLY or STL");
    }
  }
  header.vertices = count(text, "vertices");
  header.faces = count(text, "faces");
  text.next_line();
  return header;
}

}  // namespace

RawModel parse_off(std::string_view content, Monitor& monitor) {
  RawModel model;
  TextCursor text(content, '#');
  const Header header = parse_header(text);
  // The shortest vertex is "0 0 0", the shortest face "0"; the last line may lack its end.
  require_room(header.vertices, 6, text.remaining() + 1, "vertices");
  model.vertices.reserve(static_cast<std::size_t>(header.vertices));
  if (header.normals) model.normals.reserve(static_cast<std::size_t>(header.vertices));
  for (std::int64_t i = 0; i < header.vertices; ++i) {
    if (i % elements_per_step == 0)
      monitor.step(static_cast<double>(text.offset()) / static_cast<double>(content.size()));
    const auto coordinate = [&](const char* name) {
      return parse_coordinate(text, text.token(), "vertex", i, name);
    };
    const double x = coordinate("x"), y = coordinate("y"), z = coordinate("z");
    add_vertex(model, {x, y, z});
    if (header.normals) {
      const double nx = coordinate("nx"), ny = coordinate("ny"), nz = coordinate("nz");
      model.normals.push_back({nx, ny, nz});
    }
    text.next_line();  // colours and texture coordinates
  }

  require_room(header.faces, 2, text.remaining() + 1, "faces");
  model.triangles.reserve(static_cast<std::size_t>(header.faces));
  std::vector<std::int32_t> corners;
  for (std::int64_t f = 0; f < header.faces; ++f) {
    if (f % elements_per_step == 0)
      monitor.step(static_cast<double>(text.offset()) / static_cast<double>(content.size()));
    const std::string_view size_token = text.token();
    const auto size = parse_integer(size_token);
    if (!size || *size < 0) {
      throw InputError("face " + std::to_string(f) + ": the number of corners is " +
                           (size_token.empty() ? "missing" : excerpt(size_token)) + text.place_of(size_token),
                       "the file is cut off or damaged; fetch or write it again");
    }
    corners.clear();
    for (std::int64_t k = 0; k < *size; ++k) {
      const std::string_view token = text.token();
      const auto index = parse_integer(token);
      if (!index) {
        throw InputError("face " + std::to_string(f) + ": vertex index " + std::to_string(k) + " of " +
                             std::to_string(*size) + " is " + (token.empty() ? "missing" : excerpt(token)) +
                             text.place_of(token),
                         "the file is cut off or damaged; fetch or write it again");
      }
      if (*index < 0 || *index >= header.vertices) {
        refuse_index("face", f, "vertex", std::to_string(*index), model.vertices.size(),
                     text.place_of(token));
      }
      corners.push_back(static_cast<std::int32_t>(*index));
    }
    add_polygon(model, corners);
    text.next_line();  // colours
  }
  return model;
}

}  // namespace ballflow::geometry
