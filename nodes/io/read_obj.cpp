// Wavefront OBJ: v, vn and f; everything else (texture coordinates, lines, groups, materials) is passed over.
#include <limits>
#include <optional>
#include <utility>

#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

/// A corner "v", "v/vt", "v//vn" or "v/vt/vn" as written: from 1, or negative, counted from the last one.
struct Corner {
  std::optional<std::int64_t> vertex, normal;
  bool has_normal = false;
};

Corner parse_corner(std::string_view token) {
  Corner corner;
  const std::size_t slash = token.find('/');
  corner.vertex = parse_integer(token.substr(0, slash));
  if (slash == std::string_view::npos) return corner;
  const std::size_t second = token.find('/', slash + 1);
  if (second == std::string_view::npos || second + 1 == token.size()) return corner;
  corner.has_normal = true;
  corner.normal = parse_integer(token.substr(second + 1));
  return corner;
}

/// An index above what is defined so far; OBJ files may define it later.
struct ForwardReference {
  std::int64_t face;
  std::int64_t index;  // from 0
  std::string_view token;
};

class Parser {
 public:
  Parser(std::string_view content, Monitor& monitor)
      : text_(content, '#'), size_(content.size()), monitor_(monitor) {}

  RawModel parse() {
    for (std::int64_t line = 0; !text_.at_end(); ++line, text_.next_line()) {
      if (line % elements_per_step == 0) {
        monitor_.step(static_cast<double>(text_.offset()) / static_cast<double>(size_));
      }
      const std::string_view keyword = text_.token_on_line();
      if (keyword == "v") {
        const auto number = static_cast<std::int64_t>(model_.vertices.size());
        add_vertex(model_,
                   {real("vertex", number, "x"), real("vertex", number, "y"), real("vertex", number, "z")});
      } else if (keyword == "vn") {
        const auto number = static_cast<std::int64_t>(normals_.size());
        normals_.push_back(
            {real("normal", number, "x"), real("normal", number, "y"), real("normal", number, "z")});
      } else if (keyword == "f") {
        face();
      }
    }
    check_forward_references(forward_vertices_, model_.vertices.size(), "vertex");
    check_forward_references(forward_normals_, normals_.size(), "normal");
    set_normals();
    return std::move(model_);
  }

 private:
  double real(const char* element, std::int64_t number, const char* name) {
    return parse_coordinate(text_, text_.token_on_line(), element, number, name);
  }

  std::int32_t resolve(std::int64_t written, std::size_t defined, std::string_view token, const char* kind,
                       std::vector<ForwardReference>& forward) {
    const auto count = static_cast<std::int64_t>(defined);
    if (written == 0 || written < -count || written > std::numeric_limits<std::int32_t>::max()) {
      refuse_index("face", model_.faces, kind, std::to_string(written), defined, text_.place_of(token));
    }
    const std::int64_t index = written > 0 ? written - 1 : count + written;
    if (index >= count) forward.push_back({model_.faces, index, token});
    return static_cast<std::int32_t>(index);
  }

  void face() {
    corners_.clear();
    for (;;) {
      std::string_view token = text_.token_on_line();
      if (token.empty()) break;
      const bool continued = token.back() == '\\';
      if (continued) token.remove_suffix(1);
      if (!token.empty()) {
        const Corner corner = parse_corner(token);
        if (!corner.vertex || (corner.has_normal && !corner.normal)) {
          throw InputError("face " + std::to_string(model_.faces) + ": " + excerpt(token) +
                               " is not a corner" + text_.place_of(token),
                           "a corner is v, v/vt, v//vn or v/vt/vn with whole numbers");
        }
        corners_.push_back(
            resolve(*corner.vertex, model_.vertices.size(), token, "vertex", forward_vertices_));
        if (corner.has_normal) {
          corner_normals_.emplace_back(
              corners_.back(), resolve(*corner.normal, normals_.size(), token, "normal", forward_normals_));
        }
      }
      if (continued) text_.next_line();
    }
    add_polygon(model_, corners_);
  }

  void check_forward_references(const std::vector<ForwardReference>& forward, std::size_t count,
                                const char* kind) {
    for (const ForwardReference& reference : forward) {
      if (reference.index < static_cast<std::int64_t>(count)) continue;
      refuse_index("face", reference.face, kind, std::to_string(reference.index + 1), count,
                   text_.place_of(reference.token));
    }
  }

  /// A vertex gets the sum of the normals of its corners; a file without faces pairs them in order.
  void set_normals() {
    if (model_.faces == 0) {
      if (normals_.size() == model_.vertices.size()) model_.normals = std::move(normals_);
      return;
    }
    if (corner_normals_.empty()) return;
    model_.normals.resize(model_.vertices.size());
    for (const auto& [vertex, normal] : corner_normals_) {
      Vec3& sum = model_.normals[static_cast<std::size_t>(vertex)];
      sum = sum + normals_[static_cast<std::size_t>(normal)];
    }
  }

  TextCursor text_;
  std::size_t size_;
  Monitor& monitor_;
  RawModel model_;
  std::vector<Vec3> normals_;
  std::vector<std::int32_t> corners_;
  std::vector<std::pair<std::int32_t, std::int32_t>> corner_normals_;  // vertex, normal
  std::vector<ForwardReference> forward_vertices_, forward_normals_;
};

}  // namespace

RawModel parse_obj(std::string_view content, Monitor& monitor) { return Parser(content, monitor).parse(); }

}  // namespace ballflow::geometry
