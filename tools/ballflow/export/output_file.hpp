// A file that appears whole or not at all.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace ballflow {

/// Collects a file in a temporary neighbor of `path`, which takes its place on commit. A path that is no
/// regular file (a pipe, /dev/stdout) is written directly. Every function throws Error (code store) when the
/// operating system refuses.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
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
  void flush();
  void write_through(const char* data, std::size_t size);
  [[noreturn]] void fail(int error) const;

  std::string path_, temporary_;  // temporary_ is empty when the path is written directly
  std::string buffer_;
  int file_ = -1;
};

}  // namespace ballflow
