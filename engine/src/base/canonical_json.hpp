// Pieces of canonical JSON (ballflow/canonical_json.hpp) for those who write it themselves.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <string>
#include <string_view>

#include "ballflow/canonical_json.hpp"
#include "ballflow/json.hpp"

namespace ballflow {

/// Appends a text in quotes.
void write_string(std::string_view text, std::string& out);

template <std::integral Number>
void write_number(Number value, std::string& out) {
  std::array<char, 24> text;
  out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

/// As canonical_json() does: RFC 8785, section 3.2.2.3, which is Number::toString of ECMAScript. `value` is
/// finite.
void write_number(double value, std::string& out);

/// For key manifests (ballflow/key.hpp), whose bytes tell a number that is a double from an integer: always
/// with a point or an exponent. `value` is finite.
void write_double(double value, std::string& out);

/// Appends a value of a key manifest in one line, objects in the order of their members. A serializer is set
/// up for arrays and objects only: parameters are numbers and texts as a rule.
void write_value(const Json& value, std::string& out);

/// A piece of foreign text for a message: shortened, unprintable characters replaced.
std::string shown_text(std::string_view text);

}  // namespace ballflow
