// Set covering instances of the literature as covering matrices, so that strategies can be compared.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/monitor.hpp"
#include "types/balls.hpp"
#include "types/cover_state.hpp"
#include "types/point_set.hpp"

namespace ballflow::geometry {

// The literature covers elements by sets; here sets are balls (rows) and elements are samples (columns).

/// All are text: integers separated by blanks and ends of lines, or lines of numbers (balls).
enum class CoverFormat : std::uint8_t {
  automatic,  // the one of the others that the file fits
  scp,        // OR-Library: elements, sets; a cost per set; for each element the number of its sets and these
  rail,       // OR-Library: elements, sets; for each set its cost, the number of its elements and these
  steiner,    // points, blocks; for each block its three points: the fewest points that meet every block
  balls,      // Coverage Axis: "v x y z r" a line; also "x y z r", and x,y,z,r below that header line
};

struct LoadCoverOptions {
  // A file, also gzipped, or steiner:N for the blocks {a, b, c}, a + b + c = 0, of the points of the affine
  // space over three elements; N = 3, 9, 27, 81, 243 or 729.
  std::string file;
  CoverFormat format = CoverFormat::automatic;
  double dilation = 0;  // balls: model units added to every radius; at least 0
};

struct LoadedCover {
  CoverState cover;  // nothing chosen
  Balls balls;       // balls: the rows, dilated; none in the other formats
};

/// Reads an instance. Every set costs 1 (unicost): costs other than 1 are read and ignored with a warning.
///
/// - Rows and columns are numbered from 0 in the order of the file, where the first is number 1.
/// - An element of no set, or a sample in no ball, is listed in `uncovered`, with a warning.
/// - `balls` covers `points`, which it needs and the other formats ignore: ball i covers sample s iff
///   |s - c| <= r + dilation, by the predicate of membership.hpp.
/// - The lower bound of the result is ceil(columns / longest row).
///
/// Throws InputError, naming the line, for text that is no number, a number out of range, an element or set
/// that is listed twice, and a file that ends too early or goes on after its end; for a file that fits more
/// than one format, or none; and for everything that read_file_content and cover_matrix refuse.
LoadedCover load_cover(const LoadCoverOptions& options, const PointSet* points = nullptr,
                       Monitor& monitor = no_monitor());

/// The same for content in memory.
LoadedCover parse_cover(std::string_view content, CoverFormat format, double dilation = 0,
                        const PointSet* points = nullptr, Monitor& monitor = no_monitor());

}  // namespace ballflow::geometry
