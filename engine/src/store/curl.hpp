// libcurl, opened when an upstream on a server is first used: with the thirty libraries that it needs in
// turn it takes longer to load than everything else that the program is linked with.
#pragma once

#include <curl/curl.h>

namespace ballflow {

/// The functions that are used, by the names that curl gives them.
struct Curl {
  decltype(&curl_global_init) global_init;
  decltype(&curl_easy_init) easy_init;
  decltype(&curl_easy_cleanup) easy_cleanup;
  decltype(&curl_easy_reset) easy_reset;
  decltype(&curl_easy_setopt) easy_setopt;
  decltype(&curl_easy_perform) easy_perform;
  decltype(&curl_easy_getinfo) easy_getinfo;
  decltype(&curl_easy_strerror) easy_strerror;
  decltype(&curl_slist_append) slist_append;
  decltype(&curl_slist_free_all) slist_free_all;
  decltype(&curl_url) url;
  decltype(&curl_url_set) url_set;
  decltype(&curl_url_cleanup) url_cleanup;
};

/// Opens the library at the first call and starts it. Throws Error (code store) that says what is missing and
/// which package has it; the next call tries again.
const Curl& curl();

}  // namespace ballflow
