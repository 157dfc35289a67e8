#include <cstdio>
#include <filesystem>
#include <optional>

#include "ballflow/text.hpp"
#include "commands.hpp"
#include "export/export.hpp"

namespace ballflow::cli {
namespace {

struct ExportArguments {
  std::string artifact, path, format;
};

/// A file, or the beginning of a digest of an artifact in the cache.
ArtifactPtr find_artifact(const Common& common, const std::string& name) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  if (fs::is_regular_file(name, ignored)) return Artifact::map(name);
  const bool hexadecimal = name.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (hexadecimal && name.size() >= 6 && name.size() <= 64) {
    const auto store = common.store();
    if (store->root().empty()) {
      throw Error(ExitCode::usage, "there is no cache to look for " + name + " in: " + store->why(),
                  "name its folder with --cache or $BALLFLOW_CACHE, or give a file");
    }
    std::vector<std::string> found;
    const fs::path shard = fs::path(store->root()) / "cas" / name.substr(0, 2);
    for (fs::directory_iterator file(shard, ignored), end; !ignored && file != end; file.increment(ignored)) {
      const std::string digest = name.substr(0, 2) + file->path().filename().string();
      if (digest.rfind(name, 0) == 0) found.push_back(digest);
    }
    if (found.size() == 1) {
      const std::string path = (shard / found.front().substr(2)).string();
      const ArtifactPtr artifact = Artifact::map(path);
      if (artifact->digest().hex() == found.front()) return artifact;
      throw Error(ExitCode::store, path + " is damaged: its content has another digest than its name",
                  "delete it; the next run that needs it makes it again");
    }
    if (found.size() > 1) {
      throw Error(ExitCode::usage, "\"" + name + "\" is the beginning of several digests",
                  "give more digits");
    }
  }
  throw Error(ExitCode::usage, "there is no artifact \"" + name + "\"",
              "give a file, or the digest of an artifact from a run report (6 digits or more)");
}

std::string formats_help() {
  std::string text = "Formats by type, the default first:\n";
  const auto add = [&text](const std::string& type, const std::vector<std::string>& formats) {
    text += "  " + type + std::string(type.size() < 20 ? 20 - type.size() : 1, ' ');
    for (const std::string& format : formats) text += (&format == &formats.front() ? "" : ", ") + format;
    text += "\n";
  };
  for (const std::string& type : exported_types()) add(type, export_formats(type));
  add("any other type", export_formats(""));
  return text + "safetensors is the artifact itself, byte for byte; json only describes it.";
}

int export_one(const Common& common, const ExportArguments& arguments) {
  const ArtifactPtr artifact = find_artifact(common, arguments.artifact);
  export_artifact(*artifact, arguments.path, arguments.format);
  std::printf("wrote %s (%s)\n", printable(arguments.path).c_str(), artifact->type().c_str());
  return 0;
}

}  // namespace

void add_export(CLI::App& app, Common& common, Action& action) {
  CLI::App* command =
      app.add_subcommand("export", "write an artifact in a usual format (ply, obj, off, csv, ...)");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("artifact", arguments->artifact, "digest from a run report, or a file of the cache")
      ->required();
  command->add_option("file", arguments->path, "file to write")->required();
  command->add_option("--format", arguments->format, "format; default: by the extension of the file");
  command->add_option("--cache", common.cache, "cache folder")->type_name("DIR");
  command->footer(formats_help());
  command->callback([&common, &action, arguments] {
    action = [&common, arguments] { return export_one(common, *arguments); };
  });
}

}  // namespace ballflow::cli
