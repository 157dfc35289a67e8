#include "ballflow/shipped_graphs.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <system_error>

#include "ballflow/error.hpp"
#include "ballflow/json.hpp"
#include "base/quote.hpp"
#include "document/graph_files.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

const std::string experiments = "experiments/", extension = ".json";
constexpr std::size_t most_names = 3;  // that an error proposes

/// "experiments/table_3_3" -> graphs/experiments/table_3_3.json
std::string file_of(const std::string& name, const std::string& folder) {
  return (fs::path(folder) / (name + extension)).string();
}

std::vector<std::string> names_in(const fs::path& folder, const std::string& before) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().extension() == extension && entry->is_regular_file(ignored))
      names.push_back(before + entry->path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!blank) {
      line += c;
    } else if (!line.empty() && line.back() != ' ') {
      line += ' ';
    }
  }
  if (line.ends_with(' ')) line.pop_back();
  return line;
}

std::string doc_of(const std::string& file) {
  const Json graph = Json::parse(read_text_file(file), nullptr, false, true);
  const bool has_doc = graph.is_object() && graph.contains("doc") && graph.at("doc").is_string();
  return has_doc ? one_line(graph.at("doc").get<std::string>()) : std::string();
}

/// The name that `text` is a misspelling of, and those that have it as a part.
std::vector<std::string> near(const std::string& text, const std::vector<std::string>& names) {
  std::vector<std::string> found;
  const auto add = [&found](const std::string& name) {
    if (found.size() < most_names && std::find(found.begin(), found.end(), name) == found.end())
      found.push_back(name);
  };
  if (const std::string best = nearest(text, names); !best.empty()) add(best);
  for (const std::string& name : names) {
    // The folder is easily forgotten.
    if (name == experiments + text || (text.size() > 2 && name.find(text) != std::string::npos)) add(name);
  }
  return found;
}

}  // namespace

std::string shipped_graphs_folder(const std::string& libraries) {
  return (fs::path(libraries) / "../../share/ballflow/graphs").lexically_normal().string();
}

std::vector<std::string> shipped_graph_names(const std::string& folder) {
  std::vector<std::string> names = names_in(folder, "");
  for (std::string& name : names_in(fs::path(folder) / experiments, experiments))
    names.push_back(std::move(name));
  return names;
}

std::vector<ShippedGraph> shipped_graphs(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw Error(ExitCode::store, "there are no graphs in " + in_quotes(folder),
                "they are installed with the program: is the installation complete?");
  }
  std::vector<ShippedGraph> graphs;
  for (const std::string& name : shipped_graph_names(folder)) {
    const std::string file = file_of(name, folder);
    graphs.push_back({name, doc_of(file), file});
  }
  return graphs;
}

std::string find_graph(const std::string& text, const std::string& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(text, error);
  if (fs::exists(status) && !fs::is_directory(status)) return text;
  const std::vector<std::string> names = shipped_graph_names(folder);
  if (std::find(names.begin(), names.end(), text) != names.end()) return file_of(text, folder);
  if (const std::string name = fs::path(text).filename().replace_extension().string();
      text == "graphs/" + name + extension && std::find(names.begin(), names.end(), name) != names.end()) {
    // As the documentation calls it, in another folder than a checkout.
    throw Error(ExitCode::usage, "there is no file " + in_quotes(text),
                "did you mean " + in_quotes(name) + ", which comes with ballflow?");
  }
  const bool is_path =
      text.empty() || text.front() == '/' || text.front() == '.' || text.ends_with(extension);
  if (is_path) return text;
  std::string hint;
  for (const std::string& name : near(text, names))
    hint += (hint.empty() ? "did you mean " : " or ") + in_quotes(name);
  throw Error(ExitCode::usage,
              "there is no file " + in_quotes(text) + ", and no graph of this name comes with ballflow",
              hint.empty() ? "\"ballflow graph --list\" lists those that do" : hint + "?");
}

}  // namespace ballflow
