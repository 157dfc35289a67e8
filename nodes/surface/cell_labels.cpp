#include "surface/cell_labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <string>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "base/index.hpp"
#include "base/space_order.hpp"
#include "search/neighbor_distances.hpp"
#include "surface/cell_walk.hpp"
#include "surface/minimum_cut.hpp"

namespace ballflow::geometry {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double in_complex_share = 0.01;  // what cutting through a facet of K costs, of its area
constexpr double prior = 0.5;        // how strongly an unreached void is inside, of the area of its boundary
constexpr double outer_leak = 1e-3;  // inner votes in the outer void, of its outer ones, that mean a leak
constexpr double inner_leak = 0.1;   // votes of the lesser label in another void, of the larger
constexpr double unit = 0x1p-36;     // of capacities, in squares of the box' longest edge

struct Vote {
  std::int32_t cell;
  bool inner;
  double weight;
};

/// What poles say, in the cells that they lie in.
std::vector<Vote> votes_of(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                           Monitor& monitor) {
  const std::vector<double> spacing = neighbor_distances(sample.points.span(), 6, monitor);
  const std::vector<std::uint8_t> pole = is_pole(poles);
  std::vector<std::int32_t> voters;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const bool certain = poles.uncertain.empty() || poles.uncertain[i] == 0;
    const bool labelled = poles.labels[i] != static_cast<std::uint8_t>(PoleLabel::unlabelled);
    if (pole[i] == 1 && certain && labelled && poles.unbounded[i] == 0)
      voters.push_back(static_cast<std::int32_t>(i));
  }
  // From each to the next it is not far.
  const SpaceOrder order(bounding_box(sample.points.span()));
  std::vector<std::uint64_t> place(poles.size(), 0);
  for (const std::int32_t i : voters) place[at(i)] = order(poles.centers[at(i)]);
  std::sort(voters.begin(), voters.end(), [&](std::int32_t a, std::int32_t b) {
    return std::pair(place[at(a)], a) < std::pair(place[at(b)], b);
  });
  const CellWalk walk(diagram);
  std::vector<Vote> votes;
  std::int32_t last = walk.any();
  Lookout look(monitor);
  for (const std::int32_t i : voters) {
    look(1024);
    double widest = 0;
    for (auto k = poles.defining_offsets[at(i)]; k < poles.defining_offsets[at(i) + 1]; ++k) {
      const double d = spacing[at(poles.defining_samples[static_cast<std::size_t>(k)])];
      if (std::isfinite(d)) widest = std::max(widest, d);
    }
    const std::int32_t cell = walk.cell_of(poles.centers[at(i)], last);
    if (!walk.is_infinite(cell)) last = cell;
    votes.push_back(
        {cell, poles.labels[at(i)] == static_cast<std::uint8_t>(PoleLabel::inner), widest * widest});
  }
  return votes;
}

struct Balance {
  double inner = 0, outer = 0;
};

class Cutter {
 public:
  Cutter(const PowerDiagram& diagram, const std::vector<Vote>& votes)
      : diagram_(diagram), votes_(votes), parts_(diagram.size()), infinite_(diagram.size(), 0) {
    for (std::size_t c = 0; c < diagram.size(); ++c) {
      for (const std::int32_t v : diagram.cells[c]) infinite_[c] |= v == PowerDiagram::infinite ? 1 : 0;
    }
    join_voids();
    number_nodes();
    const double edge = bounding_box(diagram.centers.span()).longest_edge();
    scale_ = 1 / (unit * edge * edge);
  }

  CellLabels cut(Monitor& monitor) const {
    const CutGraph graph = make_graph();
    const MinimumCut found = minimum_cut(graph, monitor);
    CellLabels result;
    result.mixed_voids = mixed_;
    for (const std::int32_t node : node_) {
      result.inside.push_back(node >= 0 ? found.at_source[at(node)] : 0);
    }
    double all = 0, wrong = 0;
    std::vector<double> against(diagram_.size(), 0);  // the label of each cell, less what is for it
    for (const Vote& vote : votes_) {
      const bool right = vote.inner == (result.inside[at(vote.cell)] == 1);
      all += vote.weight;
      if (!right) wrong += vote.weight;
      against[at(vote.cell)] += right ? -vote.weight : vote.weight;
    }
    for (const double weight : against) result.contradicted.push_back(weight > 0 ? 1 : 0);
    result.overruled = all > 0 ? wrong / all : 0;
    return result;
  }

 private:
  bool whole(std::size_t c) const { return (diagram_.in_complex[c] & PowerDiagram::whole) != 0; }
  bool facet_in_complex(std::size_t c, std::size_t k) const { return (diagram_.in_complex[c] >> k & 1) != 0; }

  void join_voids() {
    for (std::size_t c = 0; c < diagram_.size(); ++c) {
      if (whole(c)) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::int32_t beside = diagram_.neighbors[c][k];
        if (at(beside) > c && !whole(at(beside)) && !facet_in_complex(c, k))
          parts_.join(static_cast<std::int32_t>(c), beside);
      }
    }
  }

  /// Voids of one kind of votes are one node, the outer one the sink (-1); other cells have nodes of their
  /// own.
  void number_nodes() {
    std::vector<Balance> balance(diagram_.size());
    for (const Vote& vote : votes_) {
      Balance& b = balance[at(parts_.root(vote.cell))];
      (vote.inner ? b.inner : b.outer) += vote.weight;
    }
    std::int32_t outer = -1;
    for (std::size_t c = 0; c < diagram_.size() && outer < 0; ++c) {
      if (infinite_[c] == 1) outer = parts_.root(static_cast<std::int32_t>(c));
    }
    std::vector<std::uint8_t> mixed(diagram_.size(), 0);  // per root
    for (std::size_t c = 0; c < diagram_.size(); ++c) {
      if (whole(c) || parts_.root(static_cast<std::int32_t>(c)) != static_cast<std::int32_t>(c)) continue;
      const auto& [inner, out] = balance[c];
      const bool is_mixed = static_cast<std::int32_t>(c) == outer
                                ? inner > outer_leak * out
                                : std::min(inner, out) > inner_leak * std::max(inner, out);
      if (!is_mixed) continue;
      mixed[c] = 1;
      ++mixed_;
    }
    node_.assign(diagram_.size(), -1);
    std::vector<std::int32_t> of_void(diagram_.size(), -1);
    for (std::size_t c = 0; c < diagram_.size(); ++c) {
      if (infinite_[c] == 1) continue;
      const std::int32_t root = parts_.root(static_cast<std::int32_t>(c));
      if (whole(c) || mixed[at(root)] == 1) {
        node_[c] = nodes_++;
      } else if (root != outer) {
        if (of_void[at(root)] < 0) of_void[at(root)] = nodes_++;
        node_[c] = of_void[at(root)];
      }
    }
    outer_ = outer;
  }

  CutGraph make_graph() const {
    CutGraph graph;
    graph.nodes = nodes_;
    graph.from_source.assign(at(nodes_), 0);
    graph.to_sink.assign(at(nodes_), 0);
    for (const Vote& vote : votes_) {
      const std::int32_t node = node_[at(vote.cell)];
      if (node < 0) continue;
      (vote.inner ? graph.from_source : graph.to_sink)[at(node)] += rounded(vote.weight);
    }
    DisjointSets parts = parts_;  // root() shortens ways
    for (std::size_t c = 0; c < diagram_.size(); ++c) {
      const bool closed_void =
          !whole(c) && infinite_[c] == 0 && parts.root(static_cast<std::int32_t>(c)) != outer_;
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t beside = at(diagram_.neighbors[c][k]);
        if (infinite_[c] == 1 && infinite_[beside] == 1) continue;
        const double area =
            facet_area(diagram_, infinite_[c] == 1 ? beside : c, infinite_[c] == 1 ? opposite(beside, c) : k);
        if (closed_void && facet_in_complex(c, k)) graph.from_source[at(node_[c])] += rounded(prior * area);
        if (beside < c || node_[c] == node_[beside]) continue;
        const std::int64_t capacity = rounded(facet_in_complex(c, k) ? in_complex_share * area : area);
        if (node_[c] < 0 || node_[beside] < 0) {
          graph.to_sink[at(std::max(node_[c], node_[beside]))] += capacity;
        } else {
          graph.edges.push_back({node_[c], node_[beside], capacity});
        }
      }
    }
    return graph;
  }
  /// The corner of `cell` that is not in the facet which it shares with `other`.
  std::size_t opposite(std::size_t cell, std::size_t other) const {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& vertices = diagram_.cells[other];
      if (std::find(vertices.begin(), vertices.end(), diagram_.cells[cell][k]) == vertices.end()) return k;
    }
    return 0;
  }
  std::int64_t rounded(double area) const { return std::llround(std::min(area * scale_, 0x1p52)); }

  const PowerDiagram& diagram_;
  const std::vector<Vote>& votes_;
  DisjointSets parts_;
  std::vector<std::uint8_t> infinite_;
  std::vector<std::int32_t> node_;  // per cell, -1 for the sink
  std::int32_t nodes_ = 0, outer_ = -1;
  std::int64_t mixed_ = 0;
  double scale_ = 1;
};

}  // namespace

double facet_area(const PowerDiagram& diagram, std::size_t cell, std::size_t k) {
  std::array<Vec3, 3> p;
  for (std::size_t j = 0, n = 0; j < 4; ++j) {
    if (j != k) p[n++] = diagram.centers[at(diagram.cells[cell][j])];
  }
  return 0.5 * length(cross(p[1] - p[0], p[2] - p[0]));
}

CellLabels cell_labels(const PowerDiagram& diagram, const PoleSet& poles, const PointSet& sample,
                       Monitor& monitor) {
  if (poles.sample_poles.size() != sample.points.size()) {
    throw InputError("the poles are those of " + std::to_string(poles.sample_poles.size()) +
                         " samples, but there are " + std::to_string(sample.points.size()),
                     "connect the points that the poles were computed from");
  }
  PartMonitor voting(monitor, 0, 0.4), cutting(monitor, 0.4, 1);
  const std::vector<Vote> votes = votes_of(diagram, poles, sample, voting);
  return Cutter(diagram, votes).cut(cutting);
}

}  // namespace ballflow::geometry
