#include "commands/completions.hpp"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ballflow/shipped_graphs.hpp"
#include "ballflow/text.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

const OptionFacts* option_of(const CommandFacts& command, const std::string& name) {
  for (const OptionFacts& option : command.options) {
    if (std::find(option.names.begin(), option.names.end(), name) != option.names.end()) return &option;
  }
  return nullptr;
}

const CommandFacts* command_of(const CommandFacts& group, const std::string& name) {
  for (const CommandFacts& command : group.commands) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// What was written before the word that is completed.
struct Line {
  const CommandFacts* command = nullptr;
  const OptionFacts* waiting = nullptr;  // an option whose value comes next
  bool filled = false;                   // it has one, and takes more: what comes may be something else
  bool no_options = false;               // behind "--"
  std::vector<std::string> arguments;    // positional ones of the command
  std::vector<std::string> plugins;

  const OptionFacts* positional(std::size_t place) const {
    for (const OptionFacts& option : command->options) {
      if (option.positional && (place-- == 0 || option.takes_many)) return &option;
    }
    return nullptr;
  }
  /// What was given for the positional argument with this value, or empty.
  std::string argument(const std::string& value) const {
    for (std::size_t place = 0; place < arguments.size(); ++place) {
      const OptionFacts* option = positional(place);
      if (option != nullptr && option->value == value) return arguments[place];
    }
    return {};
  }
};

Line read_line(const CommandFacts& program, const std::vector<std::string>& words) {
  Line line;
  line.command = &program;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const std::string& word = words[i];
    const bool is_option = !line.no_options && word.size() > 1 && word.front() == '-';
    if (is_option) {
      line.waiting = nullptr;
      line.filled = false;
      line.no_options = word == "--";
      const OptionFacts* option = option_of(*line.command, word);
      if (option != nullptr && option->takes_value) line.waiting = option;
    } else if (line.waiting != nullptr && !(line.filled && command_of(*line.command, word) != nullptr)) {
      if (line.waiting->names.back() == "--plugin") line.plugins.push_back(word);
      line.filled = line.waiting->takes_many;
      if (!line.filled) line.waiting = nullptr;
    } else if (const CommandFacts* command = command_of(*line.command, word)) {
      line.command = command;
      line.waiting = nullptr;
      line.arguments.clear();
    } else {
      line.arguments.push_back(word);
    }
  }
  return line;
}

class Candidates {
 public:
  explicit Candidates(std::string word) : word_(std::move(word)) {}

  void add(const std::string& text, const std::string& doc) {
    if (text.starts_with(word_)) text_ += printable(text) + "\t" + printable(first_line(doc)) + "\n";
  }
  void paths(const std::string& what) { paths_ = what; }
  std::string text() const { return text_ + ":" + paths_ + "\n"; }

 private:
  std::string word_, text_, paths_;
};

Json read_graph(const std::string& name) {
  if (name.empty()) return {};
  std::ifstream file(find_graph(name), std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  const Json graph = Json::parse(text.str(), nullptr, false, true);
  return graph.is_object() ? graph : Json();
}

/// A member that is an object or a list, or an empty one.
const Json& member(const Json& object, const char* name) {
  static const Json none = Json::object();
  const bool there = object.is_object() && object.contains(name) && object.at(name).is_structured();
  return there ? object.at(name) : none;
}

std::string text_of(const Json& object, const char* name) {
  return object.is_object() ? plain(object.value(name, Json(""))) : std::string();
}

/// The subgraphs that a parameter of the graph chooses from: "strategies/${strategy}.json".
std::vector<std::string> parts(const std::string& graph_name, const Json& graph, const std::string& param) {
  std::vector<std::string> names;
  for (const auto& [name, node] : member(graph, "nodes").items()) {
    const std::string path = text_of(node, "graph");
    const std::size_t at = path.find("${" + param + "}.json");
    if (at == std::string::npos) continue;
    const fs::path folder = fs::path(find_graph(graph_name)).parent_path() / path.substr(0, at);
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

/// "name=" of every parameter of the graph, or the values of the one that is named.
void add_settings(const Line& line, const std::string& word, Candidates& candidates) {
  const std::string graph_name = line.argument("GRAPH");
  const Json graph = read_graph(graph_name);
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  for (const auto& [param, declared] : member(graph, "params").items()) {
    const std::string doc = text_of(declared, "doc");
    if (equals == std::string::npos) {
      candidates.add(param + "=", doc);
    } else if (param == name) {
      for (const Json& choice : member(declared, "choices")) candidates.add(name + "=" + plain(choice), doc);
      for (const std::string& part : parts(graph_name, graph, name)) candidates.add(name + "=" + part, doc);
      const std::string kind = text_of(declared, "kind");
      if (kind == "boolean") {
        for (const char* value : {"true", "false"}) candidates.add(name + ("=" + std::string(value)), doc);
      }
      if (kind.starts_with("file") || kind == "artifact") candidates.paths("files");
    }
  }
}

/// The same of a node type.
void add_params(const Registry& registry, const std::string& type, const std::string& word,
                Candidates& candidates) {
  const NodeDeclaration* node = registry.node(type);
  if (node == nullptr) return;
  const std::size_t equals = word.find('=');
  for (const ParamDecl& param : node->params) {
    if (equals == std::string::npos) candidates.add(param.name + "=", param.doc);
    if (param.name != word.substr(0, equals)) continue;
    for (const auto& [value, doc] : param.choices) candidates.add(param.name + "=" + value, doc);
  }
}

std::shared_ptr<const Registry> registry_of(const Common& common, const Line& line) {
  Common with = common;
  with.plugins.insert(with.plugins.end(), line.plugins.begin(), line.plugins.end());
  return with.registry();
}

/// What stands for the value in the help says what the value is.
void add_values(const OptionFacts& option, const Common& common, const Line& line, const std::string& word,
                Candidates& candidates) {
  for (const std::string& choice : option.choices) candidates.add(choice, option.doc);
  if (!option.choices.empty()) return;
  const std::string& value = option.value;
  if (value == "GRAPH") {
    candidates.paths("files");
    for (const ShippedGraph& graph : shipped_graphs()) candidates.add(graph.name, graph.doc);
  } else if (value == "NAME=VALUE" || value == "NAME=VALUES") {
    const std::string type = line.argument("TYPE");
    if (type.empty()) {
      add_settings(line, word, candidates);
    } else {
      add_params(*registry_of(common, line), type, word, candidates);
    }
  } else if (value == "NODE") {
    const Json graph = read_graph(line.argument("GRAPH"));
    for (const auto& [name, node] : member(graph, "nodes").items())
      candidates.add(name, text_of(node, node.contains("type") ? "type" : "graph"));
  } else if (value == "OUTPUT=FORMAT") {
    const Json graph = read_graph(line.argument("GRAPH"));
    for (const auto& [name, output] : member(graph, "outputs").items())
      candidates.add(name + "=", text_of(output, "doc"));
  } else if (value == "TYPE") {
    const auto registry = registry_of(common, line);
    for (const auto& [id, node] : registry->nodes()) candidates.add(id, node.summary);
  } else if (value == "DIR") {
    candidates.paths("folders");
  } else if (value.find("RUN") != std::string::npos) {
    candidates.add("latest", "the newest run");
    candidates.add("previous", "the run before");
    candidates.paths("files");
  } else if (value != "UINT" && value != "INT" && value != "FLOAT" && value != "SIZE") {
    candidates.paths("files");
  }
}

void add_all(const CommandFacts& program, const Common& common, const std::vector<std::string>& words,
             const std::string& word, Candidates& candidates) {
  const Line line = read_line(program, words);
  const bool is_option = !line.no_options && word.starts_with('-');
  if (is_option && word.starts_with("--") && word.find('=') != std::string::npos) return;  // --epsilon=0.3
  if (is_option) {
    for (const OptionFacts& option : line.command->options) {
      if (option.positional) continue;
      for (const std::string& name : option.names) candidates.add(name, option.doc);
    }
    return;
  }
  if (line.waiting != nullptr) {
    add_values(*line.waiting, common, line, word, candidates);
    if (!line.filled) return;
  }
  for (const CommandFacts& command : line.command->commands) candidates.add(command.name, command.doc);
  if (const OptionFacts* option = line.positional(line.arguments.size()))
    add_values(*option, common, line, word, candidates);
}

}  // namespace

std::string completions(const CommandFacts& program, const Common& common,
                        const std::vector<std::string>& words) {
  const std::string word = words.empty() ? std::string() : words.back();
  Candidates candidates(word);
  try {
    add_all(program, common, words, word, candidates);
  } catch (const std::exception&) {
    // A graph that cannot be read: who runs it will be told.
  }
  return candidates.text();
}

}  // namespace ballflow::cli
