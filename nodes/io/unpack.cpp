#include "io/unpack.hpp"

#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>
#include <utility>

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 30;  // of one call of zlib, whose counters have 32 bits

/// Memory that grows with what is written into it, up to a limit.
class Output {
 public:
  Output(const std::string& name, std::size_t packed, std::int64_t max_bytes)
      : name_(name), limit_(static_cast<std::size_t>(std::max<std::int64_t>(max_bytes, 0))) {
    capacity_ = std::min(limit_ + 1, std::max<std::size_t>(4 * packed, 4096));
    data_.reset(new char[capacity_]);
  }
  /// Throws InputError when more has been written than is allowed.
  void make_room() {
    if (written_ > limit_) {
      throw InputError("the file " + name_ + " unpacks to more than " + std::to_string(limit_) + " bytes",
                       "is it what you think it is? If so, unpack it first");
    }
    if (written_ < capacity_) return;
    const std::size_t larger = std::min(limit_ + 1, 2 * capacity_);
    std::unique_ptr<char[]> grown(new char[larger]);
    std::memcpy(grown.get(), data_.get(), written_);
    data_ = std::move(grown);
    capacity_ = larger;
  }
  char* end() { return data_.get() + written_; }
  std::size_t room() const { return capacity_ - written_; }
  void wrote(std::size_t bytes) { written_ += bytes; }
  FileContent take() {
    if (written_ > limit_) make_room();
    if (written_ == 0) throw InputError("the file " + name_ + " is empty when unpacked", "write it again");
    return {std::move(data_), written_};
  }

 private:
  const std::string& name_;
  std::size_t limit_, capacity_ = 0, written_ = 0;
  std::unique_ptr<char[]> data_;
};

[[noreturn]] void refuse_stream(const char* kind, const std::string& name, const std::string& what) {
  throw InputError(std::string("the ").append(kind).append(" stream of ").append(name).append(what),
                   "fetch or pack the file again");
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

FileContent inflated(const std::string& name, std::string_view packed, std::int64_t max_bytes) {
  Inflater inflater;
  z_stream& z = inflater.stream;
  Output output(name, packed.size(), max_bytes);
  std::size_t read = 0;
  for (;;) {
    output.make_room();
    const std::size_t in = std::min(chunk, packed.size() - read), out = std::min(chunk, output.room());
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + read));
    z.avail_in = static_cast<uInt>(in);
    z.next_out = reinterpret_cast<Bytef*>(output.end());
    z.avail_out = static_cast<uInt>(out);
    const int status = inflate(&z, Z_NO_FLUSH);
    read += in - z.avail_in;
    output.wrote(out - z.avail_out);
    if (status == Z_STREAM_END) {
      // Tapes and some archivers pad with zeros; anything else must be another member.
      read = std::min(packed.size(), packed.find_first_not_of('\0', read));
      if (read == packed.size()) break;
      if (inflateReset(&z) != Z_OK) throw std::bad_alloc();
    } else if (status == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (status != Z_OK && status != Z_BUF_ERROR) {
      throw InputError("the gzip stream of " + name + " is damaged: " + (z.msg ? z.msg : "unknown error"),
                       "fetch or pack the file again");
    } else if (read == packed.size() && z.avail_out != 0) {
      throw InputError("the gzip stream of " + name + " is cut off", "fetch or pack the file again");
    }
  }
  return output.take();
}

struct FreeContext {
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

FileContent decompressed(const std::string& name, std::string_view packed, std::int64_t max_bytes) {
  const std::unique_ptr<ZSTD_DCtx, FreeContext> context(ZSTD_createDCtx());
  if (!context) throw std::bad_alloc();
  Output output(name, packed.size(), max_bytes);
  ZSTD_inBuffer in{packed.data(), packed.size(), 0};
  for (;;) {
    output.make_room();
    ZSTD_outBuffer out{output.end(), output.room(), 0};
    const std::size_t read = in.pos, status = ZSTD_decompressStream(context.get(), &out, &in);
    if (ZSTD_isError(status)) {
      refuse_stream("zstd", name, std::string(" is damaged: ") + ZSTD_getErrorName(status));
    }
    output.wrote(out.pos);
    // 0: a frame is complete; what follows must be another one.
    if (status == 0 && in.pos == in.size) return output.take();
    if (in.pos == in.size && in.pos == read && out.pos < out.size) {
      refuse_stream("zstd", name, " is cut off");
    }
  }
}

struct Packer {
  std::string_view magic;
  const char* name;
};

}  // namespace

FileContent unpacked(const std::string& name, FileContent content, std::int64_t max_bytes) {
  static constexpr std::array others = {Packer{"BZh", "bzip2"}, Packer{{"\xfd\x37zXZ\0", 6}, "xz"},
                                        Packer{"PK\x03\x04", "ZIP"}, Packer{"7z\xbc\xaf\x27\x1c", "7z"},
                                        Packer{"Rar!\x1a\x07", "RAR"}};
  const std::string_view packed = content.view();
  if (packed.starts_with("\x1f\x8b")) return inflated(name, packed, max_bytes);
  if (packed.starts_with("\x28\xb5\x2f\xfd")) return decompressed(name, packed, max_bytes);
  for (const Packer& packer : others) {
    if (!packed.starts_with(packer.magic)) continue;
    const bool printed = packed.find("3D/3dmodel.model") != std::string_view::npos;
    throw InputError("the file " + name + (printed ? " is a 3MF model" : " is packed with ") +
                         (printed ? "" : packer.name),
                     printed ? "write it as OFF, OBJ, PLY or STL"
                             : "unpack it first; gzip and zstd are unpacked while reading");
  }
  return content;
}

}  // namespace ballflow::geometry
