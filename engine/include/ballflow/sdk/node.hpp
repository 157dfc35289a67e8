// A node: a struct with typed ports, parameters, a declaration and a function run. sdk.hpp shows one.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ballflow/plugin.h"
#include "ballflow/sdk/error.hpp"
#include "ballflow/sdk/summary.hpp"
#include "ballflow/sdk/type.hpp"

namespace ballflow {

/// What a running node gets from the engine.
class RunContext {
 public:
  explicit RunContext(const bf_run& run) : run_(run) {}

  bool cancelled() const { return run_.cancelled(run_.host) != 0; }
  void check_cancelled() const {
    if (cancelled()) throw RunCancelled();
  }
  void progress(double fraction) const { run_.progress(run_.host, fraction); }
  /// Shown to the user, kept in the report, and shown again when the result comes from the cache.
  void warn(std::string_view text) const { run_.log(run_.host, BF_WARNING, {text.data(), text.size()}); }
  void info(std::string_view text) const { run_.log(run_.host, BF_INFO, {text.data(), text.size()}); }
  std::uint64_t seed() const { return run_.seed; }
  unsigned max_threads() const { return run_.max_threads; }
  /// Bytes that the nodes of the run may take together; 0 when nobody has said, as an older engine does not.
  /// Results must not depend on it: only whether the node fails, in time and with words.
  std::uint64_t memory_bytes() const {
    return run_.struct_size < BALLFLOW_SIZE_UP_TO(bf_run, memory_bytes) ? 0 : run_.memory_bytes;
  }
  const bf_run& raw() const { return run_; }

 private:
  const bf_run& run_;
};

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

/// An input port that takes a list of artifacts of one type, in the order of the graph. Empty only when the
/// port is optional.
template <class T>
class InList {
 public:
  std::size_t size() const { return values_.size(); }
  bool empty() const { return values_.empty(); }
  const T& operator[](std::size_t i) const { return values_[i]; }
  auto begin() const { return values_.begin(); }
  auto end() const { return values_.end(); }
  void add(T value) { values_.push_back(std::move(value)); }

 private:
  std::vector<T> values_;
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
  void summary(std::string_view field, SummaryValue value) { extra_[field] = std::move(value); }
  const Summary& extra() const { return extra_; }

 private:
  std::optional<T> value_;
  Summary extra_;
};

/// A file that a file names: the name as it is written there, and where it is, empty where it is not.
struct NamedFile {
  std::string name, path;
};

namespace detail {

/// One value of a parameter with named values.
template <class E>
struct Choice {
  E value;
  std::string name;
  std::string doc;
};

/// What a declaration of a node says and how it is run. Ports and parameters are known by their offset in the
/// node's struct, so that nothing here depends on it.
class AnyNodeDecl {
 public:
  enum class Kind { number, integer, boolean, string, choice };

  struct Port {
    std::string name, type, doc;
    int type_version = 0;
    bool optional = false, list = false;
    std::size_t offset = 0;
    void (*read)(void* port, const bf_artifact& artifact) = nullptr;  // inputs
    bool (*write)(const void* port, OutArrays& arrays,
                  Summary& summary) = nullptr;  // outputs; false: not set
  };

  struct Param {
    Kind kind = Kind::string;
    std::string name, doc, unit, default_value;  // the last one JSON
    std::optional<double> minimum, maximum, exclusive_minimum, exclusive_maximum;
    bool required = false, file = false, hashed = true;
    std::vector<std::string> schemes;
    std::vector<Choice<std::int64_t>> choices;
    std::size_t offset = 0;
    std::size_t size = 0;  // of a number, integer or enumeration
    std::optional<double> lowest,
        highest;  // what the member can hold, where that is less than the kind allows
  };

  class PortRef {
   public:
    explicit PortRef(std::vector<Port>& ports) : ports_(ports), index_(ports.size() - 1) {}
    PortRef& doc(std::string_view text);
    /// The node also works without it (inputs only).
    PortRef& optional();

   private:
    std::vector<Port>& ports_;
    std::size_t index_;
  };

  class ParamRef {
   public:
    explicit ParamRef(std::vector<Param>& params) : params_(params), index_(params.size() - 1) {}
    /// What it does, and what its extreme values do.
    ParamRef& doc(std::string_view text);
    ParamRef& unit(std::string_view text);
    ParamRef& at_least(double value);
    ParamRef& at_most(double value);
    ParamRef& above(double value);
    ParamRef& below(double value);
    /// A text parameter names a file; the content of the file, not its path, enters the cache key.
    ParamRef& file();
    /// Values of a file parameter that begin with `prefix` are not files and enter the key as text.
    ParamRef& scheme(std::string_view prefix);
    /// The user must give a value.
    ParamRef& required();
    /// Changes how fast, never what: not part of the cache key.
    ParamRef& not_hashed();

   private:
    Param& param() { return params_[index_]; }
    std::vector<Param>& params_;
    std::size_t index_;
  };

  /// The declaration as JSON, see node_decl.hpp.
  std::string json() const;
  /// Makes a node, fills it, runs it and hands over its outputs. Returns a bf_status; throws nothing.
  int run(const bf_run& raw) const noexcept;
  /// Whether it reads files that files name.
  bool names_files() const { return operations_.files != nullptr; }
  /// Which ones, for these parameters; none where something is wrong, which a run will say.
  std::vector<NamedFile> files(bf_bytes params) const noexcept;

 protected:
  struct Operations {
    void* (*make)() = nullptr;
    void (*destroy)(void* node) = nullptr;
    void (*run)(void* node, RunContext& context) = nullptr;
    std::vector<NamedFile> (*files)(const void* node) = nullptr;
  };
  struct Citation {
    std::string key, where;
  };

  Port& add_port(std::vector<Port>& ports, std::string_view name, const AnyTypeDecl& type,
                 std::size_t offset);
  Param& add_param(std::string_view name, Kind kind, std::string default_value, std::size_t offset,
                   std::size_t size);

  Operations operations_;
  std::string id_, text_summary_, doc_, avoid_when_;
  int version_ = 0;
  std::vector<Citation> cites_;
  std::vector<std::pair<std::string, std::string>> libraries_;
  bool uses_seed_ = false;
  std::optional<std::pair<std::uint64_t, double>> memory_;
  std::vector<Port> inputs_, outputs_;
  std::vector<Param> params_;

 private:
  void fill_params(void* node, bf_bytes params) const;
  void fill(void* node, const bf_run& raw) const;
  void hand_over(const void* node, const bf_run& raw) const;
};

template <class T>
void read_one(void* port, const bf_artifact& artifact) {
  static_cast<In<T>*>(port)->set(type_decl<T>().read(artifact));
}
template <class T>
void read_next(void* port, const bf_artifact& artifact) {
  static_cast<InList<T>*>(port)->add(type_decl<T>().read(artifact));
}
template <class T>
bool write_out(const void* port, OutArrays& arrays, Summary& summary) {
  const Out<T>& out = *static_cast<const Out<T>*>(port);
  if (!out) return false;
  summary = type_decl<T>().summary_of(*out);
  summary.update(out.extra());
  arrays = type_decl<T>().write(*out);
  return true;
}

}  // namespace detail

/// Declares a node: identity, ports, parameters. Everything the engine hashes, checks, documents and
/// completes in an editor comes from here.
template <class N>
class NodeDecl : public detail::AnyNodeDecl {
 public:
  template <class E>
  using Choice = detail::Choice<E>;

  NodeDecl() {
    operations_ = {[]() -> void* { return new N{}; }, [](void* node) { delete static_cast<N*>(node); },
                   [](void* node, RunContext& context) { static_cast<N*>(node)->run(context); }, nullptr};
  }

  /// `behaviour_version` grows whenever equal inputs and parameters may give another output.
  NodeDecl& id(std::string_view name, int behaviour_version) {
    id_ = name;
    version_ = behaviour_version;
    return *this;
  }
  /// One sentence.
  NodeDecl& summary(std::string_view text) { return set(text_summary_, text); }
  /// What it computes, what it accepts and refuses.
  NodeDecl& doc(std::string_view text) { return set(doc_, text); }
  /// When another node or none is the better choice.
  NodeDecl& avoid_when(std::string_view text) { return set(avoid_when_, text); }
  /// `key` is in nodes/refs.bib; `where` names the section, lemma or table.
  NodeDecl& cites(std::string_view key, std::string_view where) {
    cites_.push_back({std::string(key), std::string(where)});
    return *this;
  }
  /// A library whose version may change the result; part of the cache key. Give the version of the library
  /// that runs, not of the headers: declarations are made when the node library is loaded.
  NodeDecl& library(std::string_view name, std::string_view version) {
    libraries_.emplace_back(name, version);
    return *this;
  }
  /// The result depends on RunContext::seed(); the seed then enters the key.
  NodeDecl& uses_seed() {
    uses_seed_ = true;
    return *this;
  }
  /// Peak memory beyond inputs and outputs: `fixed` bytes + `per_input_byte` times the bytes of all inputs.
  NodeDecl& memory(std::uint64_t fixed, double per_input_byte) {
    memory_ = {fixed, per_input_byte};
    return *this;
  }

  /// The node reads files that its file parameters name, like the meshes of a robot. `List` is a member
  /// function that lists them, from the parameters alone; their contents then are in the key.
  template <std::vector<NamedFile> (N::*List)() const>
  NodeDecl& reads_named_files() {
    operations_.files = [](const void* node) { return (static_cast<const N*>(node)->*List)(); };
    return *this;
  }

  template <class T>
  PortRef input(std::string_view name, In<T> N::*member) {
    add_port(inputs_, name, type_decl<T>(), offset(member)).read = &detail::read_one<T>;
    return PortRef(inputs_);
  }
  /// Takes at least one artifact, or any number where it is optional.
  template <class T>
  PortRef input(std::string_view name, InList<T> N::*member) {
    Port& port = add_port(inputs_, name, type_decl<T>(), offset(member));
    port.read = &detail::read_next<T>;
    port.list = true;
    return PortRef(inputs_);
  }
  template <class T>
  PortRef output(std::string_view name, Out<T> N::*member) {
    add_port(outputs_, name, type_decl<T>(), offset(member)).write = &detail::write_out<T>;
    return PortRef(outputs_);
  }

  /// A parameter: double, float, integer, bool or std::string. `path` leads to it: a member of the node, or a
  /// member of an options struct of the node, or of an options struct in that. Its default is the member's.
  template <class Member, class... Path>
  ParamRef param(std::string_view name, Member N::*member, Path... path) {
    const auto& value = follow(defaults_.*member, path...);
    using V = std::remove_cvref_t<decltype(value)>;
    const std::size_t at = detail::offset_of(defaults_, value);
    if constexpr (std::is_same_v<V, bool>) {
      add_param(name, Kind::boolean, SummaryValue(value).text(), at, sizeof value);
    } else if constexpr (std::is_integral_v<V>) {
      Param& added = add_param(name, Kind::integer, SummaryValue(value).text(), at, sizeof value);
      if constexpr (sizeof(V) < 8 || std::is_unsigned_v<V>)
        added.lowest = static_cast<double>(std::numeric_limits<V>::lowest());
      if constexpr (sizeof(V) < 8) added.highest = static_cast<double>(std::numeric_limits<V>::max());
    } else if constexpr (std::is_floating_point_v<V>) {
      static_assert(sizeof(V) <= 8, "results must not depend on long double");
      Param& added = add_param(name, Kind::number, SummaryValue(double{value}).text(), at, sizeof value);
      if constexpr (sizeof(V) < 8) {
        added.highest = static_cast<double>(std::numeric_limits<V>::max());
        added.lowest = -*added.highest;
      }
    } else {
      static_assert(std::is_same_v<V, std::string>, "a parameter is a number, a boolean, a text or a choice");
      add_param(name, Kind::string, SummaryValue(value).text(), at, sizeof value);
    }
    return ParamRef(params_);
  }

  /// A parameter with named values, reached like any other.
  template <class E>
  requires std::is_enum_v<E> ParamRef choice(std::string_view name, E N::*member,
                                             std::vector<Choice<E>> choices) {
    return add_choice(name, defaults_.*member, choices);
  }
  template <class O, class E>
  requires std::is_enum_v<E> ParamRef choice(std::string_view name, O N::*options, E O::*member,
                                             std::vector<Choice<E>> choices) {
    return add_choice(name, (defaults_.*options).*member, choices);
  }
  template <class O, class P, class E>
  requires std::is_enum_v<E> ParamRef choice(std::string_view name, O N::*options, P O::*inner, E P::*member,
                                             std::vector<Choice<E>> choices) {
    return add_choice(name, ((defaults_.*options).*inner).*member, choices);
  }

 private:
  NodeDecl& set(std::string& to, std::string_view text) {
    to = text;
    return *this;
  }
  template <class Member>
  std::size_t offset(Member N::*member) const {
    return detail::offset_of(defaults_, defaults_.*member);
  }
  template <class V>
  static const V& follow(const V& value) {
    return value;
  }
  template <class O, class M, class... Path>
  static const auto& follow(const O& object, M member, Path... path) {
    return follow(object.*member, path...);
  }
  template <class E>
  ParamRef add_choice(std::string_view name, const E& value, const std::vector<Choice<E>>& choices) {
    std::string name_of_default;
    std::vector<Choice<std::int64_t>> all;
    for (const Choice<E>& choice : choices) {
      all.push_back({static_cast<std::int64_t>(choice.value), choice.name, choice.doc});
      if (choice.value == value) name_of_default = SummaryValue(choice.name).text();
    }
    Param& added = add_param(name, Kind::choice, std::move(name_of_default),
                             detail::offset_of(defaults_, value), sizeof(E));
    added.choices = std::move(all);
    return ParamRef(params_);
  }

  N defaults_{};  // of parameters; tells where members lie
};

template <class N>
const NodeDecl<N>& node_decl() {
  static const NodeDecl<N>* const decl = [] {
    auto* d = new NodeDecl<N>;  // for as long as the process: a node may run until its end
    N::declare(*d);
    return d;
  }();
  return *decl;
}

}  // namespace ballflow
