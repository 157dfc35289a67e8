#include "ballflow/key.hpp"

#include <algorithm>
#include <bit>

#include "base/canonical_json.hpp"
#include "run/named_files.hpp"

namespace ballflow {
namespace {

constexpr int key_format = 2;  // 2: summaries have the numbers of RFC 8785

void add_u64(std::string& bytes, std::uint64_t value) {
  char little_endian[8];
  for (int i = 0; i < 8; ++i) little_endian[i] = static_cast<char>(value >> (8 * i) & 0xff);
  bytes.append(little_endian, sizeof little_endian);
}

void add_tag(std::string& bytes, char tag) { bytes += tag; }

void add_text(std::string& bytes, std::string_view text) {
  add_u64(bytes, text.size());
  bytes += text;
}

// Every value starts with a tag of its kind and every variable-length part with its length, so that no two
// different manifests give the same bytes.
void add_value(std::string& bytes, const Json& value) {
  switch (value.type()) {
    case Json::value_t::null:
      add_tag(bytes, 'n');
      break;
    case Json::value_t::boolean:
      add_tag(bytes, value.get<bool>() ? 't' : 'f');
      break;
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      add_tag(bytes, 'i');
      add_u64(bytes, static_cast<std::uint64_t>(value.get<std::int64_t>()));
      break;
    case Json::value_t::number_float:
      add_tag(bytes, 'd');
      add_u64(bytes, std::bit_cast<std::uint64_t>(value.get<double>() + 0.0));  // -0 + 0 = +0
      break;
    case Json::value_t::string:
      add_tag(bytes, 's');
      add_text(bytes, value.get_ref<const std::string&>());
      break;
    case Json::value_t::array:
      add_tag(bytes, 'a');
      add_u64(bytes, value.size());
      for (const Json& item : value) add_value(bytes, item);
      break;
    case Json::value_t::object: {
      std::vector<std::pair<std::string, const Json*>> members;
      for (const auto& [name, item] : value.items()) members.emplace_back(name, &item);
      std::sort(members.begin(), members.end());
      add_tag(bytes, 'o');
      add_u64(bytes, members.size());
      for (const auto& [name, item] : members) {
        add_text(bytes, name);
        add_value(bytes, *item);
      }
      break;
    }
    default:
      throw Error(ExitCode::plugin, "a parameter has a value that JSON does not know");
  }
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

/// SHA-256 of the file of the node's library where that is part of the key, else empty.
const std::string& library_file(const NodeKind& kind) {
  static const std::string none;
  const NodeDeclaration* decl = kind.declared();
  return decl == nullptr ? none : decl->library_file;
}

Json body_manifest(const Dag& body, Store& store);

/// What a node does, without its inputs.
Json node_manifest(const DagNode& node, Store& store) {
  Json manifest = {{"node", node.kind.type()}, {"version", node.kind.version()}};
  manifest["libraries"] = Json::object();
  for (const auto& [name, version] : node.kind.libraries()) manifest["libraries"][name] = version;
  Json params = Json::object();
  for (const ParamDecl& param : node.kind.params()) {
    if (param.hashed) params[param.name] = key_value(param, node.params.at(param.name), store);
  }
  manifest["params"] = std::move(params);
  if (Json files = named_files_manifest(node, store); files.is_object()) manifest["files"] = std::move(files);
  if (const std::string& file = library_file(node.kind); !file.empty()) manifest["library_file"] = file;
  if (const Loop* loop = node.kind.loop()) manifest["body"] = body_manifest(loop->body, store);
  return manifest;
}

/// Types and versions of ports. Outside of loops they come with the inputs; inside a body no artifact is
/// looked at.
Json port_types(const std::vector<PortDecl>& ports) {
  Json types = Json::object();
  for (const PortDecl& port : ports) types[port.name] = {{"type", port.type}, {"version", port.type_version}};
  return types;
}

/// The nodes of a loop body by position and type, because names are in no key, and how they are connected.
Json body_manifest(const Dag& body, Store& store) {
  const auto name = [&](std::size_t i) { return std::to_string(i) + ":" + body.nodes[i].kind.type(); };
  const auto source = [&](const EdgeRef& edge) {
    return (edge.node == loop_input ? "inputs" : name(edge.node)) + "." + edge.port;
  };
  Json nodes = Json::object(), states = Json::object();
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    Json one = node_manifest(body.nodes[i], store);
    one["inputs"] = Json::object();
    for (const auto& [port, edge] : body.nodes[i].inputs) one["inputs"][port] = source(edge);
    one["input_types"] = port_types(body.nodes[i].kind.inputs());
    one["output_types"] = port_types(body.nodes[i].kind.outputs());
    nodes.get_ref<Json::object_t&>().emplace_back(name(i), std::move(one));  // names are unique
  }
  for (const DagOutput& output : body.outputs) states[output.name] = source(output.from);
  return {{"nodes", std::move(nodes)}, {"states", std::move(states)}};
}

}  // namespace

/// Writes a manifest and the bytes that are hashed for it at once, because a Json object of it would cost
/// more than everything else that the engine does for a node. The manifest has its members in the order in
/// which they are easiest to read, the bytes have them sorted.
ActionKey action_key(const DagNode& node, const std::map<std::string, OutputEntry>& inputs,
                     std::uint64_t seed, Store& store) {
  const NodeKind& kind = node.kind;
  std::vector<std::pair<std::string_view, Json>> params;
  for (const ParamDecl& param : kind.params()) {
    if (param.hashed) params.emplace_back(param.name, key_value(param, node.params.at(param.name), store));
  }
  const Loop* const loop = kind.loop();
  const Json files = named_files_manifest(node, store);
  const Json body = loop != nullptr ? body_manifest(loop->body, store) : Json();

  std::string text;
  text.reserve(512);
  const auto add_member = [&text](std::string_view name) {
    if (text.back() != '{') text += ',';
    write_string(name, text);
    text += ':';
  };
  text += '{';
  add_member("format");
  write_number(key_format, text);
  add_member("node");
  write_string(kind.type(), text);
  add_member("version");
  write_number(kind.version(), text);
  add_member("libraries");
  text += '{';
  for (const auto& [name, version] : kind.libraries()) {
    add_member(name);
    write_string(version, text);
  }
  text += '}';
  const std::string& file = library_file(kind);
  if (!file.empty()) {
    add_member("library_file");
    write_string(file, text);
  }
  add_member("params");
  text += '{';
  for (const auto& [name, value] : params) {
    add_member(name);
    write_value(value, text);
  }
  text += '}';
  if (loop != nullptr) {
    add_member("body");
    text += body.dump();
  }
  if (files.is_object()) {
    add_member("files");
    text += files.dump();
  }
  add_member("seed");
  if (kind.uses_seed()) {
    write_number(seed, text);
  } else {
    text += "null";
  }
  add_member("inputs");
  text += '{';
  for (const auto& [port, entry] : inputs) {
    add_member(port);
    text += '{';
    add_member("type");
    write_string(entry.type, text);
    add_member("version");
    write_number(entry.type_version, text);
    add_member("digest");
    text += '"';
    text += entry.digest.hex();
    text += "\"}";
  }
  text += "}}";

  std::string bytes;
  bytes.reserve(512);
  const auto add_string = [&bytes](std::string_view value) {
    add_tag(bytes, 's');
    add_text(bytes, value);
  };
  const auto add_integer = [&bytes](std::uint64_t value) {
    add_tag(bytes, 'i');
    add_u64(bytes, value);
  };
  const auto add_object = [&bytes](std::size_t members) {
    add_tag(bytes, 'o');
    add_u64(bytes, members);
  };
  add_object(7 + (loop != nullptr ? 1 : 0) + (file.empty() ? 0 : 1) + (files.is_object() ? 1 : 0));
  if (loop != nullptr) {
    add_text(bytes, "body");
    add_value(bytes, body);
  }
  if (files.is_object()) {
    add_text(bytes, "files");
    add_value(bytes, files);
  }
  add_text(bytes, "format");
  add_integer(key_format);
  add_text(bytes, "inputs");
  add_object(inputs.size());
  for (const auto& [port, entry] : inputs) {
    add_text(bytes, port);
    add_object(3);
    add_text(bytes, "digest");
    add_string(entry.digest.hex());
    add_text(bytes, "type");
    add_string(entry.type);
    add_text(bytes, "version");
    add_integer(static_cast<std::uint64_t>(entry.type_version));
  }
  add_text(bytes, "libraries");
  add_object(kind.libraries().size());
  for (const auto& [name, version] : kind.libraries()) {
    add_text(bytes, name);
    add_string(version);
  }
  if (!file.empty()) {
    add_text(bytes, "library_file");
    add_string(file);
  }
  add_text(bytes, "node");
  add_string(kind.type());
  add_text(bytes, "params");
  add_object(params.size());
  std::sort(params.begin(), params.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [name, value] : params) {
    add_text(bytes, name);
    add_value(bytes, value);
  }
  add_text(bytes, "seed");
  if (kind.uses_seed()) {
    add_integer(seed);
  } else {
    add_tag(bytes, 'n');
  }
  add_text(bytes, "version");
  add_integer(static_cast<std::uint64_t>(kind.version()));
  return {sha256(bytes), std::move(text)};
}

Digest key_of(const std::string& manifest) {
  const Json json = Json::parse(manifest, nullptr, false);
  if (!json.is_object()) throw Error(ExitCode::store, "a key manifest cannot be read");
  std::string bytes;
  add_value(bytes, json);
  return sha256(bytes);
}

}  // namespace ballflow
