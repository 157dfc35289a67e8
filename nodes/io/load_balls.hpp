// Balls, and medial axes, that other programs wrote.
#pragma once

#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/medial_axis.hpp"

namespace ballflow::geometry {

struct LoadBallsOptions {
  // A file, also packed (gzip, zstd), or balls: and the balls themselves, separated by semicolons
  // ("balls:0 0 0 1; 1.5 0 0 1").
  std::string file;
  std::string scale = "1";  // of centres and radii: a factor, or the unit of the file, see parse_scale
};

struct LoadedBalls {
  Balls balls;      // in the order of the file
  MedialAxis axis;  // of ma: the balls as vertices, edges that bound no triangle, triangles; else empty
};

/// Reads balls. The content decides the format:
///
/// - ma (Q-MAT, MATFP, MATTopo): the numbers of vertices, edges and triangles; then that many lines
///   "v x y z r", "e i j", "f i j k" with indices from 0. MATFP's flags may follow: type and deleted (0 or 1)
///   of vertices and edges, deleted of triangles. What is marked as deleted is left out.
/// - sph: the number of balls (Q-MAT), or 4 and the number of balls (MATTopo); then that many lines
///   "x y z r", which MATTopo's flags may follow: type, deleted, count.
/// - sphere trees: the numbers of levels and of branches; then every node level by level, "x y z r" and an
///   importance, r < 0 for no ball. The leaves are read: balls none of whose children is one.
/// - rows: "x y z r" a line, separated by blanks, commas or semicolons, also with a "v" in front (Coverage
///   Axis) or with decimal commas (see NumberRows). A first line may name the columns: x, y, z, and r, radius
///   or diameter, in any order and among others.
/// - PLY: the vertices with their property radius, or diameter; everything else is passed over.
///
/// "#" begins a comment, except in PLY. Numbers are read with the decimal point in every locale and rounded
/// to the nearest double; they are not changed but by the
/// scale. In an axis, repeated edges and triangles, and those that use
/// a vertex twice, are dropped with a warning.
///
/// Throws InputError, naming the element and the line, for what is no number, not finite, negative as a
/// radius, or out of range as an index; for a file that has more or fewer lines than it promises, or no ball
/// at all; for content of no such format; and for everything that read_file_content refuses. Memory stays
/// proportional to the size of the file.
LoadedBalls load_balls(const LoadBallsOptions& options, Monitor& monitor = no_monitor());

/// The same for content in memory.
LoadedBalls parse_balls(std::string_view content, Monitor& monitor = no_monitor());

/// Whether a file is one of balls and not of a model: one called .ma or .sph (.gz or .zst may follow), PLY
/// whose vertices have a radius or diameter and that has no faces, and rows under the names of columns x, y,
/// z and r, radius or diameter. That is how the program itself writes balls.
bool holds_balls(const std::string& path, std::string_view content);

/// True when the content begins as rows do.
bool is_ball_rows(std::string_view content);

/// Rows only. Empty content and content of comments is refused.
Balls parse_ball_rows(std::string_view content, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
