#include "cover/components.hpp"

#include <boost/graph/graph_traits.hpp>
#include <boost/graph/incremental_components.hpp>
#include <boost/pending/disjoint_sets.hpp>
#include <numeric>
#include <utility>

#include "base/lists.hpp"

namespace ballflow::geometry {
namespace {

/// The columns of a matrix as a graph of Boost.Graph that is never built: a row joins its first column to
/// each of the others. It is an EdgeListGraph, the edges of which are enumerated once.
class ColumnGraph {
 public:
  using vertex_descriptor = std::int32_t;
  using edge_descriptor = std::pair<std::int32_t, std::int32_t>;
  using directed_category = boost::undirected_tag;
  using edge_parallel_category = boost::allow_parallel_edge_tag;
  using traversal_category = boost::edge_list_graph_tag;

  class edge_iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = edge_descriptor;
    using difference_type = std::ptrdiff_t;
    using pointer = const edge_descriptor*;
    using reference = edge_descriptor;

    edge_iterator() = default;
    edge_iterator(const ColumnGraph& graph, std::size_t row) : graph_(&graph), row_(row) { skip(); }
    edge_descriptor operator*() const { return {columns()[0], columns()[at_]}; }
    edge_iterator& operator++() {
      ++at_;
      skip();
      return *this;
    }
    friend bool operator==(const edge_iterator& a, const edge_iterator& b) {
      return a.row_ == b.row_ && a.at_ == b.at_;
    }
    friend bool operator!=(const edge_iterator& a, const edge_iterator& b) { return !(a == b); }

   private:
    std::span<const std::int32_t> columns() const { return graph_->state_.row(row_); }
    void skip() {
      while (row_ < graph_->state_.rows() && at_ >= columns().size()) {
        graph_->look_(columns().size());
        ++row_;
        at_ = 1;
      }
    }
    const ColumnGraph* graph_ = nullptr;
    std::size_t row_ = 0, at_ = 1;
  };

  ColumnGraph(const CoverState& state, Monitor& monitor) : state_(state), look_(monitor) {}

  friend std::pair<edge_iterator, edge_iterator> edges(const ColumnGraph& graph) {
    return {{graph, 0}, {graph, graph.state_.rows()}};
  }
  friend vertex_descriptor source(const edge_descriptor& edge, const ColumnGraph&) { return edge.first; }
  friend vertex_descriptor target(const edge_descriptor& edge, const ColumnGraph&) { return edge.second; }

 private:
  const CoverState& state_;
  mutable Lookout look_;
};

}  // namespace

Components components(const CoverState& state, Monitor& monitor) {
  const std::size_t cols = state.cols();
  std::vector<std::int32_t> rank(cols), parent(cols);
  std::iota(parent.begin(), parent.end(), 0);
  boost::disjoint_sets sets(rank.data(), parent.data());
  const ColumnGraph graph(state, monitor);
  boost::incremental_components(graph, sets);

  Components result;
  result.of_column.resize(cols);
  std::vector<std::int32_t> number(cols, -1);
  for (std::size_t c = 0; c < cols; ++c) {
    std::int32_t& component = number[static_cast<std::size_t>(sets.find_set(static_cast<std::int32_t>(c)))];
    if (component < 0) {
      component = static_cast<std::int32_t>(result.columns.size());
      result.columns.push_back(0);
    }
    result.of_column[c] = component;
    ++result.columns[static_cast<std::size_t>(component)];
  }
  result.rows.resize(result.columns.size());
  result.of_row.reserve(state.rows());
  for (std::size_t i = 0; i < state.rows(); ++i) {
    const auto row = state.row(i);
    result.of_row.push_back(row.empty() ? -1 : result.of_column[static_cast<std::size_t>(row[0])]);
    if (!row.empty()) ++result.rows[static_cast<std::size_t>(result.of_row.back())];
  }
  return result;
}

namespace {

/// The members of each group, ascending. Negative groups are left out.
Lists<std::int32_t> members(const std::vector<std::int32_t>& group_of, std::size_t groups) {
  return lists_of<std::int32_t>(groups, [&](auto&& put) {
    for (std::size_t i = 0; i < group_of.size(); ++i) {
      if (group_of[i] >= 0) put(static_cast<std::size_t>(group_of[i]), static_cast<std::int32_t>(i));
    }
  });
}

}  // namespace

Parts::Parts(const CoverState& state, Monitor& monitor)
    : state_(state),
      components_(components(state, monitor)),
      rows_(members(components_.of_row, count())),
      columns_(members(components_.of_column, count())),
      number_(state.cols()) {
  for (std::size_t k = 0; k < count(); ++k) {
    std::int32_t next = 0;
    for (const std::int32_t c : columns(k)) number_[static_cast<std::size_t>(c)] = next++;
  }
}

std::int32_t Parts::whole_row(std::size_t k) const {
  for (const std::int32_t i : rows(k)) {
    if (state_.row(static_cast<std::size_t>(i)).size() == columns(k).size()) return i;
  }
  return -1;
}

Part Parts::part(std::size_t k, Monitor& monitor) const {
  Part part{{rows(k).begin(), rows(k).end()}, {columns(k).begin(), columns(k).end()}, {}, {}};
  std::vector<std::int64_t> offsets{0};
  std::size_t size = 0;
  for (const std::int32_t i : part.row_ids) {
    size += state_.row(static_cast<std::size_t>(i)).size();
    offsets.push_back(static_cast<std::int64_t>(size));
  }
  std::vector<std::int32_t> entries;
  entries.reserve(size);
  Lookout look(monitor);
  for (const std::int32_t i : part.row_ids) {
    look(state_.row(static_cast<std::size_t>(i)).size());
    for (const std::int32_t c : state_.row(static_cast<std::size_t>(i))) {
      entries.push_back(number_[static_cast<std::size_t>(c)]);
    }
  }
  part.rows = {std::move(offsets), std::move(entries)};
  part.columns = transpose(part.rows, part.column_ids.size(), monitor);
  return part;
}

}  // namespace ballflow::geometry
