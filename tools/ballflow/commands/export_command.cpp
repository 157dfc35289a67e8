#include <cstdio>
#include <filesystem>

#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/submit_command.hpp"
#include "commands/watched.hpp"
#include "export/export.hpp"
#include "export/scaled.hpp"
#include "io/lengths.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string artifact, path, format, scale = "1", to;
  SubmitArguments workflow;
};

std::string formats_help() {
  std::string text = "Formats by type, the default first:\n";
  const auto add = [&text](const std::string& type, const std::vector<std::string>& formats) {
    text += "  " + type + std::string(type.size() < 20 ? 20 - type.size() : 1, ' ');
    for (const std::string& format : formats) text += (&format == &formats.front() ? "" : ", ") + format;
    text += "\n";
  };
  for (const std::string& type : exported_types()) add(type, export_formats(type));
  add("any other type", export_formats(""));
  return text +
         "safetensors is the artifact itself, byte for byte; json only describes it.\n"
         "For ParaView take vtp, for Blender and browsers glb, for NumPy npy, for Q-MAT and its kin ma.";
}

int export_workflow(Common& common, const ExportArguments& arguments) {
  if (arguments.workflow.store.empty() || arguments.workflow.out.empty()) {
    throw Error(ExitCode::usage, "--to snakemake needs a store and a folder",
                "ballflow export GRAPH --to snakemake --store DIR -o FOLDER");
  }
  SubmitArguments workflow = arguments.workflow;
  workflow.graph.graph = arguments.artifact;
  return export_snakemake(common, workflow, workflow.out);
}

int export_one(const Common& common, const ExportArguments& arguments) {
  if (arguments.path.empty()) {
    throw Error(ExitCode::usage, "which file?", "name the file to write behind the artifact: balls.ply");
  }
  const ArtifactPtr artifact = find_artifact(common, arguments.artifact);
  common.store();  // whose files are not written over, also where the artifact is a file
  common.places->writes("the exported file", arguments.path);
  double factor = 1;
  watched("nothing was written",
          [&](geometry::Monitor&) { factor = geometry::parse_scale(arguments.scale); });
  const std::string format =
      arguments.format.empty() ? fs::path(arguments.path).extension().string() : arguments.format;
  if (factor != 1 && (format.ends_with("json") || format.ends_with("safetensors"))) {
    throw Error(ExitCode::usage, "--scale: json and safetensors hold the artifact as it is",
                "choose another format");
  }
  export_artifact(factor == 1 ? *artifact : *scaled(artifact, factor), arguments.path, arguments.format);
  std::printf("wrote %s (%s)\n", printable(arguments.path).c_str(), artifact->type().c_str());
  return 0;
}

}  // namespace

void add_export(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("export", "write an artifact in a usual format (ply, vtp, glb, npy, ...)");
  const auto arguments = std::make_shared<ExportArguments>();
  command
      .option("artifact", arguments->artifact,
              "digest from a run report, or a file: of the cache, of a model, or of balls; with --to a graph")
      .required();
  command.option("file", arguments->path, "file to write");
  command.option("--format", arguments->format, "format; default: by the extension of the file");
  command.option(
      "--scale", arguments->scale,
      "of all lengths: a factor, or the unit that they have, which becomes metres (mm, cm, in, ...)");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  SubmitArguments& workflow = arguments->workflow;
  command.option("--to", arguments->to, "write a workflow of a graph instead, for an engine that runs it")
      .one_of({"snakemake"});
  command.option("-o,--out", workflow.out, "folder that receives the workflow").type_name("DIR");
  command.option("--store", workflow.store, "of a workflow: shared folder of results, an upstream")
      .type_name("DIR");
  command.option("--set", workflow.graph.sets, "of a workflow: as of \"run\"")
      .type_name("NAME=VALUE")
      .one_at_a_time();
  command.option("--axis", workflow.graph.axes, "of a workflow: as of \"sweep\"")
      .type_name("NAME=VALUES")
      .one_at_a_time();
  command.option("--inputs", workflow.graph.inputs, "of a workflow: as of \"sweep\"")
      .type_name("PATTERN")
      .one_at_a_time();
  command.option("--unit-seconds", workflow.unit_seconds, "of a workflow: as of \"submit\"")
      .between(0.001, 1e6);
  command.option("--threads", workflow.threads, "of a workflow: processors of a unit");
  command.option("--seed", workflow.seed, "of a workflow: seed of the nodes that use random numbers");
  command.footer(formats_help());
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] {
      return arguments->to.empty() ? export_one(common, *arguments) : export_workflow(common, *arguments);
    };
  });
}

}  // namespace ballflow::cli
