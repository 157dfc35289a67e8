#include "motion/path_balls.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "exact/separation.hpp"
#include "io/file_content.hpp"
#include "io/lengths.hpp"
#include "io/number_rows.hpp"

namespace ballflow::geometry {
namespace {

constexpr std::string_view inline_scheme = "path:";
constexpr double most_balls = 2e7;
constexpr std::int64_t max_unpacked_bytes = std::int64_t{1} << 30;

struct Columns {
  std::size_t x = 0, y = 1, z = 2;
  std::optional<std::size_t> radius;
  double share = 1;  // of what is in that column: a width is twice a radius
};

Columns named_columns(const NumberRows& rows) {
  Columns at;
  const auto x = rows.column("x"), y = rows.column("y"), z = rows.column("z");
  if (!x || !y || !z)
    throw InputError("the columns of the path are called \"" + std::string(rows.names()) + "\"",
                     "name them x, y, z, and r, radius or width where there is one");
  at.x = *x;
  at.y = *y;
  at.z = *z;
  for (const auto& [name, share] : {std::pair{"r", 1.0}, {"radius", 1.0}, {"width", 0.5}}) {
    if (const auto column = rows.column(name); column && !at.radius) {
      at.radius = column;
      at.share = share;
    }
  }
  return at;
}

void check_length(double value, std::int64_t number, const std::string& place) {
  if (std::abs(value) <= largest_separable) return;
  throw InputError("point " + std::to_string(number) + " has a coordinate or a radius beyond 1e140" + place,
                   "use another unit of length");
}

/// What of a radius or a place rounding may have taken, generously.
double upwards(double value) { return value * (1 + 0x1p-48); }

/// The squared radius that two balls need beyond their own to hold all balls between them.
double extra(double gap, double difference) {
  const double h = upwards(gap), d = difference * (1 - 0x1p-48);
  return h <= d ? 0 : 0.25 * upwards(h * h - d * d);
}

}  // namespace

Path read_path(std::string_view content, double width, double scale, Monitor& monitor) {
  if (!(width >= 0) || !std::isfinite(width))
    throw InputError("the width is negative or not finite", "0 is a line");
  NumberRows rows(content, 3, monitor);
  const bool named = rows.read_names();
  Columns at = named ? named_columns(rows) : Columns{};
  std::vector<Vec3> points;
  std::vector<double> radii;
  std::int64_t number = 0, repeated = 0;
  while (rows.next()) {
    const auto count = rows.fields().size();
    if (number == 0 && !named && count == 4) at.radius = 3;
    const std::size_t wanted = named ? rows.columns() : at.radius ? 4 : 3;
    if (count != wanted && (!named || count < wanted))
      throw InputError("point " + std::to_string(number) + " has " + std::to_string(count) +
                           " numbers instead of " + std::to_string(wanted) + rows.place(),
                       "a line of a path is x y z, or on all lines x y z radius");
    const Vec3 p{rows.coordinate(at.x, "point", number, "x"), rows.coordinate(at.y, "point", number, "y"),
                 rows.coordinate(at.z, "point", number, "z")};
    double radius = 0.5 * width;
    if (at.radius) radius = at.share * rows.coordinate(*at.radius, "point", number, "radius");
    if (radius < 0)
      throw InputError("point " + std::to_string(number) + " has a negative radius" + rows.place(),
                       "a radius is at least 0");
    const Vec3 scaled{scale * p.x, scale * p.y, scale * p.z};
    for (const double value : {scaled.x, scaled.y, scaled.z, scale * radius})
      check_length(value, number, rows.place());
    if (!points.empty() && points.back() == scaled) {
      radii.back() = std::max(radii.back(), scale * radius);
      ++repeated;
    } else {
      points.push_back(scaled);
      radii.push_back(scale * radius);
    }
    ++number;
  }
  if (points.empty())
    throw InputError("the path has no point", "a line of a path is x y z, and perhaps a radius");
  if (repeated > 0)
    monitor.warn(std::to_string(repeated) + (repeated == 1 ? " point repeats" : " points repeat") +
                 " the one before, and count as one with the larger radius");
  Path path;
  path.points = std::move(points);
  path.radii = std::move(radii);
  return path;
}

Balls balls_along(Path& path, double spacing, PathSide side, Monitor& monitor) {
  const std::size_t n = path.size();
  if (n > 1 && !(spacing > 0)) throw InputError("the spacing of the path is 0", "give a length above 0");
  double total = static_cast<double>(n);
  double largest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 p = path.points[i];
    largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (i > 0) total += std::ceil(distance(path.points[i - 1], p) / spacing) - 1;
  }
  if (!(total <= most_balls))
    throw InputError("the path would have more than 20 million balls",
                     "use a larger spacing, or a shorter path");

  std::vector<Vec3> centers{path.points[0]};
  std::vector<double> radii{path.radii[0]}, extras{0}, moved{0};
  Lookout look(monitor);
  path.spacing = 0;
  for (std::size_t i = 1; i < n; ++i) {
    const Vec3 from = path.points[i - 1], way = path.points[i] - from;
    const double r = path.radii[i - 1], growth = path.radii[i] - r, all = length(way);
    const double steps = std::max(1.0, std::ceil(all / spacing));
    const double between = extra(all / steps, std::abs(growth) / steps);
    path.spacing = std::max(path.spacing, upwards(all / steps));
    extras.back() = std::max(extras.back(), between);
    for (double k = 1; k <= steps; ++k) {
      look(16);
      const bool end = k == steps;
      const double t = k / steps;
      centers.push_back(end ? path.points[i] : from + t * way);
      radii.push_back(end ? path.radii[i] : r + t * growth);
      extras.push_back(between);
      // A center between two points is where it should be up to some units in the last place of the largest
      // number.
      moved.push_back(end ? 0 : 0x1p-48 * largest);
    }
  }
  // The same for both sides: as far as outer balls reach beyond the path, as much inner ones may leave out.
  path.error = 0;
  for (std::size_t i = 0; i < centers.size(); ++i) {
    const double r = radii[i];
    double outer = r;
    if (extras[i] > 0) outer = upwards(std::sqrt(r * r + extras[i]));
    if (moved[i] > 0) outer = upwards(std::max(outer, upwards(r)) + moved[i]);
    const double inner = moved[i] > 0 ? std::max(0.0, r * (1 - 0x1p-48) - moved[i]) : r;
    path.error = std::max(path.error, upwards(outer - inner));
    radii[i] = side == PathSide::outer ? outer : inner;
  }
  path.balls = static_cast<std::int64_t>(centers.size());
  path.contains = side == PathSide::outer ? 1 : 0;
  return {std::move(centers), std::move(radii), {}, {}};
}

PathWithBalls path_balls(const PathBallsOptions& options, Monitor& monitor) {
  const double scale = parse_scale(options.scale);
  const Tolerance spacing = parse_tolerance(options.spacing);
  PathWithBalls result;
  if (options.file.starts_with(inline_scheme)) {
    std::string text = options.file.substr(inline_scheme.size());
    std::replace(text.begin(), text.end(), ';', '\n');
    result.path = read_path(text, options.width, scale, monitor);
  } else {
    const FileContent content = read_file_content(options.file, max_unpacked_bytes);
    result.path = read_path(content.view(), options.width, scale, monitor);
  }
  const double edge = bounding_box(result.path.points.span()).longest_edge();
  result.balls = balls_along(result.path, spacing.length(edge), options.side, monitor);
  return result;
}

}  // namespace ballflow::geometry
