#include "report/result_plots.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "report/html.hpp"
#include "report/member.hpp"
#include "report/plot.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;
/// The rows of a table of results by the axes of a sweep.
class Rows {
 public:
  Rows(const Value& report, const cli::Comparison& table) : table_(table) {
    for (const Value& axis : member(report, "axes")) {
      if (axis.is_string()) axes_.push_back(axis.get<std::string>());
    }
    // Values run along the numeric axis that has the most of them.
    std::size_t most = 1;
    for (const std::string& axis : axes_) {
      const auto values = values_of(axis);
      const bool numbers =
          std::all_of(values.begin(), values.end(), [](const Value& v) { return v.is_number(); });
      if (numbers && values.size() > most) most = values.size(), x_ = axis;
    }
    for (std::size_t i = 0; i < table_.rows.size(); ++i) groups_[name_of(i)].push_back(i);
    if (x_.empty()) return;
    for (auto& [name, rows] : groups_) {
      std::stable_sort(rows.begin(), rows.end(),
                       [this](std::size_t a, std::size_t b) { return x(a) < x(b); });
    }
  }

  /// The numeric axis, empty when there is none.
  const std::string& x_name() const { return x_; }
  double x(std::size_t row) const { return value(row, x_); }
  /// Rows that differ in the numeric axis alone, by what they have in common.
  const std::map<std::string, std::vector<std::size_t>>& groups() const { return groups_; }
  double value(std::size_t row, const std::string& column) const {
    const auto at = find(column);
    return at < table_.columns.size() ? number_of(table_.rows[row][at])
                                      : std::numeric_limits<double>::quiet_NaN();
  }
  bool has(const std::string& column) const {
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      if (std::isfinite(value(row, column))) return true;
    }
    return false;
  }
  std::size_t size() const { return table_.rows.size(); }
  /// All axes of a row in words.
  std::string label(std::size_t row) const {
    std::string text = name_of(row);
    if (!x_.empty()) text += (text.empty() ? "" : ", ") + x_ + " " + number(x(row));
    return text;
  }

 private:
  std::size_t find(const std::string& column) const {
    std::size_t at = 0;
    while (at < table_.columns.size() && table_.columns[at].name != column) ++at;
    return at;
  }
  std::set<Value> values_of(const std::string& axis) const {
    std::set<Value> values;
    const std::size_t at = find(axis);
    if (at == table_.columns.size()) return values;
    for (const auto& row : table_.rows) values.insert(row[at]);
    return values;
  }
  std::string name_of(std::size_t row) const {
    std::string text;
    for (const std::string& axis : axes_) {
      const std::size_t at = find(axis);
      if (axis == x_ || at == table_.columns.size() || values_of(axis).size() < 2) continue;
      text += (text.empty() ? "" : ", ") + shown(table_.rows[row][at]);
    }
    return text;
  }

  const cli::Comparison& table_;
  std::vector<std::string> axes_;
  std::string x_;
  std::map<std::string, std::vector<std::size_t>> groups_;
};

struct Curve {
  std::string title, y_name;
  std::string y, low;  // columns
  double factor = 1;
  bool zero = false;
};

std::string along_axis(const Rows& rows, const Curve& curve) {
  if (!rows.has(curve.y)) return "";
  Plot plot;
  plot.title = curve.title, plot.y_name = curve.y_name, plot.zero = curve.zero;
  plot.x_name = rows.x_name();
  for (const auto& [name, members] : rows.groups()) {
    Series series;
    series.name = name;
    for (const std::size_t row : members) {
      // Without a numeric axis every row is its own place on the axis.
      series.x.push_back(rows.x_name().empty() ? static_cast<double>(plot.x_labels.size()) : rows.x(row));
      if (rows.x_name().empty()) plot.x_labels.push_back(name);
      series.y.push_back(curve.factor * rows.value(row, curve.y));
      if (!curve.low.empty()) series.low.push_back(curve.factor * rows.value(row, curve.low));
    }
    plot.series.push_back(std::move(series));
  }
  return svg(plot);
}

/// Few balls and a small error are both wanted: what no other row beats in both is worth a look.
std::string balls_against_error(const Rows& rows, const std::string& balls, const std::string& error) {
  if (!rows.has(balls) || !rows.has(error)) return "";
  Plot plot;
  plot.title = "Error against number of balls";
  plot.x_name = "balls", plot.y_name = "Hausdorff distance, model units";
  for (const auto& [name, members] : rows.groups()) {
    Series series;
    series.name = name;
    std::vector<std::size_t> order = members;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return rows.value(a, balls) < rows.value(b, balls);
    });
    for (const std::size_t row : order) {
      series.x.push_back(rows.value(row, balls));
      series.y.push_back(rows.value(row, error));
      series.labels.push_back(rows.x_name().empty() ? "" : rows.x_name() + " " + number(rows.x(row)));
    }
    plot.series.push_back(std::move(series));
  }
  Series best;
  best.name = "no other is better in both";
  best.guide = true;
  std::vector<std::pair<double, double>> points;
  for (std::size_t row = 0; row < rows.size(); ++row) {
    points.emplace_back(rows.value(row, balls), rows.value(row, error));
  }
  std::erase_if(points, [](const auto& p) { return !std::isfinite(p.first) || !std::isfinite(p.second); });
  std::sort(points.begin(), points.end());
  for (const auto& [count, distance] : points) {
    if (!best.y.empty() && distance >= best.y.back()) continue;
    best.x.push_back(count);
    best.y.push_back(distance);
  }
  plot.series.push_back(std::move(best));
  plot.lines = false;
  return svg(plot);
}

/// Names of outputs of the graph of one type.
std::vector<std::string> outputs_of_type(const Value& report, const std::string& type) {
  std::vector<std::string> names;
  for (const auto& [name, output] : member(report, "outputs").items()) {
    const std::size_t slash = name.rfind('/');
    const std::string own = slash == std::string::npos ? name : name.substr(slash + 1);
    if (member(output, "type") == type && std::find(names.begin(), names.end(), own) == names.end()) {
      names.push_back(own);
    }
  }
  return names;
}

}  // namespace

std::string result_plots(const nlohmann::json& report, const cli::Comparison& all) {
  if (all.rows.size() < 2) return "";
  const Rows rows(report, all);
  std::string out, balls;
  for (const std::string& name : outputs_of_type(report, "CoverState")) {
    out += along_axis(rows, {"Balls (" + name + "), and no cover has fewer than the lower end", "balls",
                             name + ".upper_bound", name + ".lower_bound"});
    out +=
        along_axis(rows, {"Gap to the proven bound (" + name + ")", "gap, %", name + ".gap", "", 100, true});
    balls = name + ".upper_bound";
  }
  for (const std::string& name : outputs_of_type(report, "Balls")) {
    if (balls.empty()) {
      balls = name + ".count";
      out += along_axis(rows, {"Number of balls (" + name + ")", "balls", balls, ""});
    }
  }
  for (const std::string& name : outputs_of_type(report, "Comparison")) {
    out += along_axis(rows,
                      {"Hausdorff distance (" + name + ")", "model units", name + ".hausdorff", "", 1, true});
    out += balls_against_error(rows, balls, name + ".hausdorff");
  }
  return out;
}

}  // namespace ballflow::report
