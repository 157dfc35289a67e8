#include "ballflow/explain.hpp"

#include <algorithm>
#include <set>

#include "base/quote.hpp"

namespace ballflow {
namespace {

/// Where the comparison is: "params.epsilon", with the type of the node that the fields belong to.
struct Field {
  std::string path;
  std::string type;

  Field inner(const std::string& name) const { return {path.empty() ? name : path + "." + name, type}; }
};

/// The rest of `text` behind `start`; nothing when it begins otherwise.
std::optional<std::string> behind(const std::string& text, const std::string& start) {
  if (text.rfind(start, 0) != 0) return std::nullopt;
  return text.substr(start.size());
}

/// The name of a field as people say it.
std::string spoken(const Field& field) {
  if (field.path == "version") return field.type + " version";
  if (field.path == "node") return "node type";
  if (field.path == "format") return "key format";
  if (field.path == "library_file") return "file of the node library";
  if (const auto file = behind(field.path, "files.")) return "file " + *file;
  if (const auto library = behind(field.path, "libraries.")) return "library " + *library;
  const auto port = [](const std::string& kind, const std::string& path) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string::npos) return kind + path;
    const std::string what = path.substr(dot + 1);
    return kind + path.substr(0, dot) + (what == "version" ? ": type version" : ": " + what);
  };
  if (const auto input = behind(field.path, "inputs.")) return port("input ", *input);
  if (const auto input = behind(field.path, "input_types.")) return port("input ", *input);
  if (const auto output = behind(field.path, "output_types.")) return port("output ", *output);
  return field.path;
}

/// Whether a manifest is of a node in Python: those have its version among their libraries.
bool is_python(const Json& manifest) {
  return manifest.contains("libraries") && manifest.at("libraries").contains("Python");
}

void compare(const Field& field, const Json& before, const Json& now, std::vector<std::string>& out) {
  if (before.is_object() && now.is_object()) {
    for (const auto& [name, value] : before.items()) {
      const Field inner = field.inner(name);
      if (inner.path == "library_file" && now.contains(name) && is_python(now)) {
        // Not all of its file: the function and what it names.
        if (value != now.at(name)) out.emplace_back("source of the node: other content");
      } else if (now.contains(name)) {
        compare(inner, value, now.at(name), out);
      } else {
        out.push_back(spoken(inner) + " is gone");
      }
    }
    for (const auto& [name, value] : now.items()) {
      if (before.contains(name)) continue;
      out.push_back(spoken(field.inner(name)) + " is new" +
                    (value.is_structured() ? std::string() : ": " + value.dump()));
    }
    return;
  }
  if (before == now && before.type() == now.type()) return;  // 1 and 1.0 are equal and other keys
  if (field.path == "library_file" || field.path.ends_with(".library_file")) {
    out.push_back(spoken(field) + ": other content");
    return;
  }
  constexpr std::string_view digest = ".digest";
  if (field.path.size() > digest.size() && field.path.ends_with(digest)) {
    Field owner{field.path.substr(0, field.path.size() - digest.size()), field.type};
    if (owner.path.ends_with(".file")) owner.path.resize(owner.path.size() - 5);  // of a parameter
    out.push_back(spoken(owner) + ": other content");
    return;
  }
  const auto shown = [](const Json& value) {
    return value.is_object() ? std::string("a file") : value.dump();  // of a file parameter
  };
  out.push_back(spoken(field) + " " + shown(before) + " -> " + shown(now));
}

Json parsed(const std::string& manifest) { return Json::parse(manifest, nullptr, false); }

std::vector<std::string> differences(const Json& before, const Json& now) {
  std::vector<std::string> out;
  compare({"", now.value("node", std::string())}, before, now, out);
  return out;
}

std::string node_of(const std::string& from) { return from.substr(0, from.rfind('.')); }

/// A manifest without its inputs: what the node itself is.
Json itself(Json manifest) {
  manifest.erase("inputs");
  return manifest;
}

/// The inputs of two manifests, and where those of now come from.
std::vector<Explanation::Input> compare_inputs(const Json& before, const Json& now,
                                               const std::map<std::string, std::string>& from) {
  using State = Explanation::Input::State;
  const Json none = Json::object();
  const Json& old_ports = before.contains("inputs") ? before.at("inputs") : none;
  const Json& ports = now.contains("inputs") ? now.at("inputs") : none;
  std::vector<Explanation::Input> inputs;
  for (const auto& [port, source] : from) {
    Explanation::Input input{port, source, State::same};
    if (!ports.contains(port)) {
      input.state = State::unknown;
    } else if (!old_ports.contains(port)) {
      input.state = State::added;
    } else if (old_ports.at(port) != ports.at(port)) {
      input.state = State::other;
    }
    inputs.push_back(std::move(input));
  }
  for (const auto& [port, entry] : old_ports.items()) {
    if (!from.contains(port)) inputs.push_back({port, "", State::removed});
  }
  return inputs;
}

/// The loop whose body has the node, and its name in the manifest of the loop.
struct BodyPlace {
  std::string loop;
  std::string name;
};

std::optional<BodyPlace> place_in_body(const NodeRecords& records, const std::string& path) {
  for (const auto& [loop, record] : records) {
    const auto found = std::find(record.body.begin(), record.body.end(), path);
    if (found == record.body.end()) continue;
    const Json manifest = parsed(record.manifest);
    if (!manifest.is_object() || !manifest.contains("body")) continue;
    const std::string number = std::to_string(found - record.body.begin()) + ":";
    for (const auto& [name, node] : manifest.at("body").at("nodes").items()) {
      if (name.rfind(number, 0) == 0) return BodyPlace{loop, name};
    }
  }
  return std::nullopt;
}

/// Nodes upstream of `inputs` that changed themselves; through those that did not it goes on.
class Causes {
 public:
  Causes(const NodeRecords& before, const NodeRecords& now) : before_(before), now_(now) {}

  std::vector<Explanation::Cause> find(const std::vector<Explanation::Input>& inputs) {
    std::vector<std::string> level = changed(inputs);
    while (!level.empty()) {
      std::vector<std::string> next;
      for (const std::string& path : level) {
        if (!seen_.insert(path).second) continue;
        for (const std::string& upstream : look_at(path)) next.push_back(upstream);
      }
      level = std::move(next);
    }
    return std::move(causes_);
  }

 private:
  using State = Explanation::Input::State;

  static std::vector<std::string> changed(const std::vector<Explanation::Input>& inputs) {
    std::vector<std::string> paths;
    for (const Explanation::Input& input : inputs) {
      if (input.state == State::other || input.state == State::unknown) paths.push_back(node_of(input.from));
    }
    return paths;
  }

  /// Adds the node to the causes when it is one; what to look at next.
  std::vector<std::string> look_at(const std::string& path) {
    const auto now = now_.find(path);
    if (now == now_.end()) return {};
    const auto before = before_.find(path);
    const Json old_manifest = before == before_.end() ? Json() : parsed(before->second.manifest);
    const Json manifest = parsed(now->second.manifest);
    if (!manifest.is_object()) return {};
    if (!old_manifest.is_object()) {
      causes_.push_back({path, {"is new"}});
      return {};
    }
    std::vector<std::string> own = differences(itself(old_manifest), itself(manifest));
    const std::vector<Explanation::Input> inputs = compare_inputs(old_manifest, manifest, now->second.inputs);
    for (const Explanation::Input& input : inputs) {
      if (input.state == State::added) own.push_back("input " + input.port + " is new");
      if (input.state == State::removed) own.push_back("input " + input.port + " is gone");
      const auto was = before->second.inputs.find(input.port);
      if (input.state == State::other && was != before->second.inputs.end() && was->second != input.from)
        own.push_back("input " + input.port + " comes from " + input.from + " instead of " + was->second);
    }
    const bool waits = std::any_of(inputs.begin(), inputs.end(), [](const Explanation::Input& input) {
      return input.state != State::same;
    });
    // Equal keys and other outputs: the node is not deterministic, or its result is no longer in the cache.
    if (own.empty() && !waits) own.push_back("the same key, but another result, or none in the cache");
    if (!own.empty()) causes_.push_back({path, std::move(own)});
    return changed(inputs);
  }

  const NodeRecords& before_;
  const NodeRecords& now_;
  std::set<std::string> seen_;
  std::vector<Explanation::Cause> causes_;
};

[[noreturn]] void refuse(const NodeRecords& now, const std::string& path) {
  std::vector<std::string> known;
  for (const auto& [name, record] : now) {
    known.push_back(name);
    known.insert(known.end(), record.body.begin(), record.body.end());
  }
  const std::string hint = did_you_mean(path, known);
  throw Error(ExitCode::usage, "there is no node " + in_quotes(path),
              hint.empty() ? "nodes are " + listed(known, 40) : hint);
}

Explanation explain_node(const NodeRecords& before, const NodeRecords& now, const std::string& path) {
  const NodeRecord& record = now.at(path);
  Explanation result;
  result.type = record.type;
  const Json manifest = parsed(record.manifest);
  if (!manifest.is_object()) {
    throw Error(ExitCode::usage, "nothing is known about " + in_quotes(path) + " in this run",
                "no output of the graph needed it, or a node before it failed");
  }
  const auto old_record = before.find(path);
  const Json old_manifest = old_record == before.end() ? Json() : parsed(old_record->second.manifest);
  result.ran_before = old_manifest.is_object();
  if (!result.ran_before) return result;
  result.differences = differences(itself(old_manifest), itself(manifest));
  result.inputs = compare_inputs(old_manifest, manifest, record.inputs);
  result.causes = Causes(before, now).find(result.inputs);
  return result;
}

Explanation explain_in_body(const NodeRecords& before, const NodeRecords& now, const BodyPlace& place,
                            const std::string& path) {
  const auto node_in = [](const NodeRecords& records, const BodyPlace& where) {
    return parsed(records.at(where.loop).manifest).at("body").at("nodes").at(where.name);
  };
  Explanation result;
  result.loop = place.loop;
  const Json manifest = node_in(now, place);
  result.type = manifest.value("node", std::string());
  const std::optional<BodyPlace> old_place = place_in_body(before, path);
  result.ran_before = old_place.has_value();
  if (!result.ran_before) return result;
  const Json old_manifest = node_in(before, *old_place);
  result.differences = differences(itself(old_manifest), itself(manifest));
  // Inside a body there are no digests: an input reads a node of the body or an input of the loop.
  const Explanation loop = explain_node(before, now, place.loop);
  const NodeRecord& record = now.at(place.loop);
  std::vector<Explanation::Input> outside;
  using State = Explanation::Input::State;
  for (const auto& [port, source] : manifest.at("inputs").items()) {
    const std::string text = source.get<std::string>();
    Explanation::Input input{port, "", State::same};
    if (const auto name = behind(text, "inputs.")) {
      const auto of_loop = std::find_if(loop.inputs.begin(), loop.inputs.end(),
                                        [&](const Explanation::Input& i) { return i.port == *name; });
      input.from = place.loop + "." + *name;
      if (of_loop != loop.inputs.end()) {
        input.state = of_loop->state;
        outside.push_back(*of_loop);
      }
    } else {
      const std::size_t number = std::stoul(text.substr(0, text.find(':')));
      input.from = record.body.at(number) + text.substr(text.rfind('.'));
    }
    const Json& old_inputs = old_manifest.at("inputs");
    if (!old_inputs.contains(port)) {
      input.state = State::added;
    } else if (old_inputs.at(port) != source) {
      input.state = State::other;
    }
    result.inputs.push_back(std::move(input));
  }
  for (const auto& [port, source] : old_manifest.at("inputs").items()) {
    if (!manifest.at("inputs").contains(port)) result.inputs.push_back({port, "", State::removed});
  }
  result.causes = Causes(before, now).find(outside);
  return result;
}

}  // namespace

NodeRecords records_of(const Dag& dag, const std::vector<NodePlan>& plans) {
  NodeRecords records;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const DagNode& node = dag.nodes[i];
    NodeRecord& record = records[node.path];
    record.type = node.kind.type();
    record.manifest = plans[i].manifest;
    for (const auto& [port, edge] : node.inputs)
      record.inputs[port] = dag.nodes[edge.node].path + "." + edge.port;
    if (const Loop* loop = node.kind.loop()) {
      for (const DagNode& inner : loop->body.nodes) record.body.push_back(inner.path);
    }
  }
  return records;
}

NodeRecords records_of(const nlohmann::json& report, const Manifests& manifests) {
  NodeRecords records;
  for (const auto& [path, node] : report.at("nodes").items()) {
    NodeRecord& record = records[path];
    record.type = node.value("type", std::string());
    if (const auto manifest = manifests.find(path); manifest != manifests.end())
      record.manifest = manifest->second;
    if (node.contains("inputs")) {
      for (const auto& [port, from] : node.at("inputs").items()) record.inputs[port] = from;
    }
    if (node.contains("body")) record.body = node.at("body").get<std::vector<std::string>>();
  }
  return records;
}

bool Explanation::same() const {
  return ran_before && differences.empty() &&
         std::all_of(inputs.begin(), inputs.end(),
                     [](const Input& input) { return input.state == Input::State::same; });
}

Explanation explain(const NodeRecords& before, const NodeRecords& now, const std::string& path) {
  if (now.contains(path)) return explain_node(before, now, path);
  if (const std::optional<BodyPlace> place = place_in_body(now, path))
    return explain_in_body(before, now, *place, path);
  refuse(now, path);
}

std::vector<std::string> manifest_differences(const std::string& before, const std::string& now) {
  const Json a = parsed(before), b = parsed(now);
  if (!a.is_object() || !b.is_object()) return {"the record of the earlier run cannot be read"};
  return differences(a, b);
}

}  // namespace ballflow
