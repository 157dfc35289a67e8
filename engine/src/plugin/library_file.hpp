// The content of the files of node libraries.
#pragma once

#include <string>

#include "ballflow/digest.hpp"

namespace ballflow {

/// SHA-256 of the library at `real_path`, as it was when this process first asked: the loader keeps the code
/// of that moment for as long as the process lives, whatever happens to the file. Throws Error (code plugin)
/// when the file cannot be read.
Digest library_digest(const std::string& real_path);

}  // namespace ballflow
