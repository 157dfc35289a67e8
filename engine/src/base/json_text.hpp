// JSON text with places: a small tree that knows where every key and value was written. Comments (// and
// /* */) and a UTF-8 byte order mark are accepted; everything else is RFC 8259.
//
// nlohmann's own tree keeps no places, takes the last of two equal keys, and recurses on printing; its SAX
// parser does none of this, and untrusted text goes through that only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ballflow/error.hpp"
#include "ballflow/json.hpp"

namespace ballflow::json_text {

constexpr std::size_t max_size = std::size_t{64} << 20;  // bytes; offsets fit 32 bits
constexpr std::size_t max_depth = 100;
constexpr std::size_t max_values = 8'000'000;

struct Position {
  int line = 0, column = 0;  // 1-based, bytes
};

/// A text and where its lines begin.
class Source {
 public:
  Source(std::string file, std::string content);
  const std::string& file() const { return file_; }
  std::string_view content() const { return content_; }
  Position position(std::size_t offset) const;
  /// The line around `offset`, at most 400 bytes of it.
  std::string line(std::size_t offset) const;

 private:
  std::string file_, content_;
  std::vector<std::uint32_t> lines_;
};

struct Member;

/// A value of the text. Offsets are bytes from the start of the text.
struct Value {
  std::uint32_t offset = 0, end = 0;
  Json scalar;                  // null, a boolean, a number or a text; an empty array or object for those
  std::vector<Member> members;  // of an object or array, in order of the text

  bool is_object() const { return scalar.is_object(); }
  bool is_array() const { return scalar.is_array(); }
  bool is_string() const { return scalar.is_string(); }
  const std::string& string() const { return scalar.get_ref<const std::string&>(); }
  const Value* find(std::string_view key) const;
  /// The whole value as JSON.
  Json json() const;
};

struct Member {
  std::string key;           // empty in arrays
  std::uint32_t offset = 0;  // of the key; in arrays, of the value
  Value value;
};

/// Reads a text. Syntax errors and broken limits give one finding and return false; duplicate keys give
/// one finding each and the first member stays (`root` has no duplicates).
bool parse(const Source& source, Value& root, std::vector<Diagnostic>& findings);

/// A finding about the place `offset` of a text that was read.
Diagnostic finding(const Source& source, const Value& root, std::uint32_t offset, std::string message,
                   std::string hint = {}, Diagnostic::Severity severity = Diagnostic::Severity::error);

/// The RFC 6901 pointer of the innermost member that begins at or around `offset`.
std::string pointer(const Value& root, std::uint32_t offset);
std::string escape_pointer(std::string_view key);

}  // namespace ballflow::json_text
