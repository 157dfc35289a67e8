// Balls for a path: what a Minkowski sum needs to move something along a polyline.
#pragma once

#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/path.hpp"

namespace ballflow::geometry {

enum class PathSide {
  outer,  // the union of the balls contains the path
  inner,  // it lies in the path: the places along it, and nothing between them
};

struct PathBallsOptions {
  // A file with a point a line, x y z and perhaps a radius, also packed (gzip, zstd), or path: and the
  // points, separated by semicolons ("path:0 0 0; 1 0 0; 1 1 0").
  std::string file;
  std::string scale =
      "1";           // of coordinates, radii and width: a factor, or the unit of the file; see parse_scale
  double width = 0;  // of the path where the file has no radii: twice the radius; in the unit of the file
  std::string spacing = "0.5%";  // of centers along the path, a length or a share; see parse_tolerance
  PathSide side = PathSide::outer;
};

struct PathWithBalls {
  Path path;
  Balls balls;  // along it
};

/// Reads a polyline. Rows are those of NumberRows: blanks, commas or semicolons between the numbers, names of
/// columns in the first line or not (x, y, z, and r or radius or width, in any order). Points that repeat the
/// one before them are left out, with a warning where the radius is the same; of others with the same place
/// and another radius the larger one stays. One point is a path. Throws InputError for no point, for what is
/// no number or not finite, for negative radii, for rows of less than three numbers, and for coordinates or
/// radii beyond 1e140.
Path read_path(std::string_view content, double width, double scale, Monitor& monitor = no_monitor());

/// Balls around all points of the path, and between them so many that centers are no farther apart than the
/// spacing.
///
/// outer: of two balls with squared radii r^2 + e and s^2 + e at a distance h the union contains all balls
/// between,
///   with radii from r to s, where 4 e = h^2 - (r - s)^2: the power of a point to a ball between is no less
///   than to the better one of both. So every radius becomes sqrt(r^2 + e), with the larger e of its two
///   sides; of a path of radius 0 it is half the spacing. Rounded upwards, also by what rounding centers can
///   do. The error is the largest of what radii grew by, at most half the spacing.
/// inner: radii stay. Of the path nothing is farther from the balls than outer ones would have grown.
/// - Throws InputError for a spacing of 0 where there is more than one point, and where more than 20 million
/// balls
///   would be needed.
PathWithBalls path_balls(const PathBallsOptions& options, Monitor& monitor = no_monitor());
Balls balls_along(Path& path, double spacing, PathSide side, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
