// Medial axes of Q-MAT, MATFP and MATTopo: vertices, edges and triangles; see load_balls.hpp.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "io/ball_lines.hpp"

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;

class AxisReader {
 public:
  AxisReader(std::string_view content, Monitor& monitor) : lines_(content, monitor), monitor_(monitor) {}

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
    throw InputError(excerpt(token) + " is no number of " + what + lines_.place_of(token), damaged_balls);
  }

  void begin(char kind, const char* element, std::int64_t number, std::int64_t all) {
    const std::string_view token = lines_.begin();
    if (token.size() == 1 && token[0] == kind) return;
    const std::string found = token.empty() ? "the file ends" : "the line begins with " + excerpt(token);
    throw InputError(place_of_element(element, number) + found + " where \"" + kind + "\" should be" +
                         lines_.place_of(token) + "; the header promises " + std::to_string(all),
                     damaged_balls);
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
        throw InputError(place_of_element(element, number) + "a vertex index is " +
                             (token.empty() ? "missing" : excerpt(token)) + lines_.place_of(token),
                         damaged_balls);
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
        throw InputError(place_of_element(element, number) + "vertex " + std::to_string(corner) +
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

}  // namespace

LoadedBalls parse_ma(std::string_view content, Monitor& monitor) {
  return AxisReader(content, monitor).parse();
}

}  // namespace ballflow::geometry
