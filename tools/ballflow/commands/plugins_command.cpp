#include <cstdio>
#include <filesystem>

#include "ballflow/text.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {
namespace {

/// Ids of the nodes or types that a library brought.
template <class Declarations>
std::vector<std::string> ids_from(const Declarations& declarations, const std::string& path) {
  std::vector<std::string> ids;
  for (const auto& [id, declaration] : declarations.unparsed()) {
    if (declaration->plugin_path == path) ids.push_back(id);
  }
  return ids;
}

bool is_folder(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_directory(path, error);
}

Json as_json(const Registry& registry) {
  Json json = {{"folders", Json::array()}, {"plugins", Json::array()}, {"refused", Json::array()}};
  for (const std::string& folder : registry.folders())
    json["folders"].push_back({{"path", folder}, {"exists", is_folder(folder)}});
  for (const PluginCandidate& candidate : registry.candidates()) {
    if (!candidate.refused.empty()) {
      json["refused"].push_back({{"path", candidate.path}, {"reason", candidate.refused}});
      continue;
    }
    json["plugins"].push_back({{"path", candidate.path},
                               {"name", candidate.name},
                               {"version", candidate.version},
                               {"nodes", ids_from(registry.nodes(), candidate.path)},
                               {"types", ids_from(registry.types(), candidate.path)}});
  }
  return json;
}

void print(const char* title, const std::vector<std::string>& ids) {
  if (ids.empty()) return;
  std::string line;
  for (const std::string& id : ids) line += (line.empty() ? "" : ", ") + id;
  std::printf("  %s: %s\n", title, line.c_str());
}

int list_plugins(const Common& common, bool json) {
  const auto registry = common.registry();
  if (json) {
    std::printf("%s\n", as_json(*registry).dump(1, ' ', false, Json::error_handler_t::replace).c_str());
    return 0;
  }
  for (const PluginCandidate& candidate : registry->candidates()) {
    if (!candidate.refused.empty()) continue;
    std::printf("%s %s  %s\n", candidate.name.c_str(), candidate.version.c_str(),
                printable(candidate.path).c_str());
    print("nodes", ids_from(registry->nodes(), candidate.path));
    print("types", ids_from(registry->types(), candidate.path));
  }
  for (const PluginCandidate& candidate : registry->candidates()) {
    if (candidate.refused.empty()) continue;
    std::printf("refused  %s\n  %s\n", printable(candidate.path).c_str(),
                printable(candidate.refused).c_str());
  }
  std::printf("looked for *.so in\n");
  for (const std::string& folder : registry->folders())
    std::printf("  %s%s\n", printable(folder).c_str(), is_folder(folder) ? "" : " (no such folder)");
  return 0;
}

}  // namespace

void add_plugins(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("plugins", "list the node libraries that were found, and why others were refused");
  const auto json = std::make_shared<bool>(false);
  command.flag("--json", *json, "print JSON");
  command.footer(
      "Libraries are looked for in --plugin PATH, in the folders of $BALLFLOW_PLUGIN_PATH (separated by "
      "\":\"),\n"
      "and beside the program (../lib/ballflow). A file *.py in --plugin has nodes in Python.");
  command.callback(
      [&common, &action, json] { action = [&common, json] { return list_plugins(common, *json); }; });
}

}  // namespace ballflow::cli
