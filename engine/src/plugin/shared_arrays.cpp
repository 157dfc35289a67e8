#include "plugin/shared_arrays.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "ballflow/error.hpp"
#include "base/quote.hpp"
#include "plugin/text_view.hpp"

namespace ballflow {
namespace {

constexpr std::uint64_t alignment = 64;

[[noreturn]] void not_shared(const std::string& why, const std::string& hint = {}) {
  throw Error(ExitCode::plugin, why, hint);
}

}  // namespace

Json ArraysToShare::add(const bf_artifact& artifact) {
  Json arrays = Json::array();
  const auto* at = reinterpret_cast<const char*>(artifact.arrays);
  for (std::uint64_t i = 0; i < artifact.array_count; ++i) {
    const auto& array = *reinterpret_cast<const bf_array*>(at + i * artifact.arrays->struct_size);
    Json shape = Json::array();
    std::uint64_t size = dtype_size(array.dtype);
    for (std::uint32_t d = 0; d < array.rank; ++d) {
      shape.push_back(array.shape[d]);
      size *= array.shape[d];
    }
    end_ = (end_ + alignment - 1) / alignment * alignment;
    arrays.push_back({{"name", std::string(view(array.name))},
                      {"dtype", std::string(dtype_name(array.dtype))},
                      {"shape", std::move(shape)},
                      {"offset", end_}});
    if (size != 0) pieces_.push_back({array.data, size, end_});
    end_ += size;
  }
  return {{"type", std::string(view(artifact.type))},
          {"version", artifact.type_version},
          {"summary", Json::parse(view(artifact.summary), nullptr, false)},
          {"arrays", std::move(arrays)}};
}

Descriptor ArraysToShare::file() const {
  Descriptor file(::memfd_create("ballflow inputs", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  bool written = file.is_open() && ::ftruncate(file.get(), static_cast<off_t>(end_)) == 0;
  for (const Piece& piece : pieces_) {
    for (std::uint64_t done = 0; written && done < piece.size;) {
      const ssize_t count = ::pwrite(file.get(), static_cast<const char*>(piece.data) + done,
                                     piece.size - done, static_cast<off_t>(piece.offset + done));
      if (count < 0 && errno == EINTR) continue;
      written = count > 0;
      if (written) done += static_cast<std::uint64_t>(count);
    }
  }
  if (!written) {
    not_shared("its inputs (" + std::to_string(end_) +
                   " bytes) cannot be shared with its process: " + std::strerror(errno),
               "use a smaller input, or a machine with more memory");
  }
  ::fcntl(file.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL);
  return file;
}

SharedArrays::SharedArrays(Descriptor file) {
  constexpr int seals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;
  struct stat status {};
  if (file.is_open()) ::fcntl(file.get(), F_ADD_SEALS, seals);  // it may be sealed already
  const int sealed = file.is_open() ? ::fcntl(file.get(), F_GET_SEALS) : -1;
  if (sealed < 0 || (sealed & seals) != seals || ::fstat(file.get(), &status) != 0)
    not_shared("its process handed over no memory that can be sealed");
  size_ = static_cast<std::uint64_t>(status.st_size);
  if (size_ == 0) return;
  void* const address = ::mmap(nullptr, size_, PROT_READ, MAP_SHARED, file.get(), 0);
  if (address == MAP_FAILED) not_shared(std::string("its outputs cannot be mapped: ") + std::strerror(errno));
  memory_ = std::shared_ptr<const void>(
      address, [size = size_](const void* at) { ::munmap(const_cast<void*>(at), size); });
}

std::vector<bf_array> SharedArrays::arrays(const Json& described) const {
  if (!described.is_array()) not_shared("its process described no arrays");
  std::vector<bf_array> all;
  for (const Json& item : described) {
    const auto wrong = [&](const std::string& why) {
      not_shared("its process described an array that " + why + ": " +
                 in_quotes(item.dump(-1, ' ', false, Json::error_handler_t::replace)));
    };
    const auto number = [](const Json& value) { return value.is_number_unsigned(); };
    if (!item.is_object() || !item.contains("name") || !item.at("name").is_string() ||
        !item.contains("dtype") || !item.at("dtype").is_string() || !item.contains("shape") ||
        !item.at("shape").is_array() || item.at("shape").size() > BALLFLOW_MAX_RANK ||
        !item.contains("offset") || !number(item.at("offset"))) {
      wrong("has no name, dtype, shape or offset");
    }
    bf_array array{};
    array.struct_size = sizeof array;
    const auto& name = item.at("name").get_ref<const std::string&>();
    array.name = {name.data(), name.size()};
    array.dtype = dtype_from_name(item.at("dtype").get_ref<const std::string&>());
    std::uint64_t size = dtype_size(array.dtype);
    if (size == 0) wrong("has no known dtype");
    bool empty = false, fits = true;
    for (const Json& length : item.at("shape")) {
      if (!number(length)) wrong("has no known shape");
      const auto extent = length.get<std::uint64_t>();
      array.shape[array.rank++] = extent;
      empty = empty || extent == 0;
      fits = fits && !__builtin_mul_overflow(size, extent, &size);
    }
    const auto offset = item.at("offset").get<std::uint64_t>();
    if (empty) {
      static constexpr double nothing = 0;
      array.data = &nothing;
    } else {
      if (!fits || offset % alignment != 0 || offset > size_ || size > size_ - offset)
        wrong("lies outside of its memory");
      array.data = static_cast<const char*>(memory_.get()) + offset;
    }
    all.push_back(array);
  }
  // Owners last: nobody releases them when something before has thrown.
  for (bf_array& array : all) {
    array.owner = new std::shared_ptr<const void>(memory_);
    array.release = [](void* owner) { delete static_cast<std::shared_ptr<const void>*>(owner); };
  }
  return all;
}

}  // namespace ballflow
