// Lines of numbers, as lists of points and of balls have them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {

/// Goes through the lines of a text, leaving out empty ones and comments ("#" to the end of a line, lines
/// that begin with "//").
///
/// - Fields are separated by blanks, semicolons or commas. An empty field between two commas is a field.
/// - Commas are decimal commas when blanks or semicolons separate the fields and some of these hold a comma
///   between digits ("1,5 0,2 3" or "1,5;0,2;3"); a warning says so. Lines that can be read both ways are
///   refused: those with a decimal point as well ("1.234,5"), those that are at variance with earlier ones,
///   and whole numbers between commas where there are twice as many as are needed ("1,4000,0,0000,0,0000").
/// - A first line of words names the columns; a comment sign "//" before them is passed over. What separates
///   them, a comma, a semicolon or a tab, then separates fields, which may be in quotes.
class NumberRows {
 public:
  /// A line that is of use has at least `least` fields.
  NumberRows(std::string_view content, std::size_t least, Monitor& monitor)
      : text_(content, '#'), size_(content.size()), least_(least), monitor_(monitor) {}

  /// Reads the names of the columns if the first line has them. To be called first.
  bool read_names();
  /// The column with this name (in small letters); none where no column has it.
  std::optional<std::size_t> column(std::string_view name) const;
  /// How many columns have names.
  std::size_t columns() const { return names_.size(); }
  /// The first line as it is written, where it is one of names.
  std::string_view names() const { return names_line_; }

  /// Goes to the next line with a field; false at the end. Throws InputError for commas that can mean both.
  bool next();
  std::span<const std::string_view> fields() const { return fields_; }
  /// Field `i` of the line as a coordinate; see parse_coordinate.
  double coordinate(std::size_t i, const char* element, std::int64_t number, const char* name) const;
  /// Field `i` as a number; none where it is missing or no number.
  std::optional<double> number(std::size_t i) const;
  /// " (line 12)"
  std::string place() const { return text_.place_of(line_); }
  std::string place_of(std::string_view token) const { return text_.place_of(token); }

 private:
  enum class Commas { unknown, separate, decimal };

  std::string_view next_line();
  Commas meaning_of_commas(std::string_view line);
  bool is_delimited(std::string_view line) const;
  void split(std::string_view line, bool at_commas);
  void split_at(std::string_view line, char delimiter);
  void drop_empty_end();
  void require_equal_columns();
  [[noreturn]] void refuse_commas(const std::string& what) const;

  TextCursor text_;
  std::size_t size_, least_;
  Monitor& monitor_;
  std::int64_t lines_ = 0;
  std::string_view line_, names_line_;
  std::vector<std::string> names_;
  std::vector<std::string_view> fields_;
  char delimiter_ = 0;  // between the names of columns, if that is no blank
  Commas commas_ = Commas::unknown;
  std::size_t dropped_ = 0;                    // empty fields at the end of the line
  std::size_t columns_ = 0;                    // of the first line
  std::string_view first_line_, ragged_line_;  // and the first one with another number of fields
  bool points_ = false;                        // a decimal point, or an exponent, was somewhere
  std::string_view whole_line_;  // the first line of whole numbers between commas, and its fields
  std::size_t whole_fields_ = 0;
};

/// True when the first line names columns x, y and z.
bool names_columns(std::string_view content);

}  // namespace ballflow::geometry
