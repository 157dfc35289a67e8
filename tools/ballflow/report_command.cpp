#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/report.hpp"
#include "ballflow/text.hpp"
#include "commands.hpp"
#include "report/report_page.hpp"

namespace ballflow::cli {
namespace {

struct ReportArguments {
  std::string run = "latest", path = "report.html";
};

int write(const Common& common, const ReportArguments& arguments) {
  const auto store = common.store();
  const auto registry = common.registry();
  report::ReportInput input;
  input.run = find_run(*store, arguments.run);
  input.manifests = run_manifests(*store, input.run.id);
  input.registry = registry.get();
  write_atomically(arguments.path, report::report_page(input));
  std::printf("wrote %s\n", printable(arguments.path).c_str());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, Common& common, Action& action) {
  CLI::App* command =
      app.add_subcommand("report", "a run, or a sweep, as one page: results, plots, pictures, sources");
  const auto arguments = std::make_shared<ReportArguments>();
  command
      ->add_option("run", arguments->run,
                   "an id of a run or the beginning of one (see \"ballflow runs\"), latest, previous,\n"
                   "a report file, or a folder with a report.json; default: latest")
      ->type_name("RUN");
  command->add_option("-o,--output", arguments->path, "the page to write; default: report.html")
      ->type_name("FILE");
  command->add_option("--cache", common.cache, "cache folder")->type_name("DIR");
  command->callback(
      [&common, &action, arguments] { action = [&common, arguments] { return write(common, *arguments); }; });
}

}  // namespace ballflow::cli
