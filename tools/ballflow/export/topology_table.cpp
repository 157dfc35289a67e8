// TopologyTable: one line per stage (csv).
#include "export/format_table.hpp"
#include "show/typed.hpp"
#include "types/artifact_types.hpp"

namespace ballflow {
namespace {

void write_topology_csv(const Artifact& artifact, OutputFile& out) {
  const auto table = typed<geometry::TopologyTable>(artifact);
  out << "stage,euler,components,tunnels,cavities\n";
  for (std::size_t row = 0; row < table.size(); ++row) {
    out << geometry::name(static_cast<geometry::TopologyStage>(table.stages[row]));
    if (!table.known(row)) {
      out << ",,,,\n";
      continue;
    }
    out << ',' << table.euler[row];
    for (const std::int64_t number : table.betti[row]) out << ',' << number;
    out << '\n';
  }
}

}  // namespace

TypeFormats topology_table_formats() {
  return {"TopologyTable", {generic_formats().front(), {"csv", write_topology_csv}}};
}

}  // namespace ballflow
