#include "store/curl.hpp"

#include <dlfcn.h>

#include <string>

#include "ballflow/error.hpp"

namespace ballflow {
namespace {

// The name changes with the interface that the header describes.
constexpr const char* library_name = "libcurl.so.4";
static_assert(LIBCURL_VERSION_MAJOR >= 7);
// Older ones do not know CURLOPT_PROTOCOLS_STR.
constexpr const char* install = "install libcurl 7.85 or newer (Debian package libcurl4), or name a folder";

[[noreturn]] void fail(const std::string& why) {
  throw Error(ExitCode::store, "an upstream on a server needs libcurl, which " + why, install);
}

template <class Function>
void find(void* library, const char* name, Function& function) {
  function = reinterpret_cast<Function>(dlsym(library, name));
  if (function == nullptr) fail(std::string("has no function ") + name);
}

Curl load() {
  // Never closed: what it started runs until the program ends.
  void* const library = dlopen(library_name, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) fail(std::string("cannot be loaded: ") + dlerror());
  Curl functions{};
  find(library, "curl_global_init", functions.global_init);
  find(library, "curl_easy_init", functions.easy_init);
  find(library, "curl_easy_cleanup", functions.easy_cleanup);
  find(library, "curl_easy_reset", functions.easy_reset);
  find(library, "curl_easy_setopt", functions.easy_setopt);
  find(library, "curl_easy_perform", functions.easy_perform);
  find(library, "curl_easy_getinfo", functions.easy_getinfo);
  find(library, "curl_easy_strerror", functions.easy_strerror);
  find(library, "curl_slist_append", functions.slist_append);
  find(library, "curl_slist_free_all", functions.slist_free_all);
  find(library, "curl_url", functions.url);
  find(library, "curl_url_set", functions.url_set);
  find(library, "curl_url_cleanup", functions.url_cleanup);
  if (functions.global_init(CURL_GLOBAL_DEFAULT) != CURLE_OK) fail("cannot be started");
  return functions;
}

}  // namespace

const Curl& curl() {
  static const Curl functions = load();
  return functions;
}

}  // namespace ballflow
