#include "io/load_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "io/ball_lines.hpp"
#include "io/file_content.hpp"
#include "io/formats.hpp"
#include "io/lengths.hpp"
#include "io/number_rows.hpp"
#include "io/ply_header.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::int64_t max_bytes = std::int64_t{2} << 30;
constexpr std::string_view inline_scheme = "balls:";
constexpr std::string_view row_separators = ",;";

// ---- rows

/// Which columns hold x, y, z and r: the first four, or those with these names.
struct BallColumns {
  std::array<std::size_t, 4> columns{0, 1, 2, 3};
  bool diameter = false, named = false;
};

/// Beside columns g and b, r is the red of a colour.
bool has_colours(const NumberRows& rows) { return rows.column("g") && rows.column("b"); }

BallColumns ball_columns(NumberRows& rows, Monitor& monitor) {
  BallColumns result;
  if (!rows.read_names()) return result;
  result.named = true;
  static constexpr std::array<std::array<std::string_view, 2>, 4> names = {
      {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"r", "radius"}}};
  for (std::size_t i = 0; i < 4; ++i) {
    auto column = i == 3 && has_colours(rows) ? std::nullopt : rows.column(names[i][0]);
    if (!column) column = rows.column(names[i][1]);
    if (!column && i == 3 && (column = rows.column("diameter"))) result.diameter = true;
    if (!column) {
      throw InputError("the columns are named " + excerpt(rows.names()) + ", and none is called " +
                           std::string(names[i][0]) + (i == 3 ? " or radius" : "") +
                           rows.place_of(rows.names()),
                       "name the columns of a list of balls x, y, z and r");
    }
    result.columns[i] = *column;
  }
  if (rows.columns() > 4) {
    monitor.warn("of " + std::to_string(rows.columns()) + " columns those called x, y, z and " +
                 (result.diameter ? "diameter" : "r or radius") + " are read");
  }
  return result;
}

// ---- sph, sphere trees and PLY

Balls parse_sph(std::string_view content, std::int64_t count, Monitor& monitor) {
  LineReader lines(content, monitor);
  lines.begin();
  lines.end();
  require_room(count, 8, lines.remaining() + 1, "balls");
  BallList all, kept;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string_view token = lines.begin();
    if (token.empty()) {
      throw InputError("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                           " balls" + lines.place_of(token),
                       damaged_balls);
    }
    lines.ball(token, "ball", all);
    if (lines.deleted_flag("ball", i, 3, 1)) continue;
    kept.add(all.centers.back(), all.radii.back());
  }
  require_end(lines, "the " + std::to_string(count) + " balls of the header");
  return kept.take();
}

/// Lines with anything on them but a comment.
std::int64_t count_lines(std::string_view content, Monitor& monitor) {
  LineReader lines(content, monitor);
  std::int64_t count = 0;
  for (; !lines.begin().empty(); lines.end()) ++count;
  return count;
}

/// How many nodes a full tree has; at most `most`, or nothing.
std::optional<std::int64_t> nodes_of_tree(std::int64_t levels, std::int64_t branches, std::int64_t most) {
  if (levels < 1 || branches < 1) return std::nullopt;
  std::int64_t nodes = 0, level = 1;
  for (std::int64_t l = 0; l < levels; ++l) {
    nodes += level;
    if (nodes > most || level > most / branches)
      return l + 1 == levels && nodes <= most ? std::optional(nodes) : std::nullopt;
    level *= branches;
  }
  return nodes;
}

/// The nodes of a tree level by level, the root first, each with an importance; a negative radius is no ball.
/// Leaves are the balls none of whose children is one.
Balls parse_sphere_tree(std::string_view content, std::int64_t nodes, std::int64_t branches,
                        Monitor& monitor) {
  LineReader lines(content, monitor);
  lines.begin();
  lines.end();
  BallList all, leaves;
  for (std::int64_t i = 0; i < nodes; ++i) {
    lines.ball(lines.begin(), "ball", all, true);
    lines.end();
  }
  std::vector<bool> has_child(all.radii.size());
  for (std::size_t i = 1; i < all.radii.size(); ++i) {
    if (all.radii[i] >= 0) has_child[(i - 1) / static_cast<std::size_t>(branches)] = true;
  }
  for (std::size_t i = 0; i < all.radii.size(); ++i) {
    if (all.radii[i] >= 0 && !has_child[i]) leaves.add(all.centers[i], all.radii[i]);
  }
  return leaves.take();
}

std::string place_of_first(std::string_view content) {
  TextCursor text(content, '#');
  return text.place_of(text.token());
}

/// Two numbers begin the lists of MATTopo (4 and the number of balls) and sphere trees (levels and branches).
Balls parse_two_counts(std::string_view content, std::int64_t first, std::int64_t second, Monitor& monitor) {
  const std::int64_t lines = count_lines(content, monitor) - 1;
  const auto nodes = nodes_of_tree(first, second, lines);
  if (nodes && *nodes == lines && (first != 4 || second != lines)) {
    return parse_sphere_tree(content, *nodes, second, monitor);
  }
  if (first == 4 && (second >= lines || second == 0)) return parse_sph(content, second, monitor);
  const std::string counts = std::to_string(first) + " " + std::to_string(second);
  throw InputError("the file begins with \"" + counts + "\"" + place_of_first(content) + ", and " +
                       std::to_string(lines) + " lines follow: neither " + std::to_string(second) +
                       " balls nor the spheres of a tree with " + std::to_string(first) + " levels and " +
                       std::to_string(second) + " branches at each",
                   damaged_balls);
}

Balls parse_ply_balls(std::string_view content, Monitor& monitor) {
  RawModel model = parse_ply(content, monitor);
  if (model.radii.size() != model.vertices.size()) {
    throw InputError("the vertices of the PLY file have no property \"radius\"",
                     "write the radii as vertex property radius; for a model without radii use Sample");
  }
  for (std::size_t i = 0; i < model.radii.size(); ++i) {
    if (std::isfinite(model.radii[i]) && model.radii[i] >= 0) continue;
    throw InputError("vertex " + std::to_string(i) + ": the radius is " + std::to_string(model.radii[i]),
                     "a radius is a finite number of at least 0");
  }
  return BallList{std::move(model.vertices), std::move(model.radii)}.take();
}

LoadedBalls only(Balls balls) {
  LoadedBalls loaded;
  loaded.balls = std::move(balls);
  loaded.axis.polygon_offsets = {0};
  return loaded;
}

LoadedBalls scaled(LoadedBalls loaded, double scale) {
  if (scale == 1) return loaded;
  const auto scaled_points = [scale](const Array<Vec3>& points) {
    std::vector<Vec3> result(points.begin(), points.end());
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] = scale * result[i];
      require_finite(result[i], "scaled ball", static_cast<std::int64_t>(i));
    }
    return result;
  };
  const auto scaled_radii = [scale](const Array<double>& radii) {
    std::vector<double> result(radii.begin(), radii.end());
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] *= scale;
      if (std::isfinite(result[i])) continue;
      throw InputError(
          place_of_element("scaled ball", static_cast<std::int64_t>(i)) + "the radius is not finite",
          "take a smaller scale");
    }
    return result;
  };
  loaded.balls.centers = scaled_points(loaded.balls.centers);
  loaded.balls.radii = scaled_radii(loaded.balls.radii);
  loaded.axis.vertices = scaled_points(loaded.axis.vertices);
  loaded.axis.radii = scaled_radii(loaded.axis.radii);
  return loaded;
}

}  // namespace

bool holds_balls(const std::string& path, std::string_view content) {
  const std::string extension = lower_extension(path);
  if (extension == ".ma" || extension == ".sph") return true;
  if (TextCursor(content).token() == "ply") return ply::has_radii(content);
  NumberRows rows(content, 4, no_monitor());
  return rows.read_names() && rows.column("x") && rows.column("y") && rows.column("z") &&
         ((rows.column("r") && !has_colours(rows)) || rows.column("radius") || rows.column("diameter"));
}

bool is_ball_rows(std::string_view content) {
  TextCursor text(content, '#', row_separators);
  const std::string_view token = text.token();
  if (token == "v" || token == "x" || (parse_real(token) && !parse_integer(token))) return true;
  // "1,5 0 0 1" begins with a decimal comma.
  TextCursor words(content, '#');
  const std::string_view word = words.token();
  return (!parse_real(word) && !words.token_on_line().empty() && parse_real(token)) || names_columns(content);
}

Balls parse_ball_rows(std::string_view content, Monitor& monitor) {
  NumberRows rows(content, 4, monitor);
  const BallColumns columns = ball_columns(rows, monitor);
  BallList balls;
  while (rows.next()) {
    const auto number = static_cast<std::int64_t>(balls.radii.size());
    const std::size_t first = rows.fields()[0] == "v" && !columns.named ? 1 : 0;
    const auto value = [&](std::size_t i, const char* name) {
      return rows.coordinate(first + columns.columns[i], "ball", number, name);
    };
    const double x = value(0, "x"), y = value(1, "y"), z = value(2, "z"), r = value(3, "r");
    if (r < 0) {
      const std::string_view field = rows.fields()[first + columns.columns[3]];
      throw InputError(
          place_of_element("ball", number) + "the radius is " + excerpt(field) + rows.place_of(field),
          "a radius is at least 0");
    }
    if (!columns.named && rows.fields().size() > first + 4) {
      const std::string_view rest = rows.fields()[first + 4];
      throw InputError(
          place_of_element("ball", number) + excerpt(rest) + " follows the radius" + rows.place_of(rest),
          "a line is x y z r, with or without a v before it");
    }
    balls.add({x, y, z}, columns.diameter ? r / 2 : r);
  }
  return balls.take();
}

LoadedBalls parse_balls(std::string_view content, Monitor& monitor) {
  monitor.step(0);
  // The first line tells the formats apart: it has 3 whole numbers in ma, 1 or 2 in sph.
  TextCursor text(content, '#', row_separators);
  const std::string_view first = text.token();
  if (first == "ply") return only(parse_ply_balls(content, monitor));
  std::vector<std::int64_t> counts;
  bool numbers = true;
  std::size_t tokens = 0;
  for (std::string_view token = first; !token.empty() && tokens < 5; token = text.token_on_line(), ++tokens) {
    const auto value = parse_integer(token);
    if (value) counts.push_back(*value);
    numbers = numbers && parse_real(token).has_value();
  }
  if (counts.size() == tokens && tokens == 3) return parse_ma(content, monitor);
  if (counts.size() == tokens && tokens == 1) return only(parse_sph(content, counts[0], monitor));
  if (counts.size() == tokens && tokens == 2)
    return only(parse_two_counts(content, counts[0], counts[1], monitor));
  if (is_ball_rows(content) || (numbers && tokens >= 4)) {
    return only(parse_ball_rows(content, monitor));
  }
  if (first.empty()) throw InputError("the file has no ball", readable_balls);
  refuse_other_formats(content, readable_balls);
  throw InputError(
      "the file begins with " + excerpt(first) + text.place_of(first) + ", which begins no format of balls",
      readable_balls);
}

LoadedBalls load_balls(const LoadBallsOptions& options, Monitor& monitor) {
  const double scale = parse_scale(options.scale);
  if (options.file.starts_with(inline_scheme)) {
    std::string rows = options.file.substr(inline_scheme.size());
    std::replace(rows.begin(), rows.end(), ';', '\n');
    return scaled(only(parse_ball_rows(rows, monitor)), scale);
  }
  const FileContent content = read_file_content(options.file, max_bytes);
  return scaled(parse_balls(content.view(), monitor), scale);
}

}  // namespace ballflow::geometry
