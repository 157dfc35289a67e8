// The bytes of a file, unpacked when it is gzipped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ballflow::geometry {

class FileContent {
 public:
  FileContent() = default;
  FileContent(std::unique_ptr<char[]> data, std::size_t size) : data_(std::move(data)), size_(size) {}
  std::string_view view() const { return {data_.get(), size_}; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0;
};

/// Reads the whole file. Content that begins with the gzip magic number is unpacked (several members are
/// joined), to at most `max_unpacked_bytes`.
///
/// Throws InputError for a missing, unreadable or empty file, for a folder or device, and for a gzip stream
/// that is damaged, cut off, followed by other bytes, or larger than allowed.
FileContent read_file_content(const std::string& path, std::int64_t max_unpacked_bytes);

}  // namespace ballflow::geometry
