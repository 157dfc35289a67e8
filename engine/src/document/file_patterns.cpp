#include "document/file_patterns.hpp"

#include <glob.h>

#include <filesystem>

#include "base/quote.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

/// Not "a.ply", and not "shape:torus?n=4000", which no file is named like.
bool is_pattern(const std::string& text) {
  const std::size_t colon = text.find(':');
  return text.find_first_of("*?[") != std::string::npos &&
         (colon == std::string::npos || !is_identifier(text.substr(0, colon)));
}

}  // namespace

std::vector<std::string> matching_files(const std::string& text) {
  std::error_code unknown;
  if (!is_pattern(text) || fs::is_regular_file(text, unknown)) return {text};
  std::vector<std::string> paths;
  glob_t matches{};
  if (::glob(text.c_str(), 0, nullptr, &matches) == 0) {
    std::error_code ignored;
    for (std::size_t i = 0; i < matches.gl_pathc; ++i) {
      if (!fs::is_directory(matches.gl_pathv[i], ignored)) paths.emplace_back(matches.gl_pathv[i]);
    }
  }
  ::globfree(&matches);
  return paths;
}

}  // namespace ballflow
