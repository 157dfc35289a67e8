// How the graphs of a folder use every node type.
#include <algorithm>
#include <filesystem>

#include "ballflow/schema.hpp"
#include "document/expand.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> graphs_in(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".json") files.push_back(entry->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Json read(const std::string& file) { return Json::parse(read_text_file(file), nullptr, true, true); }

/// The ways to run a graph: as it is, and with every subgraph that one of its parameters may choose
/// ("strategies/${strategy}.json").
std::vector<std::vector<Setting>> variants(const std::string& file) {
  std::vector<std::vector<Setting>> result = {{}};
  const Json graph = read(file);
  for (const auto& [name, node] : graph.at("nodes").items()) {
    const std::string path = node.value("graph", std::string());
    const std::size_t begin = path.find("${"), end = path.find("}.json");
    if (begin == std::string::npos || end == std::string::npos || begin > end) continue;
    const std::string param = path.substr(begin + 2, end - begin - 2);
    for (const std::string& choice : graphs_in(fs::path(file).parent_path() / path.substr(0, begin)))
      result.push_back({{param, fs::path(choice).stem().string()}});
  }
  return result;
}

class Collector {
 public:
  Collector(const fs::path& folder, std::map<std::string, NodeExample>& examples)
      : folder_(folder), examples_(examples) {}

  void add(const Dag& dag, const std::string& graph, const std::vector<Setting>& settings) {
    for (const DagNode& node : dag.nodes) {
      if (const Loop* loop = node.kind.loop()) {
        add(loop->body, graph, settings);
        continue;
      }
      const auto [place, fresh] = examples_.try_emplace(node.kind.type());
      if (!fresh) continue;
      const std::string name = node.path.substr(node.path.rfind('/') + 1);
      place->second.graph = fs::path(graph).lexically_relative(folder_).string();
      place->second.file = fs::path(node.place.file).lexically_relative(folder_).string();
      place->second.settings = settings;
      place->second.entry = {{name, read(node.place.file).at("nodes").at(name)}};
    }
  }

 private:
  fs::path folder_;
  std::map<std::string, NodeExample>& examples_;
};

}  // namespace

std::map<std::string, NodeExample> find_examples(const std::string& folder, const Registry& registry) {
  std::map<std::string, NodeExample> examples;
  std::error_code ignored;
  const fs::path root = fs::weakly_canonical(folder, ignored);
  Collector collector(root, examples);
  for (const std::string& file : graphs_in(root)) {
    try {
      for (const std::vector<Setting>& settings : variants(file))
        collector.add(load_graph(file, registry, settings), file, settings);
    } catch (const std::exception&) {
      // A graph for node libraries that are not here is no example.
    }
  }
  return examples;
}

}  // namespace ballflow
