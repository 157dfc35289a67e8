// A file of the user that appears whole or not at all.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

namespace ballflow {

class FileSystem;

/// Collects a file in a temporary neighbour of `path` (base/draft.hpp), which takes its place on commit:
/// readers see the old or the new content, never a part, and without a commit nothing has happened.
///
/// A path that is a link stays one: what it points to is replaced. A pipe or a device (/dev/stdout) is
/// written as it is, in order. Every function throws Error (code store) when the operating system refuses.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path, std::shared_ptr<FileSystem> files = {});
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* data, std::size_t size);
  /// The bytes of a number, little-endian.
  template <class T>
  requires std::is_arithmetic_v<T>
  void raw(T value) {
    static_assert(std::endian::native == std::endian::little);
    write(&value, sizeof value);
  }
  OutputFile& operator<<(std::string_view text) {
    write(text.data(), text.size());
    return *this;
  }
  OutputFile& operator<<(char c) {
    write(&c, 1);
    return *this;
  }
  /// The shortest decimal that reads back as `value`.
  OutputFile& operator<<(double value);
  template <std::integral I>
  OutputFile& operator<<(I value) {
    return *this << std::string_view(std::to_string(value));
  }

  void commit();

 private:
  struct Target;

  void flush();
  void write_through(const char* data, std::size_t size);
  [[noreturn]] void fail(int negative_errno) const;

  std::string path_;  // of what is replaced
  std::unique_ptr<Target> target_;
  std::string buffer_;
};

/// The same for content that is there already.
void write_atomically(const std::string& path, std::string_view content);

}  // namespace ballflow
