#include "report/report_page.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "ballflow/text.hpp"
#include "report/bibliography.hpp"
#include "report/compare.hpp"
#include "report/html.hpp"
#include "report/member.hpp"
#include "report/model_plots.hpp"
#include "report/output_cards.hpp"
#include "report/plot.hpp"
#include "report/result_plots.hpp"
#include "report/search_plots.hpp"
#include "report/style.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;

std::string seconds_text(double seconds) { return number(std::round(seconds * 1000) / 1000) + " s"; }

std::string cell(const std::string& text, bool is_number) {
  return (is_number ? "<td class=\"number\">" : "<td>") + escaped(text) + "</td>";
}

std::string section(const std::string& title, const std::string& content) {
  return content.empty() ? "" : "<section><h2>" + title + "</h2>\n" + content + "</section>\n";
}

// ---- the table of results

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

/// Errors first, then warnings, each with what to do on a line of its own where that is said.
std::string troubles(const ReportInput& input) {
  const Value& report = input.run.report;
  std::string errors, warnings;
  const auto item = [](const char* kind, const std::string& path, const std::string& cause,
                       const std::string& remedy) {
    return "<li class=\"" + std::string(kind) + "\"><code>" + escaped(path) + "</code> " + escaped(cause) +
           (remedy.empty() ? "" : "<br><strong>What to do:</strong> " + escaped(remedy)) + "</li>\n";
  };
  for (const auto& [path, node] : member(report, "nodes").items()) {
    for (const Value& warning : member(node, "warnings")) {
      const std::string text = shown(warning);
      warnings += item("warning", path, text, input.remedy ? input.remedy(text) : "");
    }
    const Value& error = member(node, "error");
    if (!error.is_object()) continue;
    const Value& hint = member(error, "hint");
    errors +=
        item("error", path, shown(member(error, "cause")), hint.is_string() ? hint.get<std::string>() : "");
  }
  return errors.empty() && warnings.empty() ? "" : "<ul class=\"troubles\">" + errors + warnings + "</ul>\n";
}

std::string facts(const std::vector<std::string>& facts) {
  std::string out;
  for (const std::string& fact : facts) out += "<li>" + escaped(fact) + "</li>\n";
  return out.empty() ? "" : "<ul class=\"facts\">" + out + "</ul>\n";
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
    const auto words = input.words.find(picture.title);
    out += figure(picture, words == input.words.end() ? "" : words->second);
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
  page += ".</p>\n" + facts(input.facts) + "</header>\n";
  page += section("Warnings and errors", troubles(input));
  const std::string cards = output_cards(input);
  if (!cards.empty()) {
    page += section("Results", cards);
  } else {
    page += section(
        "Results", table_of(table) + "<details><summary>all fields</summary>" + table_of(all) + "</details>");
  }
  page += section("Plots", result_plots(report, all) + search_plots(report) + model_plots(report));
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
