#include "report/plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "report/html.hpp"

namespace ballflow::report {
namespace {

constexpr double width = 640, height = 380;
constexpr double left = 72, right = 16, top = 16, bottom = 52;
constexpr std::size_t colours = 8;

std::string text(double value) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.1f", value);
  return digits;
}

/// From values to pixels.
class Axis {
 public:
  Axis() = default;
  Axis(double low, double high, bool from_zero, double first, double last) : first_(first), last_(last) {
    if (!(low <= high)) low = 0, high = 1;
    logarithmic_ = low > 0 && high > 20 * low;
    if (logarithmic_) {
      low_ = low / 1.1, high_ = high * 1.1;
      return;
    }
    if (from_zero) low = std::min(low, 0.0);
    if (low == high) {
      const double half = low == 0 ? 1 : std::abs(low) / 10;
      low -= from_zero && low == 0 ? 0 : half;
      high += half;
    }
    const std::vector<double> marks = ticks(low, high, 5);
    low_ = marks.front(), high_ = marks.back();
  }
  /// For indices 0 .. count - 1.
  Axis(std::size_t count, double first, double last)
      : low_(-0.5), high_(static_cast<double>(count) - 0.5), first_(first), last_(last) {}

  double operator()(double value) const {
    const double part =
        logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
    return first_ + std::clamp(part, 0.0, 1.0) * (last_ - first_);
  }

  std::vector<double> marks() const {
    if (!logarithmic_) return ticks(low_, high_, 5);
    std::vector<double> all;
    // 1, 2, 5 of every decade, or powers of ten when there are many.
    const bool dense = high_ / low_ < 2000;
    for (double decade = std::pow(10.0, std::floor(std::log10(low_))); decade <= high_; decade *= 10) {
      for (const double factor : {1.0, 2.0, 5.0}) {
        const double value = decade * factor;
        if ((dense || factor == 1) && value >= low_ && value <= high_) all.push_back(value);
      }
    }
    return all;
  }

 private:
  double low_ = 0, high_ = 1, first_ = 0, last_ = 1;
  bool logarithmic_ = false;
};

std::string line(double x1, double y1, double x2, double y2, const char* style) {
  return "<line class=\"" + std::string(style) + "\" x1=\"" + text(x1) + "\" y1=\"" + text(y1) + "\" x2=\"" +
         text(x2) + "\" y2=\"" + text(y2) + "\"/>";
}

std::string label(double x, double y, const char* anchor, const std::string& words) {
  return "<text x=\"" + text(x) + "\" y=\"" + text(y) + "\" text-anchor=\"" + anchor + "\">" +
         escaped(words) + "</text>";
}

std::string colour(std::size_t series) { return "s" + std::to_string(series % colours); }

/// The later a series is drawn the smaller its marks: what lies on the same place can be seen.
double size_of(std::size_t series) {
  return 6 - 0.5 * static_cast<double>(std::min<std::size_t>(series % colours, 6));
}

/// A circle, then a square, then a diamond: series of one colour differ.
std::string mark(std::size_t series, double x, double y, const std::string& title) {
  const double r = size_of(series);
  std::string shape, name;
  switch (series / colours % 3) {
    case 0:
      name = "circle";
      shape = "cx=\"" + text(x) + "\" cy=\"" + text(y) + "\" r=\"" + text(r) + "\"";
      break;
    case 1:
      name = "rect";
      shape = "x=\"" + text(x - r) + "\" y=\"" + text(y - r) + "\" width=\"" + text(2 * r) + "\" height=\"" +
              text(2 * r) + "\"";
      break;
    default:
      name = "path";
      shape = "d=\"M" + text(x) + " " + text(y - r) + "l" + text(r) + " " + text(r) + "l-" + text(r) + " " +
              text(r) + "l-" + text(r) + " -" + text(r) + "z\"";
  }
  return "<" + name + " " + shape + "><title>" + escaped(title) + "</title></" + name + ">";
}

std::string begin(const std::string& title, double h) {
  return "<figure><figcaption>" + escaped(title) + "</figcaption><svg class=\"plot\" viewBox=\"0 0 " +
         text(width) + " " + text(h) + "\" role=\"img\" aria-label=\"" + escaped(title) + "\">";
}

std::string key(const std::string& style, const std::string& shape, const std::string& name) {
  return "<span><svg class=\"key " + style + "\" viewBox=\"0 0 14 14\">" + shape + "</svg>" + escaped(name) +
         "</span> ";
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string draw_guide(const Series& s, const Axis& x, const Axis& y) {
  std::string path;
  for (std::size_t i = 0; i < s.x.size(); ++i) path += text(x(s.x[i])) + "," + text(y(s.y[i])) + " ";
  return "<polyline class=\"guide\" points=\"" + path + "\"/>";
}

std::string draw_series(const Series& s, std::size_t index, const Plot& plot, const Axis& x, const Axis& y) {
  std::string above, below, path, marks;
  for (std::size_t i = 0; i < s.x.size(); ++i) {
    if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
    const double px = x(s.x[i]), py = y(s.y[i]);
    path += (path.empty() ? "" : " ") + text(px) + "," + text(py);
    const std::string at = plot.x_labels.empty() ? plot.x_name + " " + number(s.x[i])
                                                 : plot.x_labels.at(static_cast<std::size_t>(s.x[i]));
    std::string title =
        s.name + (s.name.empty() ? "" : "\n") + at + "\n" + plot.y_name + " " + number(s.y[i]);
    if (!s.low.empty() && std::isfinite(s.low[i])) {
      const double lowest = y(s.low[i]);
      above += (above.empty() ? "" : " ") + text(px) + "," + text(py);
      below = text(px) + "," + text(lowest) + (below.empty() ? "" : " ") + below;
      title += ", at least " + number(s.low[i]);
      marks += line(px, py, px, lowest, "whisker") + line(px - 4, lowest, px + 4, lowest, "whisker");
    }
    if (!s.labels.empty() && !s.labels[i].empty()) title += "\n" + s.labels[i];
    marks += mark(index, px, py, title);
  }
  std::string out = "<g class=\"" + colour(index) + "\" style=\"--w: " + text(size_of(index) / 2) + "\">";
  const bool joined = plot.lines && plot.x_labels.empty();
  if (joined && !above.empty()) out += "<polygon class=\"band\" points=\"" + above + " " + below + "\"/>";
  if (joined && !path.empty()) out += "<polyline points=\"" + path + "\"/>";
  return out + marks + "</g>";
}

}  // namespace

std::vector<double> ticks(double low, double high, int count) {
  const double rough = (high - low) / std::max(1, count);
  if (!(rough > 0) || !std::isfinite(rough)) return {low, high};
  const double decade = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * decade;
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (rough <= factor * decade * (1 + 1e-9)) {
      step = factor * decade;
      break;
    }
  }
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> all;
  for (double k = first; k <= last; ++k) all.push_back(k * step);
  return all;
}

std::string svg(const Plot& plot) {
  Range x_range, y_range;
  for (const Series& s : plot.series) {
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      if (!std::isfinite(s.x[i]) || !std::isfinite(s.y[i])) continue;
      x_range.add(s.x[i]);
      y_range.add(s.y[i]);
      if (!s.low.empty()) y_range.add(s.low[i]);
    }
  }
  const Axis x = plot.x_labels.empty() ? Axis(x_range.low, x_range.high, false, left, width - right)
                                       : Axis(plot.x_labels.size(), left, width - right);
  const Axis y(y_range.low, y_range.high, plot.zero, height - bottom, top);

  std::string out = begin(plot.title, height);
  for (const double value : y.marks()) {
    out += line(left, y(value), width - right, y(value), "grid");
    out += label(left - 8, y(value) + 4, "end", number(value));
  }
  if (plot.x_labels.empty()) {
    for (const double value : x.marks()) {
      out += line(x(value), top, x(value), height - bottom, "grid");
      out += label(x(value), height - bottom + 18, "middle", number(value));
    }
  } else {
    for (std::size_t i = 0; i < plot.x_labels.size(); ++i) {
      out += label(x(static_cast<double>(i)), height - bottom + 18, "middle", plot.x_labels[i]);
    }
  }
  out += line(left, height - bottom, width - right, height - bottom, "axis");
  out += label((left + width - right) / 2, height - 12, "middle", plot.x_name);
  out += "<text transform=\"translate(14 " + text((top + height - bottom) / 2) +
         ") rotate(-90)\" text-anchor=\"middle\">" + escaped(plot.y_name) + "</text>";
  std::string legend;
  std::size_t colored = 0;
  for (const Series& s : plot.series) {
    if (s.guide) {
      out += draw_guide(s, x, y);
      legend += key("", line(0, 7, 14, 7, "guide"), s.name);
      continue;
    }
    out += draw_series(s, colored, plot, x, y);
    if (!s.name.empty()) legend += key(colour(colored), mark(colored, 7, 7, ""), s.name);
    ++colored;
  }
  return out + "</svg>" + (legend.empty() ? "" : "<p class=\"legend\">" + legend + "</p>") + "</figure>";
}

std::string svg(const Bars& bars) {
  constexpr double row = 24, label_width = 210;
  double longest = 0;
  for (const auto& values : bars.values) {
    double sum = 0;
    for (const double value : values) sum += value;
    longest = std::max(longest, sum);
  }
  const double h = row * static_cast<double>(bars.labels.size()) + 36;
  const Axis x(0, longest > 0 ? longest : 1, true, label_width, width - right);
  std::string out = begin(bars.title, h);
  for (const double value : x.marks()) {
    out += line(x(value), 4, x(value), h - 30, "grid");
    out += label(x(value), h - 14, "middle", number(value));
  }
  out += label(label_width - 8, h - 14, "end", bars.unit);
  for (std::size_t i = 0; i < bars.labels.size(); ++i) {
    const double y = 4 + row * static_cast<double>(i);
    const std::string& name = bars.labels[i];
    // What does not fit is cut in the middle of the text; the whole of it is the title.
    std::string cut = name;
    if (cut.size() > 32) cut = name.substr(0, 14) + "..." + name.substr(name.size() - 15);
    out += "<g>" + label(label_width - 8, y + 16, "end", cut) + "<title>" + escaped(name) + "</title></g>";
    double sum = 0;
    for (std::size_t part = 0; part < bars.parts.size(); ++part) {
      const double value = bars.values[i][part];
      if (!(value > 0)) continue;
      out += "<rect class=\"" + colour(part) + "\" x=\"" + text(x(sum)) + "\" y=\"" + text(y + 3) +
             "\" width=\"" + text(std::max(0.5, x(sum + value) - x(sum))) + "\" height=\"" + text(row - 6) +
             "\"><title>" + escaped(bars.parts[part] + ": " + number(value) + " " + bars.unit) +
             "</title></rect>";
      sum += value;
    }
  }
  std::string legend;
  for (std::size_t part = 0; bars.parts.size() > 1 && part < bars.parts.size(); ++part) {
    legend += key(colour(part), "<rect x=\"1\" y=\"1\" width=\"12\" height=\"12\"/>", bars.parts[part]);
  }
  return out + "</svg>" + (legend.empty() ? "" : "<p class=\"legend\">" + legend + "</p>") + "</figure>";
}

}  // namespace ballflow::report
