#include "cover/bandwidth_order.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace ballflow::geometry {
namespace {

using Ids = std::vector<std::int32_t>;

class Numbering {
 public:
  Numbering(const Csr& rows, const Csr& columns, Monitor& monitor)
      : look_(monitor), sides_{Side{rows, Ids(rows.size(), -1)}, Side{columns, Ids(columns.size(), -1)}} {
    std::vector<Vertex> starts;
    for (const bool column : {false, true}) {
      for (std::size_t v = 0; v < side(column).adjacent.size(); ++v)
        starts.push_back({column, static_cast<std::int32_t>(v)});
    }
    std::stable_sort(starts.begin(), starts.end(),
                     [this](Vertex a, Vertex b) { return degree(a) < degree(b); });
    for (const Vertex start : starts) search(start);
  }
  BandwidthOrder result() { return {std::move(sides_[0].rank), std::move(sides_[1].rank)}; }

 private:
  struct Vertex {
    bool column;
    std::int32_t number;
  };
  struct Side {
    const Csr& adjacent;
    Ids rank;
    std::int32_t next = 0;
  };

  Side& side(bool column) { return sides_[column ? 1 : 0]; }
  std::size_t degree(Vertex v) { return side(v.column).adjacent.degree(static_cast<std::size_t>(v.number)); }
  /// Vertices leave the queue in the order in which they enter it, so they can be numbered as they enter.
  void enter(Vertex v) {
    queue_.push_back(v);
    side(v.column).rank[static_cast<std::size_t>(v.number)] = side(v.column).next++;
  }
  bool met(Vertex v) { return side(v.column).rank[static_cast<std::size_t>(v.number)] >= 0; }
  void search(Vertex start) {
    if (met(start)) return;
    queue_.clear();
    enter(start);
    Ids neighbours;
    for (std::size_t at = 0; at < queue_.size(); ++at) {
      const Vertex v = queue_[at];
      look_(degree(v));
      neighbours.clear();
      for (const std::int32_t u : side(v.column).adjacent[static_cast<std::size_t>(v.number)]) {
        if (!met({!v.column, u})) neighbours.push_back(u);
      }
      std::stable_sort(neighbours.begin(), neighbours.end(), [&](std::int32_t a, std::int32_t b) {
        return degree({!v.column, a}) < degree({!v.column, b});
      });
      for (const std::int32_t u : neighbours) enter({!v.column, u});
    }
  }

  Lookout look_;
  std::array<Side, 2> sides_;
  std::vector<Vertex> queue_;
};

}  // namespace

BandwidthOrder bandwidth_order(const Csr& rows, const Csr& columns, Monitor& monitor) {
  return Numbering(rows, columns, monitor).result();
}

}  // namespace ballflow::geometry
