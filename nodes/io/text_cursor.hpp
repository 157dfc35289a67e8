// A position in the text of a model file: tokens, numbers, and errors that name the line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/vec3.hpp"

namespace ballflow::geometry {

/// Lines end with \n, \r\n or \r.
class TextCursor {
 public:
  /// What follows `comment` on a line is skipped like a blank; 0 for formats without comments. Characters
  /// of `separators` count as blanks, too, and so does `continuation` together with the line end after it.
  explicit TextCursor(std::string_view text, char comment = 0, std::string_view separators = {},
                      char continuation = 0)
      : begin_(text.data()),
        at_(begin_),
        end_(begin_ + text.size()),
        comment_(comment),
        continuation_(continuation),
        separators_(separators) {}

  /// The next token of this line, empty at its end.
  std::string_view token_on_line() {
    skip_blanks();
    const char* first = at_;
    while (at_ != end_ && !blank(*at_) && !line_end(*at_) && !(comment_ != 0 && *at_ == comment_) &&
           !(continuation_ != 0 && continued_line() != nullptr)) {
      ++at_;
    }
    return {first, static_cast<std::size_t>(at_ - first)};
  }
  /// The next token on this or a later line, empty at the end of the text.
  std::string_view token() {
    for (;;) {
      const std::string_view found = token_on_line();
      if (!found.empty() || at_ == end_) return found;
      ++at_;
    }
  }
  /// Goes to the beginning of the next line.
  void next_line() {
    while (at_ != end_ && !line_end(*at_)) ++at_;
    if (at_ != end_ && *at_ == '\r' && at_ + 1 != end_ && at_[1] == '\n') ++at_;
    if (at_ != end_) ++at_;
  }
  /// Goes back, or on, to the first character of a token of the text.
  void go_to(std::string_view token) { at_ = token.data(); }
  /// The rest of the line without blanks at its ends.
  std::string_view rest_of_line();
  bool at_end() const { return at_ == end_; }
  /// 0 at the end.
  char next_character() const { return at_ == end_ ? '\0' : *at_; }
  void skip_character() { at_ += at_ != end_; }
  std::size_t offset() const { return static_cast<std::size_t>(at_ - begin_); }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }

  /// The number of the line of `token`, from 1.
  std::int64_t line_of(std::string_view token) const;
  /// " (line 12)"
  std::string place_of(std::string_view token) const {
    return " (line " + std::to_string(line_of(token)) + ")";
  }

 private:
  bool blank(char c) const {
    // DOS ends texts with Ctrl-Z.
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\x1a' ||
           separators_.find(c) != std::string_view::npos;
  }
  static bool line_end(char c) { return c == '\n' || c == '\r'; }
  /// The beginning of the next line when this one ends here with a continuation sign.
  const char* continued_line() const {
    if (*at_ != continuation_) return nullptr;
    const char* p = at_ + 1;
    while (p != end_ && blank(*p)) ++p;
    if (p == end_) return p;
    if (!line_end(*p)) return nullptr;
    return p + (*p == '\r' && p + 1 != end_ && p[1] == '\n' ? 2 : 1);
  }
  void skip_blanks() {
    while (at_ != end_ && blank(*at_)) ++at_;
    while (continuation_ != 0 && at_ != end_ && continued_line() != nullptr) {
      at_ = continued_line();
      while (at_ != end_ && blank(*at_)) ++at_;
    }
    if (comment_ != 0 && at_ != end_ && *at_ == comment_) {
      while (at_ != end_ && !line_end(*at_)) ++at_;
    }
  }

  const char* begin_;
  const char* at_;
  const char* end_;
  char comment_, continuation_;
  std::string_view separators_;
};

/// The token as a number; nan and inf are numbers here. Nothing for other text and for magnitudes beyond
/// the range of double.
std::optional<double> parse_real(std::string_view token);
std::optional<std::int64_t> parse_integer(std::string_view token);

/// The token as a coordinate. Throws InputError when it is missing, no number, or not finite; `element` and
/// `name` say which ("vertex 17", "y").
double parse_coordinate(const TextCursor& cursor, std::string_view token, const char* element,
                        std::int64_t number, const char* name);

/// Throws InputError when p is not finite ("vertex 17: y is nan" and the place).
void require_finite(const Vec3& p, const char* element, std::int64_t number, const std::string& place = {});

/// Shortens and quotes text of a file for a message.
std::string excerpt(std::string_view text);

}  // namespace ballflow::geometry
