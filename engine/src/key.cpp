#include "ballflow/key.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <filesystem>

#include "ballflow/run.hpp"

namespace ballflow {
namespace {

constexpr int key_format = 1;

void add_u64(Hasher& hasher, std::uint64_t value) {
  unsigned char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<unsigned char>(value >> (8 * i));
  hasher.add(bytes, sizeof bytes);
}

void add_tag(Hasher& hasher, char tag) { hasher.add(&tag, 1); }

void add_text(Hasher& hasher, std::string_view text) {
  add_u64(hasher, text.size());
  hasher.add(text);
}

// Every value starts with a tag of its kind and every variable-length part with its length, so that no two
// different manifests give the same bytes.
void add_value(Hasher& hasher, const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      add_tag(hasher, 'n');
      break;
    case Json::value_t::boolean:
      add_tag(hasher, value.get<bool>() ? 't' : 'f');
      break;
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      add_tag(hasher, 'i');
      add_u64(hasher, static_cast<std::uint64_t>(value.get<std::int64_t>()));
      break;
    case Json::value_t::number_float:
      add_tag(hasher, 'd');
      add_u64(hasher, std::bit_cast<std::uint64_t>(value.get<double>() + 0.0));  // -0 + 0 = +0
      break;
    case Json::value_t::string:
      add_tag(hasher, 's');
      add_text(hasher, value.get_ref<const std::string&>());
      break;
    case Json::value_t::array:
      add_tag(hasher, 'a');
      add_u64(hasher, value.size());
      for (const Json& item : value) add_value(hasher, item);
      break;
    case Json::value_t::object: {
      std::vector<std::pair<std::string, const Json*>> members;
      for (const auto& [name, item] : value.items()) members.emplace_back(name, &item);
      std::sort(members.begin(), members.end());
      add_tag(hasher, 'o');
      add_u64(hasher, members.size());
      for (const auto& [name, item] : members) {
        add_text(hasher, name);
        add_value(hasher, *item);
      }
      break;
    }
    default:
      throw Error(ExitCode::plugin, "a parameter has a value that JSON does not know");
  }
}

/// "scan.OFF.gz" -> "off.gz": readers choose by it, so it belongs to the key.
std::string file_format(const std::string& path) {
  const std::filesystem::path name = std::filesystem::path(path).filename();
  std::string format = name.extension().string();
  if (format == ".gz" || format == ".GZ") format = name.stem().extension().string() + format;
  std::transform(format.begin(), format.end(), format.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return format.empty() ? format : format.substr(1);
}

Json key_value(const ParamDecl& decl, const Json& value, Store& store) {
  switch (decl.kind) {
    case ParamKind::number:
      return value.get<double>();
    case ParamKind::integer:
      return value.get<std::int64_t>();
    case ParamKind::file: {
      const auto& text = value.get_ref<const std::string&>();
      for (const std::string& scheme : decl.schemes) {
        if (text.rfind(scheme, 0) == 0) return text;
      }
      return Json{{"file", {{"digest", store.file_digest(text).hex()}, {"format", file_format(text)}}}};
    }
    default:
      return value;
  }
}

void compare(const std::string& path, const Json& before, const Json& now, std::vector<std::string>& out) {
  if (before == now) return;
  if (before.is_object() && now.is_object()) {
    for (const auto& [name, value] : before.items()) {
      const std::string inner = path.empty() ? name : path + "." + name;
      if (now.contains(name)) {
        compare(inner, value, now.at(name), out);
      } else {
        out.push_back(inner + " is gone");
      }
    }
    for (const auto& [name, value] : now.items()) {
      if (!before.contains(name))
        out.push_back((path.empty() ? name : path + "." + name) + " is new: " + value.dump());
    }
    return;
  }
  if (path.size() > 7 && path.substr(path.size() - 7) == ".digest") {
    const std::string owner = path.substr(0, path.size() - 7);
    if (owner.rfind("inputs.", 0) == 0) {
      out.push_back("input " + owner.substr(7) + ": other content");
    } else {
      out.push_back(owner + ": other content");
    }
    return;
  }
  out.push_back(path + " " + before.dump() + " -> " + now.dump());
}

Json body_manifest(const Dag& body, Store& store);

/// What a node does, without its inputs.
Json node_manifest(const DagNode& node, Store& store) {
  const NodeDeclaration& decl = *node.decl;
  Json manifest = {{"node", decl.id}, {"version", decl.version}};
  manifest["libraries"] = Json::object();
  for (const auto& [name, version] : decl.libraries) manifest["libraries"][name] = version;
  Json params = Json::object();
  for (const ParamDecl& param : decl.params) {
    if (param.hashed) params[param.name] = key_value(param, node.params.at(param.name), store);
  }
  manifest["params"] = std::move(params);
  if (node.loop) manifest["body"] = body_manifest(node.loop->body, store);
  return manifest;
}

/// The nodes of a loop body by position and type, because names are in no key, and how they are connected.
Json body_manifest(const Dag& body, Store& store) {
  const auto name = [&](std::size_t i) { return std::to_string(i) + ":" + body.nodes[i].decl->id; };
  const auto source = [&](const EdgeRef& edge) {
    return (edge.node == loop_input ? "inputs" : name(edge.node)) + "." + edge.port;
  };
  Json nodes = Json::object(), states = Json::object();
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    Json one = node_manifest(body.nodes[i], store);
    one["inputs"] = Json::object();
    for (const auto& [port, edge] : body.nodes[i].inputs) one["inputs"][port] = source(edge);
    nodes.get_ref<Json::object_t&>().emplace_back(name(i), std::move(one));  // names are unique
  }
  for (const DagOutput& output : body.outputs) states[output.name] = source(output.from);
  return {{"nodes", std::move(nodes)}, {"states", std::move(states)}};
}

}  // namespace

ActionKey action_key(const DagNode& node, const std::map<std::string, OutputEntry>& inputs,
                     std::uint64_t seed, Store& store) {
  Json manifest = {{"format", key_format}};
  manifest.update(node_manifest(node, store));
  manifest["seed"] = node.decl->uses_seed ? Json(seed) : Json(nullptr);
  Json ports = Json::object();
  for (const auto& [port, entry] : inputs) {
    ports[port] = {{"type", entry.type}, {"version", entry.type_version}, {"digest", entry.digest.hex()}};
  }
  manifest["inputs"] = std::move(ports);

  Hasher hasher;
  add_value(hasher, manifest);
  return {hasher.finish(), manifest.dump()};
}

std::vector<std::string> manifest_differences(const std::string& before, const std::string& now) {
  std::vector<std::string> out;
  const Json a = Json::parse(before, nullptr, false);
  const Json b = Json::parse(now, nullptr, false);
  if (a.is_discarded() || b.is_discarded()) return {"the record of the earlier run cannot be read"};
  compare("", a, b, out);
  return out;
}

}  // namespace ballflow
