#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "ballflow/gc.hpp"
#include "ballflow/text.hpp"
#include "commands.hpp"

namespace ballflow::cli {

std::shared_ptr<Store> Common::store() const {
  StoreOptions options;
  if (!no_cache) options.root = cache.empty() ? Store::default_root() : cache;
  return Store::open(options);
}

std::uint64_t Common::cache_limit(Store& store) const {
  const char* const variable = std::getenv("BALLFLOW_CACHE_SIZE");
  const bool given = !cache_size.empty();
  const std::string size = given ? cache_size : variable != nullptr ? variable : "";
  if (size.empty()) return default_limit(store);
  if (const auto limit = parse_size(size)) return *limit;
  throw Error(ExitCode::usage, (given ? "" : "BALLFLOW_CACHE_SIZE: ") + ("\"" + size + "\" is not a size"),
              "write it as 5G, 800M, 1.5T, a number of bytes, or none");
}

void GraphArguments::add_to(CLI::App& command) {
  command.add_option("graph", file, "graph file")->required()->type_name("GRAPH.json");
  command
      .add_option(
          "--set", sets,
          "set a parameter of the graph (epsilon=0.5) or of one node (prune/greedy.mode=until_covered)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command
      .add_option(
          "--axis", axes,
          "run the graph once for every one of these values (epsilon=0.1,0.3); several axes give every\n"
          "combination; replaces the axis of that name in the graph's \"sweep\"")
      ->type_name("NAME=VALUES")
      ->allow_extra_args(false);
  command
      .add_option("--inputs", inputs,
                  "run the graph once for every file that matches ('scans/*.ply'); NAME=PATTERN chooses the\n"
                  "parameter when the graph has several of kind file")
      ->type_name("PATTERN...");
}

namespace {

std::vector<Override> split(const char* option, const std::vector<std::string>& texts, const char* example) {
  std::vector<Override> result;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error(ExitCode::usage, std::string(option) + " " + text + ": no \"=\" between a name and a value",
                  std::string("write it as ") + option + " " + example);
    }
    result.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return result;
}

}  // namespace

Dag GraphArguments::load(const Registry& registry) const {
  Dag dag = load_graph(file, registry, split("--set", sets, "epsilon=0.5"),
                       {split("--axis", axes, "epsilon=0.1,0.3"), inputs});
  for (const Diagnostic& warning : dag.warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  return dag;
}

std::string GraphArguments::words() const {
  std::string text = quoted(file);
  for (const std::string& set : sets) text += " --set " + quoted(set);
  for (const std::string& axis : axes) text += " --axis " + quoted(axis);
  if (!inputs.empty()) text += " --inputs";
  for (const std::string& input : inputs) text += " " + quoted(input);
  return text;
}

std::string quoted(const std::string& text) {
  if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@") ==
      std::string::npos) {
    return text;
  }
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

void print_table(const std::vector<std::vector<std::string>>& rows) {
  // One column per character, not per byte: continuation bytes take no room.
  const auto columns = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(printable(row[i])));
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = printable(row[i]);
      line += cell;
      if (i + 1 < row.size()) line += std::string(widths[i] - columns(cell) + 2, ' ');
    }
    std::printf("%s\n", line.c_str());
  }
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ballflow::cli
