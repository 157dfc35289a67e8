#include "ballflow/error.hpp"

#include <algorithm>

#include "base/quote.hpp"

namespace ballflow {

namespace {

/// The line and a caret below its column, cut to a window of a terminal's width.
std::string with_caret(const std::string& line, std::size_t column) {
  constexpr std::size_t window = 100, context = 60;
  if (column > line.size() + 1) return {};
  const std::size_t begin = column > window ? column - context : 0;
  std::string shown = line.substr(begin, window);
  std::replace(shown.begin(), shown.end(), '\t', ' ');
  std::string pad;
  // One column per character, not per byte: continuation bytes take no room.
  for (std::size_t i = begin; i + 1 < column; ++i) {
    if ((static_cast<unsigned char>(line[i]) & 0xc0) != 0x80) pad += ' ';
  }
  return "\n    " + printable(shown) + "\n    " + pad + "^";
}

std::string joined(const std::vector<Diagnostic>& findings) {
  std::string text;
  for (const Diagnostic& finding : findings) text += (text.empty() ? "" : "\n") + finding.text();
  return text;
}

}  // namespace

std::string Diagnostic::text() const {
  std::string result = printable(file);
  if (line > 0) result += ":" + std::to_string(line) + ":" + std::to_string(column);
  if (!result.empty()) result += ": ";
  result += severity == Severity::error ? "error: " : "warning: ";
  result += message;
  constexpr std::size_t longest_pointer = 200;
  if (!pointer.empty() && pointer.size() <= longest_pointer) result += " (at " + printable(pointer) + ")";
  if (!source_line.empty() && column > 0) result += with_caret(source_line, static_cast<std::size_t>(column));
  if (!hint.empty()) result += "\n  " + hint;
  return result;
}

GraphError::GraphError(std::vector<Diagnostic> findings)
    : Error(ExitCode::usage, joined(findings)), findings_(std::move(findings)) {}

}  // namespace ballflow
