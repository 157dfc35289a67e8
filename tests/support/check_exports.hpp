// Exported files against the artifacts they were made from.
#pragma once

#include <string>

#include "process.hpp"
#include "test_data.hpp"

namespace ballflow::test {

inline bool has_python() { return run_process({"/usr/bin/env", "python3", "--version"}).exit_code == 0; }

/// Runs check_exports.py: a line "equal TYPE FORMAT" or "DIFFERENT ..." for every file in the folder that
/// lies beside a .safetensors file of the same name.
inline ProcessResult check_exports(const TempFolder& folder) {
  return run_process(
      {"/usr/bin/env", "python3", source_file("tests/support/check_exports.py"), folder.path()});
}

/// How often `word` occurs.
inline std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

}  // namespace ballflow::test
