#include "sdk/params.hpp"

#include <charconv>
#include <stdexcept>

namespace ballflow::detail {

namespace {

class Reader {
 public:
  explicit Reader(std::string_view json) : rest_(json) {}

  std::map<std::string, ParamValue, std::less<>> object() {
    std::map<std::string, ParamValue, std::less<>> all;
    expect('{');
    if (!take('}')) {
      do {
        std::string name = string();
        expect(':');
        all[std::move(name)] = value();
      } while (take(','));
      expect('}');
    }
    skip_space();
    if (!rest_.empty()) fail();
    return all;
  }

 private:
  [[noreturn]] static void fail() { throw std::invalid_argument("the parameters are no flat JSON object"); }
  void skip_space() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_[0]) != std::string_view::npos)
      rest_.remove_prefix(1);
  }
  bool take(char c) {
    skip_space();
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail();
  }
  bool take_word(std::string_view word) {
    if (rest_.substr(0, word.size()) != word) return false;
    rest_.remove_prefix(word.size());
    return true;
  }
  char next() {
    if (rest_.empty()) fail();
    const char c = rest_[0];
    rest_.remove_prefix(1);
    return c;
  }

  std::uint32_t code_unit() {
    std::uint32_t unit = 0;
    const char* const end = rest_.data() + (rest_.size() < 4 ? rest_.size() : 4);
    const auto [stop, error] = std::from_chars(rest_.data(), end, unit, 16);
    if (error != std::errc() || stop != rest_.data() + 4) fail();
    rest_.remove_prefix(4);
    return unit;
  }
  static void append_utf8(std::string& text, std::uint32_t code) {
    const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (code >> shift & 0x3f)); };
    if (code < 0x80) {
      text += static_cast<char>(code);
    } else if (code < 0x800) {
      text += static_cast<char>(0xc0 | code >> 6);
      tail(0);
    } else if (code < 0x10000) {
      text += static_cast<char>(0xe0 | code >> 12);
      tail(6);
      tail(0);
    } else {
      text += static_cast<char>(0xf0 | code >> 18);
      tail(12);
      tail(6);
      tail(0);
    }
  }
  std::string string() {
    expect('"');
    std::string text;
    for (char c = next(); c != '"'; c = next()) {
      if (c != '\\') {
        text += c;
        continue;
      }
      c = next();
      constexpr std::string_view escapes = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
      if (const std::size_t at = escapes.find(c); at != std::string_view::npos) {
        text += meanings[at];
        continue;
      }
      if (c != 'u') fail();
      std::uint32_t code = code_unit();
      if (code >= 0xd800 && code < 0xdc00) {  // the first half of a pair
        if (next() != '\\' || next() != 'u') fail();
        const std::uint32_t low = code_unit();
        if (low < 0xdc00 || low >= 0xe000) fail();
        code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
      }
      append_utf8(text, code);
    }
    return text;
  }

  ParamValue value() {
    skip_space();
    ParamValue value;
    if (rest_.empty()) fail();
    if (rest_[0] == '"') {
      value.kind = ParamValue::Kind::string;
      value.text = string();
    } else if (take_word("true")) {
      value.kind = ParamValue::Kind::boolean;
      value.boolean = true;
    } else if (take_word("false")) {
      value.kind = ParamValue::Kind::boolean;
    } else if (!take_word("null")) {
      const std::size_t length = std::min(rest_.find_first_of(",} \t\r\n"), rest_.size());
      const char* const end = rest_.data() + length;
      value.kind = ParamValue::Kind::number;
      if (const auto [stop, error] = std::from_chars(rest_.data(), end, value.number);
          stop != end || error != std::errc()) {
        fail();
      }
      if (const auto [stop, error] = std::from_chars(rest_.data(), end, value.integer);
          stop == end && error == std::errc()) {
        value.kind = ParamValue::Kind::integer;
      }
      rest_.remove_prefix(length);
    }
    return value;
  }

  std::string_view rest_;
};

}  // namespace

std::map<std::string, ParamValue, std::less<>> read_params(std::string_view json) {
  return Reader(json).object();
}

}  // namespace ballflow::detail
