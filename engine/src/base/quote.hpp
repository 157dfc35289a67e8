// How foreign text appears in messages: never raw, so that no input can break a line or drive a terminal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballflow/json.hpp"
#include "ballflow/text.hpp"

namespace ballflow {

/// Whether the text is UTF-8, as every JSON text must be.
bool is_utf8(const std::string& text);

/// `printable` in double quotes; long text is cut.
std::string in_quotes(std::string_view text);

/// A JSON scalar as a message shows it ("is -1", "is the text \"abc\"", "is an array").
std::string described(const Json& value);

/// The shortest decimal text that reads back as the same number: 0.1, 3, 1e-05.
std::string shortest(double value);

/// A parameter value as text inside another text: numbers by `shortest`, texts without quotes.
std::string plain_text(const Json& value);

/// "a", "b" or "c"; the first `limit` names and how many more there are.
std::string listed(const std::vector<std::string>& names, std::size_t limit = 12);

/// Words of a "did you mean" hint; empty when nothing is near.
std::string did_you_mean(const std::string& name, const std::vector<std::string>& candidates);

/// Letters, digits and _; no digit first.
bool is_identifier(std::string_view text);

/// Identifiers joined by dots: the id of a node or artifact type, with or without a namespace.
bool is_type_id(std::string_view text);

}  // namespace ballflow
