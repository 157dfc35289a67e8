#include "io/text_cursor.hpp"

#include <charconv>
#include <cmath>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

const char* spelled(double value) { return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf"; }

[[noreturn]] void refuse_coordinate(
    const char* element, std::int64_t number, const std::string& rest,
    const char* hint = "repair or remove it; coordinates must be finite numbers") {
  throw InputError(std::string(element) + " " + std::to_string(number) + ": " + rest, hint);
}

/// "1,5"
bool has_decimal_comma(std::string_view token) {
  const std::size_t comma = token.find(',');
  if (comma == std::string_view::npos || token.find(',', comma + 1) != std::string_view::npos) return false;
  std::string with_point(token);
  with_point[comma] = '.';
  return parse_real(with_point).has_value();
}

std::string_view without_plus(std::string_view token) {
  return token.size() > 1 && token[0] == '+' && token[1] != '-' ? token.substr(1) : token;
}

}  // namespace

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* first = at_;
  while (at_ != end_ && !line_end(*at_)) ++at_;
  const char* last = at_;
  while (last != first && blank(last[-1])) --last;
  return {first, static_cast<std::size_t>(last - first)};
}

std::int64_t TextCursor::line_of(std::string_view token) const {
  std::int64_t line = 1;
  for (const char* p = begin_; p < token.data(); ++p) {
    if (*p == '\n' || (*p == '\r' && (p + 1 == end_ || p[1] != '\n'))) ++line;
  }
  return line;
}

std::optional<double> parse_real(std::string_view token) {
  token = without_plus(token);
  double value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (end != token.data() + token.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // Both 1e999 and 1e-999 end up here; the latter is zero for our purposes.
    const std::size_t exponent = token.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos ? token.find_first_of("123456789") > token.find('.')
                                                         : token.substr(exponent + 1).starts_with('-');
    return tiny ? std::optional(0.0) : std::nullopt;
  }
  return value;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
  token = without_plus(token);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
  if (error != std::errc() || end != token.data() + token.size()) return std::nullopt;
  return value;
}

double parse_coordinate(const TextCursor& cursor, std::string_view token, const char* element,
                        std::int64_t number, const char* name) {
  const auto value = parse_real(token);
  if (value && std::isfinite(*value)) return *value;
  const std::string place = cursor.place_of(token);
  if (value) refuse_coordinate(element, number, std::string(name) + " is " + spelled(*value) + place);
  if (token.empty()) refuse_coordinate(element, number, std::string(name) + " is missing" + place);
  refuse_coordinate(element, number, std::string(name) + " is " + excerpt(token) + ", not a number" + place,
                    has_decimal_comma(token)
                        ? "it has a decimal comma: write the file again with decimal points"
                        : "repair or remove it; coordinates must be finite numbers");
}

void require_finite(const Vec3& p, const char* element, std::int64_t number, const std::string& place) {
  if (!std::isfinite(p.x)) refuse_coordinate(element, number, std::string("x is ") + spelled(p.x) + place);
  if (!std::isfinite(p.y)) refuse_coordinate(element, number, std::string("y is ") + spelled(p.y) + place);
  if (!std::isfinite(p.z)) refuse_coordinate(element, number, std::string("z is ") + spelled(p.z) + place);
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string result = "\"";
  for (const char c : text.substr(0, longest)) result += c >= ' ' && c <= '~' ? c : '?';
  return result + (text.size() > longest ? "...\"" : "\"");
}

}  // namespace ballflow::geometry
