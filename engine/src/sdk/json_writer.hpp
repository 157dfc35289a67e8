// JSON as the SDK writes it: straight into a text.
#pragma once

#include <string>
#include <string_view>

namespace ballflow::detail {

/// Appends `text` in quotes.
void write_json_string(std::string& json, std::string_view text);
/// Appends ,"name": to an object, without the comma behind an opening brace.
void write_json_name(std::string& json, std::string_view name);
/// Appends ,"name":"text".
void write_json_text(std::string& json, std::string_view name, std::string_view text);
/// Appends ,"name":value with a value that is JSON already.
void write_json_value(std::string& json, std::string_view name, std::string_view value);
/// A number that reads back as the same double; null for NaN and infinities. Whole numbers end in ".0".
std::string json_number(double value);

}  // namespace ballflow::detail
