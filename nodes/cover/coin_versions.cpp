#include <CbcConfig.h>
#include <CglConfig.h>
#include <Clp_C_Interface.h>
#include <link.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

#include "cover/ip_solver.hpp"

namespace ballflow::geometry {
namespace {

/// The file behind "libCbc.so" in this process, its links followed: "libCbc.so.3.10.8". The libraries of
/// COIN-OR but Clp have no function that tells their version, and headers tell that of the machine that
/// compiled. Empty where the library is linked statically; then the headers are right.
std::string loaded_file(const char* library) {
  struct Search {
    std::string_view name;
    std::string found;
  } search{library, {}};
  dl_iterate_phdr(
      [](dl_phdr_info* object, std::size_t, void* data) {
        auto& wanted = *static_cast<Search*>(data);
        const std::filesystem::path path = object->dlpi_name;
        if (path.filename().string().rfind(wanted.name, 0) != 0) return 0;
        std::error_code error;
        const std::filesystem::path real = std::filesystem::canonical(path, error);
        wanted.found = (error ? path : real).filename().string();
        return 1;
      },
      &search);
  return search.found;
}

std::string version(const char* library, const char* of_headers) {
  const std::string file = loaded_file(library);
  return file.empty() ? of_headers : file;
}

}  // namespace

std::string cbc_version() { return version("libCbc.so", CBC_VERSION); }
std::string cgl_version() { return version("libCgl.so", CGL_VERSION); }
std::string clp_version() { return Clp_Version(); }

}  // namespace ballflow::geometry
