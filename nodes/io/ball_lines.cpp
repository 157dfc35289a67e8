#include "io/ball_lines.hpp"

#include <utility>

namespace ballflow::geometry {

void BallList::add(const Vec3& center, double radius) {
  if (radii.size() == static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw InputError("the file has too many balls", "thin it out first");
  }
  centers.push_back(center);
  radii.push_back(radius);
}

Balls BallList::take() {
  if (radii.empty()) throw InputError("the file has no ball", "a line of a list of balls is x y z r");
  return {std::move(centers), std::move(radii), {}, {}};
}

void LineReader::ball(std::string_view token, const char* element, BallList& balls, bool unused) {
  const auto number = static_cast<std::int64_t>(balls.radii.size());
  const double x = parse_coordinate(text_, token, element, number, "x");
  const double y = parse_coordinate(text_, text_.token_on_line(), element, number, "y");
  const double z = parse_coordinate(text_, text_.token_on_line(), element, number, "z");
  const std::string_view radius = text_.token_on_line();
  const double r = parse_coordinate(text_, radius, element, number, "r");
  if (r < 0 && !unused) {
    throw InputError(
        place_of_element(element, number) + "the radius is " + excerpt(radius) + place_of(radius),
        "a radius is at least 0");
  }
  balls.add({x, y, z}, r);
}

bool LineReader::deleted_flag(const char* element, std::int64_t number, int most, int deleted) {
  bool is_deleted = false;
  for (int k = 0;; ++k) {
    const std::string_view token = text_.token_on_line();
    if (token.empty()) return is_deleted;
    const auto value = parse_integer(token);
    if (k >= most || !value || (k == deleted && *value != 0 && *value != 1)) {
      throw InputError(place_of_element(element, number) + excerpt(token) +
                           " is one number too many or no flag" + place_of(token),
                       "check the format of the line; the flag \"deleted\" is 0 or 1");
    }
    if (k == deleted) is_deleted = *value == 1;
  }
}

void require_end(LineReader& lines, const std::string& promise) {
  const std::string_view token = lines.begin();
  if (token.empty()) return;
  throw InputError(excerpt(token) + " follows after " + promise + lines.place_of(token), damaged_balls);
}

}  // namespace ballflow::geometry
