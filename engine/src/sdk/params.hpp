// Parameters as they reach a node: one flat JSON object of numbers, booleans and texts.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace ballflow::detail {

struct ParamValue {
  enum class Kind { null, boolean, integer, number, string } kind = Kind::null;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  // of integers too
  std::string text;
};

/// Throws std::invalid_argument when `json` is anything else.
std::map<std::string, ParamValue, std::less<>> read_params(std::string_view json);

}  // namespace ballflow::detail
