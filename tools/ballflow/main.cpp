#include <malloc.h>

#include <cstdio>
#include <exception>

#include "ballflow/text.hpp"
#include "commands/commands.hpp"

int main(int argc, char** argv) {
  using namespace ballflow;
  // Where malloc ends up by itself after the first large arrays are freed. Before that it returns memory to
  // the system and takes it again all the time: a sixth of all page faults of a run of ten thousand cached
  // nodes.
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  CLI::App app{
      "ballflow runs pipelines of typed nodes from JSON graph files and caches every intermediate result.\n"
      "Its nodes compute with unions of balls: poles, discrete medial axis, set-cover pruning,\n"
      "alpha-shapes and medial axes.\n\n"
      "  ballflow run graphs/medial_axis.json --set input=scan.ply --out out/\n",
      "ballflow"};
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 ok, 2 wrong usage or graph, 3 a node failed, 4 cancelled, 5 store or files, 6 plugin.\n"
      "The cache is $BALLFLOW_CACHE, else ~/.cache/ballflow; it may be deleted at any time.");
  cli::Common common;
  if (argc > 0) common.program = argv[0];
  app.add_option("--plugin", common.plugins,
                 "a node library, or a folder of them, to load besides the built-in ones")
      ->type_name("PATH");
  cli::Action action;
  cli::add_run(app, common, action);
  cli::add_sweep(app, common, action);
  cli::add_compare(app, common, action);
  cli::add_plan(app, common, action);
  cli::add_runs(app, common, action);
  cli::add_check(app, common, action);
  cli::add_nodes(app, common, action);
  cli::add_cache(app, common, action);
  cli::add_report(app, common, action);
  cli::add_export(app, common, action);
  cli::add_graph(app, common, action);
  cli::add_view(app, common, action);
  cli::add_plugins(app, common, action);
  cli::add_new_node(app, common, action);
  cli::add_explain(app, common, action);
  cli::add_render(app, common, action);
  cli::add_exec_node(app, common, action);
  cli::add_version(app, common, action);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : static_cast<int>(ExitCode::usage);
  }
  try {
    const int status = action();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return status;
    throw Error(ExitCode::store, "cannot write to the standard output", "is its disk full?");
  } catch (const GraphError& error) {
    for (const Diagnostic& finding : error.findings()) std::fprintf(stderr, "%s\n", finding.text().c_str());
    return static_cast<int>(error.code());
  } catch (const Error& error) {
    std::fprintf(stderr, "ballflow: error: %s\n", printable(error.what()).c_str());
    if (!error.hint().empty()) std::fprintf(stderr, "  %s\n", printable(error.hint()).c_str());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "ballflow: error: out of memory\n");
    return static_cast<int>(ExitCode::node_failed);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ballflow: error: %s\n  this is a bug of ballflow; please report it\n",
                 printable(error.what()).c_str());
    return static_cast<int>(ExitCode::node_failed);
  }
}
