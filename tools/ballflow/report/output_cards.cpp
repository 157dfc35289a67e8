#include "report/output_cards.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "report/html.hpp"
#include "report/member.hpp"

namespace ballflow::report {
namespace {

using Value = nlohmann::json;

constexpr std::size_t most_rows = 8;      // of a table; the others are a click away
constexpr std::size_t most_numbers = 12;  // of a list that is shown in full

std::size_t numbers_in(const Value& value) {
  if (!value.is_structured()) return 1;
  std::size_t sum = 0;
  for (const Value& part : value) sum += numbers_in(part);
  return sum;
}

/// "1, 2, 0"; lists in lists are set apart by semicolons.
std::string list_text(const Value& list) {
  std::string text;
  for (const Value& value : list) {
    if (!text.empty()) text += value.is_array() ? "; " : ", ";
    text += value.is_array() ? list_text(value) : shown(value);
  }
  return text;
}

/// "1.04 x 0.66 x 0.88" for the two corners of a box, null for what is none.
Value size_of_box(const Value& box) {
  if (!box.is_array() || box.size() != 2 || !box[0].is_array() || !box[1].is_array()) return nullptr;
  if (box[0].size() != 3 || box[1].size() != 3) return nullptr;
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!box[0][k].is_number() || !box[1][k].is_number()) return nullptr;
    text += (k == 0 ? "" : " x ") + number(box[1][k].get<double>() - box[0][k].get<double>());
  }
  return text;
}

std::string row(std::string name, const Value& value, const std::string& doc) {
  std::replace(name.begin(), name.end(), '_', ' ');
  std::string text;
  if (const Value size = name == "bbox" ? size_of_box(value) : Value(); size.is_string()) {
    name = "size", text = size.get<std::string>();
  } else if (!value.is_array()) {
    text = shown(value);
  } else if (numbers_in(value) <= most_numbers) {
    text = list_text(value);
  } else {
    text = number(static_cast<double>(value.size())) + " entries";
  }
  const std::string title = doc.empty() ? "" : " title=\"" + escaped(doc) + "\"";
  const bool words = value.is_string() && text.size() > 24;
  return "<tr" + title + "><th>" + escaped(name) + (words ? "</th><td>" : "</th><td class=\"number\">") +
         escaped(text) + "</td></tr>\n";
}

using Docs = std::vector<std::pair<std::string, std::string>>;

/// Fields in the order in which their type declares them, then the others.
std::vector<std::string> rows_of(const Value& summary, const Docs& docs, const std::string& words) {
  std::vector<std::string> rows;
  if (!summary.is_object()) return rows;
  const auto add = [&](const std::string& name, const Value& value, const std::string& doc) {
    if (value.is_null()) return;
    if (value.is_object()) {
      for (const auto& [inner, part] : value.items()) rows.push_back(row(name + " " + inner, part, doc));
    } else if (!(value.is_string() && words.find(value.get<std::string>()) != std::string::npos)) {
      rows.push_back(row(name, value, doc));
    }
  };
  std::set<std::string> known;
  for (const auto& [name, doc] : docs) {
    known.insert(name);
    if (const auto found = summary.find(name); found != summary.end()) add(name, *found, doc);
  }
  for (const auto& [name, value] : summary.items()) {
    if (!known.contains(name)) add(name, value, "");
  }
  return rows;
}

std::string table(const std::vector<std::string>& rows, std::size_t first, std::size_t last) {
  std::string text = "<table>";
  for (std::size_t i = first; i < last; ++i) text += rows[i];
  return text + "</table>\n";
}

}  // namespace

std::vector<std::string> outputs_in_order(const nlohmann::json& report) {
  constexpr std::array<std::string_view, 6> first = {"CoverState", "Balls",      "TopologyTable",
                                                     "Comparison", "MedialAxis", "SimplicialComplex"};
  std::vector<std::pair<std::size_t, std::string>> order;
  const Value& outputs = member(report, "outputs");
  if (!outputs.is_object()) return {};
  for (const auto& [name, output] : outputs.items()) {
    const auto place = std::find(first.begin(), first.end(), shown(member(output, "type")));
    order.emplace_back(static_cast<std::size_t>(place - first.begin()), name);
  }
  std::sort(order.begin(), order.end());
  std::vector<std::string> names;
  for (auto& [place, name] : order) names.push_back(std::move(name));
  return names;
}

std::string output_cards(const ReportInput& input) {
  const Value& report = input.run.report;
  const Value& outputs = member(report, "outputs");
  if (!outputs.is_object() || member(report, "variants").is_array()) return "";
  std::string html;
  for (const std::string& name : outputs_in_order(report)) {
    const Value& output = outputs.at(name);
    const auto found = input.words.find(name);
    const std::string words = found == input.words.end() ? "" : found->second;
    const TypeDeclaration* const type =
        input.registry == nullptr ? nullptr : input.registry->type(shown(member(output, "type")));
    const std::vector<std::string> rows =
        rows_of(member(output, "summary"), type == nullptr ? Docs() : type->summary, words);
    html += "<article><h3>" + escaped(name) + " <small>" + escaped(shown(member(output, "type"))) +
            "</small></h3>\n";
    if (!words.empty()) html += "<p>" + escaped(words) + "</p>\n";
    // A table that is hardly longer is not cut.
    const std::size_t shown_rows = rows.size() <= most_rows + 2 ? rows.size() : most_rows;
    if (!rows.empty()) html += table(rows, 0, shown_rows);
    if (shown_rows < rows.size()) {
      html += "<details><summary>" + number(static_cast<double>(rows.size() - shown_rows)) +
              " more</summary>" + table(rows, shown_rows, rows.size()) + "</details>\n";
    }
    const Value& digest = member(output, "digest");
    if (digest.is_string())
      html += "<p class=\"export\"><code>ballflow export " +
              escaped(digest.get<std::string>().substr(0, 12)) + " FILE</code></p>\n";
    html += "</article>\n";
  }
  return html.empty() ? "" : "<div class=\"cards\">\n" + html + "</div>\n";
}

}  // namespace ballflow::report
