#include "report/html.hpp"

#include <cmath>
#include <cstdint>
#include <cstdio>

namespace ballflow::report {
namespace {

/// Length of the UTF-8 sequence at the start of `text`, 0 when there is none.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  std::size_t length = 0;
  std::uint32_t point = 0, least = 0;
  if (byte(0) < 0x80) return 1;
  if (byte(0) >= 0xc2 && byte(0) < 0xe0) {
    length = 2, point = byte(0) & 0x1fu, least = 0x80;
  } else if (byte(0) >= 0xe0 && byte(0) < 0xf0) {
    length = 3, point = byte(0) & 0x0fu, least = 0x800;
  } else if (byte(0) >= 0xf0 && byte(0) < 0xf5) {
    length = 4, point = byte(0) & 0x07u, least = 0x10000;
  } else {
    return 0;
  }
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
    point = point << 6 | (byte(i) & 0x3fu);
  }
  const bool surrogate = point >= 0xd800 && point < 0xe000;
  return point < least || point > 0x10ffff || surrogate ? 0 : length;
}

}  // namespace

std::string escaped(std::string_view text) {
  constexpr std::string_view replacement = "\xef\xbf\xbd";
  std::string out;
  while (!text.empty()) {
    const char c = text.front();
    const std::size_t length = sequence_length(text);
    if (length != 1) {
      out += length == 0 ? replacement : text.substr(0, length);
    } else if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\'') {
      out += "&#39;";
    } else if ((c >= 0 && c < 0x20 && c != '\n' && c != '\t') || c == 0x7f) {
      out += replacement;
    } else {
      out += c;
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return out;
}

std::string number(double value) {
  char text[64];
  if (std::nearbyint(value) == value && std::abs(value) < 1e15) {
    std::snprintf(text, sizeof text, "%.0f", value);
    std::string digits = text;
    if (digits == "-0") return "0";
    const std::size_t first = digits[0] == '-' ? 1 : 0;
    for (std::size_t at = digits.size(); at > first + 3;) digits.insert(at -= 3, "\xe2\x80\xaf");
    return digits;
  }
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string shown(const nlohmann::json& value) {
  if (value.is_null()) return "\xe2\x80\x93";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return number(value.get<double>());
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ballflow::report
