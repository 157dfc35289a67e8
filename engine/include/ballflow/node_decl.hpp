// Declarations of nodes and types as the engine sees them: parsed and checked copies of the JSON that
// plugins hand over (sdk.hpp writes it).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/json.hpp"
#include "ballflow/plugin.h"

namespace ballflow {

struct ArrayDecl {
  std::string name, dtype, doc;
  // First dimension by name ("n", "n+1": equal names mean equal lengths) unless rank 0 or fixed; others
  // fixed.
  std::vector<Json> shape;
  bool optional = false;

  friend bool operator==(const ArrayDecl&, const ArrayDecl&) = default;
};

struct TypeDeclaration {
  std::string id;
  int version = 0;
  std::string doc;
  std::vector<ArrayDecl> arrays;
  std::vector<std::pair<std::string, std::string>> summary;  // field, doc
  std::string plugin_path;
  const bf_type* entry = nullptr;

  bool same_content(const TypeDeclaration& other) const;
};

struct PortDecl {
  std::string name, type, doc;
  int type_version = 0;
  bool optional = false;
  bool list = false;  // inputs only: takes several artifacts, in the order of the graph

  friend bool operator==(const PortDecl&, const PortDecl&) = default;
};

/// What is connected to an input is known by its slot: the name of the port, and for a port that is a list
/// the place in it too: "clouds[0]", "clouds[1]", ...
std::string list_slot(std::string_view port, std::size_t index);
/// "clouds[1]" -> "clouds"
std::string_view port_of_slot(std::string_view slot);
/// The port that has the slot; null when there is none, and for a place in what is no list.
const PortDecl* find_input(const std::vector<PortDecl>& inputs, std::string_view slot);

// The last three of graphs only.
enum class ParamKind { number, integer, boolean, string, choice, file, list, files, artifact };

/// A list of texts, or of files.
constexpr bool is_list(ParamKind kind) { return kind == ParamKind::list || kind == ParamKind::files; }

struct ParamDecl {
  std::string name, doc, unit;
  ParamKind kind = ParamKind::string;
  Json default_value;  // null when required
  bool required = false;
  bool hashed = true;
  std::optional<double> minimum, maximum, exclusive_minimum, exclusive_maximum;
  std::vector<std::pair<std::string, std::string>> choices;  // value, doc
  std::vector<std::string> schemes;                          // prefixes of file parameters that are not files
  std::string type;                                          // of an artifact

  /// Empty when `value` is acceptable, else why not ("must be at least 0, is -1").
  std::string refuse(const Json& value) const;

  friend bool operator==(const ParamDecl&, const ParamDecl&) = default;
};

struct Citation {
  std::string key, where;

  friend bool operator==(const Citation&, const Citation&) = default;
};

struct NodeDeclaration {
  std::string id;
  int version = 0;
  std::string summary, doc, avoid_when;
  std::vector<Citation> cites;
  std::map<std::string, std::string> libraries;
  bool uses_seed = false;
  std::uint64_t memory_fixed = 0;
  double memory_per_input_byte = 0;
  std::vector<PortDecl> inputs, outputs;
  std::vector<ParamDecl> params;
  std::string plugin_path;
  // SHA-256 of the library's file, part of the key: of libraries outside the installed folder, which change
  // more often than their versions; else empty.
  std::string library_file;
  const bf_node* entry = nullptr;

  const PortDecl* input(std::string_view name) const;
  const PortDecl* output(std::string_view name) const;
  const ParamDecl* param(std::string_view name) const;
  bool same_content(const NodeDeclaration& other) const;
};

/// Parse declarations; throw Error (code plugin) that names the field that is missing or wrong.
NodeDeclaration parse_node_declaration(std::string_view json);
TypeDeclaration parse_type_declaration(std::string_view json);

}  // namespace ballflow
