// What the readers of balls have in common: a list that grows, and lines with a ball each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.hpp"
#include "io/load_balls.hpp"
#include "io/raw_model.hpp"
#include "io/text_cursor.hpp"

namespace ballflow::geometry {

constexpr const char* damaged_balls = "the file is cut off or damaged; fetch or write it again";

/// "ball 12: "
inline std::string place_of_element(const char* element, std::int64_t number) {
  return std::string(element) + " " + std::to_string(number) + ": ";
}

struct BallList {
  std::vector<Vec3> centers;
  std::vector<double> radii;

  /// Throws InputError when the list is full.
  void add(const Vec3& center, double radius);
  /// Throws InputError when the list is empty.
  Balls take();
};

/// Goes through the lines of a text, leaving out empty ones and comments.
class LineReader {
 public:
  LineReader(std::string_view content, Monitor& monitor)
      : text_(content, '#'), size_(content.size()), monitor_(monitor) {}

  /// The first token that is left, empty at the end of the text.
  std::string_view begin() {
    if (lines_++ % elements_per_step == 0) {
      monitor_.step(0.8 * static_cast<double>(text_.offset()) / static_cast<double>(size_ + 1));
    }
    return text_.token();
  }
  std::string_view token() { return text_.token_on_line(); }
  void end() { text_.next_line(); }
  std::string place_of(std::string_view token) const { return text_.place_of(token); }
  std::size_t remaining() const { return text_.remaining(); }

  /// Reads x, y, z and r, the first of which is `token`. A negative radius is refused unless `unused` says
  /// that it stands for no ball.
  void ball(std::string_view token, const char* element, BallList& balls, bool unused = false);

  /// The rest of the line must be at most `most` whole numbers. True when number `deleted` of them, counted
  /// from 0, is there and is 1.
  bool deleted_flag(const char* element, std::int64_t number, int most, int deleted);

 private:
  TextCursor text_;
  std::size_t size_;
  Monitor& monitor_;
  std::int64_t lines_ = 0;
};

/// Throws InputError, naming the line, when the file goes on after what it promised.
void require_end(LineReader& lines, const std::string& promise);

/// A medial axis as Q-MAT, MATFP and MATTopo write it; see load_balls.
LoadedBalls parse_ma(std::string_view content, Monitor& monitor);

}  // namespace ballflow::geometry
