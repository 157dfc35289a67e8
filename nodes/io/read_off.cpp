// Object File Format (Geomview): one vertex per line, then one face per line.
#include <string>
#include <utility>

#include "io/formats.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

struct Header {
  bool normals = false, homogeneous = false;
  std::int64_t vertices = 0, faces = 0;
};

const char* const variants =
    "readable are OFF, COFF, NOFF, CNOFF and their ST variants, 4OFF, and nOFF of dimension 3, as text";

std::int64_t count(TextCursor& text, const char* what) {
  const std::string_view token = text.token();
  if (const auto value = parse_integer(token); value && *value >= 0) return *value;
  throw InputError(
      "the OFF header gives " + excerpt(token) + " as the number of " + what + text.place_of(token),
      "the header is: OFF, number of vertices, faces and edges");
}

/// Whether the next line with anything on it has one number: the dimension that follows nOFF, not counts.
bool is_one_number(TextCursor text) { return parse_integer(text.token()) && text.token_on_line().empty(); }

/// [ST][C][N][4][n]OFF, then the numbers of vertices, faces and edges. Geomview allows the keyword to be
/// absent; ModelNet leaves out the blank after it.
Header parse_header(TextCursor& text) {
  Header header;
  TextCursor after_keyword = text;
  const std::string_view word = after_keyword.token();
  if (!parse_integer(word)) {
    const auto keyword = off_keyword(word);
    if (!keyword)
      throw InputError("the OFF file begins with " + excerpt(word) + text.place_of(word), variants);
    if (keyword->size < word.size()) {
      text.go_to(word.substr(keyword->size));
    } else {
      text = after_keyword;
      if (after_keyword.token() == "BINARY") {
        throw InputError("binary OFF files are not readable", "write the model as text, or as PLY or STL");
      }
    }
    header.normals = keyword->normals;
    header.homogeneous = keyword->homogeneous;
    if (keyword->dimension && !is_one_number(text) && word.ends_with("off")) {
      header.normals = true;  // noff is what some programs make of NOFF
    } else if (keyword->dimension) {
      const std::string_view token = text.token();
      if (token != "3") {
        throw InputError("the OFF file has dimension " + excerpt(token) + text.place_of(token), variants);
      }
    }
  }
  header.vertices = count(text, "vertices");
  header.faces = count(text, "faces");
  text.next_line();
  return header;
}

/// Where a file is out of step, the first line that is too short is the cause, though the error comes later:
/// numbers may go on in the next line. Empty when no line is.
std::string first_short_line(TextCursor text, const Header& header) {
  const auto enough = [&text](std::string_view first, std::int64_t needed) {
    std::int64_t found = 0;
    for (std::string_view token = first; found < needed && !token.empty(); token = text.token_on_line())
      ++found;
    return found == needed;
  };
  const auto is_short = [&text](const char* element, std::int64_t number, std::string_view first) {
    return std::string("; the line of ") + element + " " + std::to_string(number) + " has too few numbers" +
           text.place_of(first);
  };
  for (std::int64_t i = 0; i < header.vertices; ++i, text.next_line()) {
    const std::string_view first = text.token();
    if (first.empty()) return {};
    if (!enough(first, 3 + header.homogeneous + 3 * header.normals)) return is_short("vertex", i, first);
  }
  for (std::int64_t f = 0; f < header.faces; ++f, text.next_line()) {
    const std::string_view first = text.token();
    const auto corners = parse_integer(first);
    if (!corners || *corners < 0) return {};
    if (!enough(first, *corners + 1)) return is_short("face", f, first);
  }
  return {};
}

class Parser {
 public:
  Parser(std::string_view content, Monitor& monitor)
      : text_(content, '#'), size_(content.size()), monitor_(monitor) {}

  RawModel parse() {
    const Header header = parse_header(text_);
    const TextCursor body = text_;
    // The shortest vertex is "0 0 0", the shortest face "0"; the last line may lack its end.
    require_room(header.vertices, 6, text_.remaining() + 1, "vertices");
    try {
      vertices(header);
      faces(header);
      end(header);
    } catch (const InputError& error) {
      const std::string line = first_short_line(body, header);
      if (line.empty()) throw;
      const std::string what = error.what();
      const std::size_t cause = what.find('\n');
      throw InputError(what.substr(0, cause) + line, what.substr(cause + 1));
    }
    return std::move(model_);
  }

 private:
  void step(std::int64_t element) {
    if (element % elements_per_step == 0) {
      monitor_.step(static_cast<double>(text_.offset()) / static_cast<double>(size_));
    }
  }

  void vertices(const Header& header) {
    model_.vertices.reserve(static_cast<std::size_t>(header.vertices));
    if (header.normals) model_.normals.reserve(static_cast<std::size_t>(header.vertices));
    for (std::int64_t i = 0; i < header.vertices; ++i) {
      step(i);
      std::string_view token;
      const auto coordinate = [&](const char* name) {
        token = text_.token();
        return parse_coordinate(text_, token, "vertex", i, name);
      };
      double x = coordinate("x"), y = coordinate("y"), z = coordinate("z");
      if (header.homogeneous) {
        const double w = coordinate("w");
        if (w == 0) {
          throw InputError("vertex " + std::to_string(i) + ": w is 0, the vertex is infinitely far" +
                               text_.place_of(token),
                           "repair or remove it");
        }
        x /= w, y /= w, z /= w;
        require_finite({x, y, z}, "vertex", i);
      }
      add_vertex(model_, {x, y, z});
      if (header.normals) {
        const double nx = coordinate("nx"), ny = coordinate("ny"), nz = coordinate("nz");
        model_.normals.push_back({nx, ny, nz});
      }
      text_.next_line();  // colours and texture coordinates
    }
  }

  void faces(const Header& header) {
    require_room(header.faces, 2, text_.remaining() + 1, "faces");
    model_.triangles.reserve(static_cast<std::size_t>(header.faces));
    std::vector<std::int32_t> corners;
    for (std::int64_t f = 0; f < header.faces; ++f) {
      step(f);
      const std::string_view size_token = text_.token();
      const auto size = parse_integer(size_token);
      if (!size || *size < 0) {
        throw InputError("face " + std::to_string(f) + ": the number of corners is " +
                             (size_token.empty() ? "missing" : excerpt(size_token)) +
                             text_.place_of(size_token),
                         "the file is cut off or damaged; fetch or write it again");
      }
      corners.clear();
      for (std::int64_t k = 0; k < *size; ++k) {
        const std::string_view token = text_.token();
        const auto index = parse_integer(token);
        if (!index) {
          throw InputError("face " + std::to_string(f) + ": vertex index " + std::to_string(k) + " of " +
                               std::to_string(*size) + " is " + (token.empty() ? "missing" : excerpt(token)) +
                               text_.place_of(token),
                           "the file is cut off or damaged; fetch or write it again");
        }
        if (*index < 0 || *index >= header.vertices) {
          refuse_index("face", f, "vertex", std::to_string(*index), model_.vertices.size(),
                       text_.place_of(token));
        }
        corners.push_back(static_cast<std::int32_t>(*index));
      }
      add_polygon(model_, corners);
      text_.next_line();  // colours
    }
  }

  void end(const Header& header) {
    const std::string_view token = text_.token();
    // Some programs pad with zeros.
    if (token.find_first_not_of('\0') == std::string_view::npos) return;
    throw InputError(excerpt(token) + " follows after the " + std::to_string(header.vertices) +
                         " vertices and " + std::to_string(header.faces) + " faces that the header promises" +
                         text_.place_of(token),
                     "correct the numbers in the header, or remove what follows");
  }

  TextCursor text_;
  std::size_t size_;
  Monitor& monitor_;
  RawModel model_;
};

}  // namespace

RawModel parse_off(std::string_view content, Monitor& monitor) { return Parser(content, monitor).parse(); }

}  // namespace ballflow::geometry
