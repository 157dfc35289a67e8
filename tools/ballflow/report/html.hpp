// Text in pages.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace ballflow::report {

/// `text` as it must stand in HTML or SVG, in an attribute too: nothing in it is markup any more. Bytes that
/// are no UTF-8 and control characters become U+FFFD.
std::string escaped(std::string_view text);

/// "35 676", "0.0123", "1.3e-07": at most four significant digits of numbers that are no integers.
std::string number(double value);

/// A value of a report: texts without quotes, a dash where there is none.
std::string shown(const nlohmann::json& value);

}  // namespace ballflow::report
