#include "document/expand.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <utility>

#include "base/quote.hpp"
#include "document/until.hpp"
#include "plugin/param_value.hpp"

namespace ballflow {

namespace fs = std::filesystem;

namespace {

/// Thrown when a limit is reached; its finding was added.
struct Abandoned {};

std::string canonical(const std::string& path) {
  std::error_code error;
  const fs::path result = fs::weakly_canonical(path, error);
  return error ? path : result.string();
}

/// Settings by "path.param" (".param" at the top), with a note which of them found their parameter.
class Settings {
 public:
  explicit Settings(const std::vector<const Setting*>& settings)
      : all_(settings), used_(settings.size(), false) {
    for (std::size_t i = 0; i < all_.size(); ++i) by_name_[setting_target(all_[i]->name)].push_back(i);
  }

  /// The setting of a parameter, if there is one; the last wins.
  const Setting* find(const std::string& path, const std::string& param) {
    if (all_.empty()) return nullptr;
    const auto found = by_name_.find(path + "." + param);
    if (found == by_name_.end()) return nullptr;
    for (const std::size_t i : found->second) used_[i] = true;
    return all_[found->second.back()];
  }

  std::vector<const Setting*> unused() const {
    std::vector<const Setting*> result;
    for (std::size_t i = 0; i < all_.size(); ++i) {
      if (!used_[i]) result.push_back(all_[i]);
    }
    return result;
  }

 private:
  const std::vector<const Setting*>& all_;
  std::map<std::string, std::vector<std::size_t>> by_name_;
  std::vector<bool> used_;
};

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
  Expander(GraphFiles& files, const Registry& registry, const std::vector<const Setting*>& settings,
           Expansion& expansion, Findings& findings)
      : files_(files), registry_(registry), settings_(settings), expansion_(expansion), findings_(findings) {
    for (const auto& [id, node] : registry.nodes()) type_names_.push_back(id);
  }

  void run(const GraphFile& file) {
    chain_.push_back({canonical(file.source.file()), file.source.file()});
    std::vector<std::optional<Json>> params;
    for (const GraphParam& param : file.params) {
      if (param.decl.kind == ParamKind::artifact) {  // find_given looks for its value
        settings_.find("", param.decl.name);
        params.emplace_back(nullptr);
        continue;
      }
      if (const Setting* setting = settings_.find("", param.decl.name)) {
        params.push_back(param.broken ? std::nullopt : value_of(*setting, param.decl));
      } else if (param.broken) {
        params.push_back(std::nullopt);
      } else if (param.decl.required) {
        findings_.error(file, param.offset, "parameter " + in_quotes(param.decl.name) + " has no value",
                        "give it one: --set " + param.decl.name + "=<" + kind_name(param.decl.kind) + ">");
        params.push_back(std::nullopt);
      } else {
        params.push_back(param.decl.default_value);
      }
    }
    instantiate(file, nowhere, nowhere, "", std::move(params));
    report_unused_settings();
  }

 private:
  struct ChainLink {
    std::string key, name;
  };

  std::optional<Json> value_of(const Setting& setting, const ParamDecl& param) {
    Json value;
    if (setting.value) {
      value = *setting.value;
    } else if (!is_utf8(setting.text)) {
      findings_.add(about_setting(setting, in_quotes(param.name) + " must be UTF-8",
                                  "rename the file, or set a link to it with a name in UTF-8"));
      return std::nullopt;
    } else if (!from_text(param, setting.text, value)) {
      const char* wanted = param.kind == ParamKind::boolean   ? "true or false"
                           : param.kind == ParamKind::integer ? "a whole number of 64 bits"
                                                              : "a finite number";
      findings_.add(about_setting(
          setting, in_quotes(param.name) + " must be " + wanted + ", is " + in_quotes(setting.text),
          param_hint(param, value)));
      return std::nullopt;
    }
    if (std::string why = param.refuse(value); !why.empty()) {
      findings_.add(about_setting(setting, in_quotes(param.name) + " " + why, param_hint(param, value)));
      return std::nullopt;
    }
    return normalised(param, value);
  }

  /// The value written for `param` at a node, or from a setting. Nothing when absent or wrong.
  std::optional<Json> given_value(const Scope& scope, const GraphNode::Param* written,
                                  const std::string& path, const ParamDecl& param, bool& given) {
    given = true;
    if (const Setting* setting = settings_.find(path, param.name)) return value_of(*setting, param);
    given = written != nullptr;
    if (!given) return std::nullopt;
    const std::optional<Json> value = written->value.evaluate(scope.params);
    if (!value) return std::nullopt;
    if (std::string why = param.refuse(*value); !why.empty()) {
      findings_.error(*scope.file, written->value.offset, in_quotes(param.name) + " " + why,
                      param_hint(param, *value));
      return std::nullopt;
    }
    return normalised(param, *value);
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
                          const std::string& path, std::vector<std::optional<Json>> params) {
    const std::size_t index = expansion_.scopes.size();
    Scope& scope = expansion_.scopes.emplace_back();
    scope.file = &file;
    scope.parent = parent;
    scope.parent_node = parent_node;
    scope.loop = loop_;
    scope.path = path;
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
    const Included included = include(scope, subgraph.file, "\"graph\"");
    if (included.file == nullptr) return {};
    Params params = params_of(*included.file, scope, node_index, path, "subgraph", "subgraph");
    chain_.push_back({included.key, included.file->source.file()});
    const std::size_t inner = instantiate(*included.file, scope_index, node_index, path, std::move(params));
    chain_.pop_back();
    return {Scope::Slot::Kind::scope, inner};
  }

  /// A loop is one node for what is around it; its body is a scope that nothing outside sees.
  Scope::Slot add(std::size_t scope_index, std::size_t node_index, const std::string& path,
                  const GraphNode::Loop& written) {
    const Scope& scope = expansion_.scopes[scope_index];
    const Included included = include(scope, written.body, "\"loop\"");
    if (included.file == nullptr) return {};
    Params params = params_of(*included.file, scope, node_index, path, "loop", "loop body");
    chain_.push_back({included.key, included.file->source.file()});
    const Scope::Slot slot =
        add_loop(*included.file, scope_index, node_index, path, written, std::move(params));
    chain_.pop_back();
    return slot;
  }

  /// A node that has no kind was reported.
  Scope::Slot add(std::size_t, std::size_t, const std::string&, const std::monostate&) { return {}; }

  struct Included {
    const GraphFile* file = nullptr;  // null when it cannot be used
    std::string key;
  };
  using Params = std::vector<std::optional<Json>>;

  /// The file of a subgraph or of the body of a loop.
  Included include(const Scope& scope, const Template& path, const char* field) {
    Included included;
    const std::optional<Json> name = path.evaluate(scope.params);
    if (!name) return included;
    if (name->is_string()) {
      included.file = load(*scope.file, path.offset, name->get<std::string>(), included.key);
    } else {
      findings_.error(*scope.file, path.offset,
                      field + std::string(" must be the path of a file, ") + described(*name));
    }
    return included;
  }

  /// The parameters of a file that a node includes.
  Params params_of(const GraphFile& file, const Scope& scope, std::size_t node_index, const std::string& path,
                   const std::string& node_is, const std::string& file_is) {
    const GraphNode& node = scope.file->nodes[node_index];
    Params params;
    std::vector<std::string> known;
    for (const GraphParam& param : file.params) {
      known.push_back(param.decl.name);
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
      std::optional<Json> value = given_value(scope, node.param(param.decl.name), path, param.decl, given);
      if (!given && param.decl.required) {
        findings_.error(*scope.file, node.offset,
                        node_is + " " + in_quotes(node.name) + " (" + file.source.file() +
                            ") needs a value for its parameter " + in_quotes(param.decl.name),
                        param_hint(param.decl, nullptr));
      }
      if (!given && !param.decl.required) value = param.decl.default_value;
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
    bool good = read_interface(*scope.file, node, written, body, *loop);
    Leaf leaf{path, scope_index, node_index, NodeKind(loop)};
    for (const ParamDecl& param : loop_params()) {
      bool given = false;
      std::optional<Json> value = given_value(scope, written.param(param.name), path, param, given);
      if (!given && !param.required) value = param.default_value;
      good = good && value;
      if (value) leaf.params[param.name] = std::move(*value);
    }
    if (const auto until = leaf.params.find("until"); until != leaf.params.end() && !loop->outputs.empty())
      good = read_until(scope, node, written, path, until->second.get<std::string>(), *loop) && good;
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

  /// The ports of a loop are those of its body.
  bool read_interface(const GraphFile& file, const GraphNode& node, const GraphNode::Loop& written,
                      const GraphFile& body, Loop& loop) {
    const std::string owner = "loop " + in_quotes(node.name);
    bool good = true;
    for (const GraphParam& param : body.params) {
      for (const ParamDecl& own : loop_params()) {
        if (param.decl.name != own.name) continue;
        findings_.error(body, param.offset,
                        "the body of " + owner + " cannot have a parameter " + in_quotes(param.decl.name),
                        "every loop has a parameter of that name; choose another one");
        good = false;
      }
    }
    const auto port = [&](const GraphInput& input) {
      PortDecl decl;
      decl.name = input.name;
      decl.type = input.type;
      const TypeDeclaration* type = registry_.type(input.type);
      decl.type_version = type == nullptr ? 0 : type->version;
      decl.optional = input.optional;
      return decl;
    };
    for (const GraphInput& input : body.inputs) {
      good = good && !input.broken;
      loop.inputs.push_back(port(input));
    }
    if (body.outputs.empty()) {
      findings_.error(file, written.body.offset,
                      owner + " has no state: " + printable(body.source.file()) + " has no \"outputs\"",
                      "a loop passes its outputs to its inputs of the same names");
      good = false;
    }
    for (const GraphOutput& output : body.outputs) {
      const auto input = body.input_index.find(output.name);
      if (input == body.input_index.end()) {
        findings_.error(body, output.offset,
                        "output " + in_quotes(output.name) + " is a state of " + owner +
                            ", but there is no input of that name",
                        "a loop passes its outputs to its inputs: declare " + in_quotes(output.name) +
                            " under \"inputs\" with the type of the output");
        good = false;
        continue;
      }
      const GraphInput& state = body.inputs[input->second];
      if (state.optional && !state.broken) {
        findings_.error(
            body, state.offset,
            "input " + in_quotes(state.name) + " is a state of " + owner + " and cannot be optional");
        good = false;
      }
      loop.outputs.push_back(port(state));
      loop.outputs.back().optional = false;
    }
    return good;
  }

  bool read_until(const Scope& scope, const GraphNode& node, const GraphNode::Loop& written,
                  const std::string& path, const std::string& text, Loop& loop) {
    std::vector<UntilProblem> problems;
    loop.until = text;
    loop.conditions = parse_until(
        text, problems, [&](const Loop::Comparison& comparison, std::size_t state_at, std::size_t field_at) {
          std::vector<std::string> known;
          const auto state =
              std::find_if(loop.outputs.begin(), loop.outputs.end(),
                           [&](const PortDecl& port) { return port.name == comparison.state; });
          if (state == loop.outputs.end()) {
            for (const PortDecl& port : loop.outputs) known.push_back(port.name);
            const std::string hint = did_you_mean(comparison.state, known);
            problems.push_back(
                {state_at, "loop " + in_quotes(node.name) + " has no state " + in_quotes(comparison.state),
                 hint.empty() ? "states are " + listed(known) : hint});
            return;
          }
          const TypeDeclaration* const type = registry_.type(state->type);
          if (type == nullptr) return;  // reported where the body declares it
          for (const auto& [field, doc] : type->summary) known.push_back(field);
          if (std::find(known.begin(), known.end(), comparison.field) != known.end()) return;
          const std::string hint = did_you_mean(comparison.field, known);
          problems.push_back({field_at,
                              "the summary of a " + type->id + " has no field " + in_quotes(comparison.field),
                              !hint.empty()   ? hint
                              : known.empty() ? "it has no fields"
                                              : "fields are " + listed(known)});
        });
    for (UntilProblem& problem : problems) {
      problem.message = "\"until\": " + problem.message;
      if (const Setting* setting = settings_.find(path, "until")) {
        findings_.add(about_setting(*setting, std::move(problem.message), std::move(problem.hint)));
        continue;
      }
      // Inside the text when it stands in the file as it is, without escapes and parameters.
      const std::size_t begin = written.param("until")->value.offset;
      const bool verbatim = scope.file->source.content().substr(begin + 1, text.size()) == text &&
                            scope.file->source.content().substr(begin + 1 + text.size(), 1) == "\"";
      findings_.error(*scope.file, static_cast<Offset>(verbatim ? begin + 1 + problem.at : begin),
                      std::move(problem.message), std::move(problem.hint));
    }
    return problems.empty();
  }

  /// The file that `includer` names, read at most once; null when it cannot be used.
  const GraphFile* load(const GraphFile& includer, Offset offset, const std::string& name, std::string& key) {
    const fs::path path = (fs::path(includer.source.file()).parent_path() / name).lexically_normal();
    const auto [memo, fresh] = files_.canonical.try_emplace(path.string());
    if (fresh) memo->second = canonical(path.string());
    key = memo->second;
    std::string cycle;
    bool found_self = false;
    for (const ChainLink& link : chain_) {
      found_self = found_self || link.key == key;
      if (found_self) cycle += link.name + " -> ";
    }
    if (found_self) {
      findings_.error(includer, offset, "the graph includes itself: " + printable(cycle + path.string()),
                      "subgraphs cannot be recursive");
      return nullptr;
    }
    if (chain_.size() >= max_subgraph_depth) {
      findings_.error(includer, offset,
                      "subgraphs are nested deeper than " + std::to_string(max_subgraph_depth) + " levels");
      return nullptr;
    }
    if (const auto known = files_.by_path.find(key); known != files_.by_path.end())
      return known->second.get();
    std::error_code error;
    if (name.find('\0') != std::string::npos || !fs::is_regular_file(path, error)) {
      findings_.error(includer, offset, "no subgraph file " + in_quotes(path.string()), neighbours(path));
      return nullptr;
    }
    std::string text;
    try {
      text = read_text_file(path.string());
    } catch (const Error& problem) {
      findings_.error(includer, offset, problem.what(), problem.hint());
      return nullptr;
    }
    files_.names.push_back(path.string());
    std::unique_ptr<GraphFile> file =
        read_graph_file(json_text::Source(path.string(), std::move(text)), files_.findings);
    if (file != nullptr && (file->sweep || !file->maps.empty())) {
      const Offset section = file->sweep ? file->sweep->offset : file->maps.front().offset;
      files_.findings.warning(*file, section, "the sweep of a subgraph is not run",
                              "only the top graph's counts; sweep over its parameters there");
    }
    return (files_.by_path[key] = std::move(file)).get();
  }

  /// Which graph files there are where one was looked for.
  static std::string neighbours(const fs::path& path) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(path.parent_path().empty() ? fs::path(".") : path.parent_path(), error),
         end;
         !error && entry != end && names.size() < 1000; entry.increment(error)) {
      if (entry->path().extension() == ".json") names.push_back(entry->path().filename().string());
    }
    const std::string folder = path.parent_path().empty() ? "." : printable(path.parent_path().string());
    if (error) return "there is no folder " + in_quotes(folder);
    if (names.empty()) return "folder " + in_quotes(folder) + " has no *.json files";
    std::sort(names.begin(), names.end());
    const std::string near = did_you_mean(path.filename().string(), names);
    return near + (near.empty() ? "" : " ") + "folder " + in_quotes(folder) + " has " + listed(names);
  }

  void report_unused_settings() {
    const std::vector<const Setting*> unused = settings_.unused();
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
    for (const Setting* setting : unused) {
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
      Setting about_name = *setting;
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
  std::vector<ChainLink> chain_;
  std::vector<std::string> broken_paths_;
  std::size_t instances_ = 0;
  std::size_t loop_ = nowhere;  // whose body is being instantiated
};

}  // namespace

const std::vector<ParamDecl>& loop_params() {
  static const std::vector<ParamDecl> params = [] {
    ParamDecl until, most, at_limit;
    until.name = "until";
    until.doc =
        "ends the loop, looked at before every iteration: fields of the summaries of states compared with "
        "numbers, joined by \"and\" and \"or\", like \"cover.remaining == 0\"";
    until.required = true;
    most.name = "max_iterations";
    most.doc = "how often the body runs at most";
    most.kind = ParamKind::integer;
    most.default_value = std::int64_t{10'000};
    most.minimum = 1;
    most.maximum = 1'000'000'000;
    at_limit.name = "at_limit";
    at_limit.doc = "what to do when max_iterations have run";
    at_limit.kind = ParamKind::choice;
    at_limit.default_value = "error";
    at_limit.choices = {{"error", "fail"}, {"stop", "go on with the state reached, and warn"}};
    return std::vector<ParamDecl>{until, most, at_limit};
  }();
  return params;
}

std::string setting_target(const std::string& name) {
  std::string path = name;
  std::replace(path.begin(), path.end(), '.', '/');
  const std::size_t last = path.rfind('/');
  return last == std::string::npos ? "." + path : path.substr(0, last) + "." + path.substr(last + 1);
}

Diagnostic about_setting(const Setting& setting, std::string message, std::string hint) {
  if (setting.file != nullptr) {
    return json_text::finding(setting.file->source, setting.file->root, setting.offset, std::move(message),
                              std::move(hint));
  }
  Diagnostic found;
  found.file = printable(setting.origin);
  found.message = std::move(message);
  found.hint = std::move(hint);
  return found;
}

void expand(const GraphFile& top, GraphFiles& files, const Registry& registry,
            const std::vector<const Setting*>& settings, Expansion& expansion, Findings& findings) {
  try {
    Expander(files, registry, settings, expansion, findings).run(top);
  } catch (const Abandoned&) {
    expansion.abandoned = true;
  }
}

std::string read_text_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::error_code error;
  if (!in || fs::is_directory(path, error)) {
    const std::string why = fs::exists(path, error)
                                ? (fs::is_directory(path, error) ? "it is a folder" : "access denied")
                                : "there is no such file";
    throw Error(ExitCode::usage, "cannot read " + in_quotes(path) + ": " + why);
  }
  std::string text;
  constexpr std::size_t block = std::size_t{1} << 16;
  while (in && text.size() <= json_text::max_size) {
    const std::size_t size = text.size();
    text.resize(size + block);
    in.read(text.data() + size, static_cast<std::streamsize>(block));
    text.resize(size + static_cast<std::size_t>(in.gcount()));
  }
  return text;
}

}  // namespace ballflow
