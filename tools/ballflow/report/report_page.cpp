#include "report/report_page.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "ballflow/text.hpp"
#include "report/bibliography.hpp"
#include "report/compare.hpp"
#include "report/html.hpp"
#include "report/plot.hpp"
#include "report/style.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

const Value& member(const Value& object, const std::string& name) {
  static const Value null;
  if (!object.is_object()) return null;
  const auto found = object.find(name);
  return found == object.end() ? null : *found;
}

std::string shown(const Value& value) {
  if (value.is_null()) return "\xe2\x80\x93";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number()) return number(value.get<double>());
  return value.dump(-1, ' ', false, Value::error_handler_t::replace);
}

double number_of(const Value& value) { return value.is_number() ? value.get<double>() : unknown; }

std::string seconds_text(double seconds) { return number(std::round(seconds * 1000) / 1000) + " s"; }

std::string base64(std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) -> std::uint32_t {
      return i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0;
    };
    const std::uint32_t three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k) {
      out += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63];
    }
  }
  return out;
}

std::string cell(const std::string& text, bool is_number) {
  return (is_number ? "<td class=\"number\">" : "<td>") + escaped(text) + "</td>";
}

std::string section(const std::string& title, const std::string& content) {
  return content.empty() ? "" : "<section><h2>" + title + "</h2>\n" + content + "</section>\n";
}

// ---- the table of results, and plots of it

std::string table_of(const cli::Comparison& table) {
  std::string out = "<div class=\"wide\"><table><thead><tr>";
  for (const auto& column : table.columns) {
    out += (column.number ? "<th class=\"number\">" : "<th>") + escaped(column.name) + "</th>";
  }
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) out += cell(shown(row[i]), table.columns[i].number);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

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
    return at < table_.columns.size() ? number_of(table_.rows[row][at]) : unknown;
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

std::string plots(const Value& report, const cli::Comparison& all) {
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

// ---- time

std::string without_variant(const std::string& path) {
  const std::size_t end = path.empty() || path[0] != '[' ? std::string::npos : path.find("]/");
  return end == std::string::npos ? path : path.substr(end + 2);
}

double cost(const Value& node) {
  const Value& seconds = member(node, "cost_seconds");
  return seconds.is_number() ? seconds.get<double>() : number_of(member(node, "seconds"));
}

std::string times(const Value& report) {
  const Value& nodes = member(report, "nodes");
  Bars bars;
  bars.unit = "seconds";
  const Value& variants = member(report, "variants");
  if (!variants.is_array() || variants.empty()) {
    std::vector<std::pair<double, std::string>> order;
    for (const auto& [path, node] : nodes.items()) {
      if (cost(node) > 0) order.emplace_back(-cost(node), path);
    }
    std::sort(order.begin(), order.end());
    if (order.size() > 20) order.resize(20);
    bars.title = "Time by node, as measured when it was computed";
    bars.parts = {"seconds"};
    for (const auto& [minus, path] : order) {
      bars.labels.push_back(path);
      bars.values.push_back({-minus});
    }
    return order.empty() ? "" : svg(bars);
  }
  // The stages that take longest, over all variants, and the rest.
  std::map<std::string, double> totals;
  for (const auto& [path, node] : nodes.items()) totals[without_variant(path)] += cost(node);
  std::vector<std::pair<double, std::string>> order;
  for (const auto& [stage, total] : totals) {
    if (total > 0) order.emplace_back(-total, stage);
  }
  std::sort(order.begin(), order.end());
  std::map<std::string, std::size_t> part_of;
  for (std::size_t i = 0; i < order.size() && i < 7; ++i) {
    part_of[order[i].second] = i;
    bars.parts.push_back(order[i].second);
  }
  if (order.size() > 7) bars.parts.emplace_back("others");
  bars.title = "Time by stage; a stage that variants share counts for each";
  for (const Value& variant : variants) {
    if (bars.labels.size() == 60) break;  // a page of bars says no more than the table
    bars.labels.push_back(shown(member(variant, "name")));
    auto& values = bars.values.emplace_back(bars.parts.size(), 0.0);
    for (const Value& path : member(variant, "nodes")) {
      if (!path.is_string()) continue;
      const double seconds = cost(member(nodes, path.get<std::string>()));
      const auto part = part_of.find(without_variant(path.get<std::string>()));
      if (seconds > 0) values[part == part_of.end() ? values.size() - 1 : part->second] += seconds;
    }
  }
  return bars.parts.empty() ? "" : svg(bars);
}

// ---- what ran

Value manifest_of(const Manifests& manifests, const std::string& path) {
  const auto found = manifests.find(path);
  if (found == manifests.end()) return nullptr;
  return Value::parse(found->second, nullptr, false);
}

std::string parameters(const Value& report) {
  const Value& params = member(report, "params");
  if (!params.is_object() || params.empty()) return "";
  std::string out = "<table><thead><tr><th>parameter</th><th>value</th></tr></thead><tbody>\n";
  for (const auto& [name, value] : params.items()) {
    out += "<tr>" + cell(name, false) + cell(shown(value), false) + "</tr>\n";
  }
  return out + "</tbody></table>\n";
}

std::string nodes_table(const Value& report, const Manifests& manifests) {
  std::string out =
      "<div class=\"wide\"><table><thead><tr><th>node</th><th>type</th><th class=\"number\">version</th>"
      "<th>status</th><th class=\"number\">cost, "
      "s</th><th>parameters</th><th>results</th></tr></thead><tbody>\n";
  for (const auto& [path, node] : member(report, "nodes").items()) {
    std::string results;
    for (const auto& [port, output] : member(node, "outputs").items()) {
      results += (results.empty() ? "" : " ") + port + " " + shown(member(output, "digest")).substr(0, 12);
    }
    std::string params;
    for (const auto& [name, value] : member(node, "params").items()) {
      params += (params.empty() ? "" : ", ") + name + " " + shown(value);
    }
    const Value manifest = manifest_of(manifests, path);
    out += "<tr>" + cell(path, false) + cell(shown(member(node, "type")), false) +
           cell(shown(member(manifest, "version")), true) + cell(shown(member(node, "status")), false) +
           cell(number(std::round(1e4 * cost(node)) / 1e4), true) + cell(params, false) +
           cell(results, false) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string troubles(const Value& report) {
  std::string out;
  for (const auto& [path, node] : member(report, "nodes").items()) {
    for (const Value& warning : member(node, "warnings")) {
      out += "<li><code>" + escaped(path) + "</code>: " + escaped(shown(warning)) + "</li>\n";
    }
    const Value& error = member(node, "error");
    if (!error.is_object()) continue;
    out += "<li class=\"error\"><code>" + escaped(path) +
           "</code>: " + escaped(shown(member(error, "cause"))) + "<br>" +
           escaped(shown(member(error, "hint"))) + "</li>\n";
  }
  return out.empty() ? "" : "<ul>" + out + "</ul>\n";
}

// ---- how to run it again

std::string commands(const Value& report, const std::string& id) {
  const Value& command = member(report, "command");
  std::string line = command.is_string() ? command.get<std::string>() + "\n" : "";
  line += "ballflow compare " + id + "   # the table of results\n";
  line += "ballflow view " + id + "      # the results in 3D\n";
  line += "ballflow explain NODE --against " + id + "   # after a change: what is different\n";
  return "<pre>" + escaped(line) + "</pre>\n";
}

std::string versions(const ReportInput& input) {
  std::map<std::string, std::set<std::string>> libraries;
  std::map<std::string, std::string> contents;  // digests of files
  for (const auto& [path, text] : input.manifests) {
    const Value manifest = Value::parse(text, nullptr, false);
    for (const auto& [name, version] : member(manifest, "libraries").items()) {
      libraries[name].insert(shown(version));
    }
    for (const auto& [name, value] : member(manifest, "params").items()) {
      const Value& digest = member(member(value, "file"), "digest");
      if (!digest.is_string()) continue;
      const Value& node = member(member(input.run.report, "nodes"), path);
      contents[shown(member(member(node, "params"), name))] = digest.get<std::string>();
    }
  }
  const Value& version = member(input.run.report, "version");
  std::string out =
      version.is_string() ? "<p>ballflow " + escaped(version.get<std::string>()) : "<p>ballflow";
  for (const auto& [name, found] : libraries) {
    for (const std::string& one : found) out += ", " + escaped(name) + " " + escaped(one);
  }
  out += ". Versions of the nodes stand in their table.</p>\n";
  std::string files;
  for (const auto& [file, digest] : contents) {
    files += "<tr>" + cell(file, false) + "<td><code>" + escaped(digest) + "</code></td></tr>\n";
  }
  if (!files.empty()) {
    out += "<table><thead><tr><th>input file</th><th>SHA-256</th></tr></thead><tbody>\n" + files +
           "</tbody></table>\n";
  }
  return out;
}

std::string bibliography(const ReportInput& input) {
  if (input.registry == nullptr) return "";
  std::map<std::string, std::set<std::string>> used;  // by key: what it is cited for
  for (const auto& [path, node] : member(input.run.report, "nodes").items()) {
    const NodeDeclaration* declaration = input.registry->node(shown(member(node, "type")));
    if (declaration == nullptr) continue;
    for (const Citation& citation : declaration->cites) {
      used[citation.key].insert(declaration->id + (citation.where.empty() ? "" : ": " + citation.where));
    }
  }
  std::string out;
  for (const auto& [key, nodes] : used) {
    const auto source = built_in_sources().find(key);
    out += "<li>" + escaped(source == built_in_sources().end() ? key : source->second.text()) + " <small>";
    for (const std::string& node : nodes) out += (node == *nodes.begin() ? "" : "; ") + escaped(node);
    out += "</small></li>\n";
  }
  return out.empty() ? "" : "<ol>" + out + "</ol>\n";
}

std::string pictures(const ReportInput& input) {
  std::string out;
  for (const Picture& picture : input.pictures) {
    out += "<figure><figcaption>" + escaped(picture.title) + "</figcaption><img alt=\"" +
           escaped(picture.title) + "\" src=\"data:image/png;base64," + base64(picture.png) +
           "\"></figure>\n";
  }
  if (input.pictures_left_out > 0) {
    out += "<p>Not drawn, because they are many or no longer in the cache: " +
           number(static_cast<double>(input.pictures_left_out)) + " more (<code>--pictures</code>).</p>\n";
  }
  return out;
}

}  // namespace

std::string report_page(const ReportInput& input) {
  const Value& report = input.run.report;
  const std::string graph = shown(member(report, "graph"));
  const std::string id = shown(member(report, "run"));
  const std::vector<RunRecord> runs = {input.run};
  const cli::Comparison table = cli::compare(runs, {});
  const bool has_outputs = member(report, "outputs").is_object() && !member(report, "outputs").empty();
  const cli::Comparison all = has_outputs ? cli::compare(runs, {"all"}) : table;

  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "img-src data:\">\n<meta name=\"viewport\" content=\"width=device-width\">\n<title>" +
      escaped(graph) + "</title>\n<style>" + style_sheet() + "</style>\n</head>\n<body>\n";
  page += "<header><h1>" + escaped(graph) + "</h1>\n<p>Run " + escaped(id) + ", started " +
          escaped(shown(member(report, "started"))) + ": <strong>" +
          escaped(shown(member(report, "status"))) + "</strong>, " +
          seconds_text(number_of(member(report, "seconds"))) + " (" +
          seconds_text(number_of(member(report, "cpu_seconds"))) + " CPU), " +
          number(std::ceil(number_of(member(report, "peak_rss_bytes")) / 1e6)) + " MB at most";
  const Value& variants = member(report, "variants");
  if (variants.is_array() && !variants.empty()) page += ", " + number(double(variants.size())) + " variants";
  page += ".</p></header>\n";
  page += section("Warnings and errors", troubles(report));
  page += section("Results",
                  table_of(table) + "<details><summary>all fields</summary>" + table_of(all) + "</details>");
  page += section("Plots", plots(report, all));
  page += section("Pictures", pictures(input));
  page += section("Time", times(report));
  page += section("What ran", parameters(report) + "<details><summary>" +
                                  number(double(member(report, "nodes").size())) + " nodes</summary>" +
                                  nodes_table(report, input.manifests) + "</details>\n");
  page += section("To run it again", commands(report, id) + versions(input));
  page += section("Sources", bibliography(input));
  return page + "</body>\n</html>\n";
}

}  // namespace ballflow::report
