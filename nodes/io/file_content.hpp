// The bytes of a file, unpacked when it is packed, without the mark of its encoding.
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
  std::string_view view() const { return {data_.get() + begin_, size_ - begin_}; }
  /// Leaves out the first bytes, at most all.
  void skip(std::size_t bytes) { begin_ += bytes; }

 private:
  std::unique_ptr<char[]> data_;
  std::size_t size_ = 0, begin_ = 0;
};

/// Reads the whole file: the one way in which readers of models, balls and covers get at content.
///
/// - Content that begins with the magic number of gzip or zstd is unpacked (several members or frames are
///   joined), to at most `max_unpacked_bytes`, whatever the file is called.
/// - A UTF-8 byte order mark before text is skipped. It counts as text when no zero byte comes before the end
///   of the first line: the header of a binary STL file may begin with any bytes.
///
/// Throws InputError for a missing, unreadable or empty file, for a folder or device; for a packed stream
/// that is damaged, cut off, followed by other bytes, or larger than allowed; for bzip2, xz, ZIP, 7z and RAR;
/// and for text in UTF-16 or UTF-32, with a byte order mark or without one.
FileContent read_file_content(const std::string& path, std::int64_t max_unpacked_bytes);

}  // namespace ballflow::geometry
