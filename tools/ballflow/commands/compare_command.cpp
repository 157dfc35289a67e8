#include <cstdio>

#include "ballflow/history.hpp"
#include "commands/commands.hpp"
#include "report/compare.hpp"

namespace ballflow::cli {
namespace {

struct CompareArguments {
  std::vector<std::string> runs, fields;
  std::string format = "text";
};

int show(const Common& common, const CompareArguments& arguments) {
  const auto store = common.store();
  std::vector<RunRecord> runs;
  if (arguments.runs.empty()) runs.push_back(named_run(common, *store, "latest"));
  for (const std::string& name : arguments.runs) runs.push_back(named_run(common, *store, name));
  const std::string table = render(compare(runs, arguments.fields), arguments.format);
  std::fwrite(table.data(), 1, table.size(), stdout);
  return 0;
}

}  // namespace

void add_compare(const Command& app, Common& common, Action& action) {
  const Command command = app.subcommand(
      "compare", "a table of runs, or of the variants of a sweep: parameters, results, seconds");
  const auto arguments = std::make_shared<CompareArguments>();
  command
      .option(
          "run", arguments->runs,
          "runs: an id or the beginning of one (see \"ballflow runs\"), latest, previous, a report file,\n"
          "or a folder with a report.json; default: latest")
      .type_name("RUN...");
  command
      .option(
          "--fields", arguments->fields,
          "what of the results: output.field, subgraph.output.field, node.port.field, node.parameter, or\n"
          "all; default: what differs in the summaries of the outputs")
      .delimiter(',')
      .one_at_a_time()
      .type_name("FIELD,FIELD");
  command.option("--format", arguments->format, "text, csv, md or json")
      .one_of({"text", "csv", "md", "json"});
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return show(common, *arguments); }; });
}

}  // namespace ballflow::cli
