#include "io/file_content.hpp"

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 30;  // of one call of zlib, whose counters have 32 bits

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

class Inflater {
 public:
  Inflater() {
    if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  z_stream stream{};
};

FileContent unpack(const std::string& path, std::string_view packed, std::int64_t max_bytes) {
  Inflater inflater;
  z_stream& z = inflater.stream;
  const auto limit = static_cast<std::size_t>(std::max<std::int64_t>(max_bytes, 0));
  std::size_t capacity = std::min(limit + 1, std::max<std::size_t>(4 * packed.size(), 4096));
  std::unique_ptr<char[]> data(new char[capacity]);
  std::size_t read = 0, written = 0;
  for (;;) {
    if (written == capacity) {
      if (written > limit) {
        throw InputError(
            "the file " + quoted(path) + " unpacks to more than " + std::to_string(limit) + " bytes",
            "is it what you think it is? If so, unpack it first");
      }
      const std::size_t larger = std::min(limit + 1, 2 * capacity);
      std::unique_ptr<char[]> grown(new char[larger]);
      std::memcpy(grown.get(), data.get(), written);
      data = std::move(grown);
      capacity = larger;
    }
    const std::size_t in = std::min(chunk, packed.size() - read), out = std::min(chunk, capacity - written);
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + read));
    z.avail_in = static_cast<uInt>(in);
    z.next_out = reinterpret_cast<Bytef*>(data.get() + written);
    z.avail_out = static_cast<uInt>(out);
    const int status = inflate(&z, Z_NO_FLUSH);
    read += in - z.avail_in;
    written += out - z.avail_out;
    if (status == Z_STREAM_END) {
      // Tapes and some archivers pad with zeros; anything else must be another member.
      read = std::min(packed.size(), packed.find_first_not_of('\0', read));
      if (read == packed.size()) break;
      if (inflateReset(&z) != Z_OK) throw std::bad_alloc();
    } else if (status == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError(
          "the gzip stream of " + quoted(path) + " is damaged: " + (z.msg ? z.msg : "unknown error"),
          "fetch or pack the file again");
    } else if (read == packed.size() && z.avail_out != 0) {
      throw InputError("the gzip stream of " + quoted(path) + " is cut off", "fetch or pack the file again");
    }
  }
  if (written == 0)
    throw InputError("the file " + quoted(path) + " is empty when unpacked", "write it again");
  return {std::move(data), written};
}

}  // namespace

FileContent read_file_content(const std::string& path, std::int64_t max_unpacked_bytes) {
  FileContent content = read_plain(path);
  if (content.view().starts_with("\x1f\x8b")) return unpack(path, content.view(), max_unpacked_bytes);
  return content;
}

}  // namespace ballflow::geometry
