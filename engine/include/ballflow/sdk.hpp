// The C++ side of the plugin boundary: what the author of a node writes, and nothing else of the engine.
//
//   struct Enlarge {
//     In<Balls> balls;
//     Out<Balls> enlarged;
//     EnlargeOptions options;                       // defaults live once, in the options struct
//
//     static void declare(NodeDecl<Enlarge>& d) {
//       d.id("acme.Grow", 1).summary("Grow radii so that pruning may drop small features.");
//       d.cites("kornberger2010", "3.5");
//       d.input("balls", &Enlarge::balls).doc("n balls");
//       d.output("balls", &Enlarge::enlarged).doc("n balls, same order, radii >= input");
//       d.param("epsilon", &Enlarge::options, &EnlargeOptions::epsilon)
//           .unit("% of the longest bounding-box edge").at_least(0).doc("0 returns the input");
//     }
//     void run(RunContext& context) { enlarged = enlarge(*balls, options); }
//   };
//   BALLFLOW_PLUGIN("acme", "0.1.0", ballflow::node_entries<Enlarge>(), ballflow::type_entries<Balls>())
//
// A type that travels on edges is any struct of arrays with a specialisation of TypeOf that names them
// (see nodes/types/artifact_types.hpp). A failing run throws; what() is "cause\nhint".
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ballflow/plugin.h"

namespace ballflow {

using Json = nlohmann::ordered_json;

/// Thrown by RunContext::check_cancelled and by Monitor adapters; ends the run quietly.
struct RunCancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// A failure with a cause (place and number) and a hint (the next step).
struct NodeError : std::runtime_error {
  NodeError(const std::string& cause, const std::string& hint)
      : std::runtime_error(hint.empty() ? cause : cause + "\n" + hint) {}
};

/// What a running node gets from the engine.
class RunContext {
 public:
  explicit RunContext(const bf_run& run) : run_(run) {}

  bool cancelled() const { return run_.cancelled(run_.self) != 0; }
  void check_cancelled() const {
    if (cancelled()) throw RunCancelled();
  }
  void progress(double fraction) const { run_.progress(run_.self, fraction); }
  /// Shown to the user, kept in the report, and shown again when the result comes from the cache.
  void warn(std::string_view text) const { run_.log(run_.self, BF_WARNING, {text.data(), text.size()}); }
  void info(std::string_view text) const { run_.log(run_.self, BF_INFO, {text.data(), text.size()}); }
  std::uint64_t seed() const { return run_.seed; }
  unsigned max_threads() const { return run_.max_threads; }
  const bf_run& raw() const { return run_; }

 private:
  const bf_run& run_;
};

namespace detail {

inline bf_bytes bytes(std::string_view text) { return {text.data(), text.size()}; }
inline std::string_view view(bf_bytes text) { return {text.data, static_cast<std::size_t>(text.size)}; }

template <class T>
struct ScalarDtype;
template <>
struct ScalarDtype<double> {
  static constexpr bf_dtype value = BF_F64;
  static constexpr const char* name = "f64";
};
template <>
struct ScalarDtype<float> {
  static constexpr bf_dtype value = BF_F32;
  static constexpr const char* name = "f32";
};
template <>
struct ScalarDtype<std::int64_t> {
  static constexpr bf_dtype value = BF_I64;
  static constexpr const char* name = "i64";
};
template <>
struct ScalarDtype<std::int32_t> {
  static constexpr bf_dtype value = BF_I32;
  static constexpr const char* name = "i32";
};
template <>
struct ScalarDtype<std::uint32_t> {
  static constexpr bf_dtype value = BF_U32;
  static constexpr const char* name = "u32";
};
template <>
struct ScalarDtype<std::uint16_t> {
  static constexpr bf_dtype value = BF_U16;
  static constexpr const char* name = "u16";
};
template <>
struct ScalarDtype<std::uint8_t> {
  static constexpr bf_dtype value = BF_U8;
  static constexpr const char* name = "u8";
};

/// How one element of an array is stored: a scalar, std::array<scalar, k>, or a struct of k equal scalars
/// that says so by `scalar` and `dimension`. width 0 = no trailing dimension.
template <class T>
struct Element {
  using Scalar = T;
  static constexpr std::size_t width = 0;
};
template <class T, std::size_t K>
struct Element<std::array<T, K>> {
  using Scalar = T;
  static constexpr std::size_t width = K;
};
template <class T>
requires requires {
  typename T::scalar;
  T::dimension;
}
struct Element<T> {
  using Scalar = typename T::scalar;
  static constexpr std::size_t width = T::dimension;
  static_assert(sizeof(T) == width * sizeof(Scalar));
};

/// A shared array: constructible from (data, size, owner), read by data() and size().
template <class A>
concept SharedArray = requires(const A& a) {
  typename A::value_type;
  { a.data() } -> std::convertible_to<const typename A::value_type*>;
  { a.size() } -> std::convertible_to<std::size_t>;
  A(a.data(), a.size(), std::shared_ptr<const void>());
};

inline std::shared_ptr<const void> keep(const bf_artifact& artifact) {
  artifact.retain(artifact.owner);
  return {artifact.owner,
          [release = artifact.release](const void* owner) { release(const_cast<void*>(owner)); }};
}

/// Arrays on their way out, with what keeps their data alive.
class OutArrays {
 public:
  template <class T>
  void add(std::string_view name, const T* data, std::size_t count, std::shared_ptr<const void> owner) {
    using E = Element<T>;
    bf_array array{};
    array.name = bytes(name);
    array.dtype = ScalarDtype<typename E::Scalar>::value;
    array.rank = E::width == 0 ? 1 : 2;
    array.shape[0] = count;
    array.shape[1] = E::width;
    array.data = data;
    push(array, std::move(owner));
  }
  template <class T>
  void add_scalar(std::string_view name, const T& value) {
    using E = Element<T>;
    auto owner = std::make_shared<T>(value);
    bf_array array{};
    array.name = bytes(name);
    array.dtype = ScalarDtype<typename E::Scalar>::value;
    array.rank = E::width == 0 ? 0 : 1;
    array.shape[0] = E::width;
    array.data = owner.get();
    push(array, std::move(owner));
  }
  /// The caller owes one release per array.
  const std::vector<bf_array>& arrays() const { return arrays_; }

 private:
  void push(bf_array array, std::shared_ptr<const void> owner) {
    array.owner = new std::shared_ptr<const void>(std::move(owner));
    array.release = [](void* o) { delete static_cast<std::shared_ptr<const void>*>(o); };
    arrays_.push_back(array);
  }
  std::vector<bf_array> arrays_;
};

}  // namespace detail

/// Names the arrays and summary fields of an artifact type; filled by TypeOf<T>::declare.
template <class T>
class TypeDecl {
 public:
  class ArrayRef {
   public:
    ArrayRef(TypeDecl& decl, std::size_t index) : decl_(decl), index_(index) {}
    /// What an element means and its unit.
    ArrayRef& doc(std::string_view text) { return set("doc", text); }
    /// May be absent; an empty array is not written.
    ArrayRef& optional() {
      decl_.fields_[index_].optional = true;
      return set("optional", true);
    }
    /// Name of the length of the first dimension; arrays with equal names have equal lengths, "n+1" is
    /// one longer than "n".
    ArrayRef& length(std::string_view name) {
      decl_.json_["arrays"][index_]["shape"][0] = name;
      return *this;
    }

   private:
    template <class V>
    ArrayRef& set(const char* key, V value) {
      decl_.json_["arrays"][index_][key] = value;
      return *this;
    }
    TypeDecl& decl_;
    std::size_t index_;
  };

  TypeDecl& id(std::string_view name, int version) {
    json_["id"] = name;
    json_["version"] = version;
    return *this;
  }
  TypeDecl& doc(std::string_view text) {
    json_["doc"] = text;
    return *this;
  }

  /// An array member of T.
  template <detail::SharedArray A>
  ArrayRef array(std::string_view name, A T::*member) {
    using Value = typename A::value_type;
    using E = detail::Element<Value>;
    Json shape = Json::array({name});
    if (E::width != 0) shape.push_back(E::width);
    add(name, detail::ScalarDtype<typename E::Scalar>::name, std::move(shape));
    Field& field = fields_.back();
    field.write = [member, name = field.name](const T& value, detail::OutArrays& out, bool optional) {
      const A& a = value.*member;
      if (optional && a.size() == 0) return;
      auto keeper = std::make_shared<A>(a);
      out.add<Value>(*name, a.data(), a.size(), keeper);
    };
    field.read = [member](T& value, const bf_array& in, const std::shared_ptr<const void>& owner) {
      value.*member = A(static_cast<const Value*>(in.data), static_cast<std::size_t>(in.shape[0]), owner);
    };
    return {*this, fields_.size() - 1};
  }

  /// A number (rank 0) or a std::array of numbers (rank 1) of T.
  template <class V>
  ArrayRef scalar(std::string_view name, V T::*member) {
    using E = detail::Element<V>;
    Json shape = Json::array();
    if (E::width != 0) shape.push_back(E::width);
    add(name, detail::ScalarDtype<typename E::Scalar>::name, std::move(shape));
    Field& field = fields_.back();
    field.write = [member, name = field.name](const T& value, detail::OutArrays& out, bool) {
      out.add_scalar<V>(*name, value.*member);
    };
    field.read = [member](T& value, const bf_array& in, const std::shared_ptr<const void>&) {
      std::memcpy(&(value.*member), in.data, sizeof(V));
    };
    return {*this, fields_.size() - 1};
  }

  /// A field of the summary. Summaries are hashed: they hold nothing that is not a function of the input.
  TypeDecl& summary(std::string_view name, std::string_view doc) {
    json_["summary"].push_back({{"name", name}, {"doc", doc}});
    return *this;
  }
  /// Computes the summary of a value: an object with the fields declared by summary().
  TypeDecl& summarize(std::function<Json(const T&)> function) {
    summarize_ = std::move(function);
    return *this;
  }
  /// Returns an empty string when every invariant holds, else what is wrong and where.
  TypeDecl& check(std::function<std::string(const T&)> function) {
    check_ = std::move(function);
    return *this;
  }

  const Json& json() const { return json_; }

  T read(const bf_artifact& artifact) const {
    T value{};
    const auto owner = detail::keep(artifact);
    for (std::uint64_t i = 0; i < artifact.array_count; ++i) {
      const bf_array& array = artifact.arrays[i];
      for (const Field& field : fields_) {
        if (*field.name == detail::view(array.name)) field.read(value, array, owner);
      }
    }
    return value;
  }
  detail::OutArrays write(const T& value) const {
    detail::OutArrays out;
    for (const Field& field : fields_) field.write(value, out, field.optional);
    return out;
  }
  Json summary_of(const T& value) const { return summarize_ ? summarize_(value) : Json::object(); }
  std::string broken(const T& value) const { return check_ ? check_(value) : std::string(); }

 private:
  struct Field {
    std::shared_ptr<const std::string> name;
    bool optional = false;
    std::function<void(const T&, detail::OutArrays&, bool)> write;
    std::function<void(T&, const bf_array&, const std::shared_ptr<const void>&)> read;
  };
  void add(std::string_view name, const char* dtype, Json shape) {
    json_["arrays"].push_back({{"name", name}, {"dtype", dtype}, {"shape", std::move(shape)}});
    fields_.push_back({std::make_shared<const std::string>(name), false, {}, {}});
  }
  Json json_ = {
      {"id", ""}, {"version", 0}, {"doc", ""}, {"arrays", Json::array()}, {"summary", Json::array()}};
  std::vector<Field> fields_;
  std::function<Json(const T&)> summarize_;
  std::function<std::string(const T&)> check_;
};

/// Specialise: static void declare(TypeDecl<T>&).
template <class T>
struct TypeOf;

/// The declaration of T, made once.
template <class T>
const TypeDecl<T>& type_decl() {
  static const TypeDecl<T> decl = [] {
    TypeDecl<T> d;
    TypeOf<T>::declare(d);
    return d;
  }();
  return decl;
}

/// An input port. Empty only when the port is optional and not connected.
template <class T>
class In {
 public:
  const T& operator*() const { return *value_; }
  const T* operator->() const { return &*value_; }
  explicit operator bool() const { return value_.has_value(); }
  void set(T value) { value_ = std::move(value); }

 private:
  std::optional<T> value_;
};

/// An output port; run() assigns it.
template <class T>
class Out {
 public:
  Out& operator=(T value) {
    value_ = std::move(value);
    return *this;
  }
  const T& operator*() const { return *value_; }
  explicit operator bool() const { return value_.has_value(); }
  /// Adds a field to the summary that cannot be derived from the arrays alone.
  template <class V>
  void summary(std::string_view field, V&& value) {
    extra_[std::string(field)] = std::forward<V>(value);
  }
  const Json& extra() const { return extra_; }

 private:
  std::optional<T> value_;
  Json extra_ = Json::object();
};

/// Declares a node: identity, ports, parameters. Everything the engine hashes, checks, documents and
/// completes in an editor comes from here.
template <class N>
class NodeDecl {
 public:
  class PortRef {
   public:
    explicit PortRef(Json& json) : json_(json) {}
    PortRef& doc(std::string_view text) {
      json_["doc"] = text;
      return *this;
    }
    /// The node also works without it (inputs only).
    PortRef& optional() {
      json_["optional"] = true;
      return *this;
    }

   private:
    Json& json_;
  };

  class ParamRef {
   public:
    explicit ParamRef(Json& json) : json_(json) {}
    /// What it does, and what its extreme values do.
    ParamRef& doc(std::string_view text) { return set("doc", text); }
    ParamRef& unit(std::string_view text) { return set("unit", text); }
    ParamRef& at_least(double value) { return set_number("minimum", value); }
    ParamRef& at_most(double value) { return set_number("maximum", value); }
    ParamRef& above(double value) { return set_number("exclusive_minimum", value); }
    ParamRef& below(double value) { return set_number("exclusive_maximum", value); }
    /// A text parameter names a file; the content of the file, not its path, enters the cache key.
    ParamRef& file() { return set("kind", "file"); }
    /// Values of a file parameter that begin with `prefix` are not files and enter the key as text.
    ParamRef& scheme(std::string_view prefix) {
      json_["schemes"].push_back(prefix);
      return *this;
    }
    /// The user must give a value.
    ParamRef& required() {
      json_.erase("default");
      return set("required", true);
    }
    /// Changes how fast, never what: not part of the cache key.
    ParamRef& not_hashed() { return set("hashed", false); }

   private:
    template <class V>
    ParamRef& set(const char* key, V value) {
      json_[key] = value;
      return *this;
    }
    ParamRef& set_number(const char* key, double value) {
      if (json_["kind"] == "integer") return set(key, static_cast<std::int64_t>(value));
      return set(key, value);
    }
    Json& json_;
  };

  /// `behaviour_version` grows whenever equal inputs and parameters may give another output.
  NodeDecl& id(std::string_view name, int behaviour_version) {
    json_["id"] = name;
    json_["version"] = behaviour_version;
    return *this;
  }
  /// One sentence.
  NodeDecl& summary(std::string_view text) { return set("summary", text); }
  /// What it computes, what it accepts and refuses.
  NodeDecl& doc(std::string_view text) { return set("doc", text); }
  /// When another node or none is the better choice.
  NodeDecl& avoid_when(std::string_view text) { return set("avoid_when", text); }
  /// `key` is in nodes/refs.bib; `where` names the section, lemma or table.
  NodeDecl& cites(std::string_view key, std::string_view where) {
    json_["cites"].push_back({{"key", key}, {"where", where}});
    return *this;
  }
  /// A library whose version may change the result; part of the cache key.
  NodeDecl& library(std::string_view name, std::string_view version) {
    json_["libraries"][std::string(name)] = version;
    return *this;
  }
  /// The result depends on RunContext::seed(); the seed then enters the key.
  NodeDecl& uses_seed() {
    json_["uses_seed"] = true;
    return *this;
  }
  /// Peak memory beyond inputs and outputs: `fixed` bytes + `per_input_byte` times the bytes of all inputs.
  NodeDecl& memory(std::uint64_t fixed, double per_input_byte) {
    json_["memory"] = {{"fixed", fixed}, {"per_input_byte", per_input_byte}};
    return *this;
  }

  template <class T>
  PortRef input(std::string_view name, In<T> N::*member) {
    json_["inputs"].push_back(port<T>(name));
    readers_.push_back([member, name = std::string(name)](N& node, const bf_run& run) {
      bf_artifact artifact{};
      if (run.input(run.self, detail::bytes(name), &artifact) == 0) return;
      (node.*member).set(type_decl<T>().read(artifact));
    });
    return PortRef(json_["inputs"].back());
  }

  template <class T>
  PortRef output(std::string_view name, Out<T> N::*member) {
    json_["outputs"].push_back(port<T>(name));
    writers_.push_back([member, name = std::string(name)](const N& node, const bf_run& run) {
      const Out<T>& out = node.*member;
      if (!out) throw std::logic_error("the node did not set its output \"" + name + "\"");
      Json summary = type_decl<T>().summary_of(*out);
      for (const auto& [key, value] : out.extra().items()) summary[key] = value;
      const std::string text = summary.dump();
      const detail::OutArrays arrays = type_decl<T>().write(*out);
      if (run.output(run.self, detail::bytes(name), arrays.arrays().data(), arrays.arrays().size(),
                     detail::bytes(text)) != 0) {
        throw RunCancelled();  // the engine has recorded why it refused the output
      }
    });
    return PortRef(json_["outputs"].back());
  }

  /// A parameter of the node struct: double, integer, bool or std::string. Its default is the member's.
  template <class V>
  ParamRef param(std::string_view name, V N::*member) {
    return add_param<V>(name, [member](N& node) -> V& { return node.*member; });
  }
  /// A parameter inside an options struct of the node.
  template <class O, class V>
  ParamRef param(std::string_view name, O N::*options, V O::*member) {
    return add_param<V>(name, [options, member](N& node) -> V& { return (node.*options).*member; });
  }

  template <class E>
  struct Choice {
    E value;
    const char* name;
    const char* doc;
  };
  /// A parameter with named values.
  template <class O, class E>
  requires std::is_enum_v<E> ParamRef choice(std::string_view name, O N::*options, E O::*member,
                                             std::vector<Choice<E>> choices) {
    return add_choice<E>(
        name, [options, member](N& node) -> E& { return (node.*options).*member; }, std::move(choices));
  }

  const Json& json() const { return json_; }

  int run(const bf_run& raw) const {
    N node{};
    RunContext context(raw);
    try {
      const Json params = Json::parse(detail::view(raw.params));
      for (const auto& set : setters_) set(node, params);
      for (const auto& read : readers_) read(node, raw);
      node.run(context);
      for (const auto& write : writers_) write(node, raw);
      return BF_OK;
    } catch (const RunCancelled&) {
      return BF_CANCELLED;
    } catch (...) {
      // Whatever an algorithm throws to get out of a cancelled computation is not a failure.
      if (context.cancelled()) return BF_CANCELLED;
      report_exception(raw);
    }
    return BF_FAILED;
  }

 private:
  /// Called inside a catch block.
  static void report_exception(const bf_run& raw) {
    try {
      throw;
    } catch (const std::bad_alloc&) {
      fail(raw, "out of memory", "use a smaller input, a smaller epsilon, or a machine with more memory");
    } catch (const std::exception& error) {
      const std::string text = error.what();
      const std::size_t split = text.find('\n');
      fail(raw, text.substr(0, split), split == std::string::npos ? "" : text.substr(split + 1));
    } catch (...) {
      fail(raw, "the node threw something that is not an exception", "this is a bug of the node");
    }
  }

  NodeDecl& set(const char* key, std::string_view text) {
    json_[key] = text;
    return *this;
  }
  static void fail(const bf_run& run, const std::string& cause, const std::string& hint) {
    run.fail(run.self, detail::bytes(cause), detail::bytes(hint));
  }
  template <class T>
  static Json port(std::string_view name) {
    const Json& type = type_decl<T>().json();
    return {{"name", name}, {"type", type["id"]}, {"type_version", type["version"]}, {"doc", ""}};
  }

  template <class V, class Get>
  ParamRef add_param(std::string_view name, Get get) {
    N defaults{};
    const V value = get(defaults);
    Json json = {{"name", name}};
    if constexpr (std::is_same_v<V, bool>) {
      json["kind"] = "boolean";
    } else if constexpr (std::is_integral_v<V>) {
      json["kind"] = "integer";
    } else if constexpr (std::is_floating_point_v<V>) {
      json["kind"] = "number";
    } else {
      static_assert(std::is_same_v<V, std::string>, "a parameter is a number, a boolean, a text or a choice");
      json["kind"] = "string";
    }
    json["default"] = value;
    json["doc"] = "";
    json_["params"].push_back(std::move(json));
    setters_.push_back([get, name = std::string(name)](N& node, const Json& params) {
      get(node) = params.at(name).template get<V>();
    });
    return ParamRef(json_["params"].back());
  }

  template <class E, class Get>
  ParamRef add_choice(std::string_view name, Get get, std::vector<Choice<E>> choices) {
    N defaults{};
    Json json = {
        {"name", name}, {"kind", "choice"}, {"default", nullptr}, {"doc", ""}, {"choices", Json::array()}};
    for (const Choice<E>& choice : choices) {
      json["choices"].push_back({{"value", choice.name}, {"doc", choice.doc}});
      if (choice.value == get(defaults)) json["default"] = choice.name;
    }
    json_["params"].push_back(std::move(json));
    setters_.push_back(
        [get, name = std::string(name), choices = std::move(choices)](N& node, const Json& params) {
          const auto text = params.at(name).template get<std::string>();
          for (const Choice<E>& choice : choices) {
            if (text == choice.name) get(node) = choice.value;
          }
        });
    return ParamRef(json_["params"].back());
  }

  Json json_ = {{"id", ""},
                {"version", 0},
                {"summary", ""},
                {"doc", ""},
                {"avoid_when", ""},
                {"cites", Json::array()},
                {"libraries", Json::object()},
                {"uses_seed", false},
                {"inputs", Json::array()},
                {"outputs", Json::array()},
                {"params", Json::array()}};
  std::vector<std::function<void(N&, const bf_run&)>> readers_;
  std::vector<std::function<void(const N&, const bf_run&)>> writers_;
  std::vector<std::function<void(N&, const Json&)>> setters_;
};

template <class N>
const NodeDecl<N>& node_decl() {
  static const NodeDecl<N> decl = [] {
    NodeDecl<N> d;
    N::declare(d);
    return d;
  }();
  return decl;
}

namespace detail {

template <class N>
const bf_node* node_entry() {
  static const std::string text = node_decl<N>().json().dump();
  static const bf_node node = {sizeof(bf_node), 0, bytes(text),
                               [](const bf_run* run) -> int { return node_decl<N>().run(*run); }};
  return &node;
}

template <class T>
const bf_type* type_entry() {
  static const std::string text = type_decl<T>().json().dump();
  static const bf_type type = {
      sizeof(bf_type), 0, bytes(text),
      [](const bf_artifact* artifact, void* context, void (*found)(void*, bf_bytes)) {
        std::string broken;
        try {
          broken = type_decl<T>().broken(type_decl<T>().read(*artifact));
        } catch (const std::exception& error) {
          broken = error.what();
        }
        if (!broken.empty()) found(context, bytes(broken));
      }};
  return &type;
}

}  // namespace detail

/// The table entry of one node; a plugin of several files collects one per file.
template <class N>
const bf_node* node_entry() {
  return detail::node_entry<N>();
}
template <class... N>
std::vector<const bf_node*> node_entries() {
  return {detail::node_entry<N>()...};
}
template <class... T>
std::vector<const bf_type*> type_entries() {
  return {detail::type_entry<T>()...};
}

}  // namespace ballflow

/// The one line that makes a shared object a plugin. `nodes` and `types` are expressions of type
/// std::vector<const bf_node*> and std::vector<const bf_type*>; they are evaluated once, when the engine
/// asks for the tables.
#define BALLFLOW_PLUGIN(plugin_name, plugin_version, nodes_expression, types_expression)                     \
  extern "C" __attribute__((visibility("default"), used, section(BALLFLOW_ABI_SECTION)))                     \
  const bf_abi_note ballflow_abi_note = {{'B', 'A', 'L', 'L', 'F', 'L', 'O', 'W'}, BALLFLOW_ABI_VERSION, 0}; \
  extern "C" __attribute__((visibility("default"))) const bf_plugin* ballflow_plugin(void) {                 \
    try {                                                                                                    \
      static const std::vector<const bf_node*> nodes = nodes_expression;                                     \
      static const std::vector<const bf_type*> types = types_expression;                                     \
      static const bf_plugin plugin = {sizeof(bf_plugin),                                                    \
                                       BALLFLOW_ABI_VERSION,                                                 \
                                       ::ballflow::detail::bytes(plugin_name),                               \
                                       ::ballflow::detail::bytes(plugin_version),                            \
                                       types.data(),                                                         \
                                       types.size(),                                                         \
                                       nodes.data(),                                                         \
                                       nodes.size()};                                                        \
      return &plugin;                                                                                        \
    } catch (...) {                                                                                          \
      return nullptr; /* the engine reports that the tables could not be made */                             \
    }                                                                                                        \
  }
