#include "store/usage.hpp"

#include <algorithm>
#include <charconv>

namespace ballflow {
namespace {

constexpr const char* usage_file = "usage";
constexpr std::uint64_t most_bytes = 1u << 20;   // of the file
constexpr std::uint64_t account_at = 64u << 20;  // lost from the count at most when a process is killed
constexpr int write_flags = O_WRONLY | O_CREAT | O_APPEND | O_NOFOLLOW | O_NONBLOCK;

/// In one call, so that lines of several processes do not mix.
void write_line(const StoreFolders& folders, int flags, const std::string& line) {
  const OpenFile file(*folders.files, folders.files->open(folders.root.get(), usage_file, flags, 0644));
  if (file.is_open()) folders.files->write(file.get(), line.data(), line.size());
}

}  // namespace

void WrittenBytes::add(std::uint64_t file_bytes) {
  const std::uint64_t more = disk_bytes(file_bytes);
  if (bytes_.fetch_add(more) + more >= account_at) account();
}

void WrittenBytes::account() {
  if (const std::uint64_t bytes = bytes_.exchange(0); bytes != 0) {
    write_line(folders_, write_flags, '+' + std::to_string(bytes) + '\n');
  }
}

Usage read_usage(const StoreFolders& folders) {
  const auto text = read_trusted(folders, folders.root, usage_file, most_bytes);
  if (!text) return {};
  Usage usage;
  // A line that is cut off or unknown is skipped: the total is approximate anyway.
  for (std::size_t begin = 0, end; (end = text->find('\n', begin)) != std::string::npos; begin = end + 1) {
    const char* const last = text->data() + end;
    const char* next = text->data() + begin;
    if (next == last) continue;
    const char kind = *next++;
    std::uint64_t bytes = 0;
    const auto number = std::from_chars(next, last, bytes);
    if (number.ec != std::errc()) continue;
    if (kind == '+') {
      usage.bytes = bytes > UINT64_MAX - usage.bytes ? UINT64_MAX : usage.bytes + bytes;
      usage.written = true;
    } else if (kind == '=' && number.ptr != last) {
      std::int64_t seconds = 0;
      if (std::from_chars(number.ptr + 1, last, seconds).ec != std::errc()) continue;
      usage = {true, bytes, false, std::clamp<std::int64_t>(seconds, 0, INT64_MAX / second) * second};
    }
  }
  return usage;
}

void write_usage(const StoreFolders& folders, std::uint64_t bytes) {
  const std::int64_t now = folders.files->now() / second;
  write_line(folders, write_flags | O_TRUNC, '=' + std::to_string(bytes) + ' ' + std::to_string(now) + '\n');
}

}  // namespace ballflow
