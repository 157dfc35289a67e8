#include "ballflow/graph.hpp"

#include "expand.hpp"

namespace ballflow {

const DagNode* Dag::find(const std::string& path) const {
  for (const DagNode& node : nodes) {
    if (node.path == path) return &node;
  }
  return nullptr;
}

Dag parse_graph(const std::string& text, const std::string& file, const Registry& registry,
                const std::vector<Override>& overrides) {
  Findings findings;
  Expansion expansion;
  expansion.file_names.push_back(file);
  Dag dag;
  if (std::unique_ptr<GraphFile> top = read_graph_file(json_text::Source(file, text), findings)) {
    expand(std::move(top), registry, overrides, expansion, findings);
    if (!expansion.abandoned) dag = connect(expansion, registry, findings);
  }
  const bool failed = findings.failed();
  std::vector<Diagnostic> all = findings.take(expansion.file_names);
  if (failed) throw GraphError(std::move(all));
  dag.warnings = std::move(all);
  return dag;
}

Dag load_graph(const std::string& file, const Registry& registry, const std::vector<Override>& overrides) {
  return parse_graph(read_text_file(file), file, registry, overrides);
}

}  // namespace ballflow
