// Patterns of file names, as shells have them.
#pragma once

#include <string>
#include <vector>

namespace ballflow {

/// The files that match a pattern with *, ? or [...], relative to the current directory, sorted; none when
/// there are none. What is no pattern, and what is there under just this name ("scan [1].off"), is itself,
/// whether it is there or not: "shape:torus?n=4000" is no pattern.
std::vector<std::string> matching_files(const std::string& text);

}  // namespace ballflow
