// Units as files, and back. The grammar is in units.hpp.
#include <charconv>
#include <utility>

#include "ballflow/units.hpp"

namespace ballflow {
namespace {

constexpr int format = 1;

std::string hex_of(std::uint64_t number) {
  char text[17] = {};
  const auto end = std::to_chars(text, text + 16, number, 16).ptr;
  return {text, end};
}

std::uint64_t number_of(const std::string& hex) {
  std::uint64_t number = 0;
  const auto parsed = std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
  if (parsed.ec != std::errc() || parsed.ptr != hex.data() + hex.size())
    throw Error(ExitCode::store, "\"" + hex + "\" is no checksum");
  return number;
}

Digest digest_of(const Json& json) {
  if (const auto digest = Digest::from_hex(json.get<std::string>())) return *digest;
  throw Error(ExitCode::store, "\"" + json.get<std::string>() + "\" is no digest");
}

Json ports_json(const std::vector<PortDecl>& ports) {
  Json json = Json::array();
  for (const PortDecl& port : ports)
    json.push_back(Json::array({port.name, port.type, port.type_version, port.optional, port.list}));
  return json;
}

std::vector<PortDecl> ports_of(const Json& json) {
  std::vector<PortDecl> ports;
  for (const Json& port : json) {
    PortDecl& decl = ports.emplace_back();
    decl.name = port.at(0);
    decl.type = port.at(1);
    decl.type_version = port.at(2);
    decl.optional = port.at(3);
    decl.list = port.at(4);
  }
  return ports;
}

Json edge_json(const EdgeRef& edge, std::size_t nodes) {
  if (edge.node == loop_input) return Json::array({nullptr, edge.port});
  const auto node = static_cast<std::int64_t>(edge.node), count = static_cast<std::int64_t>(nodes);
  return Json::array({node < count ? node : count - node - 1, edge.port});
}

/// `inside`: of how many nodes it may be; `outside`: of how many others.
EdgeRef edge_of(const Json& json, std::size_t inside, std::size_t nodes, std::size_t outside) {
  EdgeRef edge{loop_input, json.at(1)};
  if (json.at(0).is_null()) return edge;
  const std::int64_t node = json.at(0);
  const bool good =
      node >= 0 ? static_cast<std::size_t>(node) < inside : static_cast<std::size_t>(-(node + 1)) < outside;
  if (!good)
    throw Error(ExitCode::store,
                "an edge leads to node " + std::to_string(node) + ", which is not there before");
  edge.node = node >= 0 ? static_cast<std::size_t>(node) : nodes + static_cast<std::size_t>(-(node + 1));
  return edge;
}

Json nodes_json(const std::vector<DagNode>& nodes);
std::vector<DagNode> nodes_of(const Json& json, std::size_t outside, const Registry& registry);

Json loop_json(const Loop& loop) {
  Json conditions = Json::array();
  for (const auto& all : loop.conditions) {
    Json list = Json::array();
    for (const Loop::Comparison& one : all)
      list.push_back(Json::array({one.state, one.field, static_cast<int>(one.op), one.number}));
    conditions.push_back(std::move(list));
  }
  Json states = Json::array();
  for (const DagOutput& output : loop.body.outputs)
    states.push_back(Json::array({output.name, edge_json(output.from, loop.body.nodes.size())}));
  return {{"inputs", ports_json(loop.inputs)},
          {"outputs", ports_json(loop.outputs)},
          {"until", loop.until},
          {"conditions", std::move(conditions)},
          {"max_iterations", loop.max_iterations},
          {"stop_at_limit", loop.stop_at_limit},
          {"uses_seed", loop.uses_seed},
          {"memory", Json::array({loop.memory.fixed, loop.memory.per_input_byte})},
          {"file", loop.body.file},
          {"params", loop.body.params},
          {"body", nodes_json(loop.body.nodes)},
          {"states", std::move(states)}};
}

std::shared_ptr<const Loop> loop_of(const Json& json, const Registry& registry) {
  auto loop = std::make_shared<Loop>();
  loop->inputs = ports_of(json.at("inputs"));
  loop->outputs = ports_of(json.at("outputs"));
  loop->until = json.at("until");
  for (const Json& all : json.at("conditions")) {
    auto& list = loop->conditions.emplace_back();
    for (const Json& one : all) {
      const int op = one.at(2);
      if (op < 0 || op > static_cast<int>(Loop::Comparison::Op::at_least))
        throw Error(ExitCode::store, "a comparison has operator " + std::to_string(op));
      list.push_back({one.at(0), one.at(1), static_cast<Loop::Comparison::Op>(op), one.at(3)});
    }
  }
  loop->max_iterations = json.at("max_iterations");
  loop->stop_at_limit = json.at("stop_at_limit");
  loop->uses_seed = json.at("uses_seed");
  loop->memory = {json.at("memory").at(0), json.at("memory").at(1)};
  loop->body.file = json.at("file");
  for (const auto& [name, value] : json.at("params").items()) loop->body.params[name] = value;
  loop->body.nodes = nodes_of(json.at("body"), 0, registry);
  const std::size_t n = loop->body.nodes.size();
  for (const Json& state : json.at("states"))
    loop->body.outputs.push_back({state.at(0), "", edge_of(state.at(1), n, n, 0)});
  return loop;
}

Json nodes_json(const std::vector<DagNode>& nodes) {
  Json list = Json::array();
  for (const DagNode& node : nodes) {
    Json inputs = Json::object();
    for (const auto& [port, edge] : node.inputs) inputs[port] = edge_json(edge, nodes.size());
    Json json{{"path", node.path},
              {"type", node.kind.type()},
              {"params", node.params},
              {"inputs", std::move(inputs)}};
    if (const Loop* loop = node.kind.loop()) {
      json["loop"] = loop_json(*loop);
    } else {
      json["version"] = node.kind.version();
    }
    list.push_back(std::move(json));
  }
  return list;
}

NodeKind kind_of(const Json& json, const Registry& registry) {
  if (json.contains("loop")) return loop_of(json.at("loop"), registry);
  const std::string type = json.at("type");
  const NodeDeclaration* const declared = registry.node(type);
  if (declared == nullptr) {
    throw Error(ExitCode::plugin, "no node library here has a node " + type,
                "name the library with --plugin, or install the same ballflow on all machines");
  }
  if (const int version = json.at("version"); version != declared->version) {
    throw Error(ExitCode::plugin,
                type + " has behaviour version " + std::to_string(declared->version) + " here and " +
                    std::to_string(version) + " where the unit was written",
                "install the same ballflow on all machines, then submit again");
  }
  return *declared;
}

std::vector<DagNode> nodes_of(const Json& json, std::size_t outside, const Registry& registry) {
  std::vector<DagNode> nodes;
  nodes.reserve(json.size());
  for (const Json& one : json) {
    DagNode node{one.at("path"), kind_of(one, registry)};
    for (const auto& [name, value] : one.at("params").items()) node.params[name] = value;
    for (const ParamDecl& param : node.kind.params()) {
      if (node.params.count(param.name) == 0)
        throw Error(ExitCode::store, "node " + node.path + " has no parameter " + param.name);
    }
    for (const auto& [port, edge] : one.at("inputs").items())
      node.inputs[port] = edge_of(edge, nodes.size(), json.size(), outside);
    nodes.push_back(std::move(node));
  }
  return nodes;
}

Json outside_json(const OutsideNode& node) {
  Json json{{"path", node.path}};
  if (!node.unit.empty()) json["unit"] = node.unit;
  if (node.key) json["key"] = node.key->hex();
  if (const auto& artifact = node.artifact) {
    json["artifact"] = {{"port", artifact->port},
                        {"type", artifact->type},
                        {"version", artifact->type_version},
                        {"digest", artifact->digest.hex()},
                        {"bytes", artifact->bytes},
                        {"checksum", {hex_of(artifact->checksum.low), hex_of(artifact->checksum.high)}},
                        {"summary", artifact->summary}};
  }
  return json;
}

OutsideNode outside_of(const Json& json) {
  OutsideNode node;
  node.path = json.at("path");
  node.unit = json.value("unit", "");
  if (json.contains("key")) node.key = digest_of(json.at("key"));
  if (json.contains("artifact")) {
    const Json& from = json.at("artifact");
    OutputEntry& to = node.artifact.emplace();
    to.port = from.at("port");
    to.type = from.at("type");
    to.type_version = from.at("version");
    to.digest = digest_of(from.at("digest"));
    to.bytes = from.at("bytes");
    to.checksum = {number_of(from.at("checksum").at(0)), number_of(from.at("checksum").at(1))};
    to.summary = from.at("summary");
  }
  return node;
}

}  // namespace

std::string unit_text(const Unit& unit) {
  Json outside = Json::array();
  for (const OutsideNode& node : unit.outside) outside.push_back(outside_json(node));
  const Json json{{"format", format},
                  {"run", unit.run},
                  {"unit", unit.name},
                  {"seed", unit.seed},
                  {"threads", unit.threads},
                  {"seconds", unit.seconds},
                  {"outside", std::move(outside)},
                  {"nodes", nodes_json(unit.nodes)}};
  return json.dump() + '\n';
}

Unit read_unit(const std::string& text, const Registry& registry) {
  try {
    const Json json = Json::parse(text);
    if (json.at("format") != format) {
      throw Error(ExitCode::store,
                  "the unit has format " + json.at("format").dump() + ", this ballflow reads " +
                      std::to_string(format),
                  "install the same ballflow on all machines, then submit again");
    }
    Unit unit;
    unit.run = json.at("run");
    unit.name = json.at("unit");
    unit.seed = json.at("seed");
    unit.threads = json.at("threads");
    unit.seconds = json.at("seconds");
    for (const Json& node : json.at("outside")) unit.outside.push_back(outside_of(node));
    unit.nodes = nodes_of(json.at("nodes"), unit.outside.size(), registry);
    return unit;
  } catch (const Json::exception& error) {
    throw Error(ExitCode::store, std::string("this is no unit: ") + error.what(), "submit the graph again");
  }
}

}  // namespace ballflow
