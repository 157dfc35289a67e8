// Wavefront OBJ: v, vn and f; everything else (texture coordinates, lines, groups, materials) is passed over.
#include <algorithm>
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
      : text_(content, '#', {}, '\\'), size_(content.size()), monitor_(monitor) {}

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
      } else if (keyword == "f" || keyword == "fo") {
        face();
      }
    }
    if (model_.vertices.empty()) {
      throw InputError("the OBJ file has no vertex: no line begins with v",
                       "is it an OBJ file? Its extension says so");
    }
    check_forward_references();
    set_normals();
    return std::move(model_);
  }

 private:
  double real(const char* element, std::int64_t number, const char* name) {
    return parse_coordinate(text_, text_.token_on_line(), element, number, name);
  }

  std::int32_t resolve_vertex(std::int64_t written, std::string_view token) {
    const auto count = static_cast<std::int64_t>(model_.vertices.size());
    if (written == 0 || written < -count || written > std::numeric_limits<std::int32_t>::max()) {
      refuse_index("face", model_.faces, "vertex", std::to_string(written), model_.vertices.size(),
                   text_.place_of(token));
    }
    const std::int64_t index = written > 0 ? written - 1 : count + written;
    if (index >= count) forward_.push_back({model_.faces, index, token});
    return static_cast<std::int32_t>(index);
  }

  /// Whether there is one with this index is known at the end.
  std::int32_t resolve_normal(std::int64_t written, std::string_view token) {
    const std::int64_t index = written > 0   ? written - 1
                               : written < 0 ? static_cast<std::int64_t>(normals_.size()) + written
                                             : -1;
    const bool impossible = index < 0 || index > std::numeric_limits<std::int32_t>::max();
    if (!impossible_normal_ && (impossible || index > greatest_normal_)) normal_token_ = token;
    impossible_normal_ = impossible_normal_ || impossible;
    if (impossible) return -1;
    if (!impossible_normal_) greatest_normal_ = std::max(greatest_normal_, index);
    return static_cast<std::int32_t>(index);
  }

  void face() {
    corners_.clear();
    for (std::string_view token = text_.token_on_line(); !token.empty(); token = text_.token_on_line()) {
      const Corner corner = parse_corner(token);
      if (!corner.vertex || (corner.has_normal && !corner.normal)) {
        throw InputError("face " + std::to_string(model_.faces) + ": " + excerpt(token) + " is not a corner" +
                             text_.place_of(token),
                         "a corner is v, v/vt, v//vn or v/vt/vn with whole numbers");
      }
      corners_.push_back(resolve_vertex(*corner.vertex, token));
      if (corner.has_normal)
        corner_normals_.emplace_back(corners_.back(), resolve_normal(*corner.normal, token));
    }
    add_polygon(model_, corners_);
  }

  void check_forward_references() {
    for (const ForwardReference& reference : forward_) {
      if (reference.index < static_cast<std::int64_t>(model_.vertices.size())) continue;
      refuse_index("face", reference.face, "vertex", std::to_string(reference.index + 1),
                   model_.vertices.size(), text_.place_of(reference.token));
    }
  }

  /// A vertex gets the sum of the normals of its corners; a file without faces pairs them in order.
  void set_normals() {
    if (model_.faces == 0) {
      if (normals_.size() == model_.vertices.size()) model_.normals = std::move(normals_);
      return;
    }
    if (corner_normals_.empty()) return;
    const auto count = static_cast<std::int64_t>(normals_.size());
    if (impossible_normal_ || greatest_normal_ >= count) {
      // Programs that strip normals leave the indices; the shape is in the vertices.
      model_.warnings.push_back("faces name normals, " + excerpt(normal_token_) +
                                text_.place_of(normal_token_) + " for one, but the file has " +
                                (count == 0 ? "none" : "only " + std::to_string(count)) +
                                ": normals are not used");
      return;
    }
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
  std::int64_t greatest_normal_ = -1;
  bool impossible_normal_ = false;  // an index of a normal that no file can have
  std::string_view normal_token_;   // the corner with that index, else with the greatest one
  std::vector<ForwardReference> forward_;
};

}  // namespace

RawModel parse_obj(std::string_view content, Monitor& monitor) { return Parser(content, monitor).parse(); }

}  // namespace ballflow::geometry
