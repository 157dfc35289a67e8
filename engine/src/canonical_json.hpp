// Pieces of canonical JSON (ballflow/artifact.hpp) for those who write it themselves.
#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <type_traits>

#include "ballflow/node_decl.hpp"

namespace ballflow {

/// Appends a text in quotes.
void write_string(std::string_view text, std::string& out);

template <class Number>
void write_number(Number value, std::string& out) {
  std::array<char, 64> text;
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  const std::string_view shown(text.data(), static_cast<std::size_t>(end - text.data()));
  out += shown;
  if (std::is_floating_point_v<Number> && shown.find_first_of(".e") == std::string_view::npos) out += ".0";
}

/// Appends a value in one line, objects in the order of their members. A serializer is set up for arrays and
/// objects only: parameters are numbers and texts as a rule.
void write_value(const Json& value, std::string& out);

/// A piece of foreign text for a message: shortened, unprintable characters replaced.
std::string shown_text(std::string_view text);

}  // namespace ballflow
