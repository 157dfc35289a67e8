// Packed content.
#pragma once

#include <cstdint>
#include <string>

#include "io/file_content.hpp"

namespace ballflow::geometry {

/// The content itself, or what it holds when it is packed with gzip or zstd; `name` is that of the file in
/// messages. See read_file_content for what is refused.
FileContent unpacked(const std::string& name, FileContent content, std::int64_t max_bytes);

}  // namespace ballflow::geometry
