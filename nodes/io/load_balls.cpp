#include "io/load_balls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "io/file_content.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;

constexpr std::int64_t max_bytes = std::int64_t{2} << 30;
constexpr std::int64_t max_balls = std::numeric_limits<std::int32_t>::max();
constexpr std::string_view inline_scheme = "balls:";
constexpr std::string_view row_separators = ",;";
const char* const damaged = "the file is cut off or damaged; fetch or write it again";
const char* const readable = "readable are ma, sph, lines of x y z r (also csv), and PLY with a radius";

std::string named(const char* element, std::int64_t number) {
  return std::string(element) + " " + std::to_string(number) + ": ";
}

struct BallList {
  std::vector<Vec3> centers;
  std::vector<double> radii;

  Balls take() {
    if (radii.empty()) throw InputError("the file has no ball", "a line of a list of balls is x y z r");
    return {std::move(centers), std::move(radii), {}, {}};
  }
};

/// Goes through the lines of a text, leaving out empty ones and comments.
class LineReader {
 public:
  LineReader(std::string_view content, std::string_view separators, Monitor& monitor)
      : text_(content, '#', separators), size_(content.size()), monitor_(monitor) {}

  /// The first token that is left, empty at the end of the text.
  std::string_view begin() {
    if (lines_++ % elements_per_step == 0) {
      monitor_.step(0.8 * static_cast<double>(text_.offset()) / static_cast<double>(size_ + 1));
    }
    return text_.token();
  }
  std::string_view token() { return text_.token_on_line(); }
  void end() { text_.next_line(); }
  std::string place_of(std::string_view token) const { return text_.place_of(token); }
  std::size_t remaining() const { return text_.remaining(); }

  /// Reads x, y, z and r, the first of which is `token`.
  void ball(std::string_view token, const char* element, BallList& balls) {
    const auto number = static_cast<std::int64_t>(balls.radii.size());
    if (number == max_balls) throw InputError("the file has too many balls", "thin it out first");
    const double x = parse_coordinate(text_, token, element, number, "x");
    const double y = parse_coordinate(text_, text_.token_on_line(), element, number, "y");
    const double z = parse_coordinate(text_, text_.token_on_line(), element, number, "z");
    const std::string_view radius = text_.token_on_line();
    const double r = parse_coordinate(text_, radius, element, number, "r");
    if (r < 0) {
      throw InputError(named(element, number) + "the radius is " + excerpt(radius) + place_of(radius),
                       "a radius is at least 0");
    }
    balls.centers.push_back({x, y, z});
    balls.radii.push_back(r);
  }

  /// The rest of the line must be at most `most` whole numbers. True when number `deleted` of them, counted
  /// from 0, is there and is 1.
  bool deleted_flag(const char* element, std::int64_t number, int most, int deleted) {
    bool is_deleted = false;
    for (int k = 0;; ++k) {
      const std::string_view token = text_.token_on_line();
      if (token.empty()) return is_deleted;
      const auto value = parse_integer(token);
      if (k >= most || !value || (k == deleted && *value != 0 && *value != 1)) {
        throw InputError(
            named(element, number) + excerpt(token) + " is one number too many or no flag" + place_of(token),
            "check the format of the line; the flag \"deleted\" is 0 or 1");
      }
      if (k == deleted) is_deleted = *value == 1;
    }
  }

 private:
  TextCursor text_;
  std::size_t size_;
  Monitor& monitor_;
  std::int64_t lines_ = 0;
};

/// The file must end here.
void require_end(LineReader& lines, const std::string& promise) {
  const std::string_view token = lines.begin();
  if (token.empty()) return;
  throw InputError(excerpt(token) + " follows after " + promise + lines.place_of(token), damaged);
}

// ---- rows

/// Whether the first line names the columns; `more` is set when it names more than four.
bool is_row_header(LineReader& lines, std::string_view first, bool& more) {
  if (first != "x" && first != "X") return false;
  static constexpr std::array<std::string_view, 3> names = {"y", "z", "r"};
  for (const std::string_view name : names) {
    std::string_view token = lines.token();
    if (token == name || (token.size() == 1 && (token[0] | 0x20) == name[0])) continue;
    if (name == "r" && token == "radius") continue;
    throw InputError("the column " + excerpt(token) + " is named where " + excerpt(name) + " should be" +
                         lines.place_of(token),
                     "the first four columns of a list of balls are x, y, z and r");
  }
  more = !lines.token().empty();
  return true;
}

// ---- ma

class AxisReader {
 public:
  AxisReader(std::string_view content, Monitor& monitor) : lines_(content, {}, monitor), monitor_(monitor) {}

  LoadedBalls parse() {
    std::int64_t vertices = 0, edges = 0, triangles = 0;
    vertices = count(lines_.begin(), "vertices");
    edges = count(lines_.token(), "edges");
    triangles = count(lines_.token(), "triangles");
    lines_.end();
    // The shortest lines are "v 0 0 0 0", "e 0 1" and "f 0 1 2"; the last one may lack its end.
    require_room(vertices, 10, lines_.remaining() + 1, "vertices");
    require_room(edges, 6, lines_.remaining() + 1, "edges");
    require_room(triangles, 8, lines_.remaining() + 1, "triangles");
    read_vertices(vertices);
    for (std::int64_t i = 0; i < edges; ++i) {
      begin('e', "edge", i, edges);
      const Edge edge = corners<2>("edge", i);
      if (!lines_.deleted_flag("edge", i, 2, 1)) add(edges_, "edge", i, edge);
    }
    for (std::int64_t i = 0; i < triangles; ++i) {
      begin('f', "face", i, triangles);
      const Triangle triangle = corners<3>("face", i);
      if (!lines_.deleted_flag("face", i, 1, 0)) add(triangles_, "face", i, triangle);
    }
    require_end(lines_, "the " + std::to_string(vertices) + " vertices, " + std::to_string(edges) +
                            " edges and " + std::to_string(triangles) + " triangles of the header");
    return finish();
  }

 private:
  std::int64_t count(std::string_view token, const char* what) {
    const auto value = parse_integer(token);
    if (value && *value >= 0) return *value;
    throw InputError(excerpt(token) + " is no number of " + what + lines_.place_of(token), damaged);
  }

  void begin(char kind, const char* element, std::int64_t number, std::int64_t all) {
    const std::string_view token = lines_.begin();
    if (token.size() == 1 && token[0] == kind) return;
    const std::string found = token.empty() ? "the file ends" : "the line begins with " + excerpt(token);
    throw InputError(named(element, number) + found + " where \"" + kind + "\" should be" +
                         lines_.place_of(token) + "; the header promises " + std::to_string(all),
                     damaged);
  }

  void read_vertices(std::int64_t all) {
    for (std::int64_t i = 0; i < all; ++i) {
      begin('v', "vertex", i, all);
      lines_.ball(lines_.token(), "vertex", listed_);
      deleted_.push_back(lines_.deleted_flag("vertex", i, 2, 1));
    }
    std::int32_t kept = 0;
    for (std::size_t i = 0; i < deleted_.size(); ++i) {
      look_(1);
      number_.push_back(kept);
      if (deleted_[i]) continue;
      list_.centers.push_back(listed_.centers[i]);
      list_.radii.push_back(listed_.radii[i]);
      ++kept;
    }
    listed_ = {};
  }

  /// Indices of the file.
  template <std::size_t n>
  std::array<std::int32_t, n> corners(const char* element, std::int64_t number) {
    std::array<std::int32_t, n> result{};
    for (std::int32_t& corner : result) {
      const std::string_view token = lines_.token();
      const auto index = parse_integer(token);
      if (!index) {
        throw InputError(named(element, number) + "a vertex index is " +
                             (token.empty() ? "missing" : excerpt(token)) + lines_.place_of(token),
                         damaged);
      }
      if (*index < 0 || *index >= static_cast<std::int64_t>(deleted_.size())) {
        refuse_index(element, number, "vertex", std::to_string(*index), deleted_.size(),
                     lines_.place_of(token));
      }
      corner = static_cast<std::int32_t>(*index);
      last_ = token;
    }
    return result;
  }

  template <std::size_t n>
  void add(std::vector<std::array<std::int32_t, n>>& list, const char* element, std::int64_t number,
           std::array<std::int32_t, n> corners) {
    for (std::int32_t& corner : corners) {
      const auto v = static_cast<std::size_t>(corner);
      if (deleted_[v]) {
        throw InputError(named(element, number) + "vertex " + std::to_string(corner) +
                             " is marked as deleted" + lines_.place_of(last_),
                         "mark the " + std::string(element) + " as deleted, too, or keep the vertex");
      }
      corner = number_[v];
    }
    list.push_back(corners);
  }

  /// std::sort, which can be cancelled.
  template <class T>
  void sort(std::vector<T>& values) {
    std::sort(values.begin(), values.end(), [this](const T& a, const T& b) {
      look_(1);
      return a < b;
    });
  }

  /// Drops elements that use a vertex twice and all but the first of those with equal vertices, and keeps the
  /// order of the others.
  template <std::size_t n>
  std::vector<std::array<std::int32_t, n>> without_repetitions(
      const std::vector<std::array<std::int32_t, n>>& list, const char* elements) {
    using Key = std::pair<std::array<std::int32_t, n>, std::size_t>;
    std::vector<Key> keys;
    keys.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      look_(n);
      auto sorted = list[i];
      std::sort(sorted.begin(), sorted.end());
      if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) keys.emplace_back(sorted, i);
    }
    sort(keys);
    std::vector<bool> is_first(list.size(), false);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      look_(1);
      is_first[keys[k].second] = k == 0 || keys[k].first != keys[k - 1].first;
    }
    std::vector<std::array<std::int32_t, n>> kept;
    kept.reserve(list.size());
    for (std::size_t i = 0; i < list.size(); ++i) {
      look_(n);
      if (is_first[i]) kept.push_back(list[i]);
    }
    if (const std::size_t dropped = list.size() - kept.size(); dropped != 0) {
      monitor_.warn(std::to_string(dropped) + " " + elements +
                    " that repeat an earlier one, or use a vertex twice, are dropped");
    }
    return kept;
  }

  LoadedBalls finish() {
    const std::vector<Triangle> triangles = without_repetitions(triangles_, "triangles");
    std::vector<Edge> edges = without_repetitions(edges_, "edges"), sides;
    const auto undirected = [](std::int32_t a, std::int32_t b) {
      return Edge{std::min(a, b), std::max(a, b)};
    };
    std::vector<std::int32_t> corners;
    std::vector<std::int64_t> offsets{0};
    for (const auto& [a, b, c] : triangles) {
      look_(9);
      sides.insert(sides.end(), {undirected(a, b), undirected(b, c), undirected(c, a)});
      corners.insert(corners.end(), {a, b, c});
      offsets.push_back(static_cast<std::int64_t>(corners.size()));
    }
    sort(sides);
    monitor_.step(0.9);
    std::erase_if(edges, [&](const Edge& edge) {
      look_(32);  // steps of the search
      return std::binary_search(sides.begin(), sides.end(), undirected(edge[0], edge[1]));
    });
    LoadedBalls loaded;
    loaded.balls = list_.take();
    loaded.axis.vertices = loaded.balls.centers;
    loaded.axis.radii = loaded.balls.radii;
    loaded.axis.edges = std::move(edges);
    loaded.axis.polygon_offsets = std::move(offsets);
    loaded.axis.polygon_vertices = std::move(corners);
    loaded.axis.polygon_kinds =
        std::vector<std::uint8_t>(triangles.size(), static_cast<std::uint8_t>(AxisKind::singular));
    loaded.axis = with_sheets(std::move(loaded.axis), monitor_);
    return loaded;
  }

  LineReader lines_;
  Monitor& monitor_;
  Lookout look_{monitor_};
  BallList listed_, list_;            // all vertices of the file; those that are kept
  std::vector<bool> deleted_;         // by index of the file
  std::vector<std::int32_t> number_;  // of a kept vertex
  std::vector<Edge> edges_;
  std::vector<Triangle> triangles_;
  std::string_view last_;
};

// ---- sph and PLY

Balls parse_sph(std::string_view content, std::int64_t count, Monitor& monitor) {
  LineReader lines(content, {}, monitor);
  lines.begin();
  lines.end();
  require_room(count, 8, lines.remaining() + 1, "balls");
  BallList all, kept;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::string_view token = lines.begin();
    if (token.empty()) {
      throw InputError("the file ends after " + std::to_string(i) + " of " + std::to_string(count) +
                           " balls" + lines.place_of(token),
                       damaged);
    }
    lines.ball(token, "ball", all);
    if (lines.deleted_flag("ball", i, 3, 1)) continue;
    kept.centers.push_back(all.centers.back());
    kept.radii.push_back(all.radii.back());
  }
  require_end(lines, "the " + std::to_string(count) + " balls of the header");
  return kept.take();
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

}  // namespace

bool is_ball_rows(std::string_view content) {
  TextCursor text(content, '#', row_separators);
  const std::string_view token = text.token();
  return token == "v" || token == "x" || (parse_real(token) && !parse_integer(token));
}

Balls parse_ball_rows(std::string_view content, Monitor& monitor) {
  LineReader lines(content, row_separators, monitor);
  BallList balls;
  bool more = false;
  for (bool first_line = true;; first_line = false) {
    std::string_view token = lines.begin();
    if (token.empty()) break;
    if (first_line && is_row_header(lines, token, more)) {
      if (more) monitor.warn("columns 5 and up are passed over");
    } else {
      const auto number = static_cast<std::int64_t>(balls.radii.size());
      lines.ball(token == "v" ? lines.token() : token, "ball", balls);
      if (const std::string_view rest = lines.token(); !rest.empty() && !more) {
        throw InputError(named("ball", number) + excerpt(rest) + " follows the radius" + lines.place_of(rest),
                         "a line is x y z r, with or without a v before it");
      }
    }
    lines.end();
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
  if (counts.size() == tokens && tokens == 3) return AxisReader(content, monitor).parse();
  if (counts.size() == tokens && tokens == 1) return only(parse_sph(content, counts[0], monitor));
  if (counts.size() == tokens && tokens == 2 && counts[0] == 4) {
    return only(parse_sph(content, counts[1], monitor));
  }
  if (is_ball_rows(content) || first == "X" || (numbers && tokens >= 4)) {
    return only(parse_ball_rows(content, monitor));
  }
  if (first.empty()) throw InputError("the file has no ball", readable);
  throw InputError(
      "the file begins with " + excerpt(first) + text.place_of(first) + ", which begins no format of balls",
      readable);
}

LoadedBalls load_balls(const LoadBallsOptions& options, Monitor& monitor) {
  if (options.file.starts_with(inline_scheme)) {
    std::string rows = options.file.substr(inline_scheme.size());
    std::replace(rows.begin(), rows.end(), ';', '\n');
    return only(parse_ball_rows(rows, monitor));
  }
  const FileContent content = read_file_content(options.file, max_bytes);
  return parse_balls(content.view(), monitor);
}

}  // namespace ballflow::geometry
