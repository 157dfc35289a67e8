#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <regex>

#include "ballflow/error.hpp"
#include "report/bibliography.hpp"
#include "report/html.hpp"
#include "report/output_cards.hpp"
#include "report/plot.hpp"
#include "report/report_page.hpp"

namespace ballflow::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

/// Tags open and close in order; an independent look at what the functions below write.
bool well_formed(const std::string& html) {
  std::vector<std::string> open;
  const std::regex tag("<(/?)([a-zA-Z0-9]+)([^<>]*?)(/?)>");
  for (auto it = std::sregex_iterator(html.begin(), html.end(), tag); it != std::sregex_iterator(); ++it) {
    const std::string name = (*it)[2];
    if ((*it)[4] == "/" || name == "meta" || name == "img" || name == "br") continue;
    if ((*it)[1] == "/") {
      if (open.empty() || open.back() != name) return false;
      open.pop_back();
    } else {
      open.push_back(name);
    }
  }
  return open.empty();
}

TEST(html, leaves_no_markup_in_text) {
  EXPECT_EQ(escaped("<script>alert(\"a\" & 'b')</script>"),
            "&lt;script&gt;alert(&quot;a&quot; &amp; &#39;b&#39;)&lt;/script&gt;");
  EXPECT_EQ(escaped("K\xc3\xb6rper \xe2\x82\xac \xf0\x9f\x98\x80"),
            "K\xc3\xb6rper \xe2\x82\xac \xf0\x9f\x98\x80");
}

TEST(html, replaces_bytes_that_are_no_text) {
  const std::string replacement = "\xef\xbf\xbd";
  EXPECT_EQ(escaped("a\xff"
                    "b"),
            "a" + replacement + "b");
  EXPECT_EQ(escaped("\xc3"), replacement);
  EXPECT_EQ(escaped("\xc0\x80"), replacement + replacement) << "overlong";
  EXPECT_EQ(count(escaped("\xed\xa0\x80"), replacement), 3u) << "surrogate";
  EXPECT_EQ(escaped(std::string("\0\x1b", 2)), replacement + replacement);
}

TEST(html, writes_numbers_for_people) {
  EXPECT_EQ(number(0), "0");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(999), "999");
  EXPECT_EQ(number(35676),
            "35\xe2\x80\xaf"
            "676");
  EXPECT_EQ(number(-1234567),
            "-1\xe2\x80\xaf"
            "234\xe2\x80\xaf"
            "567");
  EXPECT_EQ(number(0.012345), "0.01235");
  EXPECT_EQ(number(1e300), "1e+300");
}

TEST(ticks, are_round_and_enclose_the_values) {
  for (const auto& [low, high] : std::vector<std::pair<double, double>>{
           {0, 1}, {0.013, 0.094}, {-3, 17}, {1e6, 1.00001e6}, {-1e-9, 1e-9}, {5, 5.5}}) {
    const auto marks = ticks(low, high, 5);
    ASSERT_GE(marks.size(), 3u);
    EXPECT_LE(marks.size(), 12u);
    EXPECT_LE(marks.front(), low + 1e-12 * std::abs(low));
    EXPECT_GE(marks.back(), high - 1e-12 * std::abs(high));
    const double step = marks[1] - marks[0], decade = std::pow(10, std::floor(std::log10(step * 1.0001)));
    EXPECT_NEAR(
        std::min({std::abs(step / decade - 1), std::abs(step / decade - 2), std::abs(step / decade - 5)}), 0,
        1e-6)
        << step;
  }
  EXPECT_EQ(ticks(0, 10, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
}

Plot small_plot() {
  Plot plot;
  plot.title = "A & B";
  plot.x_name = "epsilon", plot.y_name = "balls";
  plot.series = {{"greedy", {1, 2, 3}, {30, 20, 10}, {15, nan, 5}, {}},
                 {"none", {1, 2, 3}, {nan, 40, 40}, {}, {}}};
  return plot;
}

TEST(plot, draws_a_mark_for_every_finite_point) {
  const std::string drawn = svg(small_plot());
  EXPECT_TRUE(well_formed(drawn));
  EXPECT_EQ(count(drawn, "<circle"), 5u + 2u) << "two in the legend";
  EXPECT_EQ(count(drawn, "class=\"band\""), 1u);
  EXPECT_EQ(count(drawn, "<polyline"), 2u);
  EXPECT_NE(drawn.find("greedy\nepsilon 1\nballs 30, at least 15"), std::string::npos);
  EXPECT_EQ(drawn.find("nan"), std::string::npos);
  EXPECT_NE(drawn.find("A &amp; B"), std::string::npos);
}

TEST(plot, places_larger_values_higher_and_to_the_right) {
  const std::string drawn = svg(small_plot());
  const std::regex circle("<circle cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"[0-9.]+\"><title>greedy");
  std::vector<std::pair<double, double>> at;
  for (auto it = std::sregex_iterator(drawn.begin(), drawn.end(), circle); it != std::sregex_iterator();
       ++it) {
    at.emplace_back(std::stod((*it)[1]), std::stod((*it)[2]));
  }
  ASSERT_EQ(at.size(), 3u);
  EXPECT_LT(at[0].first, at[1].first);
  EXPECT_LT(at[0].second, at[1].second) << "y grows downwards";
  EXPECT_NEAR(at[1].first - at[0].first, at[2].first - at[1].first, 0.2) << "linear";
}

TEST(plot, takes_logarithms_where_values_span_decades) {
  Plot plot;
  plot.series = {{"", {0.01, 0.1, 1}, {1, 10, 1000}, {}, {}}};
  const std::string drawn = svg(plot);
  const std::regex circle("<circle cx=\"([0-9.]+)\"");
  std::vector<double> x;
  for (auto it = std::sregex_iterator(drawn.begin(), drawn.end(), circle); it != std::sregex_iterator();
       ++it) {
    x.push_back(std::stod((*it)[1]));
  }
  ASSERT_EQ(x.size(), 3u);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.2);
}

TEST(plot, survives_nothing_and_one_value) {
  EXPECT_TRUE(well_formed(svg(Plot{})));
  Plot one;
  one.series = {{"a", {3}, {0}, {}, {}}};
  EXPECT_EQ(count(svg(one), "<circle"), 2u);
  one.x_labels = {"x", "y", "z", "w"};
  EXPECT_EQ(count(svg(one), "<polyline"), 0u) << "categories are not joined";
  EXPECT_TRUE(well_formed(svg(Bars{})));
}

TEST(bars, are_as_long_as_their_values) {
  Bars bars;
  bars.unit = "seconds";
  bars.labels = {"one", "<two>"};
  bars.parts = {"a", "b"};
  bars.values = {{1, 3}, {2, 0}};
  const std::string drawn = svg(bars);
  EXPECT_TRUE(well_formed(drawn));
  const std::regex bar("<rect class=\"s([0-9])\" x=\"[0-9.]+\" y=\"[0-9.]+\" width=\"([0-9.]+)\"");
  std::vector<double> width;
  for (auto it = std::sregex_iterator(drawn.begin(), drawn.end(), bar); it != std::sregex_iterator(); ++it) {
    width.push_back(std::stod((*it)[2]));
  }
  ASSERT_EQ(width.size(), 3u) << "no bar for 0";
  EXPECT_NEAR(width[1], 3 * width[0], 0.5);
  EXPECT_NEAR(width[2], 2 * width[0], 0.5);
  EXPECT_NE(drawn.find("&lt;two&gt;"), std::string::npos);
}

TEST(bibliography, reads_entries) {
  const auto sources = parse_bibtex(R"(A comment.
@Article{Key1, author = {M{\"u}ller, A. and Li, B.}, title = "About {3D} \& more",
  journal = {J. of  X}, volume = 4, number={2}, pages = {1--9}, year = 1999, }
@misc{k2, title={Tool}})");
  ASSERT_EQ(sources.size(), 2u);
  EXPECT_EQ(sources.at("Key1").kind, "article");
  EXPECT_EQ(sources.at("Key1").text(),
            "M\\\"uller, A.; Li, B.: About 3D & more. J. of X 4(2), 1\xe2\x80\x93"
            "9, 1999.");
  EXPECT_EQ(sources.at("k2").text(), "Tool.");
}

TEST(bibliography, names_the_line_of_what_it_cannot_read) {
  for (const auto& [text, line] :
       std::vector<std::pair<const char*, const char*>>{{"@a{k,\n t = {x", "line 2"},
                                                        {"@a{k t={x}}", "line 1"},
                                                        {"@a{,}", "line 1"},
                                                        {"@a{k, ={x}}", "line 1"},
                                                        {"@a{k,t={x}}\n@a{k,t={x}}", "line 2"}}) {
    try {
      parse_bibtex(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(line), std::string::npos) << error.what();
    }
  }
}

TEST(bibliography, has_the_sources_of_the_thesis) {
  EXPECT_NE(built_in_sources().at("kornberger2010").text().find("Unions of Balls"), std::string::npos);
  for (const auto& [key, source] : built_in_sources()) EXPECT_FALSE(source.text().empty()) << key;
}

ReportInput hostile_run() {
  ReportInput input;
  input.run.id = "r";
  input.run.report = nlohmann::json::parse(R"({
    "run": "r", "graph": "<script>alert(1)</script>.json", "status": "failed", "seconds": 1, "cpu_seconds": 2,
    "peak_rss_bytes": 5000000, "command": "ballflow run '<b>'", "params": {"<i>": "<u>"},
    "nodes": {"<script>": {"type": "T", "status": "failed", "reason": "", "seconds": 1, "cpu_seconds": 1,
      "cost_seconds": 1, "params": {"<p>": "\"x"}, "outputs": {}, "warnings": ["<em>"],
      "error": {"cause": "<h1>", "hint": "</style>"}}},
    "outputs": {"a<b": {"type": "Balls", "digest": "00", "bytes": 1, "summary": {"co<unt": 3}}}})");
  input.pictures = {{"</title>", "PNG"}};
  return input;
}

TEST(report_page, shows_text_of_graphs_as_text) {
  const std::string page = report_page(hostile_run());
  EXPECT_TRUE(well_formed(page));
  for (const char* const tag : {"<script", "<b>", "<i>", "<u>", "<em>", "<p>\"", "a<b", "co<unt"}) {
    EXPECT_EQ(page.find(tag), std::string::npos) << tag;
  }
  EXPECT_EQ(count(page, "</style>"), 1u);
  EXPECT_NE(page.find("&lt;script&gt;alert(1)&lt;/script&gt;.json"), std::string::npos);
  EXPECT_NE(page.find("base64,UE5H\""), std::string::npos);
}

TEST(report_page, loads_nothing_from_elsewhere) {
  const std::string page = report_page(hostile_run());
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  for (const char* const address : {"http:", "https:", "src=\"/", "href", "url(", "@import"}) {
    EXPECT_EQ(page.find(address), std::string::npos) << address;
  }
}

TEST(report_page, encodes_pictures_of_any_length) {
  for (const auto& [bytes, code] :
       std::vector<std::pair<std::string, std::string>>{{"", "base64,\""},
                                                        {"f", "base64,Zg==\""},
                                                        {"fo", "base64,Zm8=\""},
                                                        {"foo", "base64,Zm9v\""},
                                                        {"\xff\xfe\xfd\xfc", "base64,//79/A==\""}}) {
    ReportInput input = hostile_run();
    input.pictures = {{"p", bytes}};
    EXPECT_NE(report_page(input).find(code), std::string::npos) << code;
  }
}

ReportInput single_run() {
  ReportInput input;
  input.run.report = nlohmann::json::parse(R"({"run": "r", "graph": "g", "status": "ok", "params": {},
    "nodes": {"a": {"type": "T", "warnings": ["too thin"], "params": {}, "outputs": {}}},
    "outputs": {
      "anything": {"type": "acme.Grid", "digest": "0123456789abcdef", "summary": {"cells": 3}},
      "balls": {"type": "Balls", "digest": "00", "summary":
        {"count": 1286, "bbox": [[0, 0, 0], [1, 2.5, 4]], "max_radius": 0.25, "nothing": null}},
      "cover": {"type": "CoverState", "digest": "00", "summary": {"chosen": 5, "b1": 1, "b2": 1, "b3": 1, "b4": 1,
        "b5": 1, "b6": 1, "b7": 1, "b8": 1, "b9": 1, "b10": 1}}}})");
  input.words = {{"balls", "1 286 balls"}};
  input.facts = {"1 286 balls <chosen>"};
  input.remedy = [](const std::string& warning) { return warning == "too thin" ? "sample it <better>" : ""; };
  return input;
}

TEST(report_page, of_one_run_has_a_short_table_for_every_output) {
  const std::string page = report_page(single_run());
  EXPECT_TRUE(well_formed(page));
  EXPECT_EQ(count(page, "<article>"), 3u);
  EXPECT_NE(page.find("<th>size</th><td class=\"number\">1 x 2.5 x 4</td>"), std::string::npos);
  EXPECT_NE(page.find("<th>max radius</th><td class=\"number\">0.25</td>"), std::string::npos);
  EXPECT_EQ(page.find("<th>nothing</th>"), std::string::npos) << "what is not known takes no room";
  EXPECT_NE(page.find("<p>1 286 balls</p>"), std::string::npos);
  EXPECT_NE(page.find("ballflow export 0123456789ab FILE"), std::string::npos);
  EXPECT_NE(page.find("<summary>3 more</summary>"), std::string::npos) << "8 of 11 fields are shown at once";
  // What people look for first stands first.
  EXPECT_LT(page.find("<h3>cover"), page.find("<h3>balls"));
  EXPECT_LT(page.find("<h3>balls"), page.find("<h3>anything"));
}

TEST(report_page, of_one_run_begins_with_what_matters_and_with_warnings_and_their_remedies) {
  const std::string page = report_page(single_run());
  const std::size_t facts = page.find("<li>1 286 balls &lt;chosen&gt;</li>"),
                    warning = page.find(
                        "<code>a</code> too thin<br><strong>What to do:</strong> sample it &lt;better&gt;"),
                    results = page.find("<h2>Results</h2>");
  ASSERT_NE(facts, std::string::npos);
  ASSERT_NE(warning, std::string::npos);
  EXPECT_LT(facts, warning);
  EXPECT_LT(warning, results);
}

TEST(report_page, draws_the_balls_of_a_search_against_its_steps) {
  ReportInput input = single_run();
  EXPECT_EQ(count(report_page(input), "<svg class=\"plot\""), 0u);
  input.run.report["nodes"]["prune/search"] = nlohmann::json::parse(R"({"type": "LocalSearch", "params": {},
    "outputs": {"cover": {"type": "CoverState", "digest": "00", "summary": {"lower_bound": 7,
      "curve": [[0, 12], [1000, 10], "broken", [5, null], [9000, 9]]}}}})");
  const std::string page = report_page(input);
  EXPECT_TRUE(well_formed(page));
  EXPECT_EQ(count(page, "<svg class=\"plot\""), 1u);
  EXPECT_NE(page.find("Balls after steps of prune/search"), std::string::npos);
  for (const char* const balls : {"12", "10", "9"}) {
    EXPECT_EQ(count(page, std::string("\nballs ") + balls + "</title>"), 1u) << balls;
  }
  EXPECT_EQ(count(page, "<polyline class=\"guide\""), 1u);
  EXPECT_NE(page.find("lower bound"), std::string::npos);
  input.run.report["nodes"]["prune/search"]["outputs"]["cover"]["summary"]["curve"] = {"no", "numbers"};
  EXPECT_EQ(count(report_page(input), "<svg class=\"plot\""), 0u);
}

TEST(report_page, orders_outputs_by_type_and_fields_as_their_type_declares_them) {
  EXPECT_EQ(outputs_in_order(single_run().run.report),
            (std::vector<std::string>{"cover", "balls", "anything"}));
  Registry registry;
  TypeDeclaration type;
  type.id = "Balls";
  type.summary = {{"max_radius", "the <largest>"}, {"count", "how many"}};
  registry.add(type);
  ReportInput input = single_run();
  input.registry = &registry;
  const std::string page = report_page(input);
  EXPECT_TRUE(well_formed(page));
  EXPECT_LT(page.find("<th>max radius</th>"), page.find("<th>count</th>"));
  EXPECT_NE(page.find("title=\"the &lt;largest&gt;\""), std::string::npos);
}

ReportInput sweep() {
  ReportInput input;
  auto& report = input.run.report;
  report = {{"run", "r"},
            {"graph", "g"},
            {"status", "ok"},
            {"seconds", 1},
            {"cpu_seconds", 2},
            {"peak_rss_bytes", 1},
            {"params", nlohmann::json::object()},
            {"axes", {"epsilon", "strategy"}}};
  for (const double epsilon : {0.1, 0.5}) {
    for (const std::string strategy : {"greedy", "exact"}) {
      const std::string name = "epsilon=" + std::to_string(epsilon) + ",strategy=" + strategy;
      const double balls = (strategy == "exact" ? 10 : 20) / epsilon;
      report["variants"].push_back({{"name", name},
                                    {"status", "ok"},
                                    {"nodes", {"[" + name + "]/prune"}},
                                    {"params", {{"epsilon", epsilon}, {"strategy", strategy}}},
                                    {"subgraphs", nlohmann::json::object()}});
      report["nodes"]["[" + name + "]/prune"] = {{"type", "P"},
                                                 {"status", "run"},
                                                 {"cost_seconds", epsilon},
                                                 {"params", nlohmann::json::object()},
                                                 {"outputs", nlohmann::json::object()}};
      report["outputs"][name + "/cover"] = {
          {"type", "CoverState"},
          {"digest", "00"},
          {"bytes", 1},
          {"summary", {{"upper_bound", balls}, {"lower_bound", balls - 5}, {"gap", 5 / balls}}}};
      report["outputs"][name + "/error"] = {
          {"type", "Comparison"}, {"digest", "00"}, {"bytes", 1}, {"summary", {{"hausdorff", epsilon * 2}}}};
    }
  }
  return input;
}

TEST(report_page, plots_a_sweep_along_its_numbers_with_a_line_for_every_strategy) {
  const std::string page = report_page(sweep());
  EXPECT_TRUE(well_formed(page));
  EXPECT_NE(page.find("exact\nepsilon 0.1\nballs 100, at least 95"), std::string::npos);
  EXPECT_NE(page.find("greedy\nepsilon 0.5\nballs 40, at least 35"), std::string::npos);
  EXPECT_NE(page.find("gap, % 25"), std::string::npos) << "5 of 20 balls";
  EXPECT_NE(page.find("greedy\nepsilon 0.5\nmodel units 1"), std::string::npos);
  EXPECT_NE(page.find("exact\nballs 20\nHausdorff distance, model units 1\nepsilon 0.5"), std::string::npos);
  EXPECT_EQ(count(page, "class=\"guide\""), 2u) << "the front and its key";
}

TEST(report_page, plots_how_good_a_model_of_shapes_is) {
  ReportInput input = sweep();
  nlohmann::json& report = input.run.report;
  report.erase("variants");
  report["outputs"] = {{"prior",
                        {{"type", "ShapePrior"},
                         {"digest", "00"},
                         {"bytes", 1},
                         {"summary",
                          {{"compactness", {0.75, 1}},
                           {"generalization", {4, 2.5}},
                           {"generalization_deviation", {1, 0.5}},
                           {"specificity", {3, 3.5}},
                           {"specificity_deviation", {0.25, 0.25}}}}}}};
  const std::string page = report_page(input);
  EXPECT_TRUE(well_formed(page));
  EXPECT_NE(page.find("modes 1\npart 0.75"), std::string::npos);
  EXPECT_NE(page.find("modes 1\nmodel units 2.5\nstandard deviation 0.5"), std::string::npos);
  EXPECT_NE(page.find("modes 2\nmodel units 3.5\nstandard deviation 0.25"), std::string::npos);
  EXPECT_EQ(count(page, "class=\"guide\""), 8u) << "two lines with a key each, twice";
}

TEST(report_page, shows_outputs_of_a_map_over_files_whose_names_have_dots) {
  ReportInput input = sweep();
  nlohmann::json& report = input.run.report;
  report.erase("variants");
  report["outputs"] = {
      {"a.off.gz/balls", {{"type", "Balls"}, {"digest", "00"}, {"summary", {{"count", 17}}}}},
      {"b.stl/balls", {{"type", "Balls"}, {"digest", "01"}, {"summary", {{"count", 19}}}}}};
  const std::string page = report_page(input);
  EXPECT_TRUE(well_formed(page));
  EXPECT_NE(page.find("a.off.gz/balls"), std::string::npos);
  EXPECT_NE(page.find(">19<"), std::string::npos);
}

TEST(report_page, names_what_nodes_cite) {
  Registry registry;
  NodeDeclaration node;
  node.id = "P";
  node.cites = {{"kornberger2010", "3.6"}, {"unknown<key", ""}};
  registry.add(node);
  ReportInput input = sweep();
  input.registry = &registry;
  const std::string page = report_page(input);
  EXPECT_NE(page.find("Unions of Balls. Graz University of Technology, 2010. <small>P: 3.6"),
            std::string::npos);
  EXPECT_NE(page.find("unknown&lt;key"), std::string::npos);
}

}  // namespace
}  // namespace ballflow::report
