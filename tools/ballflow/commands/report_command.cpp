#include <algorithm>
#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/watched.hpp"
#include "report/report_page.hpp"
#include "show/picture/picture.hpp"

namespace ballflow::cli {
namespace {

struct ReportArguments {
  std::string run = "latest", path = "report.html";
  std::size_t pictures = 12;
};

/// Of the outputs that can be drawn, in the order of the variants, as long as the cache has them.
void draw_outputs(report::ReportInput& input, Store& store, std::size_t most, geometry::Monitor& monitor) {
  for (const auto& [name, output] : input.run.report.at("outputs").items()) {
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
    options.width = 880, options.height = 660;
    input.pictures.push_back({name, show::png(show::draw(layers, options, monitor))});
  }
}

int write(const Common& common, const ReportArguments& arguments) {
  const auto store = common.store();
  common.places->writes("--output", arguments.path);
  const auto registry = common.registry();
  report::ReportInput input;
  input.run = named_run(common, *store, arguments.run);
  input.manifests = run_manifests(*store, input.run.id);
  input.registry = registry.get();
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
