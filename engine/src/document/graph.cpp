#include "ballflow/graph.hpp"

#include "document/artifact_params.hpp"
#include "document/connect.hpp"
#include "document/expand.hpp"
#include "document/graph_json.hpp"
#include "document/variant_merger.hpp"

namespace ballflow {

const DagNode* Dag::find(const std::string& path) const {
  for (const DagNode& node : nodes) {
    if (node.path == path) return &node;
  }
  return nullptr;
}

namespace {

/// Findings of variants, each once, with a note of the first variant where it does not concern all.
class VariantFindings {
 public:
  void add(const std::string& variant, std::vector<Diagnostic> found) {
    ++variants_;
    for (Diagnostic& finding : found) {
      const std::string key = finding.file + '\0' + std::to_string(finding.line) + ':' +
                              std::to_string(finding.column) + '\0' + finding.message;
      Tally& tally = tallies_.try_emplace(key, Tally{std::move(finding), variant, 0}).first->second;
      ++tally.count;
    }
  }
  void move_to(Findings& findings) {
    for (auto& [key, tally] : tallies_) {
      if (tally.count < variants_) {
        std::string& hint = tally.finding.hint;
        hint += (hint.empty() ? "" : "; ") + std::string("in the variant ") + tally.variant;
      }
      findings.add(std::move(tally.finding));
    }
  }

 private:
  struct Tally {
    Diagnostic finding;
    std::string variant;
    std::size_t count;
  };
  std::map<std::string, Tally> tallies_;
  std::size_t variants_ = 0;
};

// Of all variants before they are merged; a graph without a sweep may have a tenth.
constexpr std::size_t max_expanded = 10 * max_instances;
constexpr std::size_t enough_failures = 20;  // variants that are wrong before the others are not looked at

/// Artifacts from outside: those that were handed over, and how others are found by their names.
struct Outside {
  const std::map<std::string, ArtifactPtr>& given;
  const FindArtifact& find;
  std::map<std::string, ArtifactPtr> found = {};
};

/// One graph without a sweep, or one variant. Nothing usable when there are findings.
Dag expand_and_connect(const GraphFile& top, GraphFiles& files, const Registry& registry,
                       const std::vector<const PlacedSetting*>& settings, Outside& outside,
                       std::size_t& expanded, Findings& findings) {
  Expansion expansion;
  expand(top, files, registry, settings, expansion, findings);
  expanded += expansion.leaves.size() + expansion.scopes.size();
  if (expansion.abandoned) return {};
  const auto given =
      find_given(top, registry, settings, outside.given, outside.find, outside.found, findings);
  Dag dag = connect(expansion, registry, given, findings);
  for (const GraphParam& param : top.params) {  // a report says which content it was, wherever that came from
    const auto artifact = given.find(param.decl.name);
    if (param.decl.kind == ParamKind::artifact && artifact != given.end())
      dag.params[param.decl.name] = artifact->second->digest().hex();
  }
  return dag;
}

Dag merge_variants(const GraphFile& top, GraphFiles& files, const Registry& registry,
                   const std::vector<const PlacedSetting*>& sets, const Sweep& sweep, Outside& outside,
                   Findings& findings) {
  VariantMerger merger(sweep);
  VariantFindings all;
  std::size_t failures = 0, expanded = 0;
  for (const Sweep::Choice& choice : sweep.variants) {
    std::vector<const PlacedSetting*> settings = sets;
    for (std::size_t axis = 0; axis < choice.size(); ++axis)
      settings.push_back(&sweep.axes[axis].values[choice[axis]]);
    Findings found(&findings);
    Dag dag = expand_and_connect(top, files, registry, settings, outside, expanded, found);
    if (found.failed()) {
      ++failures;
    } else if (failures == 0) {
      merger.add(std::move(dag));
    }
    all.add(sweep.name_of(choice), found.take(files.names()));
    if (failures == enough_failures) break;
    if (merger.nodes() <= max_instances && expanded <= max_expanded) continue;
    findings.error(top, top.sweep ? top.sweep->offset : top.root.offset,
                   "the sweep has " + std::to_string(sweep.variants.size()) + " variants with more than " +
                       std::to_string(expanded > max_expanded ? max_expanded : max_instances) + " nodes",
                   "take fewer values");
    break;
  }
  all.move_to(findings);
  return findings.failed() ? Dag() : merger.finish();
}

}  // namespace

std::string base_path(const std::string& path) {
  const std::size_t end = path.empty() || path[0] != '[' ? std::string::npos : path.find("]/");
  return end == std::string::npos ? path : path.substr(end + 2);
}

std::string without_entries(const std::string& path) {
  std::string plain;
  for (std::size_t at = 0; at < path.size();) {
    const bool entry = path[at] == '[' && at > 0 && path[at - 1] != '/';
    const std::size_t close = entry ? path.find(']', at) : std::string::npos;
    if (close == std::string::npos) {
      plain += path[at++];
    } else {
      at = close + 1;
    }
  }
  return plain;
}

Dag parse_graph(const std::string& text, const std::string& file, const Registry& registry,
                const std::vector<Setting>& settings, const SweepOptions& options,
                const std::map<std::string, ArtifactPtr>& given, const FindArtifact& find) {
  Findings findings;
  Outside outside{given, find};
  GraphFiles files(file, findings);
  std::vector<PlacedSetting> placed;
  for (const Setting& setting : settings) {
    PlacedSetting& set = placed.emplace_back();
    set.name = setting.name;
    set.text = setting.value;
    set.origin = "--set " + setting.name + "=" + setting.value;
  }
  std::vector<const PlacedSetting*> sets;
  for (const PlacedSetting& set : placed) sets.push_back(&set);
  Dag dag;
  if (const auto top = read_graph_file(json_text::Source(file, text), findings)) {
    if (const auto sweep = plan_sweep(*top, placed, options, findings)) {
      dag = merge_variants(*top, files, registry, sets, *sweep, outside, findings);
    } else {
      std::size_t expanded = 0;
      dag = expand_and_connect(*top, files, registry, sets, outside, expanded, findings);
    }
  }
  const bool failed = findings.failed();
  dag.files = files.names();
  std::vector<Diagnostic> all = findings.take(files.names());
  if (failed) throw GraphError(std::move(all));
  dag.warnings = std::move(all);
  return dag;
}

Dag load_graph(const std::string& file, const Registry& registry, const std::vector<Setting>& settings,
               const SweepOptions& sweep, const std::map<std::string, ArtifactPtr>& given,
               const FindArtifact& find) {
  return parse_graph(read_text_file(file), file, registry, settings, sweep, given, find);
}

GraphOutline parse_outline(const std::string& text, const std::string& file) {
  Findings findings;
  const auto read = read_graph_file(json_text::Source(file, text), findings);
  if (findings.failed()) throw GraphError(findings.take({file}));
  GraphOutline outline;
  if (!read) return outline;
  outline.doc = read->doc;
  for (const GraphParam& param : read->params) outline.params.push_back(param.decl);
  for (const GraphOutput& output : read->outputs) outline.outputs.emplace_back(output.name, output.doc);
  return outline;
}

GraphOutline load_outline(const std::string& file) { return parse_outline(read_text_file(file), file); }

}  // namespace ballflow
