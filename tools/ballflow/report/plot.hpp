// Plots as SVG elements for a page. Colours come from the style sheet of the page (classes s0, s1, ... of the
// series, `band`, `axis`, `grid`), so that a plot can be read in light and in dark; the numbers of a point
// appear when the pointer rests on it.
#pragma once

#include <string>
#include <vector>

namespace ballflow::report {

/// Points in the order of their x. Points whose y is not finite are left out, and so are their bands.
struct Series {
  std::string name;
  std::vector<double> x, y;
  std::vector<double> low;          // empty, or the lower end of a band below y; NaN where there is none
  std::vector<std::string> labels;  // empty, or what else to say of each point
  bool guide = false;               // a dashed line without marks, in no colour of a series
};

struct Plot {
  std::string title, x_name, y_name;
  std::vector<Series> series;         // beyond 8 the colours repeat, with other marks
  std::vector<std::string> x_labels;  // not empty: x is an index into it
  bool lines = true;                  // else marks alone (and guides)
  bool zero = false;                  // the y axis begins at 0 (where it is not logarithmic)
};

/// An axis is logarithmic when its values are positive and span a factor of more than 20.
std::string svg(const Plot& plot);

/// Horizontal bars, each cut into parts.
struct Bars {
  std::string title, unit;
  std::vector<std::string> labels;          // one per bar
  std::vector<std::string> parts;           // one per colour
  std::vector<std::vector<double>> values;  // bar by bar, one per part; not negative
};

std::string svg(const Bars& bars);

/// Round numbers from at most `low` to at least `high`, about `count` of them.
std::vector<double> ticks(double low, double high, int count);

}  // namespace ballflow::report
