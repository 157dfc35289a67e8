#include "io/number_rows.hpp"

#include <algorithm>
#include <cmath>

#include "io/raw_model.hpp"

namespace ballflow::geometry {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Commas between two digits.
std::size_t inner_commas(std::string_view token) {
  std::size_t count = 0;
  for (std::size_t i = 1; i + 1 < token.size(); ++i) {
    count += token[i] == ',' && is_digit(token[i - 1]) && is_digit(token[i + 1]);
  }
  return count;
}

std::size_t commas(std::string_view token) {
  return static_cast<std::size_t>(std::count(token.begin(), token.end(), ','));
}

/// "1.234,5"
bool has_thousands(std::string_view token) {
  const std::size_t comma = token.find(',');
  return commas(token) == 1 && comma >= 4 && token[comma - 4] == '.' &&
         token.find('.', comma) == std::string_view::npos;
}

/// Whether all blanks between fields have a comma beside them.
bool commas_separate_fields(std::string_view line) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (!is_blank(line[i])) continue;
    const std::size_t begin = i;
    while (i < line.size() && is_blank(line[i])) ++i;
    if (i == line.size() || begin == 0) continue;
    if (line[begin - 1] != ',' && line[i] != ',') return false;
  }
  return true;
}

/// The name of a column in small letters, without quotes and unit: "X [mm]" is x.
std::string plain_name(std::string_view field) {
  std::string name;
  for (const char c : field.substr(0, field.find_first_of("[("))) {
    if (c != '"' && c != '\'' && !is_blank(c)) name += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  }
  // As ParaView writes the components of points and normals.
  for (const std::string_view vector : {"points", "normals"}) {
    if (name.size() != vector.size() + 2 || !name.starts_with(vector)) continue;
    const char sign = name[vector.size()], last = name.back();
    if ((sign == ':' || sign == '_') && last >= '0' && last <= '2') {
      return std::string(vector == "normals" ? "n" : "") + static_cast<char>('x' + (last - '0'));
    }
  }
  return name;
}

/// Whether tabs, and no other blanks, are between the names: "X [mm]" is one.
bool is_table_of_tabs(std::string_view names) {
  if (names.find('\t') == std::string_view::npos) return false;
  bool unit = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == '[' || names[i] == '(') unit = true;
    if (names[i] == '\t') unit = false;
    if (names[i] != ' ' || unit) continue;
    const std::size_t next = names.find_first_not_of(' ', i);
    if (next != std::string_view::npos && names[next] != '[' && names[next] != '(' && names[next] != '\t') {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string_view NumberRows::next_line() {
  for (;; text_.next_line()) {
    if (lines_++ % elements_per_step == 0) {
      monitor_.step(0.8 * static_cast<double>(text_.offset()) / static_cast<double>(size_ + 1));
    }
    std::string_view rest = text_.rest_of_line();
    rest = rest.substr(0, rest.find('#'));
    while (!rest.empty() && is_blank(rest.back())) rest.remove_suffix(1);
    if (!rest.empty() || text_.at_end()) return rest;
  }
}

bool NumberRows::read_names() {
  const TextCursor start = text_;
  const std::string_view line = next_line();
  std::string_view words = line;
  if (words.starts_with("//")) words.remove_prefix(2);
  for (const char c : {';', ','}) {
    if (delimiter_ == 0 && words.find(c) != std::string_view::npos) delimiter_ = c;
  }
  if (delimiter_ == 0 && is_table_of_tabs(words)) delimiter_ = '\t';
  split(words, true);
  // A word begins with a letter, perhaps in quotes. A line with any number in it is none of names.
  bool names = !fields_.empty();
  for (const std::string_view field : fields_) {
    const char first = plain_name(field).empty() ? ' ' : plain_name(field).front();
    if (parse_real(field) || is_digit(first) || first == '-' || first == '+' || first == '.') names = false;
  }
  if (!names) {
    text_ = start;
    delimiter_ = 0;
    return false;
  }
  for (const std::string_view field : fields_) names_.push_back(plain_name(field));
  names_line_ = line;
  text_.next_line();
  return true;
}

std::optional<std::size_t> NumberRows::column(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

bool NumberRows::next() {
  for (;;) {
    line_ = next_line();
    if (line_.empty()) break;
    text_.next_line();
    if (line_.starts_with("//")) continue;
    const Commas meaning = meaning_of_commas(line_);
    if (meaning != Commas::unknown && meaning != commas_) {
      if (commas_ != Commas::unknown)
        refuse_commas("commas separate numbers in one line and are decimal in another");
      commas_ = meaning;
      if (meaning == Commas::decimal) monitor_.warn("the numbers have decimal commas, and are read so");
    }
    split(line_, meaning == Commas::separate);
    if (fields_.empty()) continue;
    require_equal_columns();
    return true;
  }
  // Only now it is known that no number has a decimal point.
  if (whole_fields_ >= 2 * least_ && names_.empty() && !points_) {
    line_ = whole_line_;
    refuse_commas("whole numbers and nothing but commas between them: commas may separate or be decimal");
  }
  return false;
}

NumberRows::Commas NumberRows::meaning_of_commas(std::string_view line) {
  const bool point = line.find_first_of(".eE") != std::string_view::npos;
  points_ = points_ || point;
  if (line.find(',') == std::string_view::npos) return Commas::unknown;
  split(line, false);
  const bool enough = fields_.size() >= least_ && delimiter_ != ',';
  bool inner = false, single = true;
  for (const std::string_view field : fields_) {
    inner = inner || inner_commas(field) > 0;
    single = single && commas(field) <= 1;
  }
  if (enough && inner) {
    if (!point && single) return Commas::decimal;
    // "1.5,2.5,3.5 255 0 0" or "1.5 2.5 3.5 255,0,0".
    bool plain = true;
    for (std::size_t i = 0; i < least_; ++i) plain = plain && commas(fields_[i]) == 0;
    if (plain || commas(fields_[0]) + 1 >= least_) return Commas::separate;
    // "1.5,2.5, 3.5", where no blank is without a comma.
    const bool thousands = std::any_of(fields_.begin(), fields_.end(), has_thousands);
    if (point && !thousands && commas_separate_fields(line)) return Commas::separate;
    refuse_commas("commas beside decimal points: they may separate numbers, or thousands");
  }
  if (point) return Commas::separate;
  split(line, true);
  if (whole_fields_ == 0) {
    whole_fields_ = fields_.size();
    whole_line_ = line;
  }
  if (!names_.empty() && fields_.size() > names_.size()) {
    refuse_commas(std::to_string(fields_.size()) + " whole numbers between commas for " +
                  std::to_string(names_.size()) + " columns: commas may separate or be decimal");
  }
  return Commas::separate;
}

void NumberRows::require_equal_columns() {
  const std::size_t columns = fields_.size() + dropped_;
  if (columns < 2) return;  // a number of points
  if (columns_ == 0) {
    columns_ = columns;
    first_line_ = line_;
  } else if (columns != columns_ && ragged_line_.empty()) {
    ragged_line_ = line_;
  }
  // Without commas a line may have more than another; with them it may be meant differently.
  if (commas_ != Commas::separate || ragged_line_.empty()) return;
  line_ = ragged_line_;
  split(line_, true);
  refuse_commas("commas separate fields, but the line has " + std::to_string(fields_.size() + dropped_) +
                " of them and the first one " + std::to_string(columns_) + text_.place_of(first_line_));
}

void NumberRows::refuse_commas(const std::string& what) const {
  throw InputError(
      what + place(),
      "write numbers with decimal points, or with decimal commas and blanks or semicolons between");
}

bool NumberRows::is_delimited(std::string_view line) const {
  if (delimiter_ == 0) return false;
  const auto count = static_cast<std::size_t>(std::count(line.begin(), line.end(), delimiter_));
  // Lines may have any blanks under names with tabs between them, but not with as many tabs.
  return delimiter_ == '\t' && !names_.empty() ? count + 1 == names_.size() : count > 0;
}

void NumberRows::split(std::string_view line, bool at_commas) {
  fields_.clear();
  if (is_delimited(line)) return split_at(line, delimiter_);
  bool open = true;  // nothing since the last separator that is no blank
  for (std::size_t i = 0; i < line.size();) {
    const char c = line[i];
    if (is_blank(c)) {
      ++i;
    } else if (c == ';' || (at_commas && c == ',')) {
      if (open) fields_.push_back(line.substr(i, 0));
      open = true;
      ++i;
    } else {
      std::size_t end = i + 1;
      while (end < line.size() && !is_blank(line[end]) && line[end] != ';' &&
             !(at_commas && line[end] == ',')) {
        ++end;
      }
      std::string_view field = line.substr(i, end - i);
      // In "1,5, 2,5" a comma at the end of a field separates.
      if (!at_commas && field.ends_with(',')) field.remove_suffix(1);
      if (!field.empty()) fields_.push_back(field);
      open = false;
      i = end;
    }
  }
  drop_empty_end();
}

void NumberRows::drop_empty_end() {
  const std::size_t before = fields_.size();
  while (!fields_.empty() && fields_.back().empty()) fields_.pop_back();
  dropped_ = before - fields_.size();
}

void NumberRows::split_at(std::string_view line, char delimiter) {
  bool quoted = false;
  for (std::size_t begin = 0, i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') quoted = !quoted;
    if (i < line.size() && (quoted || line[i] != delimiter)) continue;
    std::string_view field = line.substr(begin, i - begin);
    while (!field.empty() && (is_blank(field.front()) || field.front() == '"')) field.remove_prefix(1);
    while (!field.empty() && (is_blank(field.back()) || field.back() == '"')) field.remove_suffix(1);
    fields_.push_back(field);
    begin = i + 1;
  }
  drop_empty_end();
}

std::optional<double> NumberRows::number(std::size_t i) const {
  if (i >= fields_.size()) return std::nullopt;
  if (commas_ != Commas::decimal || fields_[i].find(',') == std::string_view::npos)
    return parse_real(fields_[i]);
  std::string copy(fields_[i]);
  std::replace(copy.begin(), copy.end(), ',', '.');
  return parse_real(copy);
}

double NumberRows::coordinate(std::size_t i, const char* element, std::int64_t number,
                              const char* name) const {
  const auto value = this->number(i);
  if (value && std::isfinite(*value)) return *value;
  const std::string_view end = line_.substr(line_.size());
  return parse_coordinate(text_, i < fields_.size() ? fields_[i] : end, element, number, name);
}

bool names_columns(std::string_view content) {
  NumberRows rows(content, 3, no_monitor());
  return rows.read_names() && rows.column("x") && rows.column("y") && rows.column("z");
}

}  // namespace ballflow::geometry
