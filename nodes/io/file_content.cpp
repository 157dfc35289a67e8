#include "io/file_content.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/monitor.hpp"
#include "io/unpack.hpp"

namespace ballflow::geometry {
namespace {

std::string quoted(const std::string& path) { return "\"" + path + "\""; }

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

FileContent read_plain(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    throw InputError("the file " + quoted(path) + " does not exist",
                     "check the spelling and the folder of the path");
  }
  if (error)
    throw InputError("the file " + quoted(path) + " cannot be read: " + error.message(),
                     "check its permissions");
  if (status.type() == fs::file_type::directory) {
    throw InputError(quoted(path) + " is a folder", "name a file inside it");
  }
  if (status.type() != fs::file_type::regular) {
    throw InputError(quoted(path) + " is not a regular file", "copy the data into a file");
  }
  const std::uintmax_t size = fs::file_size(path, error);
  const std::unique_ptr<std::FILE, FileCloser> file(error ? nullptr : std::fopen(path.c_str(), "rb"));
  if (!file) {
    throw InputError(
        "the file " + quoted(path) + " cannot be read: " + (error ? error.message() : std::strerror(errno)),
        "check its permissions");
  }
  if (size == 0) throw InputError("the file " + quoted(path) + " is empty", "write it again");
  std::unique_ptr<char[]> data(new char[size]);
  if (std::fread(data.get(), 1, size, file.get()) != size) {
    throw InputError("the file " + quoted(path) + " could not be read to its end",
                     "was it changed meanwhile? try again");
  }
  return {std::move(data), static_cast<std::size_t>(size)};
}

struct Mark {
  std::string_view bytes;
  const char* name;
};

/// Text of two or four bytes a character, told by its mark or by the zero bytes of its first characters;
/// empty for other content.
std::string_view wide_encoding(std::string_view content) {
  static constexpr std::array marks = {Mark{{"\xff\xfe\0\0", 4}, "UTF-32"},
                                       Mark{{"\0\0\xfe\xff", 4}, "UTF-32"}, Mark{"\xff\xfe", "UTF-16"},
                                       Mark{"\xfe\xff", "UTF-16"}};
  const std::string_view start = content.substr(0, 64);
  const auto is_text = [](char c) { return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r'); };
  for (const Mark& mark : marks) {
    if (!start.starts_with(mark.bytes)) continue;
    // Headers of binary files may begin with anything; text has letters, digits and blanks, each with zeros.
    const std::string_view rest = start.substr(mark.bytes.size());
    const auto zeros = static_cast<std::size_t>(std::count(rest.begin(), rest.end(), '\0'));
    const auto texts = static_cast<std::size_t>(std::count_if(rest.begin(), rest.end(), is_text));
    if (texts > 0 && zeros >= texts && zeros + texts == rest.size()) return mark.name;
  }
  if (start.size() < 16) return {};
  for (const std::size_t zero : {std::size_t{0}, std::size_t{1}}) {
    bool wide = true;
    for (std::size_t i = 0; i < start.size() && wide; ++i) {
      wide = i % 2 == zero ? start[i] == '\0' : is_text(start[i]);
    }
    if (wide) return "UTF-16";
  }
  return {};
}

/// How many bytes of a UTF-8 byte order mark come before the text.
std::size_t size_of_mark(std::string_view content) {
  constexpr std::string_view mark = "\xef\xbb\xbf";
  if (!content.starts_with(mark)) return 0;
  const std::string_view line = content.substr(0, content.find_first_of("\r\n"));
  return line.find('\0') == std::string_view::npos ? mark.size() : 0;
}

}  // namespace

FileContent read_file_content(const std::string& path, std::int64_t max_unpacked_bytes) {
  FileContent content = unpacked(quoted(path), read_plain(path), max_unpacked_bytes);
  if (const std::string_view encoding = wide_encoding(content.view()); !encoding.empty()) {
    throw InputError("the text of " + quoted(path) + " is in " + std::string(encoding),
                     "save it as UTF-8 or plain ASCII");
  }
  content.skip(size_of_mark(content.view()));
  if (content.view().empty()) throw InputError("the file " + quoted(path) + " is empty", "write it again");
  return content;
}

}  // namespace ballflow::geometry
