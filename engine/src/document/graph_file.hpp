// A graph file as plain data: names resolved inside the file, places kept, nothing expanded.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>
#include <vector>

#include "ballflow/node_decl.hpp"
#include "base/json_text.hpp"

namespace ballflow {

using Offset = std::uint32_t;  // into the text of the file

/// A value with "${name}" in it: parts of text and parameters in turn.
struct Template {
  struct Part {
    std::string text;
    std::optional<std::size_t> param;  // index into GraphFile::params
  };
  Offset offset = 0;
  bool broken = false;        // already reported
  std::optional<Json> fixed;  // a value without parameters
  std::vector<Part> parts;    // otherwise

  /// The value for given parameters; nothing when it is broken or a parameter has none.
  std::optional<Json> evaluate(const std::vector<std::optional<Json>>& params) const;
};

/// What a consumer names: "node.port" or "inputs.name".
struct Reference {
  enum class Kind { broken, node, input };
  Kind kind = Kind::broken;
  std::size_t index = 0;  // into GraphFile::nodes or GraphFile::inputs
  std::string port;
  Offset offset = 0;
};

struct GraphParam {
  ParamDecl decl;
  std::string alias;  // a former name that still sets it; may be empty
  Offset offset = 0;
  bool broken = false;
  bool used = false;
};

struct GraphInput {
  std::string name, type;
  bool optional = false;
  Offset offset = 0, type_offset = 0;
  bool broken = false;  // its type is unknown
  bool used = false;
  std::optional<std::size_t> param;  // index into GraphFile::params where it is a parameter of kind artifact
};

struct GraphNode {
  struct Input {
    std::string port;
    Offset offset = 0;
    Reference from;
    std::optional<std::size_t> index;  // in a list of edges; those of one port stand together, in order
  };
  struct Param {
    std::string name;
    Offset offset = 0;
    Template value;
  };
  struct Declared {  // by a library
    std::string type;
    Offset offset = 0;
  };
  struct Subgraph {
    Template file;
  };
  struct Loop {
    Template body;              // a file
    std::vector<Param> params;  // its own, by name: at_limit, max_iterations, until

    const Param* param(const std::string& name) const;
  };
  struct Map {
    Template body;                 // a file
    std::vector<Param> over = {};  // parameters of the body, each with a list; the first one names the copies
    std::string index = {};        // the parameter of the body that gets the place in the lists; empty: none
    Offset index_offset = 0;
  };
  std::string name;
  Offset offset = 0;
  std::variant<std::monostate, Declared, Subgraph, Loop, Map> kind;  // nothing when it is broken
  std::vector<Input> inputs;                                         // by port
  std::vector<Param> params;  // by name; of a loop or map those of its body
  bool broken = false;
  bool used = false;

  /// The first one of the port; null when there is none.
  const Input* input(const std::string& port) const;
  const Param* param(const std::string& name) const;
};

struct GraphOutput {
  std::string name, doc;
  Offset offset = 0;
  Reference from;
};

/// A parameter and what it is to have, one after the other.
struct SweepAxis {
  struct Value {
    Json json;  // a number, a boolean or a text
    Offset offset = 0;
  };
  std::string name;
  Offset offset = 0;
  std::vector<Value> values;
};

struct GraphSweep {
  Offset offset = 0;
  bool zip = false;
  std::vector<SweepAxis> axes;
  std::vector<std::vector<SweepAxis>> excluded;  // each axis with one value
};

struct GraphFile {
  explicit GraphFile(json_text::Source text) : source(std::move(text)) {}
  json_text::Source source;
  json_text::Value root;
  std::string doc;
  std::vector<GraphParam> params;
  std::vector<GraphInput> inputs;
  std::vector<GraphNode> nodes;
  std::vector<GraphOutput> outputs;
  std::optional<GraphSweep> sweep;
  std::vector<SweepAxis> maps;  // parameters and file patterns
  std::unordered_map<std::string, std::size_t> param_index, input_index, node_index, output_index;
};

}  // namespace ballflow
