// How a struct of arrays travels on edges: names, shapes, summary and invariants of an artifact type.
//
// A type is any struct of arrays with a specialisation of TypeOf that names them:
//
//   template <>
//   struct ballflow::TypeOf<acme::Grid> {
//     static void declare(TypeDecl<acme::Grid>& d) {
//       d.id("acme.Grid", 1).doc("A rectangle of numbers.");
//       d.array("values", &acme::Grid::values).length("n").doc("row by row");
//     }
//   };
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ballflow/plugin.h"
#include "ballflow/sdk/summary.hpp"

namespace ballflow {

namespace detail {

inline bf_bytes bytes(std::string_view text) { return {text.data(), text.size()}; }
inline std::string_view view(bf_bytes text) { return {text.data, static_cast<std::size_t>(text.size)}; }

template <class T>
inline constexpr std::uint32_t dtype_of = 0;  // 0: no element type
template <>
inline constexpr std::uint32_t dtype_of<double> = BF_F64;
template <>
inline constexpr std::uint32_t dtype_of<float> = BF_F32;
template <>
inline constexpr std::uint32_t dtype_of<std::int64_t> = BF_I64;
template <>
inline constexpr std::uint32_t dtype_of<std::int32_t> = BF_I32;
template <>
inline constexpr std::uint32_t dtype_of<std::uint32_t> = BF_U32;
template <>
inline constexpr std::uint32_t dtype_of<std::uint16_t> = BF_U16;
template <>
inline constexpr std::uint32_t dtype_of<std::uint8_t> = BF_U8;

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

/// A piece of memory on its way out, with what keeps it alive.
struct Kept {
  const void* data = nullptr;
  std::size_t count = 0;
  std::shared_ptr<const void> owner;
};

/// Arrays on their way out. The receiver owes one release per array, as in bf_run.output.
class OutArrays {
 public:
  const std::vector<bf_array>& arrays() const { return arrays_; }
  /// `array` is filled but for what Kept tells. Takes no array when it throws.
  void add(bf_array array, Kept kept);

 private:
  std::vector<bf_array> arrays_;
};

/// What a declaration of a type says, and how its members are read and written. Members are known by their
/// offset in the struct, so that nothing here depends on it.
class AnyTypeDecl {
 public:
  struct Field {
    std::string name, doc, length;
    std::uint32_t dtype = 0;
    std::uint64_t width = 0;  // of an element; 0: one scalar
    bool scalar = false;      // one element instead of an array of them
    bool optional = false;
    std::size_t offset = 0;
    std::size_t size = 0;                                  // of one element in bytes
    Kept (*write)(const void* member) = nullptr;           // arrays only
    void (*read)(void* member, const Kept& in) = nullptr;  // arrays only
  };
  class ArrayRef {
   public:
    ArrayRef(AnyTypeDecl& decl, std::size_t index) : decl_(decl), index_(index) {}
    /// What an element means and its unit.
    ArrayRef& doc(std::string_view text);
    /// May be absent; an empty array is not written.
    ArrayRef& optional();
    /// Name of the length of the first dimension; arrays with equal names have equal lengths, "n+1" is
    /// one longer than "n".
    ArrayRef& length(std::string_view name);

   private:
    AnyTypeDecl& decl_;
    std::size_t index_;
  };
  /// The declaration as JSON, see node_decl.hpp.
  std::string json() const;
  const std::string& type_id() const { return id_; }
  int type_version() const { return version_; }

 protected:
  /// Fills the members of `value`. Throws NodeError when an array is missing or not as declared: whatever the
  /// artifact comes from, nothing is read that is not there.
  void read_into(void* value, const bf_artifact& artifact) const;
  OutArrays write_from(const void* value) const;
  Field& add(std::string_view name, std::uint32_t dtype, std::size_t width, std::size_t offset,
             std::size_t size);
  /// The field that was added last.
  ArrayRef last() { return {*this, fields_.size() - 1}; }

  std::string id_, doc_;
  int version_ = 0;
  std::vector<Field> fields_;
  std::vector<std::pair<std::string, std::string>> summary_;  // field, doc
};

/// Where a member lies in its struct.
template <class T, class M>
std::size_t offset_of(const T& object, const M& member) {
  return static_cast<std::size_t>(reinterpret_cast<const char*>(&member) -
                                  reinterpret_cast<const char*>(&object));
}

}  // namespace detail

/// Names the arrays and summary fields of an artifact type; filled by TypeOf<T>::declare.
template <class T>
class TypeDecl : public detail::AnyTypeDecl {
 public:
  TypeDecl& id(std::string_view name, int version) {
    id_ = name;
    version_ = version;
    return *this;
  }
  TypeDecl& doc(std::string_view text) {
    doc_ = text;
    return *this;
  }

  /// An array member of T.
  template <detail::SharedArray A>
  ArrayRef array(std::string_view name, A T::*member) {
    using Value = typename A::value_type;
    using E = detail::Element<Value>;
    constexpr std::uint32_t dtype = detail::dtype_of<typename E::Scalar>;
    static_assert(dtype != 0, "an array holds numbers of a type that bf_dtype names");
    Field& field = add(name, dtype, E::width, detail::offset_of(probe_, probe_.*member), sizeof(Value));
    field.length = name;
    field.write = [](const void* from) {
      const A& a = *static_cast<const A*>(from);
      auto keeper = std::make_shared<A>(a);
      const void* data = keeper->data();
      return detail::Kept{data, a.size(), std::move(keeper)};
    };
    field.read = [](void* to, const detail::Kept& in) {
      *static_cast<A*>(to) = A(static_cast<const Value*>(in.data), in.count, in.owner);
    };
    return last();
  }

  /// A number (rank 0) or a std::array of numbers (rank 1) of T.
  template <class V>
  ArrayRef scalar(std::string_view name, V T::*member) {
    using E = detail::Element<V>;
    constexpr std::uint32_t dtype = detail::dtype_of<typename E::Scalar>;
    static_assert(dtype != 0, "a scalar is a number of a type that bf_dtype names");
    static_assert(std::is_trivially_copyable_v<V>);
    Field& field = add(name, dtype, E::width, detail::offset_of(probe_, probe_.*member), sizeof(V));
    field.scalar = true;
    return last();
  }

  /// A field of the summary. Summaries are hashed: they hold nothing that is not a function of the input.
  TypeDecl& summary(std::string_view name, std::string_view doc) {
    summary_.emplace_back(name, doc);
    return *this;
  }
  /// Computes the summary of a value: an object with the fields declared by summary().
  TypeDecl& summarize(Summary (*function)(const T&)) {
    summarize_ = function;
    return *this;
  }
  /// Returns an empty string when every invariant holds, else what is wrong and where.
  TypeDecl& check(std::string (*function)(const T&)) {
    check_ = function;
    return *this;
  }

  T read(const bf_artifact& artifact) const {
    T value{};
    read_into(&value, artifact);
    return value;
  }
  detail::OutArrays write(const T& value) const { return write_from(&value); }
  Summary summary_of(const T& value) const { return summarize_ != nullptr ? summarize_(value) : Summary(); }
  std::string broken(const T& value) const { return check_ != nullptr ? check_(value) : std::string(); }

 private:
  T probe_{};  // tells where members lie
  Summary (*summarize_)(const T&) = nullptr;
  std::string (*check_)(const T&) = nullptr;
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

}  // namespace ballflow
