#include "base/canonical_json.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace ballflow {
namespace {

constexpr std::size_t depth_limit = 64;

/// Writes what the parser meets. No tree is built: summaries are small and many.
class Writer final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Writer(ExitCode code) : code_(code) {}
  std::string text;

  bool null() override { return write("null"); }
  bool boolean(bool value) override { return write(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override { return number(value); }
  bool number_unsigned(number_unsigned_t value) override { return number(value); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    separate();
    write_string(value, text);
    return true;
  }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open('{'); }
  bool key(string_t& name) override {
    std::vector<Member>& members = open_.back().members;
    if (!members.empty()) members.back().end = text.size();
    separate();
    members.push_back({std::move(name), text.size()});
    write_string(members.back().key, text);
    text += ':';
    open_.back().separated = true;
    return true;
  }
  bool end_object() override {
    sort_members();
    return close('}');
  }
  bool start_array(std::size_t) override { return open('['); }
  bool end_array() override { return close(']'); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
    return false;
  }

 private:
  struct Member {
    std::string key;
    std::size_t begin, end = 0;  // in `text`, with the key and without the comma
  };
  struct Open {
    std::vector<Member> members;  // of an object
    bool separated = true;        // no comma is needed before what comes next
  };

  void separate() {
    if (open_.empty()) return;
    if (!std::exchange(open_.back().separated, false)) text += ',';
  }
  bool write(std::string_view literal) {
    separate();
    text += literal;
    return true;
  }
  template <class Number>
  bool number(Number value) {
    separate();
    write_number(value, text);
    return true;
  }
  bool open(char bracket) {
    if (open_.size() >= depth_limit)
      throw Error(code_, "JSON nests deeper than " + std::to_string(depth_limit));
    separate();
    text += bracket;
    open_.emplace_back();
    return true;
  }
  bool close(char bracket) {
    text += bracket;
    open_.pop_back();
    return true;
  }

  void sort_members() {
    std::vector<Member>& members = open_.back().members;
    if (members.empty()) return;
    members.back().end = text.size();
    const auto by_key = [](const Member& a, const Member& b) { return a.key < b.key; };
    if (!std::is_sorted(members.begin(), members.end(), by_key)) {
      const std::size_t begin = members.front().begin;
      std::sort(members.begin(), members.end(), by_key);
      std::string sorted;
      for (const Member& member : members) {
        if (!sorted.empty()) sorted += ',';
        sorted.append(text, member.begin, member.end - member.begin);
      }
      text.replace(begin, std::string::npos, sorted);
    }
    const auto twice = std::adjacent_find(members.begin(), members.end(),
                                          [](const Member& a, const Member& b) { return a.key == b.key; });
    if (twice != members.end()) throw Error(code_, "JSON names the key " + shown_text(twice->key) + " twice");
  }

  const ExitCode code_;
  std::vector<Open> open_;
};

}  // namespace

void write_string(std::string_view text, std::string& out) {
  static constexpr char digits[] = "0123456789abcdef";
  const auto plain = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\'; };
  out += '"';
  for (auto at = text.begin(); at != text.end();) {
    const auto special = std::find_if_not(at, text.end(), plain);
    out.append(at, special);
    if (special == text.end()) break;
    at = special + 1;
    switch (*special) {
      case '"':
        out += "\\\"";
        break;
      case '\\':
        out += "\\\\";
        break;
      case '\b':
        out += "\\b";
        break;
      case '\f':
        out += "\\f";
        break;
      case '\n':
        out += "\\n";
        break;
      case '\r':
        out += "\\r";
        break;
      case '\t':
        out += "\\t";
        break;
      default:
        out += "\\u00";
        out += digits[*special >> 4];
        out += digits[*special & 15];
    }
  }
  out += '"';
}

void write_number(double value, std::string& out) {
  if (value == 0) {  // -0 too
    out += '0';
    return;
  }
  // The shortest digits that read back the same, "d.ddde-dd", and where ECMAScript puts the point.
  std::array<char, 32> text;
  const char* end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  std::string_view shown(text.data(), static_cast<std::size_t>(end - text.data()));
  if (shown.front() == '-') {
    out += '-';
    shown.remove_prefix(1);
  }
  const std::size_t e = shown.find('e');
  std::string digits(1, shown.front());
  if (e > 2) digits += shown.substr(2, e - 2);
  const char* exponent_digits = shown.data() + e + 1 + (shown[e + 1] == '+');
  int exponent = 0;
  std::from_chars(exponent_digits, end, exponent);
  const int count = static_cast<int>(digits.size());
  const int point = exponent + 1;  // the number is 0.digits * 10^point
  if (count <= point && point <= 21) {
    out += digits;
    out.append(static_cast<std::size_t>(point - count), '0');
  } else if (0 < point && point <= 21) {
    out.append(digits, 0, static_cast<std::size_t>(point));
    out += '.';
    out.append(digits, static_cast<std::size_t>(point));
  } else if (-6 < point && point <= 0) {
    out += "0.";
    out.append(static_cast<std::size_t>(-point), '0');
    out += digits;
  } else {
    out += digits.front();
    if (count > 1) {
      out += '.';
      out.append(digits, 1);
    }
    out += exponent < 0 ? "e-" : "e+";
    write_number(std::abs(exponent), out);
  }
}

void write_double(double value, std::string& out) {
  std::array<char, 64> text;
  const char* end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  const std::string_view shown(text.data(), static_cast<std::size_t>(end - text.data()));
  out += shown;
  if (shown.find_first_of(".e") == std::string_view::npos) out += ".0";
}

void write_value(const Json& value, std::string& out) {
  switch (value.type()) {
    case Json::value_t::null:
      out += "null";
      break;
    case Json::value_t::boolean:
      out += value.get<bool>() ? "true" : "false";
      break;
    case Json::value_t::number_integer:
      write_number(value.get<std::int64_t>(), out);
      break;
    case Json::value_t::number_unsigned:
      write_number(value.get<std::uint64_t>(), out);
      break;
    case Json::value_t::number_float:
      write_double(value.get<double>(), out);
      break;
    case Json::value_t::string: {
      const auto& text = value.get_ref<const std::string&>();
      const auto ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
      if (std::all_of(text.begin(), text.end(), ascii)) return write_string(text, out);
      out += value.dump();  // which refuses what is not UTF-8
      break;
    }
    default:
      out += value.dump();
  }
}

std::string shown_text(std::string_view text) {
  std::string shown = "\"";
  for (const char c : text.substr(0, 40)) shown += c >= ' ' && c <= '~' && c != '"' ? c : '?';
  return shown + (text.size() > 40 ? "...\"" : "\"");
}

std::string canonical_json(std::string_view text, ExitCode code) {
  Writer writer(code);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &writer)) {
    throw Error(code, "not valid JSON: " + shown_text(text));
  }
  return std::move(writer.text);
}

}  // namespace ballflow
