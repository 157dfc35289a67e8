// A comparison as text: for people, spreadsheets, pages and programs.
#include <algorithm>
#include <cstdio>

#include "ballflow/json.hpp"
#include "ballflow/text.hpp"
#include "report/compare.hpp"

namespace ballflow::cli {
namespace {

using Value = nlohmann::json;

/// For people: numbers with six digits.
std::string shown(const Value& value) {
  if (value.is_null()) return "-";
  if (value.is_string()) return printable(value.get<std::string>());
  if (value.is_number_float()) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value.get<double>());
    return text;
  }
  return printable(value.dump(-1, ' ', false, Value::error_handler_t::replace));
}

/// In full.
std::string exact(const Value& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  return value.dump(-1, ' ', false, Value::error_handler_t::replace);
}

bool is_time(const std::string& column) { return column == "seconds" || column == "shared_seconds"; }

std::vector<std::vector<std::string>> cells_of(const Comparison& comparison) {
  std::vector<std::vector<std::string>> cells(1);
  for (const Comparison::Column& column : comparison.columns) cells[0].push_back(printable(column.name));
  for (const auto& row : comparison.rows) {
    auto& texts = cells.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) {
      char time[32];
      if (is_time(comparison.columns[i].name)) {
        std::snprintf(time, sizeof time, "%.3f", row[i].get<double>());
        texts.emplace_back(time);
      } else {
        texts.push_back(shown(row[i]));
      }
    }
  }
  return cells;
}

/// One column per character, not per byte: continuation bytes take no room.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

std::string notes(const Comparison& comparison) {
  std::string text;
  if (comparison.shared) {
    text +=
        "seconds: of the nodes that only this variant has; shared_seconds: of those it has in common with\n"
        "others, computed once for all. Both as measured when they were computed, now or before.\n";
  }
  if (!comparison.left_out.empty()) {
    text += "also different:";
    for (const std::string& name : comparison.left_out) text += " " + printable(name);
    text += " (--fields)\n";
  }
  return text;
}

std::string as_text(const Comparison& comparison) {
  const auto cells = cells_of(comparison);
  std::vector<std::size_t> widths(comparison.columns.size(), 0);
  for (const auto& row : cells) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width_of(row[i]));
  }
  std::string text;
  for (const auto& row : cells) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string gap(widths[i] - width_of(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (comparison.columns[i].number ? gap + row[i] : row[i] + gap);
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  const std::string below = notes(comparison);
  return text + (below.empty() ? "" : "\n" + below);
}

std::string as_markdown(const Comparison& comparison) {
  const auto cells = cells_of(comparison);
  std::string text;
  for (std::size_t r = 0; r < cells.size(); ++r) {
    text += "|";
    for (const std::string& cell : cells[r]) {
      text += " ";
      for (const char c : cell) text += (c == '|' ? "\\" : "") + std::string(1, c);
      text += " |";
    }
    text += "\n";
    if (r != 0) continue;
    text += "|";
    for (const Comparison::Column& column : comparison.columns) text += column.number ? "---:|" : "---|";
    text += "\n";
  }
  const std::string below = notes(comparison);
  return text + (below.empty() ? "" : "\n" + below);
}

std::string as_csv(const Comparison& comparison) {
  const auto quoted_cell = [](const std::string& cell) {
    if (cell.find_first_of(",\"\r\n") == std::string::npos) return cell;
    std::string text = "\"";
    for (const char c : cell) text += (c == '"' ? "\"" : "") + std::string(1, c);
    return text + "\"";
  };
  std::string text;
  for (std::size_t i = 0; i < comparison.columns.size(); ++i)
    text += (i == 0 ? "" : ",") + quoted_cell(comparison.columns[i].name);
  text += "\r\n";
  for (const auto& row : comparison.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += (i == 0 ? "" : ",") + quoted_cell(exact(row[i]));
    text += "\r\n";
  }
  return text;
}

std::string as_json(const Comparison& comparison) {
  Json rows = Json::array();
  for (const auto& row : comparison.rows) {
    Json one = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i) one[comparison.columns[i].name] = row[i];
    rows.push_back(std::move(one));
  }
  return rows.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string render(const Comparison& comparison, std::string_view format) {
  if (format == "csv") return as_csv(comparison);
  if (format == "md") return as_markdown(comparison);
  if (format == "json") return as_json(comparison);
  return as_text(comparison);
}

}  // namespace ballflow::cli
