#include "types/topology_table.hpp"

#include <array>
#include <string>
#include <utility>

#include "types/type_of.hpp"

namespace ballflow {

void TypeOf<geometry::TopologyTable>::declare(TypeDecl<geometry::TopologyTable>& d) {
  using T = geometry::TopologyTable;
  using geometry::TopologyStage;
  d.id("TopologyTable", 1)
      .doc("Euler characteristic and Betti numbers of a shape at the stages of a pipeline.");
  d.array("stages", &T::stages)
      .length("n")
      .doc(
          "0 solid inside the surface, 1 inner balls, 2 enlarged balls, 3 kept balls, 4 alpha-shape, 5 "
          "medial axis");
  d.array("betti", &T::betti).length("n").doc("components, tunnels, cavities; -1 where they are unknown");
  d.array("euler", &T::euler).length("n").doc("Euler characteristics, 0 where they are unknown");
  d.summary("words", "what differs from stage to stage, or that nothing does");
  d.summary("changes", "number of Betti numbers that differ from stage to stage");
  constexpr std::array<std::pair<TopologyStage, const char*>, geometry::topology_stages> whose{
      {{TopologyStage::surface, "of the solid inside the surface"},
       {TopologyStage::inner, "of the union of the inner balls"},
       {TopologyStage::enlarged, "of the union of the enlarged balls"},
       {TopologyStage::kept, "of the union of the balls that are kept"},
       {TopologyStage::complex, "of the alpha-shape"},
       {TopologyStage::axis, "of the medial axis"}}};
  for (const auto& [stage, of] : whose) {
    d.summary(geometry::name(stage),
              std::string("[components, tunnels, cavities] ") + of + "; null when not known");
    d.summary(std::string(geometry::name(stage)) + "_euler", std::string("Euler characteristic ") + of);
  }
  d.summarize([](const T& v) {
    Summary s;
    for (std::size_t i = 0; i < geometry::topology_stages; ++i) {
      const auto stage = static_cast<TopologyStage>(i);
      const auto row = v.row(stage);
      const bool known = row && v.known(*row);
      s[geometry::name(stage)] = known ? SummaryValue(v.betti[*row]) : SummaryValue(nullptr);
      s[std::string(geometry::name(stage)) + "_euler"] =
          known ? SummaryValue(v.euler[*row]) : SummaryValue(nullptr);
    }
    const auto changes = geometry::topology_changes(v);
    std::string words;
    for (const std::string& change : changes) words += (words.empty() ? "" : "; ") + change;
    for (std::size_t row = 0; row < v.size() && words.empty(); ++row) {
      if (v.known(row)) words = geometry::describe(v.betti[row]) + " at every stage that is known";
    }
    s["words"] = words.empty() ? "unknown" : words;
    s["changes"] = changes.size();
    return s;
  });
  d.check([](const T& v) { return geometry::broken_invariant(v); });
}

}  // namespace ballflow
