#include <malloc.h>

#include <cstdio>
#include <exception>

#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/hidden.hpp"

int main(int argc, char** argv) {
  using namespace ballflow;
  // By itself malloc first returns memory to the system and takes it again all the time, a sixth of all page
  // faults of a run of ten thousand cached nodes; and after the first large arrays are freed it keeps up to
  // 64 MB of them in pieces between others, a third of what a large cover takes.
  mallopt(M_MMAP_THRESHOLD, 2 << 20);
  mallopt(M_TRIM_THRESHOLD, 16 << 20);
  cli::Common common;
  if (argc > 0) common.program = argv[0];
  cli::Action action;
  const cli::Program program = {
      "ballflow runs pipelines of typed nodes from JSON graph files and caches every intermediate result.\n"
      "Its nodes compute with unions of balls: poles, discrete medial axis, set-cover pruning,\n"
      "alpha-shapes and medial axes.\n\n"
      "  ballflow run medial_axis --set input=scan.ply --out out/\n",
      "Exit codes: 0 ok, 1 the answer is no (spheres --check), 2 wrong usage or graph, 3 a node failed,\n"
      "4 cancelled, 5 store or files, 6 plugin.\n"
      "The cache is $BALLFLOW_CACHE, else ~/.cache/ballflow; it may be deleted at any time.",
      [&](const cli::Command& top) { cli::add_commands(top, common, action); }};
  try {
    if (argc > 1 && cli::is_hidden(argv[1])) {
      action = [&] { return cli::run_hidden(program, common, {argv + 1, argv + argc}); };
    } else {
      const cli::Parsed parsed = cli::parse_command_line(argc, argv, program);
      if (parsed.done) return parsed.exit_code;
    }
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
