#include "document/expand.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "base/quote.hpp"
#include "document/file_patterns.hpp"
#include "document/labels.hpp"
#include "document/loop_body.hpp"
#include "document/map_lists.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

namespace {

/// Thrown when a limit is reached; its finding was added.
struct Abandoned {};

std::vector<std::string> choice_names(const ParamDecl& param) {
  std::vector<std::string> names;
  for (const auto& choice : param.choices) names.push_back(choice.first);
  return names;
}

std::string param_hint(const ParamDecl& param, const Json& value) {
  if (param.kind == ParamKind::choice && value.is_string()) {
    if (std::string hint = did_you_mean(value.get<std::string>(), choice_names(param)); !hint.empty())
      return hint;
  }
  if (param.doc.empty()) return {};
  return param.name + ": " + param.doc + (param.unit.empty() ? "" : " (" + param.unit + ")");
}

class Expander {
 public:
  Expander(GraphFiles& files, const Registry& registry, const std::vector<const PlacedSetting*>& settings,
           Expansion& expansion, Findings& findings)
      : files_(files), registry_(registry), settings_(settings), expansion_(expansion), findings_(findings) {
    for (const auto& [id, node] : registry.nodes().unparsed()) type_names_.push_back(id);
  }

  void run(const GraphFile& file) {
    files_.enter(file);
    std::vector<std::optional<Json>> params;
    for (const GraphParam& param : file.params) {
      if (param.decl.kind == ParamKind::artifact) {  // find_given looks for its value
        settings_.find("", param.decl.name);
        params.emplace_back(nullptr);
        continue;
      }
      if (const PlacedSetting* setting = setting_of("", param.decl.name, param.alias)) {
        params.push_back(param.broken ? std::nullopt : value_of(*setting, param.decl));
      } else if (param.broken) {
        params.push_back(std::nullopt);
      } else if (param.decl.required) {
        findings_.error(file, param.offset, "parameter " + in_quotes(param.decl.name) + " has no value",
                        "give it one: --set " + param.decl.name + "=<" + kind_name(param.decl.kind) + ">");
        params.push_back(std::nullopt);
      } else {
        params.push_back(found_files(param.decl, param.decl.default_value, file, param.offset));
      }
    }
    instantiate(file, nowhere, nowhere, "", std::move(params));
    files_.leave();
    report_unused_settings();
  }

 private:
  std::optional<Json> value_of(const PlacedSetting& setting, const ParamDecl& param) {
    Json value;
    if (setting.value) {  // one value of a sweep
      value =
          is_list(param.kind) && !setting.value->is_array() ? Json::array({*setting.value}) : *setting.value;
    } else if (!is_utf8(setting.text)) {
      findings_.add(about_setting(setting, in_quotes(param.name) + " must be UTF-8",
                                  "rename the file, or set a link to it with a name in UTF-8"));
      return std::nullopt;
    } else if (!from_text(param, setting.text, value)) {
      findings_.add(about_setting(
          setting, in_quotes(param.name) + " must be " + wanted(param) + ", is " + in_quotes(setting.text),
          param_hint(param, value)));
      return std::nullopt;
    }
    if (std::string why = param.refuse(value); !why.empty()) {
      findings_.add(about_setting(setting, in_quotes(param.name) + " " + why, param_hint(param, value)));
      return std::nullopt;
    }
    return found_files(param, normalised(param, value), [&](const std::string& message, const char* hint) {
      findings_.add(about_setting(setting, message, hint));
    });
  }

  /// What a text that is no value of the parameter should have been.
  static const char* wanted(const ParamDecl& param) {
    if (param.kind == ParamKind::boolean) return "true or false";
    if (param.kind == ParamKind::integer) return "a whole number of 64 bits";
    return is_list(param.kind) ? "a,b,c or a JSON list" : "a finite number";
  }

  /// The value, with the files that match where it is a list of patterns; `complain` says what matches none.
  template <class Complain>
  static std::optional<Json> found_files(const ParamDecl& param, const Json& value, Complain complain) {
    if (param.kind != ParamKind::files) return value;
    std::set<std::string> files;
    for (const Json& entry : value) {
      const std::vector<std::string> matches = matching_files(entry.get_ref<const std::string&>());
      if (matches.empty()) {
        complain(
            in_quotes(param.name) + ": no file matches " + in_quotes(entry.get_ref<const std::string&>()),
            "patterns are relative to the current directory");
        return std::nullopt;
      }
      files.insert(matches.begin(), matches.end());
    }
    return Json(files);
  }
  std::optional<Json> found_files(const ParamDecl& param, const Json& value, const GraphFile& file,
                                  Offset offset) {
    return found_files(param, value, [&](const std::string& message, const char* hint) {
      findings_.error(file, offset, message, hint);
    });
  }

  /// By its name, else by its alias; where both are set, nothing looks for the alias, and that is reported.
  const PlacedSetting* setting_of(const std::string& path, const std::string& name,
                                  const std::string& alias) {
    const PlacedSetting* setting = settings_.find(path, name);
    return setting == nullptr && !alias.empty() ? settings_.find(path, alias) : setting;
  }

  /// The value written for `param` at a node, or from a setting. Nothing when absent or wrong.
  std::optional<Json> given_value(const Scope& scope, const GraphNode::Param* written,
                                  const std::string& path, const ParamDecl& param, bool& given,
                                  const std::string& alias = {}) {
    given = true;
    if (const PlacedSetting* setting = setting_of(path, param.name, alias)) return value_of(*setting, param);
    given = written != nullptr;
    if (!given) return std::nullopt;
    std::optional<Json> value = written->value.evaluate(scope.params);
    if (!value) return std::nullopt;
    if (param.kind == ParamKind::string && value->is_array()) value = value->dump();  // ["hand","arm"]
    if (std::string why = param.refuse(*value); !why.empty()) {
      findings_.error(*scope.file, written->value.offset, in_quotes(param.name) + " " + why,
                      param_hint(param, *value));
      return std::nullopt;
    }
    return found_files(param, normalised(param, *value), *scope.file, written->value.offset);
  }

  void refuse_unknown_params(const GraphFile& file, const GraphNode& node, const std::string& owner,
                             const std::vector<std::string>& known) {
    for (const GraphNode::Param& param : node.params) {
      if (std::find(known.begin(), known.end(), param.name) != known.end()) continue;
      std::string hint = did_you_mean(param.name, known);
      if (hint.empty())
        hint = known.empty() ? owner + " has no parameters" : "parameters are " + listed(known);
      findings_.error(file, param.offset, owner + " has no parameter " + in_quotes(param.name),
                      std::move(hint));
    }
  }

  void count_instance(const GraphFile& file, Offset offset) {
    if (++instances_ <= max_instances) return;
    findings_.error(file, offset,
                    "the graph expands to more than " + std::to_string(max_instances) + " nodes");
    throw Abandoned();
  }

  std::size_t instantiate(const GraphFile& file, std::size_t parent, std::size_t parent_node,
                          const std::string& path, std::vector<std::optional<Json>> params,
                          std::optional<std::string> entry = {}) {
    const std::size_t index = expansion_.scopes.size();
    Scope& scope = expansion_.scopes.emplace_back();
    scope.file = &file;
    scope.parent = parent;
    scope.parent_node = parent_node;
    scope.loop = loop_;
    scope.path = path;
    scope.entry = std::move(entry);
    scope.params = std::move(params);
    scope.slots.resize(file.nodes.size());
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
      const GraphNode& node = file.nodes[i];
      const std::string node_path = path.empty() ? node.name : path + "/" + node.name;
      count_instance(file, node.offset);
      if (!node.broken)
        scope.slots[i] =
            std::visit([&](const auto& kind) { return add(index, i, node_path, kind); }, node.kind);
      if (scope.slots[i].kind == Scope::Slot::Kind::broken) broken_paths_.push_back(node_path);
    }
    return index;
  }

  Scope::Slot add(std::size_t scope_index, std::size_t node_index, const std::string& path,
                  const GraphNode::Declared& declared) {
    const Scope& scope = expansion_.scopes[scope_index];
    const GraphNode& node = scope.file->nodes[node_index];
    const NodeDeclaration* decl = registry_.node(declared.type);
    if (decl == nullptr) {
      std::string hint = did_you_mean(declared.type, type_names_);
      if (hint.empty())
        hint = type_names_.empty() ? "no node libraries are loaded"
                                   : "node types are " + listed(type_names_, 40);
      findings_.error(*scope.file, declared.offset, "unknown node type " + in_quotes(declared.type),
                      std::move(hint));
      return {};
    }
    Leaf leaf{path, scope_index, node_index, *decl};
    std::vector<std::string> known;
    for (const ParamDecl& param : decl->params) {
      known.push_back(param.name);
      bool given = false;
      std::optional<Json> value = given_value(scope, node.param(param.name), path, param, given);
      if (!given && param.required) {
        findings_.error(*scope.file, node.offset,
                        "node " + in_quotes(node.name) + " (" + decl->id +
                            ") needs a value for its parameter " + in_quotes(param.name),
                        param_hint(param, nullptr));
      }
      if (!given && !param.required) value = param.default_value;
      if (value) leaf.params[param.name] = std::move(*value);
    }
    refuse_unknown_params(*scope.file, node, "node type " + in_quotes(decl->id), known);
    expansion_.leaves.push_back(std::move(leaf));
    return {Scope::Slot::Kind::leaf, expansion_.leaves.size() - 1};
  }

  Scope::Slot add(std::size_t scope_index, std::size_t node_index, const std::string& path,
                  const GraphNode::Subgraph& subgraph) {
    const Scope& scope = expansion_.scopes[scope_index];
    const GraphFile* const file = include(scope, subgraph.file, "\"graph\"");
    if (file == nullptr) return {};
    Params params = params_of(*file, scope, node_index, path, "subgraph", "subgraph");
    files_.enter(*file);
    const std::size_t inner = instantiate(*file, scope_index, node_index, path, std::move(params));
    files_.leave();
    return {Scope::Slot::Kind::scope, inner};
  }

  /// A loop is one node for what is around it; its body is a scope that nothing outside sees.
  Scope::Slot add(std::size_t scope_index, std::size_t node_index, const std::string& path,
                  const GraphNode::Loop& written) {
    const Scope& scope = expansion_.scopes[scope_index];
    const GraphFile* const body = include(scope, written.body, "\"loop\"");
    if (body == nullptr) return {};
    Params params = params_of(*body, scope, node_index, path, "loop", "loop body");
    files_.enter(*body);
    const Scope::Slot slot = add_loop(*body, scope_index, node_index, path, written, std::move(params));
    files_.leave();
    return slot;
  }

  /// A subgraph for every entry of a list.
  Scope::Slot add(std::size_t scope_index, std::size_t node_index, const std::string& path,
                  const GraphNode::Map& written) {
    const Scope& scope = expansion_.scopes[scope_index];
    const GraphNode& node = scope.file->nodes[node_index];
    const GraphFile* const body = include(scope, written.body, "\"map\"");
    if (body == nullptr) return {};
    std::vector<MapList> lists;
    if (!read_map(*scope.file, scope.params, node, written, *body, lists, findings_)) return {};
    const std::size_t map = expansion_.maps.size();
    expansion_.maps.push_back({body});
    const std::vector<std::string> labels =
        labels_of(lists[0].entries, lists[0].param->kind == ParamKind::file);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      count_instance(*scope.file, node.offset);
      const std::string copy_path = path + "[" + labels[i] + "]";
      Params params = params_of(*body, scope, node_index, copy_path, "map", "map body", {lists, i});
      files_.enter(*body);
      const std::size_t copy =
          instantiate(*body, scope_index, node_index, copy_path, std::move(params), labels[i]);
      files_.leave();
      expansion_.maps[map].scopes.push_back(copy);
    }
    return {Scope::Slot::Kind::map, map};
  }

  /// A node that has no kind was reported.
  Scope::Slot add(std::size_t, std::size_t, const std::string&, const std::monostate&) { return {}; }

  using Params = std::vector<std::optional<Json>>;

  /// The file of a subgraph or of the body of a loop; null when it cannot be used.
  const GraphFile* include(const Scope& scope, const Template& path, const char* field) {
    const std::optional<Json> name = path.evaluate(scope.params);
    if (!name) return nullptr;
    if (name->is_string()) return files_.find(*scope.file, path.offset, name->get<std::string>(), findings_);
    findings_.error(*scope.file, path.offset,
                    field + std::string(" must be the path of a file, ") + described(*name));
    return nullptr;
  }

  /// The parameters of a file that a node includes; a copy of a map has some from its lists.
  Params params_of(const GraphFile& file, const Scope& scope, std::size_t node_index, const std::string& path,
                   const std::string& node_is, const std::string& file_is, const MapEntry& entry = {}) {
    const GraphNode& node = scope.file->nodes[node_index];
    Params params;
    std::vector<std::string> known;
    for (const GraphParam& param : file.params) {
      known.push_back(param.decl.name);
      const GraphNode::Param* written = node.param(param.decl.name);
      if (written == nullptr && !param.alias.empty()) {
        known.push_back(param.alias);
        written = node.param(param.alias);
      }
      if (param.decl.kind == ParamKind::artifact && !param.broken) {
        findings_.error(*scope.file, node.offset,
                        node_is + " " + in_quotes(node.name) + " (" + file.source.file() +
                            ") has the parameter " + in_quotes(param.decl.name) +
                            " of kind artifact, which only the graph that is run has",
                        "give that file an input: \"inputs\": { " + in_quotes(param.decl.name) +
                            ": { \"type\": " + in_quotes(param.decl.type) + " } }");
      }
      if (param.broken || param.decl.kind == ParamKind::artifact) {
        settings_.find(path, param.decl.name);
        params.push_back(std::nullopt);
        continue;
      }
      bool given = false;
      std::optional<Json> value = given_value(scope, written, path, param.decl, given, param.alias);
      if (const MapList* list = given ? nullptr : entry.list_of(param.decl)) {
        value = entry_value(*scope.file, *list, entry.index, findings_);
        given = true;
      }
      if (!given && param.decl.required) {
        findings_.error(*scope.file, node.offset,
                        node_is + " " + in_quotes(node.name) + " (" + file.source.file() +
                            ") needs a value for its parameter " + in_quotes(param.decl.name),
                        param_hint(param.decl, nullptr));
      }
      if (!given && !param.decl.required)
        value = found_files(param.decl, param.decl.default_value, file, param.offset);
      params.push_back(std::move(value));
    }
    refuse_unknown_params(*scope.file, node, file_is + " " + in_quotes(file.source.file()), known);
    return params;
  }

  Scope::Slot add_loop(const GraphFile& body, std::size_t scope_index, std::size_t node_index,
                       const std::string& path, const GraphNode::Loop& written, Params params) {
    const Scope& scope = expansion_.scopes[scope_index];
    const GraphNode& node = scope.file->nodes[node_index];
    const auto loop = std::make_shared<Loop>();
    bool good = read_interface(*scope.file, node, written, body, registry_, *loop, findings_);
    Leaf leaf{path, scope_index, node_index, NodeKind(loop)};
    for (const ParamDecl& param : loop_params()) {
      bool given = false;
      std::optional<Json> value = given_value(scope, written.param(param.name), path, param, given);
      if (!given && !param.required) value = param.default_value;
      good = good && value;
      if (value) leaf.params[param.name] = std::move(*value);
    }
    if (const auto until = leaf.params.find("until"); until != leaf.params.end() && !loop->outputs.empty())
      good = read_until(*scope.file, node, written, settings_.find(path, "until"),
                        until->second.get<std::string>(), registry_, *loop, findings_) &&
             good;
    if (good) {
      loop->max_iterations = leaf.params.at("max_iterations").get<std::int64_t>();
      loop->stop_at_limit = leaf.params.at("at_limit") == "stop";
    }
    const std::size_t outer = std::exchange(loop_, expansion_.loops.size());
    expansion_.loops.push_back({loop, expansion_.scopes.size()});
    instantiate(body, scope_index, node_index, path, std::move(params));
    loop_ = outer;
    if (!good) return {};
    expansion_.leaves.push_back(std::move(leaf));
    return {Scope::Slot::Kind::leaf, expansion_.leaves.size() - 1};
  }

  void report_unused_settings() {
    const std::vector<const PlacedSetting*> unused = settings_.unused();
    if (unused.empty()) return;
    std::vector<std::string> known;
    for (const GraphParam& param : expansion_.scopes[0].file->params) known.push_back(param.decl.name);
    for (const Leaf& leaf : expansion_.leaves) {
      for (const ParamDecl& param : leaf.kind.params()) known.push_back(leaf.path + "." + param.name);
    }
    for (std::size_t i = 1; i < expansion_.scopes.size(); ++i) {
      for (const GraphParam& param : expansion_.scopes[i].file->params) {
        known.push_back(expansion_.scopes[i].path + "." + param.decl.name);
      }
    }
    std::sort(known.begin(), known.end());
    for (const PlacedSetting* setting : unused) {
      const std::string target = setting_target(setting->name);
      const std::string path = target.substr(0, target.rfind('.'));
      const auto covers = [&](const std::string& broken) {
        return path == broken || path.starts_with(broken + "/");
      };
      if (std::any_of(broken_paths_.begin(), broken_paths_.end(), covers))
        continue;  // its node has an error of its own
      const std::string name = path.empty() ? target.substr(1) : target;
      std::string hint = did_you_mean(name, known);
      if (hint.empty())
        hint = known.empty() ? "the graph has no parameters" : "parameters are " + listed(known, 20);
      PlacedSetting about_name = *setting;
      about_name.offset = setting->name_offset;
      findings_.add(
          about_setting(about_name, "the graph has no parameter " + in_quotes(name), std::move(hint)));
    }
  }

  GraphFiles& files_;
  const Registry& registry_;
  Settings settings_;
  Expansion& expansion_;
  Findings& findings_;
  std::vector<std::string> type_names_;
  std::vector<std::string> broken_paths_;
  std::size_t instances_ = 0;
  std::size_t loop_ = nowhere;  // whose body is being instantiated
};

}  // namespace

void expand(const GraphFile& top, GraphFiles& files, const Registry& registry,
            const std::vector<const PlacedSetting*>& settings, Expansion& expansion, Findings& findings) {
  try {
    Expander(files, registry, settings, expansion, findings).run(top);
  } catch (const Abandoned&) {
    expansion.abandoned = true;
  }
}

}  // namespace ballflow
