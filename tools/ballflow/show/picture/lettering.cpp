#include "show/picture/lettering.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "show/picture/light.hpp"

namespace ballflow::show {
namespace {

struct Glyph {
  char letter;
  int width;                 // of what is drawn
  std::string_view strokes;  // separated by spaces
};

// Strokes are points of two digits, x and y upwards: letters stand on y = 2, small ones reach to 6 or 8,
// capitals to 8, and what hangs below goes to 0. A stroke that begins with ~ is a smooth curve (its inner
// points are control points of a B-spline), with @ a closed one; a point twice is a dot.
constexpr std::array<Glyph, 83> font = {{
    {'a', 4, "@02424606 4642"},
    {'b', 4, "0802 @02424606"},
    {'c', 4, "~454606024243"},
    {'d', 4, "4842 @02424606"},
    {'e', 4, "0444 ~444606024243"},
    {'f', 3, "~12152838 0626"},
    {'g', 4, "@02424606 ~46434000"},
    {'h', 4, "0802 ~04064642"},
    {'i', 0, "0602 0808"},
    {'j', 1, "~16131000 1818"},
    {'k', 3, "0802 3603 1432"},
    {'l', 1, "~08030212"},
    {'m', 6, "0602 ~04063632 ~34366662"},
    {'n', 4, "0602 ~04064642"},
    {'o', 4, "@02424606"},
    {'p', 4, "0600 @02424606"},
    {'q', 4, "4640 @02424606"},
    {'r', 2, "0602 ~040626"},
    {'s', 3, "~3536060434320203"},
    {'t', 2, "~18141222 0626"},
    {'u', 4, "~06024244 4642"},
    {'v', 4, "062246"},
    {'w', 6, "0612365266"},
    {'x', 4, "0642 0246"},
    {'y', 4, "0622 4610"},
    {'z', 4, "06460242"},
    {'A', 4, "022842 1434"},
    {'B', 4, "0208 ~08484505 ~05454202"},
    {'C', 4, "~474808024243"},
    {'D', 4, "0208 ~08484202"},
    {'E', 4, "48080242 0535"},
    {'F', 4, "480802 0535"},
    {'G', 4, "~474808024244 442444"},
    {'H', 4, "0802 4842 0545"},
    {'I', 0, "0802"},
    {'J', 3, "~383532020203"},
    {'K', 4, "0802 4804 1542"},
    {'L', 4, "080242"},
    {'M', 6, "0208336862"},
    {'N', 4, "02084248"},
    {'O', 5, "@02525808"},
    {'P', 4, "0208 ~08484505"},
    {'Q', 5, "@02525808 3351"},
    {'R', 4, "0208 ~08484505 2542"},
    {'S', 4, "~4748080545420203"},
    {'T', 4, "0848 2822"},
    {'U', 4, "~080502424548"},
    {'V', 4, "082248"},
    {'W', 6, "0812365268"},
    {'X', 4, "0842 0248"},
    {'Y', 4, "082548 2522"},
    {'Z', 4, "08480242"},
    {'0', 4, "@02424808"},
    {'1', 2, "072822"},
    {'2', 4, "~070848450302 0242"},
    {'3', 4, "~0708484515 ~1545420203"},
    {'4', 4, "380444 3832"},
    {'5', 4, "480805 ~054642020203"},
    {'6', 4, "@02424505 ~04084847"},
    {'7', 4, "084812"},
    {'8', 4, "@05454808 @02424505"},
    {'9', 4, "@05454808 ~46420203"},
    {'.', 0, "0202"},
    {',', 1, "1201"},
    {':', 0, "0202 0505"},
    {';', 1, "1201 1515"},
    {'-', 3, "0434"},
    {'+', 4, "0444 2226"},
    {'/', 3, "0138"},
    {'(', 1, "~19070311"},
    {')', 1, "~09171301"},
    {'[', 1, "19090111"},
    {']', 1, "09191101"},
    {'%', 4, "0248 @07170808 @32423343"},
    {'_', 4, "0141"},
    {'=', 4, "0343 0545"},
    {'<', 4, "460442"},
    {'>', 4, "064402"},
    {'*', 4, "0444 1632 1236"},
    {'#', 4, "1218 3238 0444 0646"},
    {'\'', 0, "0807"},
    {'!', 0, "0804 0202"},
    {' ', 2, ""},
}};

constexpr Glyph unknown = {'?', 4, "0242480802"};
constexpr double gap = 2, weight = 0.75;  // between letters, and of strokes

const Glyph& glyph_of(char letter) {
  for (const Glyph& glyph : font) {
    if (glyph.letter == letter) return glyph;
  }
  return unknown;
}

struct Point {
  double x = 0, y = 0;
};

Point between(Point a, Point b, double t) { return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; }

/// Chaikin's corner cutting: every corner is cut off at a quarter of its sides.
std::vector<Point> smoothed(std::vector<Point> points, bool closed) {
  for (int round = 0; round < 4; ++round) {
    std::vector<Point> finer;
    if (!closed) finer.push_back(points.front());
    const std::size_t sides = closed ? points.size() : points.size() - 1;
    for (std::size_t i = 0; i < sides; ++i) {
      const Point a = points[i], b = points[(i + 1) % points.size()];
      if (closed || i > 0) finer.push_back(between(a, b, 0.25));
      if (closed || i + 1 < sides) finer.push_back(between(a, b, 0.75));
    }
    if (!closed) finer.push_back(points.back());
    points = std::move(finer);
  }
  if (closed) points.push_back(points.front());
  return points;
}

std::vector<Point> points_of(std::string_view stroke) {
  const char kind = stroke.front();
  if (kind == '~' || kind == '@') stroke.remove_prefix(1);
  std::vector<Point> points;
  for (std::size_t i = 0; i + 1 < stroke.size(); i += 2) {
    points.push_back({static_cast<double>(stroke[i] - '0'), static_cast<double>(stroke[i + 1] - '0')});
  }
  return kind == '~' || kind == '@' ? smoothed(std::move(points), kind == '@') : points;
}

double distance(Point p, Point a, Point b) {
  const double dx = b.x - a.x, dy = b.y - a.y, squared = dx * dx + dy * dy;
  const double along = (p.x - a.x) * dx + (p.y - a.y) * dy;
  const Point nearest = squared > 0 ? between(a, b, std::clamp(along / squared, 0.0, 1.0)) : a;
  return std::sqrt((p.x - nearest.x) * (p.x - nearest.x) + (p.y - nearest.y) * (p.y - nearest.y));
}

/// Lays a colour over a pixel that it covers in part.
void lay_over(Image& image, int x, int y, double coverage, Light light) {
  if (coverage <= 0) return;
  std::uint8_t* const pixel =
      image.rgba.data() +
      4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
  const double below = pixel[3] / 255.0, opacity = coverage + (1 - coverage) * below;
  const Light seen = mixed(light_of({pixel[0], pixel[1], pixel[2]}), light, coverage / opacity);
  const Colour colour = colour_of(seen);
  pixel[0] = colour.red;
  pixel[1] = colour.green;
  pixel[2] = colour.blue;
  pixel[3] = static_cast<std::uint8_t>(255 * opacity + 0.5);
}

}  // namespace

double text_width(std::string_view text, double capital) {
  double width = 0;
  for (const char letter : text) width += glyph_of(letter).width + gap;
  return text.empty() ? 0 : (width - gap) * capital / 6;
}

void draw_text(Image& image, double x, double y, double capital, std::string_view text, Colour colour) {
  const double unit = capital / 6, radius = weight / 2 * unit;
  const Light light = light_of(colour);
  for (const char letter : text) {
    const Glyph& glyph = glyph_of(letter);
    std::vector<std::vector<Point>> strokes;
    for (std::size_t i = 0; i < glyph.strokes.size();) {
      const std::size_t end = std::min(glyph.strokes.find(' ', i), glyph.strokes.size());
      strokes.push_back(points_of(glyph.strokes.substr(i, end - i)));
      for (Point& p : strokes.back()) p = {x + p.x * unit, y - (p.y - 2) * unit};
      i = end + 1;
    }
    const int left = std::max(0, static_cast<int>(std::floor(x - unit)));
    const int right = std::min(image.width, static_cast<int>(std::ceil(x + (glyph.width + 1) * unit)) + 1);
    const int top = std::max(0, static_cast<int>(std::floor(y - 8 * unit)));
    const int bottom = std::min(image.height, static_cast<int>(std::ceil(y + 3 * unit)) + 1);
    for (int py = top; py < bottom; ++py) {
      for (int px = left; px < right; ++px) {
        double nearest = 1e9;
        for (const auto& stroke : strokes) {
          for (std::size_t i = 0; i + 1 < stroke.size(); ++i) {
            nearest = std::min(nearest, distance({px + 0.5, py + 0.5}, stroke[i], stroke[i + 1]));
          }
        }
        lay_over(image, px, py, std::clamp(radius + 0.5 - nearest, 0.0, 1.0), light);
      }
    }
    x += (glyph.width + gap) * unit;
  }
}

void fill(Image& image, double x, double y, double width, double height, Colour colour) {
  const Light light = light_of(colour);
  const auto part = [](int pixel, double from, double length) {
    return std::clamp(std::min(pixel + 1.0, from + length) - std::max<double>(pixel, from), 0.0, 1.0);
  };
  const int bottom = std::min(image.height, static_cast<int>(std::ceil(y + height)));
  const int right = std::min(image.width, static_cast<int>(std::ceil(x + width)));
  for (int py = std::max(0, static_cast<int>(std::floor(y))); py < bottom; ++py) {
    for (int px = std::max(0, static_cast<int>(std::floor(x))); px < right; ++px) {
      lay_over(image, px, py, part(px, x, width) * part(py, y, height), light);
    }
  }
}

}  // namespace ballflow::show
