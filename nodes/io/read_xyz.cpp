// Points as text: x y z per line, separated by blanks, commas or semicolons; optionally normals in the next
// three columns; optionally the number of points first (PTS).
#include <cmath>

#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

// Columns 4 to 6 of every point are normals when all of them have about this length; else they are colours or
// the like.
constexpr double unit_tolerance = 0.02;

/// The three columns after the coordinates, where there are three numbers.
bool parse_normal(TextCursor& text, Vec3& normal) {
  for (double* value : {&normal.x, &normal.y, &normal.z}) {
    const auto parsed = parse_real(text.token_on_line());
    if (!parsed) return false;
    *value = *parsed;
  }
  return std::abs(length(normal) - 1) <= unit_tolerance;
}

}  // namespace

RawModel parse_xyz(std::string_view content, Monitor& monitor) {
  RawModel model;
  TextCursor text(content, '#', ",;");
  std::int64_t promised = -1;
  bool first_line = true, normals = true, more_columns = false;
  for (std::int64_t line = 0; !text.at_end(); ++line, text.next_line()) {
    if (line % elements_per_step == 0)
      monitor.step(static_cast<double>(text.offset()) / static_cast<double>(content.size()));
    const std::string_view x = text.token_on_line();
    if (x.empty() || x.starts_with("//")) continue;
    const std::string_view y = text.token_on_line();
    if (first_line && y.empty()) {
      if (const auto count = parse_integer(x); count && *count >= 0) promised = *count;
    }
    const bool is_count = first_line && promised >= 0;
    first_line = false;
    if (is_count) continue;
    const auto number = static_cast<std::int64_t>(model.vertices.size());
    const std::string_view z = text.token_on_line();
    add_vertex(model, {parse_coordinate(text, x, "point", number, "x"),
                       parse_coordinate(text, y, "point", number, "y"),
                       parse_coordinate(text, z, "point", number, "z")});
    if (!normals) continue;
    TextCursor columns = text;
    more_columns = more_columns || !columns.token_on_line().empty();
    Vec3 normal;
    normals = parse_normal(text, normal);
    if (normals) model.normals.push_back(normal);
  }
  if (promised >= 0 && promised != static_cast<std::int64_t>(model.vertices.size())) {
    throw InputError("the first line promises " + std::to_string(promised) + " points, the file has " +
                         std::to_string(model.vertices.size()),
                     "the file is cut off or its first line is wrong");
  }
  if (!normals) {
    model.normals.clear();
    if (more_columns) model.warnings.push_back("columns 4 and up are not unit normals and are passed over");
  }
  return model;
}

}  // namespace ballflow::geometry
