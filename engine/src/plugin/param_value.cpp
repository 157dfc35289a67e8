#include "plugin/param_value.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/quote.hpp"

namespace ballflow {

std::string ParamDecl::refuse(const Json& value) const {
  switch (kind) {
    case ParamKind::number:
    case ParamKind::integer: {
      if (!value.is_number())
        return std::string("must be ") + (kind == ParamKind::number ? "a number, " : "a whole number, ") +
               described(value);
      const double number = value.get<double>();
      if (!std::isfinite(number)) return "must be a finite number, " + described(value);
      if (kind == ParamKind::integer) {
        constexpr double exact = 9007199254740992.0;  // beyond 2^53 a double is no particular integer
        if (value.is_number_float() && (number != std::floor(number) || std::abs(number) > exact)) {
          return "must be a whole number, " + described(value);
        }
        if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX}) {
          return "must fit 64 bits with sign, " + described(value);
        }
      }
      if (minimum && number < *minimum)
        return "must be at least " + shortest(*minimum) + ", " + described(value);
      if (maximum && number > *maximum)
        return "must be at most " + shortest(*maximum) + ", " + described(value);
      if (exclusive_minimum && number <= *exclusive_minimum)
        return "must be more than " + shortest(*exclusive_minimum) + ", " + described(value);
      if (exclusive_maximum && number >= *exclusive_maximum)
        return "must be less than " + shortest(*exclusive_maximum) + ", " + described(value);
      return {};
    }
    case ParamKind::boolean:
      return value.is_boolean() ? std::string() : "must be true or false, " + described(value);
    case ParamKind::choice: {
      std::vector<std::string> names;
      for (const auto& choice : choices) {
        if (value.is_string() && value.get_ref<const std::string&>() == choice.first) return {};
        names.push_back(choice.first);
      }
      return "must be one of " + listed(names, 30) + ", " + described(value);
    }
    case ParamKind::string:
      return value.is_string() ? std::string() : "must be a text, " + described(value);
    case ParamKind::file:
      if (!value.is_string()) return "must be the path of a file, " + described(value);
      if (value.get_ref<const std::string&>().find('\0') != std::string::npos)
        return "must be the path of a file, contains a NUL character";
      if (required && value.get_ref<const std::string&>().empty())
        return "must be the path of a file, is empty";
      return {};
    case ParamKind::list:
    case ParamKind::files: {
      const bool files = kind == ParamKind::files;
      if (!value.is_array())
        return std::string("must be a list of ") + (files ? "files, " : "texts, ") + described(value);
      for (std::size_t i = 0; i < value.size(); ++i) {
        const Json& entry = value[i];
        if (files ? !entry.is_string() || entry.get_ref<const std::string&>().empty() ||
                        entry.get_ref<const std::string&>().find('\0') != std::string::npos
                  : entry.is_structured() || entry.is_null()) {
          return std::string("must be a list of ") + (files ? "files, " : "texts, ") + "its entry " +
                 std::to_string(i + 1) + " " + described(entry);
        }
      }
      return {};
    }
    case ParamKind::artifact:
      if (value.is_string() && !value.get_ref<const std::string&>().empty() &&
          value.get_ref<const std::string&>().find('\0') == std::string::npos) {
        return {};
      }
      return "must be the digest or the file of an artifact, " + described(value);
  }
  return "is of an unknown kind";
}

Json normalised(const ParamDecl& param, const Json& value) {
  if (param.kind == ParamKind::number) return value.get<double>() + 0.0;  // -0 + 0 is 0
  if (param.kind == ParamKind::integer) {
    return value.is_number_float() ? static_cast<std::int64_t>(value.get<double>())
                                   : value.get<std::int64_t>();
  }
  if (param.kind == ParamKind::list) {
    Json texts = Json::array();
    for (const Json& entry : value) texts.push_back(plain_text(entry));
    return texts;
  }
  return value;
}

namespace {

/// "a,b,c", or a JSON list, whose entries may have commas.
bool list_from_text(const std::string& text, Json& value) {
  if (text.starts_with("[")) {
    value = Json::parse(text, nullptr, false);
    return value.is_array();
  }
  value = Json::array();
  for (std::size_t begin = 0; begin <= text.size() && !text.empty();) {
    const std::size_t comma = std::min(text.find(',', begin), text.size());
    value.push_back(text.substr(begin, comma - begin));
    begin = comma + 1;
  }
  return true;
}

}  // namespace

bool from_text(const ParamDecl& param, const std::string& text, Json& value) {
  const char* end = text.data() + text.size();
  switch (param.kind) {
    case ParamKind::number: {
      double number = 0;
      const auto [stop, error] = std::from_chars(text.data(), end, number);
      if (text.empty() || stop != end || error != std::errc() || !std::isfinite(number)) return false;
      value = number;
      return true;
    }
    case ParamKind::integer: {
      std::int64_t number = 0;
      const auto [stop, error] = std::from_chars(text.data(), end, number);
      if (text.empty() || stop != end || error != std::errc()) return false;
      value = number;
      return true;
    }
    case ParamKind::boolean:
      if (text != "true" && text != "false") return false;
      value = text == "true";
      return true;
    case ParamKind::list:
    case ParamKind::files:
      return list_from_text(text, value);
    default:
      value = text;
      return true;
  }
}

namespace {
constexpr std::array<const char*, 9> kind_names = {"number", "integer", "boolean", "string",  "choice",
                                                   "file",   "list",    "files",   "artifact"};
}

const char* kind_name(ParamKind kind) { return kind_names[static_cast<std::size_t>(kind)]; }

bool kind_from_name(std::string_view name, ParamKind& kind) {
  for (std::size_t i = 0; i < kind_names.size(); ++i) {
    if (name == kind_names[i]) {
      kind = static_cast<ParamKind>(i);
      return true;
    }
  }
  return false;
}

}  // namespace ballflow
