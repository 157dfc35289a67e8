// Declarations of nodes and types as the engine sees them: parsed and checked copies of the JSON that
// plugins hand over (sdk.hpp writes it).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballflow/json.hpp"
#include "ballflow/plugin.h"

namespace ballflow {

class LazyLibrary;

/// The table of a node or type: in this program, or in a library that is opened when it is first asked for.
/// Then it throws Error (code plugin) when that cannot be. May be asked from several threads at once.
template <class Table>
class TableOf {
 public:
  TableOf(const Table* table = nullptr) : table_(table) {}
  TableOf(std::shared_ptr<const LazyLibrary> library, std::size_t place)
      : library_(std::move(library)), place_(place) {}

  operator const Table*() const { return library_ == nullptr ? table_ : opened(); }
  const Table* operator->() const { return *this; }
  const Table& operator*() const { return *static_cast<const Table*>(*this); }

 private:
  const Table* opened() const;

  const Table* table_ = nullptr;
  std::shared_ptr<const LazyLibrary> library_;
  std::size_t place_ = 0;  // among the nodes or types of the library
};
template <>
const bf_node* TableOf<bf_node>::opened() const;
template <>
const bf_type* TableOf<bf_type>::opened() const;

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
  TableOf<bf_type> entry;

  bool same_content(const TypeDeclaration& other) const;
};

/// As much of a port as tells whether its type is known.
struct PortOutline {
  std::string name, type;
  int type_version = 0;
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
  TableOf<bf_node> entry;
  // It may read files that other files name; false: it is known not to, and `entry` need not be asked.
  bool lists_files = true;

  const PortDecl* input(std::string_view name) const;
  const PortDecl* output(std::string_view name) const;
  const ParamDecl* param(std::string_view name) const;
  bool same_content(const NodeDeclaration& other) const;
};

/// A declaration that is parsed when it is first looked at, from several threads at once if need be.
template <class Declaration>
class Declared {
 public:
  explicit Declared(Declaration parsed)
      : plugin_path(parsed.plugin_path), version(parsed.version), value_(std::move(parsed)) {
    if constexpr (requires { value_->inputs; }) {
      for (const std::vector<PortDecl>* list : {&value_->inputs, &value_->outputs}) {
        for (const PortDecl& port : *list) ports.push_back({port.name, port.type, port.type_version});
      }
    }
  }
  Declared(std::string path, int its_version, std::vector<PortOutline> its_ports,
           std::function<Declaration()> parse)
      : plugin_path(std::move(path)),
        version(its_version),
        ports(std::move(its_ports)),
        parse_(std::move(parse)) {}

  const Declaration& get() const {
    std::call_once(once_, [this] {
      if (!value_) value_.emplace(parse_());
    });
    return *value_;
  }

  std::string plugin_path;
  int version;                     // of a type
  std::vector<PortOutline> ports;  // of a node

 private:
  mutable std::once_flag once_;
  mutable std::optional<Declaration> value_;
  std::function<Declaration()> parse_;
};

/// Nodes or types by id, in the order of ids. To go through them parses all.
template <class Declaration>
class Declarations {
  using Map = std::map<std::string, std::shared_ptr<const Declared<Declaration>>>;

 public:
  class Iterator {
   public:
    explicit Iterator(typename Map::const_iterator at) : at_(at) {}
    std::pair<const std::string&, const Declaration&> operator*() const {
      return {at_->first, at_->second->get()};
    }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    typename Map::const_iterator at_;
  };

  Iterator begin() const { return Iterator(map_.begin()); }
  Iterator end() const { return Iterator(map_.end()); }
  std::size_t size() const { return map_.size(); }
  /// Null when there is none of this id.
  const Declaration* find(const std::string& id) const {
    const auto found = map_.find(id);
    return found == map_.end() ? nullptr : &found->second->get();
  }
  /// Without parsing any.
  const Map& unparsed() const { return map_; }
  Map& unparsed() { return map_; }

 private:
  Map map_;
};

/// Parse declarations; throw Error (code plugin) that names the field that is missing or wrong.
NodeDeclaration parse_node_declaration(std::string_view json);
TypeDeclaration parse_type_declaration(std::string_view json);

}  // namespace ballflow
