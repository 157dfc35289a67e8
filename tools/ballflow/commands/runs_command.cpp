#include <cstdio>

#include "ballflow/history.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

struct RunsArguments {
  std::size_t limit = 20;
};

int list(const Common& common, const RunsArguments& arguments) {
  const auto store = common.store();
  const std::vector<RunInfo> runs = list_runs(*store, arguments.limit);
  if (runs.empty()) {
    std::printf("no runs are recorded%s%s\n", store->root().empty() ? "" : " in ",
                printable(store->root()).c_str());
    return 0;
  }
  std::vector<std::vector<std::string>> rows = {{"run", "status", "time", "graph"}};
  for (const RunInfo& run : runs) rows.push_back({run.id, run.status, duration(run.seconds), run.graph});
  print_table(rows);
  return 0;
}

}  // namespace

void add_runs(const Command& app, Common& common, Action& action) {
  const Command command =
      app.subcommand("runs", "list the runs that the cache has a record of, newest first");
  const auto arguments = std::make_shared<RunsArguments>();
  command.option("--limit", arguments->limit, "at most so many runs; default: 20")
      .between(1, 1000)
      .type_name("N");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command.footer(
      "The id of a run is the time (UTC) when it began, a mark of its graph file and something random. "
      "Commands\n"
      "that take a run accept its id, the beginning of it, \"latest\", \"previous\", a report file, or a "
      "folder\n"
      "with a report.json in it.");
  command.callback(
      [&common, &action, arguments] { action = [&common, arguments] { return list(common, *arguments); }; });
}

}  // namespace ballflow::cli
