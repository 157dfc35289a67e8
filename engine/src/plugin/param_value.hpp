// Values of parameters: what a declaration makes of a JSON value or of a text.
#pragma once

#include <string>
#include <string_view>

#include "ballflow/node_decl.hpp"

namespace ballflow {

/// The value as the node gets it: doubles for numbers (no -0), 64-bit integers for integers. `value` must be
/// one that `param` does not refuse.
Json normalised(const ParamDecl& param, const Json& value);

/// Reads the text of a command line option as a value of the parameter's kind; false when it is none.
bool from_text(const ParamDecl& param, const std::string& text, Json& value);

/// "number", "integer", ...
const char* kind_name(ParamKind kind);
bool kind_from_name(std::string_view name, ParamKind& kind);

}  // namespace ballflow
