// The sources that node declarations cite.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace ballflow::report {

struct Source {
  std::string kind;                           // "article"
  std::map<std::string, std::string> fields;  // names in lower case, values without braces

  /// "Amenta, N. and Bern, M.: ..." in one line, plain text.
  std::string text() const;
};

/// Reads BibTeX: entries with values in braces or quotes. Throws Error (code store) that names the line of
/// what it cannot read.
std::map<std::string, Source> parse_bibtex(std::string_view text);

/// The sources of the built-in nodes (nodes/refs.bib), by key.
const std::map<std::string, Source>& built_in_sources();

}  // namespace ballflow::report
