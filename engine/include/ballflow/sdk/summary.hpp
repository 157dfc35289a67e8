// Small JSON values that a node or type writes: the summary of an artifact, defaults of parameters. They are
// kept as text, so that no JSON library is compiled into every adapter.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ballflow {

/// null, a boolean, a number (NaN and infinities are null), a text, or a list of these.
class SummaryValue {
 public:
  // NOLINTBEGIN(google-explicit-constructor): a number is a value
  SummaryValue(std::nullptr_t = nullptr) : text_("null") {}
  template <std::same_as<bool> B>
  SummaryValue(B value) : text_(value ? "true" : "false") {}
  template <class I>
  requires(std::is_integral_v<I> && !std::is_same_v<I, bool>) SummaryValue(I value) : text_(integer(value)) {}
  SummaryValue(double value);
  SummaryValue(std::string_view value);
  SummaryValue(const std::string& value) : SummaryValue(std::string_view(value)) {}
  SummaryValue(const char* value) : SummaryValue(std::string_view(value)) {}
  /// A std::array, std::vector, or any other range of values.
  template <class R>
  requires requires(const R& r) {
    r.begin();
    r.end();
    r.size();
  } &&(!std::is_convertible_v<R, std::string_view>)SummaryValue(const R& values) {
    for (const auto& value : values) append(SummaryValue(value));
    text_ += text_.empty() ? "[]" : "]";
  }
  // NOLINTEND

  /// JSON.
  const std::string& text() const { return text_; }

 private:
  static std::string integer(std::int64_t value);
  static std::string integer(std::uint64_t value);
  template <class I>
  static std::string integer(I value) {
    if constexpr (std::is_signed_v<I>) {
      return integer(static_cast<std::int64_t>(value));
    } else {
      return integer(static_cast<std::uint64_t>(value));
    }
  }
  void append(const SummaryValue& value);
  std::string text_;
};

/// A JSON object. Summaries are hashed: they hold nothing that is not a function of the input.
class Summary {
 public:
  struct Field {
    std::string_view name;
    SummaryValue value;
  };
  Summary() = default;
  Summary(std::initializer_list<Field> fields);

  /// The field of this name, added (null) where it is new.
  SummaryValue& operator[](std::string_view name);
  /// Takes the fields of `other`, also where it has them already.
  void update(const Summary& other);
  bool empty() const { return fields_.empty(); }
  /// JSON.
  std::string text() const;

 private:
  std::vector<std::pair<std::string, SummaryValue>> fields_;
};

}  // namespace ballflow
