#include <algorithm>
#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/watched.hpp"
#include "report/output_cards.hpp"
#include "report/report_page.hpp"
#include "show/picture/picture.hpp"
#include "terminal/facts.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

struct ReportArguments {
  std::string run = "latest", path = "report.html";
  std::size_t pictures = 12;
};

/// Of the outputs that can be drawn, in the order of the variants, as long as the cache has them.
void draw_outputs(report::ReportInput& input, Store& store, std::size_t most, geometry::Monitor& monitor) {
  for (const std::string& name : report::outputs_in_order(input.run.report)) {
    const nlohmann::json& output = input.run.report.at("outputs").at(name);
    const auto digest = Digest::from_hex(output.at("digest").get<std::string>());
    if (!digest || !show::can_be_shown(output.at("type").get<std::string>())) continue;
    if (input.pictures.size() >= most) {
      ++input.pictures_left_out;
      continue;
    }
    const ArtifactPtr artifact = cached_artifact(store, *digest);
    if (artifact == nullptr) {
      ++input.pictures_left_out;
      continue;
    }
    const std::vector<show::Layer> layers = show::layers_of(*artifact);
    if (std::none_of(layers.begin(), layers.end(), [](const show::Layer& l) { return l.visible; })) continue;
    show::PictureOptions options;
    options.width = 1216, options.height = 760;
    options.up = show::upward_of(layers);
    input.pictures.push_back({name, show::png(show::draw(layers, options, monitor))});
  }
}

/// The outputs that a report names.
NamedOutputs outputs_of(const nlohmann::json& report) {
  NamedOutputs outputs;
  for (const auto& [name, output] : report.at("outputs").items()) {
    OutputEntry entry;
    entry.port = name;
    entry.type = output.value("type", "");
    entry.summary = output.value("summary", nlohmann::json::object()).dump();
    outputs.emplace_back(name, std::move(entry));
  }
  return outputs;
}

int write(const Common& common, const ReportArguments& arguments) {
  const auto store = common.store();
  common.places->writes("--output", arguments.path);
  const auto registry = common.registry();
  report::ReportInput input;
  input.run = named_run(common, *store, arguments.run);
  input.manifests = run_manifests(*store, input.run.id);
  input.registry = registry.get();
  const NamedOutputs outputs = outputs_of(input.run.report);
  for (const auto& [name, output] : outputs) input.words[name] = describe(output);
  const Json params(input.run.report.value("params", nlohmann::json::object()));
  if (!input.run.report.contains("variants")) input.facts = key_facts(outputs, params);
  input.remedy = [params](const std::string& warning) { return remedy_for(warning, params); };
  watched("no page was written",
          [&](geometry::Monitor& monitor) { draw_outputs(input, *store, arguments.pictures, monitor); });
  write_atomically(arguments.path, report::report_page(input));
  std::printf("wrote %s\n", printable(arguments.path).c_str());
  return 0;
}

}  // namespace

void add_report(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("report", "a run, or a sweep, as one page: results, plots, pictures, sources");
  const auto arguments = std::make_shared<ReportArguments>();
  command
      .option("run", arguments->run,
              "an id of a run or the beginning of one (see \"ballflow runs\"), latest, previous,\n"
              "a report file, or a folder with a report.json; default: latest")
      .type_name("RUN");
  command.option("-o,--output", arguments->path, "the page to write; default: report.html").type_name("FILE");
  command.option("--pictures", arguments->pictures, "draw at most so many outputs").shows_default();
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return write(common, *arguments); }; });
}

}  // namespace ballflow::cli
