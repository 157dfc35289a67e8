#include "axis/tidy_pieces.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

namespace ballflow::geometry {
namespace {

using Edge = std::array<std::int32_t, 2>;

Edge edge_of(std::int32_t a, std::int32_t b) { return {std::min(a, b), std::max(a, b)}; }

Edge side_of(const AxisPiece& piece, std::size_t k) {
  return edge_of(piece.corners[k], piece.corners[(k + 1) % piece.corners.size()]);
}

/// A side as one number, in the order of sides.
std::uint64_t number(const Edge& side) {
  return std::uint64_t{static_cast<std::uint32_t>(side[0])} << 32 | static_cast<std::uint32_t>(side[1]);
}

class Tidying {
  using Pieces = std::vector<std::size_t>;  // a few, in any order

 public:
  Tidying(std::vector<AxisPiece>& pieces, std::span<const Edge> edges, const TidyOptions& options,
          Monitor& monitor)
      : pieces_(pieces), options_(options), look_(monitor), gone_(pieces.size(), false) {
    for (const Edge& edge : edges) {
      loose_.insert(edge_of(edge[0], edge[1]));
      for (const std::int32_t v : edge) ++loose_at_[v];
    }
    std::int32_t last = -1;
    for (const AxisPiece& piece : pieces)
      last = std::max(last, *std::max_element(piece.corners.begin(), piece.corners.end()));
    at_corner_.resize(static_cast<std::size_t>(last + 1));
    for (std::size_t i = 0; i < pieces.size(); ++i) enter(i);
  }

  void run() {
    bool again = true;
    while (again) {
      again = collapse_needless();
      again = contract_sides() || again;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (gone_[i]) continue;
      if (kept != i) pieces_[kept] = std::move(pieces_[i]);
      ++kept;
    }
    pieces_.resize(kept);
  }

 private:
  Pieces& at_corner(std::int32_t v) { return at_corner_[static_cast<std::size_t>(v)]; }
  std::size_t count_at(const Edge& side) const {
    const auto found = at_side_.find(number(side));
    return found == at_side_.end() ? 0 : found->second.size();
  }
  static void erase(Pieces& pieces, std::size_t i) {
    *std::find(pieces.begin(), pieces.end(), i) = pieces.back();
    pieces.pop_back();
  }
  void enter(std::size_t i) {
    look_(256);
    for (std::size_t k = 0; k < pieces_[i].corners.size(); ++k) {
      at_side_[number(side_of(pieces_[i], k))].push_back(i);
      at_corner(pieces_[i].corners[k]).push_back(i);
    }
  }
  void leave(std::size_t i) {
    look_(256);
    for (std::size_t k = 0; k < pieces_[i].corners.size(); ++k) {
      const auto side = at_side_.find(number(side_of(pieces_[i], k)));
      erase(side->second, i);
      if (side->second.empty()) at_side_.erase(side);
      erase(at_corner(pieces_[i].corners[k]), i);
    }
  }

  bool collapses(std::size_t i) {
    const AxisPiece& piece = pieces_[i];
    const std::size_t n = piece.corners.size();
    const auto free = [&](std::size_t k) {
      const Edge side = side_of(piece, k % n);
      return count_at(side) == 1 && loose_.count(side) == 0;
    };
    const auto pinned = [&](std::int32_t v) { return at_corner(v).size() > 1 || loose_at_.count(v) != 0; };
    // A run of free sides ends at a side that another piece has too, and at a corner that something else
    // uses.
    std::size_t runs = 0;
    for (std::size_t k = 0; k < n; ++k) {
      if (free(k) && (!free(k + n - 1) || pinned(piece.corners[k]))) ++runs;
    }
    return runs == 1;
  }

  bool collapse_needless() {
    std::vector<std::size_t> waiting;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      if (pieces_[i].needless) waiting.push_back(i);
    }
    bool any = false;
    while (!waiting.empty()) {
      const std::size_t i = waiting.back();
      waiting.pop_back();
      look_(64);
      if (gone_[i] || !collapses(i)) continue;
      any = gone_[i] = true;
      leave(i);
      for (const std::int32_t v : pieces_[i].corners) {
        for (const std::size_t other : at_corner(v)) {
          if (pieces_[other].needless) waiting.push_back(other);
        }
      }
    }
    return any;
  }

  /// Whether the complex in which u and v are one has the homotopy type of this one.
  bool contracts(std::int32_t u, std::int32_t v) {
    const Pieces& at_both = at_side_.find(number(edge_of(u, v)))->second;
    std::map<std::int32_t, int> triangles;  // third corner: how many
    for (const std::size_t i : at_both) {
      const auto& corners = pieces_[i].corners;
      if (corners.size() != 3) continue;
      for (const std::int32_t x : corners) triangles[x] += x != u && x != v;
    }
    std::set<std::int32_t> neighbors;  // of v
    for (const std::size_t i : at_corner(v)) {
      const auto& corners = pieces_[i].corners;
      const std::size_t n = corners.size();
      if (std::find(corners.begin(), corners.end(), u) != corners.end() &&
          std::find(at_both.begin(), at_both.end(), i) == at_both.end())
        return false;
      const auto k = static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
      neighbors.insert(corners[(k + 1) % n]);
      neighbors.insert(corners[(k + n - 1) % n]);
    }
    neighbors.erase(u);
    return std::all_of(neighbors.begin(), neighbors.end(), [&](std::int32_t x) {
      const Edge other = edge_of(u, x);
      const bool common = count_at(other) != 0 || loose_.count(other) != 0;
      return common ? triangles[x] == 1 && loose_.count(other) == 0 : triangles[x] == 0;
    });
  }

  bool contract_sides() {
    std::vector<Edge> candidates;
    for (const AxisPiece& piece : pieces_) {
      if (gone_[static_cast<std::size_t>(&piece - pieces_.data())]) continue;
      for (std::size_t k = 0; k < piece.corners.size(); ++k) {
        look_(16);
        const Edge side = side_of(piece, k);
        if (side[1] >= options_.balls && options_.same(side[0], side[1])) candidates.push_back(side);
      }
    }
    std::sort(candidates.begin(), candidates.end());
    candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
    bool any = false;
    for (const auto& [u, v] : candidates) {  // u < v: balls come first
      look_(1024);
      if (count_at({u, v}) == 0 || !contracts(u, v)) continue;
      any = true;
      Pieces moving = at_corner(v);
      std::sort(moving.begin(), moving.end());
      for (const std::size_t i : moving) {
        leave(i);
        auto& corners = pieces_[i].corners;
        if (std::find(corners.begin(), corners.end(), u) != corners.end()) {
          corners.erase(std::find(corners.begin(), corners.end(), v));
        } else {
          std::replace(corners.begin(), corners.end(), v, u);
        }
        gone_[i] = corners.size() < 3;
        if (!gone_[i]) enter(i);
      }
    }
    return any;
  }

  std::vector<AxisPiece>& pieces_;
  const TidyOptions& options_;
  Lookout look_;
  std::vector<bool> gone_;
  std::unordered_map<std::uint64_t, Pieces> at_side_;  // sides of none are not there
  std::vector<Pieces> at_corner_;
  std::set<Edge> loose_;
  std::map<std::int32_t, int> loose_at_;
};

}  // namespace

void tidy_pieces(std::vector<AxisPiece>& pieces, std::span<const Edge> edges, const TidyOptions& options,
                 Monitor& monitor) {
  Tidying(pieces, edges, options, monitor).run();
}

}  // namespace ballflow::geometry
