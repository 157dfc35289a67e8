// The one spelling of a JSON value: what is hashed.
#pragma once

#include <string>
#include <string_view>

#include "ballflow/error.hpp"

namespace ballflow {

/// The one spelling of a JSON value: keys sorted by their bytes, no white space, non-ASCII characters as
/// UTF-8, numbers as RFC 8785 writes them (ECMAScript's shortest form: 1.0 is "1", 1e21 is "1e+21"), so that
/// other languages write the same bytes; only integers beyond 2^53, which ECMAScript has not, stay as they
/// are. (Members go by bytes, which differs from RFC 8785 for names beyond the Basic Multilingual Plane.)
/// Throws Error with the given code for what is not JSON, names a key twice or nests deeper than 64.
std::string canonical_json(std::string_view text, ExitCode code);

}  // namespace ballflow
