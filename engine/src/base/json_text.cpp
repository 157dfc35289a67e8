#include "base/json_text.hpp"

#include <algorithm>
#include <numeric>

#include "base/quote.hpp"

namespace ballflow::json_text {

namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

std::size_t text_begin(std::string_view text) {
  return text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
}

/// The first byte at or after `at` that is no white space, comment, comma or colon.
std::size_t next_token(std::string_view text, std::size_t at) {
  while (at < text.size()) {
    const char c = text[at];
    if (c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == ',' || c == ':') {
      ++at;
    } else if (c == '/' && at + 1 < text.size() && (text[at + 1] == '/' || text[at + 1] == '*')) {
      const bool block = text[at + 1] == '*';
      const std::size_t close = block ? text.find("*/", at + 2) : text.find('\n', at);
      if (close == std::string_view::npos) return block ? at : text.size();
      at = close + (block ? 2 : 1);
    } else {
      break;
    }
  }
  return at;
}

/// The end of the token that begins at `at`, a valid one.
std::size_t token_end(std::string_view text, std::size_t at) {
  if (text[at] == '"') {
    for (++at; text[at] != '"'; ++at) at += text[at] == '\\' ? 1 : 0;
    return at + 1;
  }
  const auto wordlike = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '+' ||
           c == '-' || c == '.';
  };
  const std::size_t begin = at;
  while (at < text.size() && wordlike(text[at])) ++at;
  return std::max(at, begin + 1);
}

class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  TreeBuilder(const Source& source, Value& root, std::vector<Diagnostic>& findings)
      : source_(source),
        text_(source.content()),
        last_end_(text_begin(text_)),
        root_(root),
        findings_(findings) {}

  bool null() override { return scalar(nullptr); }
  bool boolean(bool value) override { return scalar(value); }
  bool number_integer(number_integer_t value) override { return scalar(value); }
  bool number_unsigned(number_unsigned_t value) override { return scalar(value); }
  bool number_float(number_float_t value, const string_t&) override { return scalar(value); }
  bool string(string_t& value) override { return scalar(std::move(value)); }
  bool binary(binary_t&) override { return false; }  // no token of a text
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_array() override {
    close();
    return true;
  }
  bool key(string_t& value) override {
    token();
    Member member;
    member.key = std::move(value);
    member.offset = start_;
    open_.back()->members.push_back(std::move(member));
    return true;
  }
  bool end_object() override {
    drop_duplicates(*open_.back());
    close();
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::detail::exception& error) override {
    constexpr int out_of_range = 406;  // the parser's number for a number that is too large
    syntax_error(position + text_begin(text_), error.what(), error.id == out_of_range);
    return false;
  }

 private:
  void token() {
    start_ = static_cast<std::uint32_t>(next_token(text_, last_end_));
    last_end_ = token_end(text_, start_);
  }

  /// The place for the next value.
  Value* slot() {
    if (open_.empty()) return &root_;
    if (open_.back()->is_array()) {
      Member member;
      member.offset = start_;
      open_.back()->members.push_back(std::move(member));
    }
    return &open_.back()->members.back().value;
  }

  Value* add(Json value) {
    token();
    if (++count_ > max_values) {
      report(start_, "more than " + std::to_string(max_values) + " values", "split the file into subgraphs");
      return nullptr;
    }
    Value* const place = slot();
    place->offset = start_;
    place->end = static_cast<std::uint32_t>(last_end_);
    place->scalar = std::move(value);
    return place;
  }
  bool scalar(Json value) { return add(std::move(value)) != nullptr; }
  bool open(Json value) {
    Value* const place = add(std::move(value));
    if (place == nullptr) return false;
    if (open_.size() == max_depth) {
      report(start_, "brackets are nested deeper than " + std::to_string(max_depth) + " levels", "");
      return false;
    }
    open_.push_back(place);  // stays valid: a vector of members only grows while its owner is innermost
    return true;
  }
  void close() {
    token();
    open_.back()->end = static_cast<std::uint32_t>(last_end_);
    open_.pop_back();
  }

  void drop_duplicates(Value& object) {
    std::vector<Member>& members = object.members;
    std::vector<std::size_t> order(members.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return members[a].key < members[b].key; });
    std::vector<char> extra(members.size(), 0);
    bool any = false;
    for (std::size_t i = 1, first = 0; i < order.size(); ++i) {
      if (members[order[i]].key != members[order[first]].key) {
        first = i;
        continue;
      }
      const Position before = source_.position(members[order[first]].offset);
      report(members[order[i]].offset, "duplicate key " + in_quotes(members[order[i]].key),
             "the first one is at line " + std::to_string(before.line) + ", column " +
                 std::to_string(before.column),
             members[order[i]].key);
      extra[order[i]] = 1;
      any = true;
    }
    if (!any) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (extra[i] != 0) continue;
      if (kept != i) members[kept] = std::move(members[i]);
      ++kept;
    }
    members.resize(kept);
  }

  /// A finding at a place inside the open brackets; `key` names a member of the innermost one.
  void report(std::size_t offset, std::string message, std::string hint, std::string_view key = {}) {
    Diagnostic found;
    found.file = source_.file();
    const Position position = source_.position(offset);
    found.line = position.line;
    found.column = position.column;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const Value& value = *open_[i];
      found.pointer += "/" + (value.is_array() ? std::to_string(value.members.size() - 1)
                                               : escape_pointer(value.members.back().key));
    }
    if (!key.empty()) found.pointer += "/" + escape_pointer(key);
    found.message = std::move(message);
    found.hint = std::move(hint);
    found.source_line = source_.line(offset);
    findings_.push_back(std::move(found));
  }

  void syntax_error(std::size_t position, std::string what, bool number_too_large) {
    // After "; last read: '" the parser repeats the text, which may contain anything, the words of its own
    // messages too; the caret shows it better.
    const std::size_t last_read = what.find("; last read: '");
    if (last_read != std::string::npos) {
      const std::size_t tail = what.rfind("'; expected ");
      what = what.substr(0, last_read) +
             (tail != std::string::npos && tail > last_read ? what.substr(tail + 1) : std::string());
    }
    // `position` counts the bytes read, so it ends the offending token, whose start is what a reader looks
    // for.
    std::size_t at = std::min(position == 0 ? 0 : position - 1, text_.size());
    const std::size_t start = next_token(text_, last_end_);
    const bool inside_text = what.find("invalid string") != std::string::npos &&
                             what.find("missing closing quote") == std::string::npos;
    if (!inside_text) at = std::min(at, start);
    const std::string_view rest = text_.substr(std::min(at, text_.size()));

    std::string message, hint;
    if (number_too_large) {
      message = "the number " +
                printable(rest.substr(0, std::min<std::size_t>(token_end(text_, at) - at, 40))) +
                " is too large";
      hint = "numbers are 64-bit floating point, up to 1.79e308";
    } else {
      constexpr std::string_view marker = "syntax error while parsing ";
      const std::size_t found = what.find(marker);
      message = found == std::string::npos ? what : what.substr(found + marker.size());
      const std::size_t dash = message.find(" - ");
      std::string context;
      if (dash != std::string::npos) {
        context = message.substr(0, dash);
        message = message.substr(dash + 3);
      }
      message =
          "not JSON: " + printable(message) + (context.empty() ? "" : " (in " + printable(context) + ")");
      hint = syntax_hint(at, rest);
    }
    report(at, std::move(message), std::move(hint));
  }

  std::string syntax_hint(std::size_t at, std::string_view rest) const {
    for (const std::string_view word :
         {"NaN", "nan", "-NaN", "-nan", "Inf", "inf", "-Inf", "-inf", "+Inf", "+inf"}) {
      if (rest.starts_with(word)) return "JSON has no NaN and no infinity";
    }
    if (rest.empty()) return "the text ends too early: a bracket or quote is not closed";
    if (rest[0] == '\'') return "texts are written in double quotes";
    if (rest[0] == '}' || rest[0] == ']') {
      std::size_t before = at;
      while (before > 0 && (text_[before - 1] == ' ' || text_[before - 1] == '\n' ||
                            text_[before - 1] == '\t' || text_[before - 1] == '\r')) {
        --before;
      }
      if (before > 0 && text_[before - 1] == ',') return "remove the comma before it";
    }
    if (rest.starts_with("/*")) return "the comment is not closed";
    if (text_.starts_with("\xff\xfe") || text_.starts_with("\xfe\xff"))
      return "save the file as UTF-8, it is UTF-16";
    if (open_.empty() && root_.end != 0) return "the value ends before this; remove what follows";
    return {};
  }

  const Source& source_;
  std::string_view text_;
  std::size_t last_end_;
  std::uint32_t start_ = 0;
  std::size_t count_ = 0;
  Value& root_;
  std::vector<Value*> open_;
  std::vector<Diagnostic>& findings_;
};

}  // namespace

Source::Source(std::string file, std::string content) : file_(std::move(file)), content_(std::move(content)) {
  if (content_.size() > max_size) return;  // refused by parse(), before any offset is made
  lines_.push_back(static_cast<std::uint32_t>(text_begin(content_)));
  for (std::size_t at = content_.find('\n'); at != std::string::npos; at = content_.find('\n', at + 1)) {
    lines_.push_back(static_cast<std::uint32_t>(at + 1));
  }
}

Position Source::position(std::size_t offset) const {
  const auto line = std::upper_bound(lines_.begin() + 1, lines_.end(), offset) - 1;
  return {static_cast<int>(line - lines_.begin()) + 1,
          static_cast<int>(std::max<std::size_t>(offset, *line) - *line) + 1};
}

std::string Source::line(std::size_t offset) const {
  constexpr std::size_t longest = 400;
  const std::size_t begin = lines_[static_cast<std::size_t>(position(offset).line) - 1];
  if (offset - std::min(offset, begin) >= longest) return {};
  const std::string line = content_.substr(begin, longest);
  return line.substr(0, line.find_first_of("\r\n"));
}

const Value* Value::find(std::string_view key) const {
  for (const Member& member : members) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

Json Value::json() const {
  if (!is_object() && !is_array()) return scalar;
  Json result = scalar;
  for (const Member& member : members) {
    if (is_array()) {
      result.push_back(member.value.json());
    } else {
      result[member.key] = member.value.json();
    }
  }
  return result;
}

bool parse(const Source& source, Value& root, std::vector<Diagnostic>& findings) {
  const std::string_view text = source.content();
  const auto refuse = [&](std::size_t offset, std::string message, std::string hint) {
    Diagnostic found;
    found.file = source.file();
    found.message = std::move(message);
    found.hint = std::move(hint);
    if (text.size() <= max_size) {
      const Position position = source.position(offset);
      found.line = position.line;
      found.column = position.column;
    }
    findings.push_back(std::move(found));
    return false;
  };
  if (text.size() > max_size) return refuse(0, "the text is larger than 64 MB", "");
  // A NUL byte would end the text early for the parser, and hide what follows.
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    const bool wide = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
    return refuse(nul, "not JSON: the text contains a NUL byte",
                  wide ? "save the file as UTF-8, it is UTF-16" : "the file is binary or damaged");
  }
  TreeBuilder builder(source, root, findings);
  const std::string_view body = text.substr(text_begin(text));
  return Json::sax_parse(body.begin(), body.end(), &builder, Json::input_format_t::json, true, true);
}

Diagnostic finding(const Source& source, const Value& root, std::uint32_t offset, std::string message,
                   std::string hint, Diagnostic::Severity severity) {
  Diagnostic found;
  found.severity = severity;
  found.file = source.file();
  const Position position = source.position(offset);
  found.line = position.line;
  found.column = position.column;
  found.pointer = pointer(root, offset);
  found.message = std::move(message);
  found.hint = std::move(hint);
  found.source_line = source.line(offset);
  return found;
}

std::string escape_pointer(std::string_view key) {
  std::string result;
  for (const char c : key) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

std::string pointer(const Value& root, std::uint32_t offset) {
  std::string result;
  const Value* value = &root;
  while (true) {
    const auto next =
        std::upper_bound(value->members.begin(), value->members.end(), offset,
                         [](std::uint32_t at, const Member& member) { return at < member.offset; });
    if (next == value->members.begin()) return result;
    const Member& member = *(next - 1);
    if (offset >= member.value.end) return result;
    result += "/" + (value->is_array() ? std::to_string(next - 1 - value->members.begin())
                                       : escape_pointer(member.key));
    value = &member.value;
  }
}

}  // namespace ballflow::json_text
