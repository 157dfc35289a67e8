#include <cstdio>
#include <filesystem>
#include <optional>

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
    std::vector<std::string> found;
    for (const auto& file :
         fs::directory_iterator(fs::path(store->root()) / "cas" / name.substr(0, 2), ignored)) {
      const std::string digest = name.substr(0, 2) + file.path().filename().string();
      if (digest.rfind(name, 0) == 0) found.push_back(file.path().string());
    }
    if (found.size() == 1) return Artifact::map(found.front());
    if (found.size() > 1) {
      throw Error(ExitCode::usage, "\"" + name + "\" is the beginning of several digests",
                  "give more digits");
    }
  }
  throw Error(ExitCode::usage, "there is no artifact \"" + name + "\"",
              "give a file, or the digest of an artifact from a run report (6 digits or more)");
}

int export_one(const Common& common, const ExportArguments& arguments) {
  const ArtifactPtr artifact = find_artifact(common, arguments.artifact);
  export_artifact(*artifact, arguments.path, arguments.format);
  std::printf("wrote %s (%s)\n", arguments.path.c_str(), artifact->type().c_str());
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
  command->callback([&common, &action, arguments] {
    action = [&common, arguments] { return export_one(common, *arguments); };
  });
}

}  // namespace ballflow::cli
