#include "types/topology_table.hpp"

#include <algorithm>

namespace ballflow::geometry {
namespace {

/// What leads from the row before to the row of a stage.
const char* step_to(TopologyStage stage, bool kept_is_there) {
  switch (stage) {
    case TopologyStage::surface:
      return "the surface";
    case TopologyStage::inner:
      return "the union of inner balls";
    case TopologyStage::enlarged:
      return "growing";
    case TopologyStage::kept:
      return "pruning";
    case TopologyStage::complex:
      return kept_is_there ? "the alpha-shape" : "pruning";  // that of the kept balls
    case TopologyStage::axis:
      return "the medial axis";
  }
  return "";
}

std::string counted(std::int64_t n, const char* one, const char* many) {
  return (n == 0 ? "no" : std::to_string(n)) + " " + (n == 0 || n == 1 ? one : many);
}

}  // namespace

const char* name(TopologyStage stage) {
  constexpr const char* names[] = {"surface", "inner", "enlarged", "kept", "complex", "axis"};
  return names[static_cast<std::size_t>(stage)];
}

std::optional<std::size_t> TopologyTable::row(TopologyStage stage) const {
  const auto at = std::find(stages.begin(), stages.end(), static_cast<std::uint8_t>(stage));
  if (at == stages.end()) return std::nullopt;
  return static_cast<std::size_t>(at - stages.begin());
}

TopologyTable one_row(TopologyStage stage, const std::optional<Betti>& betti) {
  constexpr std::int64_t unknown = TopologyTable::unknown;
  const Betti b = betti.value_or(Betti{unknown, unknown, unknown});
  return {{static_cast<std::uint8_t>(stage)}, {b}, {betti ? b[0] - b[1] + b[2] : 0}};
}

std::vector<std::string> topology_changes(const TopologyTable& table) {
  std::vector<std::string> changes;
  std::optional<std::size_t> before;
  for (std::size_t row = 0; row < table.size(); ++row) {
    if (!table.known(row)) continue;
    if (before) {
      const std::string step =
          step_to(static_cast<TopologyStage>(table.stages[row]), table.row(TopologyStage::kept).has_value());
      const auto change = [&](std::size_t k, const char* more, const char* fewer, const char* one,
                              const char* many) {
        const std::int64_t difference = table.betti[row][k] - table.betti[*before][k];
        if (difference == 0) return;
        changes.push_back(step + " " + (difference > 0 ? more : fewer) + " " +
                          counted(std::abs(difference), one, many));
      };
      change(0, "added", "joined or lost", "component", "components");
      change(1, "opened", "closed", "tunnel", "tunnels");
      change(2, "opened", "closed", "cavity", "cavities");
    }
    before = row;
  }
  return changes;
}

std::string describe(const Betti& betti) {
  return counted(betti[0], "component", "components") + ", " + counted(betti[1], "tunnel", "tunnels") + ", " +
         counted(betti[2], "cavity", "cavities");
}

std::string broken_invariant(const TopologyTable& table) {
  const std::size_t n = table.size();
  if (table.betti.size() != n || table.euler.size() != n) {
    return std::to_string(n) + " stages but " + std::to_string(table.betti.size()) +
           " rows of Betti numbers and " + std::to_string(table.euler.size()) + " Euler characteristics";
  }
  for (std::size_t row = 0; row < n; ++row) {
    const std::string where = "row " + std::to_string(row);
    if (table.stages[row] >= topology_stages)
      return where + " has the unknown stage " + std::to_string(table.stages[row]);
    if (row > 0 && table.stages[row] <= table.stages[row - 1]) return where + " is out of order";
    const auto [b0, b1, b2] = table.betti[row];
    const bool unknown = b0 == TopologyTable::unknown && b1 == b0 && b2 == b0;
    if (unknown ? table.euler[row] != 0 : b0 < 0 || b1 < 0 || b2 < 0 || b0 - b1 + b2 != table.euler[row]) {
      return where + ": Betti numbers " + std::to_string(b0) + ", " + std::to_string(b1) + ", " +
             std::to_string(b2) + " do not fit the Euler characteristic " + std::to_string(table.euler[row]);
    }
  }
  return {};
}

}  // namespace ballflow::geometry
