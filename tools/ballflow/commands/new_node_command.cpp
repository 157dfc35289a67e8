#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>

#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

// In the templates, @id@ is "acme.BallOffset", @Node@ "BallOffset", @file@ "ball_offset" and @library@
// "acme_ball_offset".

const char* const source_template = R"(// @id@: a node of ballflow, outside of its repository.
#include <ballflow/sdk.hpp>
#include <vector>

#include "types/artifact_types.hpp"

namespace {

/// The algorithm, as a plain function: testable without the engine. Grows every ball by `distance` (model
/// units, >= 0); number, order and centers stay.
ballflow::geometry::Balls grow(const ballflow::geometry::Balls& balls, double distance) {
  std::vector<double> radii(balls.radii.begin(), balls.radii.end());
  for (double& radius : radii) radius += distance;
  return {balls.centers, std::move(radii), balls.defining_offsets, balls.defining_samples};
}

/// The node: ports, parameters, and what users read about them.
struct @Node@ {
  ballflow::In<ballflow::geometry::Balls> balls;
  ballflow::Out<ballflow::geometry::Balls> grown;
  double distance = 0.1;  // the default stands here and nowhere else

  static void declare(ballflow::NodeDecl<@Node@>& d) {
    // Raise the behaviour version when equal inputs and parameters may give other bytes than before.
    d.id("@id@", 1).summary("Grows balls by a distance.");
    d.doc("Accepts any balls, refuses none. Number, order and centers stay.");
    d.avoid_when("Enlarge chooses the growth that a covering needs.");
    d.input("balls", &@Node@::balls).doc("n balls");
    d.output("balls", &@Node@::grown).doc("n balls, same order and centers");
    d.param("distance", &@Node@::distance)
        .unit("model units")
        .at_least(0)
        .doc("what every radius grows by; 0 returns the input");
  }

  // A failure is an exception: throw ballflow::NodeError(cause, hint).
  void run(ballflow::RunContext&) { grown = grow(*balls, distance); }
};

}  // namespace

BALLFLOW_PLUGIN("@library@", "0.1.0", ballflow::node_entries<@Node@>(), ballflow::type_entries<>())
)";

const char* const test_template = R"(// The algorithm against what it promises.
#include "@file@.cpp"

#include <cstdio>

int main() {
  const ballflow::geometry::Balls two{{{0, 0, 0}, {1, 2, 3}}, {1, 0.5}, {}, {}};
  const auto grown = grow(two, 0.25);
  const bool good = grown.radii == ballflow::geometry::Array<double>{1.25, 0.75} &&
                    grown.centers == two.centers && grow(two, 0).radii == two.radii;
  if (!good) std::puts("grow() does not add the distance to every radius, or changes something else");
  return good ? 0 : 1;
}
)";

const char* const graph_template = R"({
  "doc": "Inner polar balls of a generated torus, grown by @id@.",
  "params": {
    "distance": { "kind": "number", "default": 0.05, "minimum": 0, "unit": "model units", "doc": "how far balls grow" }
  },
  "nodes": {
    "sample": { "type": "Sample", "params": { "file": "shape:torus?n=2000" } },
    "poles":  { "type": "VoronoiPoles", "inputs": { "points": "sample.points" } },
    "label":  { "type": "LabelPoles", "inputs": { "poles": "poles.poles", "mesh": "sample.mesh" } },
    "grow":   { "type": "@id@", "inputs": { "balls": "label.inner" }, "params": { "distance": "${distance}" } }
  },
  "outputs": { "balls": "grow.balls" }
}
)";

const char* const cmake_template = R"(cmake_minimum_required(VERSION 3.25)
project(@library@ LANGUAGES CXX)
find_package(ballflow REQUIRED)
ballflow_node_library(@library@ SOURCES @file@.cpp TESTS @file@_test.cpp GRAPHS graph.json)
)";

const char* const readme_template = R"(# @id@

A node library for ballflow.

```sh
cmake -S . -B build -DCMAKE_BUILD_TYPE=Release      # -DCMAKE_PREFIX_PATH=... where ballflow is installed
cmake --build build
ctest --test-dir build                              # @file@_test.cpp, and graph.json runs
ballflow --plugin build/@library@.so nodes @id@
ballflow --plugin build/@library@.so run graph.json --out out
```

`@file@.cpp` is all of it: an algorithm, the node around it, and the line that makes a library of nodes. A second node is
one more struct there, listed in `node_entries<...>`. `$BALLFLOW_PLUGIN_PATH=build` saves `--plugin`.
)";

struct NewNodeArguments {
  std::string id, folder;
};

bool is_word(const std::string& text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text[0])) == 0 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
}

/// "BallOffset" -> "ball_offset", "IPSolve" -> "ip_solve".
std::string snake_case(const std::string& name) {
  const auto upper = [&](std::size_t i) {
    return i < name.size() && std::isupper(static_cast<unsigned char>(name[i])) != 0;
  };
  const auto lower = [&](std::size_t i) {
    return i < name.size() && std::islower(static_cast<unsigned char>(name[i])) != 0;
  };
  std::string result;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool starts_word = upper(i) && i > 0 && name[i - 1] != '_' && (!upper(i - 1) || lower(i + 1));
    if (starts_word) result += '_';
    result += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return result;
}

std::string filled(std::string text, const std::map<std::string, std::string>& words) {
  for (const auto& [word, value] : words) {
    for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += value.size())
      text.replace(at, word.size(), value);
  }
  return text;
}

int new_node(const NewNodeArguments& arguments) {
  std::vector<std::string> words;
  std::string rest = arguments.id;
  for (std::size_t dot; (dot = rest.find('.')) != std::string::npos; rest = rest.substr(dot + 1))
    words.push_back(rest.substr(0, dot));
  words.push_back(rest);
  const std::string& name = words.back();
  const std::string example = "write it as acme.Offset: your namespace, a dot, and a name in UpperCamelCase";
  const std::string start = "\"" + arguments.id + "\" is no id for a node of your own: ";
  if (!std::all_of(words.begin(), words.end(), is_word))
    throw Error(ExitCode::usage, start + "it is made of letters, digits, _ and dots", example);
  if (words.size() < 2)
    throw Error(ExitCode::usage, start + "ids without a namespace belong to ballflow", example);
  if (std::isupper(static_cast<unsigned char>(name[0])) == 0)
    throw Error(ExitCode::usage, start + "\"" + name + "\" does not begin with a capital letter", example);
  if (arguments.id.size() > 100) throw Error(ExitCode::usage, start + "it is too long", example);

  std::string library;
  for (const std::string& word : words) library += (library.empty() ? "" : "_") + snake_case(word);
  const std::map<std::string, std::string> values = {
      {"@id@", arguments.id}, {"@Node@", name}, {"@file@", snake_case(name)}, {"@library@", library}};
  const fs::path folder = arguments.folder.empty() ? fs::path(library) : fs::path(arguments.folder);
  std::error_code error;
  if (fs::exists(fs::symlink_status(folder, error)))
    throw Error(ExitCode::usage, folder.string() + " exists already", "choose another folder with --dir");
  if (!fs::create_directories(folder, error) && error)
    throw Error(ExitCode::store, "cannot create the folder " + folder.string() + ": " + error.message());

  const std::vector<std::pair<std::string, const char*>> files = {{"@file@.cpp", source_template},
                                                                  {"@file@_test.cpp", test_template},
                                                                  {"graph.json", graph_template},
                                                                  {"CMakeLists.txt", cmake_template},
                                                                  {"README.md", readme_template}};
  for (const auto& [file, text] : files) {
    const std::string path = (folder / filled(file, values)).string();
    write_atomically(path, filled(text, values));
    std::printf("wrote %s\n", printable(path).c_str());
  }
  std::printf("next: cmake -S %s -B build && cmake --build build && ctest --test-dir build\n",
              shell_word(folder.string()).c_str());
  return 0;
}

}  // namespace

void add_new_node(const Command& app, Common&, Action& action) {
  const Command command =
      app.subcommand("new-node", "write a node library of your own: source, test, graph, CMake file");
  const auto arguments = std::make_shared<NewNodeArguments>();
  command.option("id", arguments->id, "id of the node: namespace and name")
      .required()
      .type_name("acme.Offset");
  command.option("--dir", arguments->folder, "folder to create; default: ./acme_offset").type_name("DIR");
  command.callback([&action, arguments] { action = [arguments] { return new_node(*arguments); }; });
}

}  // namespace ballflow::cli
