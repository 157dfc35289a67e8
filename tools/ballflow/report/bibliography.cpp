#include "report/bibliography.hpp"

#include <algorithm>
#include <cctype>

#include "ballflow/error.hpp"
#include "refs_bib.hpp"

namespace ballflow::report {
namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  std::map<std::string, Source> all() {
    std::map<std::string, Source> sources;
    while (at_ < text_.size()) {
      if (text_[at_++] != '@') continue;  // what is between entries is a comment
      Source source;
      source.kind = word();
      expect('{');
      const std::string key = word(false);
      if (key.empty()) fail("an entry without a key");
      expect(',');
      while (!take('}')) {
        const std::string name = word();
        if (name.empty()) fail("a field without a name");
        expect('=');
        source.fields[name] = value();
        if (!take(',')) {
          expect('}');
          break;
        }
      }
      if (!sources.emplace(key, std::move(source)).second) fail("the key " + key + " is not unique");
    }
    return sources;
  }

 private:
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool take(char c) {
    skip_space();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(std::string("\"") + c + "\" is missing");
  }
  std::string word(bool lower = true) {
    skip_space();
    std::string name;
    for (; at_ < text_.size() && !std::isspace(static_cast<unsigned char>(text_[at_])) &&
           std::string_view("{}=,\"").find(text_[at_]) == std::string_view::npos;
         ++at_) {
      const auto c = static_cast<unsigned char>(text_[at_]);
      name += static_cast<char>(lower ? std::tolower(c) : c);
    }
    return name;
  }
  std::string value() {
    const bool quoted = take('"');
    if (!quoted && !take('{')) return word();
    std::string out;
    for (int depth = 0; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (depth == 0 && c == (quoted ? '"' : '}')) {
        ++at_;
        return out;
      }
      if (c == '{') {
        ++depth;
      } else if (c == '}') {
        --depth;
      } else if (c == '\\' && at_ + 1 < text_.size() &&
                 std::string_view("&_%#$").find(text_[at_ + 1]) != std::string_view::npos) {
        continue;
      } else if (std::isspace(static_cast<unsigned char>(c))) {
        if (!out.empty() && out.back() != ' ') out += ' ';
      } else {
        out += c;
      }
    }
    fail("a value has no end");
  }
  [[noreturn]] void fail(const std::string& what) const {
    const auto read = text_.substr(0, std::min(at_, text_.size()));
    throw Error(
        ExitCode::store,
        "BibTeX, line " + std::to_string(1 + std::count(read.begin(), read.end(), '\n')) + ": " + what);
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

}  // namespace

std::string Source::text() const {
  const auto field = [this](const char* name) {
    const auto found = fields.find(name);
    return found == fields.end() ? std::string() : replaced(found->second, "--", "\xe2\x80\x93");
  };
  std::string out = replaced(field("author"), " and ", "; ");
  const auto add = [&out](const std::string& before, const std::string& part) {
    if (!part.empty()) out += (out.empty() ? "" : before) + part;
  };
  add(": ", field("title"));
  for (const char* const place : {"journal", "booktitle", "school", "howpublished", "publisher"}) {
    add(". ", field(place));
  }
  add(" ", field("volume"));
  if (!field("number").empty()) add("", "(" + field("number") + ")");
  add(", ", field("pages"));
  add(", ", field("year"));
  return out + ".";
}

std::map<std::string, Source> parse_bibtex(std::string_view text) { return Parser(text).all(); }

const std::map<std::string, Source>& built_in_sources() {
  static const std::map<std::string, Source> sources = parse_bibtex(refs_bib);
  return sources;
}

}  // namespace ballflow::report
