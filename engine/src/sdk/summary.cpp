#include "ballflow/sdk/summary.hpp"

#include <charconv>
#include <cmath>

#include "sdk/json_writer.hpp"

namespace ballflow {

namespace detail {

void write_json_string(std::string& json, std::string_view text) {
  constexpr const char* hex = "0123456789abcdef";
  json += '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      json += '\\';
      json += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += "\\u00";
      json += hex[static_cast<unsigned char>(c) >> 4];
      json += hex[c & 15];
    } else {
      json += c;
    }
  }
  json += '"';
}

void write_json_name(std::string& json, std::string_view name) {
  if (!json.empty() && json.back() != '{') json += ',';
  write_json_string(json, name);
  json += ':';
}

void write_json_text(std::string& json, std::string_view name, std::string_view text) {
  write_json_name(json, name);
  write_json_string(json, text);
}

void write_json_value(std::string& json, std::string_view name, std::string_view value) {
  write_json_name(json, name);
  json += value;
}

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[32];
  std::string number(text, std::to_chars(text, text + sizeof text, value).ptr);
  if (number.find_first_of(".e") == std::string::npos) number += ".0";
  return number;
}

}  // namespace detail

SummaryValue::SummaryValue(double value) : text_(detail::json_number(value)) {}

SummaryValue::SummaryValue(std::string_view value) { detail::write_json_string(text_, value); }

std::string SummaryValue::integer(std::int64_t value) { return std::to_string(value); }
std::string SummaryValue::integer(std::uint64_t value) { return std::to_string(value); }

void SummaryValue::append(const SummaryValue& value) {
  text_ += text_.empty() ? '[' : ',';
  text_ += value.text_;
}

Summary::Summary(std::initializer_list<Field> fields) {
  for (const Field& field : fields) (*this)[field.name] = field.value;
}

SummaryValue& Summary::operator[](std::string_view name) {
  for (auto& [known, value] : fields_) {
    if (known == name) return value;
  }
  return fields_.emplace_back(name, nullptr).second;
}

void Summary::update(const Summary& other) {
  for (const auto& [name, value] : other.fields_) (*this)[name] = value;
}

std::string Summary::text() const {
  std::string json = "{";
  for (const auto& [name, value] : fields_) detail::write_json_value(json, name, value.text());
  return json + "}";
}

}  // namespace ballflow
