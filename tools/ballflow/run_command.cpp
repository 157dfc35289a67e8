#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/report.hpp"
#include "ballflow/text.hpp"
#include "commands.hpp"
#include "export/export.hpp"
#include "output_folder.hpp"
#include "terminal.hpp"

namespace ballflow::cli {
namespace {

std::atomic<bool> cancel_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int signal_number) {
  cancel_requested.store(true);
  std::signal(signal_number, SIG_DFL);  // the second Ctrl-C ends the process at once; the store does not mind
}

struct RunArguments {
  GraphArguments graph;
  std::string out, report;
  std::vector<std::string> formats;
  unsigned threads = 0;
  std::uint64_t seed = 0;
  bool quiet = false;
};

std::string quoted(const std::string& text) {
  if (text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./=:,+%@") ==
      std::string::npos) {
    return text;
  }
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

void print_failure(const Common& common, const RunArguments& arguments, const Dag& dag,
                   const RunResult& result, std::size_t i) {
  const DagNode& node = dag.nodes[i];
  const NodeResult& failed = result.nodes[i];
  std::fprintf(stderr, "\nnode %s (%s) failed: %s\n", node.path.c_str(), node.decl->id.c_str(),
               printable(failed.cause).c_str());
  if (!failed.hint.empty()) std::fprintf(stderr, "  what to do: %s\n", printable(failed.hint).c_str());
  for (const auto& [name, value] : node.params) {
    std::fprintf(stderr, "  param %s = %s\n", name.c_str(), printable(plain(value)).c_str());
  }
  for (const auto& [port, edge] : node.inputs) {
    for (const OutputEntry& entry : result.nodes[edge.node].outputs) {
      if (entry.port != edge.port) continue;
      std::fprintf(stderr, "  input %s = %s.%s, %s, %s\n", port.c_str(), dag.nodes[edge.node].path.c_str(),
                   edge.port.c_str(), describe(entry).c_str(), entry.digest.hex().substr(0, 16).c_str());
    }
  }
  std::string again = "ballflow";
  for (const std::string& plugin : common.plugins) again += " --plugin " + quoted(plugin);
  again += " run " + quoted(arguments.graph.file);
  if (!common.cache.empty()) again += " --cache " + quoted(common.cache);
  if (common.no_cache) again += " --no-cache";
  if (arguments.seed != 0) again += " --seed " + std::to_string(arguments.seed);
  for (const std::string& set : arguments.graph.sets) again += " --set " + quoted(set);
  std::fprintf(stderr, "  again, from this node on: %s\n", printable(again).c_str());
}

void print_result(const Dag& dag, const RunResult& result) {
  std::vector<std::vector<std::string>> rows = {{"node", "", "seconds", "result"}};
  std::size_t hits = 0, runs = 0;
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const NodeResult& node = result.nodes[i];
    std::string status, seconds;
    switch (node.status) {
      case NodeStatus::hit:
        status = "HIT";
        ++hits;
        break;
      case NodeStatus::run:
        status = "RUN";
        seconds = duration(node.seconds);
        ++runs;
        break;
      case NodeStatus::failed:
        status = "FAILED";
        seconds = duration(node.seconds);
        break;
      case NodeStatus::cancelled:
        status = "CANCELLED";
        break;
      default:
        status = "-";
        break;
    }
    const bool good = node.status == NodeStatus::hit || node.status == NodeStatus::run;
    std::string text = good ? describe(node.outputs) : node.reason;
    if (node.iterations) text += " (" + grouped(*node.iterations) + " iterations)";
    rows.push_back({dag.nodes[i].path, status, seconds, text});
  }
  std::printf("\n");
  print_table(rows);
  std::printf("\n%zu run, %zu from the cache, %s (%s CPU), %s MB at most\n", runs, hits,
              duration(result.seconds).c_str(), duration(result.cpu_seconds).c_str(),
              grouped(static_cast<std::int64_t>(result.peak_rss_bytes >> 20)).c_str());
}

void check_formats(const Dag& dag, const std::map<std::string, std::string>& formats) {
  for (const auto& [name, format] : formats) {
    const std::string option = "--format " + name + "=" + format + ": ";
    const auto output = std::find_if(dag.outputs.begin(), dag.outputs.end(),
                                     [&name = name](const DagOutput& known) { return known.name == name; });
    if (output == dag.outputs.end()) {
      std::vector<std::string> names;
      for (const DagOutput& known : dag.outputs) names.push_back(known.name);
      const std::string near = nearest(name, names);
      throw Error(ExitCode::usage, option + "the graph has no output \"" + name + "\"",
                  near.empty() ? "" : "did you mean \"" + near + "\"?");
    }
    const std::string& type = dag.nodes[output->from.node].decl->output(output->from.port)->type;
    const std::vector<std::string> known = export_formats(type);
    if (std::find(known.begin(), known.end(), format) != known.end()) continue;
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    throw Error(ExitCode::usage, option + "a " + type + " cannot be written as \"" + format + "\"",
                "use one of " + all);
  }
}

void check_report(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;  // a device
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  const int code = fs::is_directory(status) ? EISDIR : access(folder.c_str(), W_OK | X_OK) != 0 ? errno : 0;
  if (code == 0) return;
  throw Error(ExitCode::store, "cannot write the report " + path + ": " + std::strerror(code),
              "choose a file in a folder that exists and can be written with --report");
}

int run(const Common& common, const RunArguments& arguments) {
  std::map<std::string, std::string> formats;
  for (const std::string& format : arguments.formats) {
    const std::size_t equals = format.find('=');
    if (equals == std::string::npos) {
      throw Error(ExitCode::usage, "--format " + format + ": no \"=\" between an output and a format",
                  "write it as --format balls=csv");
    }
    formats[format.substr(0, equals)] = format.substr(equals + 1);
  }
  const auto registry = common.registry();
  const Dag dag = load_graph(arguments.graph.file, *registry, arguments.graph.overrides());
  for (const Diagnostic& warning : dag.warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  check_formats(dag, formats);
  // Before hours of computing, not after them.
  if (!arguments.out.empty()) prepare_folder(arguments.out);
  if (!arguments.report.empty()) check_report(arguments.report);
  const auto store = common.store();
  if (!common.no_cache && !store->why().empty()) {
    std::fprintf(stderr, "warning: the cache is not written: %s\n", store->why().c_str());
  }
  const std::string id = new_run_id(arguments.graph.file);
  const KeepWithin collect_at_the_end(store, common.cache_limit(*store));

  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  // Who reads the progress may go; the results are wanted nevertheless.
  const auto on_broken_pipe = std::signal(SIGPIPE, SIG_IGN);
  RunOptions options;
  options.threads = arguments.threads;
  options.seed = arguments.seed;
  options.cancel = &cancel_requested;
  const auto display = arguments.quiet ? no_display() : progress_display(dag, isatty(STDERR_FILENO) != 0);
  Runner runner(dag, *registry, store, options, *display, latest_manifests(*store, arguments.graph.file));
  const RunResult& result = runner.run();

  WrittenOutputs written;
  if (!arguments.out.empty() && result.status == ExitCode::ok) {
    written = write_outputs(arguments.out, dag, result, formats,
                            [&runner](const EdgeRef& edge) { return runner.artifact(edge); });
  }
  if (const std::string trouble = store->trouble(); !trouble.empty()) {
    std::fprintf(stderr, "warning: not everything could be cached: %s\n", trouble.c_str());
  }
  const Json report = run_report(id, dag, result);
  save_run(*store, id, dag, result, report);
  bool reported = false;
  if (!arguments.report.empty()) {
    try {
      write_atomically(arguments.report, report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
      reported = true;
    } catch (const Error& failure) {
      if (!written.failure) written.failure = failure;
    }
  }
  std::signal(SIGPIPE, on_broken_pipe);

  if (!arguments.quiet) {
    print_result(dag, result);
    for (const WrittenFile& file : written.files) {
      std::printf("%s %s: %s\n", file.written ? "wrote" : "kept ", printable(file.path).c_str(),
                  printable(file.what).c_str());
    }
    if (reported) std::printf("report %s\n", printable(arguments.report).c_str());
  }
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (result.nodes[i].status == NodeStatus::failed) print_failure(common, arguments, dag, result, i);
  }
  if (result.status == ExitCode::cancelled) {
    std::fprintf(stderr,
                 "cancelled; what was finished is in the cache, the same command goes on from there\n");
  }
  if (written.failure) throw Error(*written.failure);
  return static_cast<int>(result.status);
}

}  // namespace

void add_run(CLI::App& app, Common& common, Action& action) {
  CLI::App* command = app.add_subcommand("run", "run a graph; what is in the cache is not computed again");
  const auto arguments = std::make_shared<RunArguments>();
  arguments->graph.add_to(*command);
  command->add_option("--out", arguments->out, "folder that receives the outputs of the graph")
      ->type_name("DIR");
  command
      ->add_option("--format", arguments->formats,
                   "format of an output file, e.g. balls=csv; see \"ballflow export --help\" for the formats")
      ->type_name("OUTPUT=FORMAT")
      ->allow_extra_args(false);
  command->add_option("--report", arguments->report, "file that receives the report of the run (JSON)")
      ->type_name("FILE");
  command->add_option("--cache", common.cache, "cache folder")->type_name("DIR");
  command
      ->add_option("--cache-size", common.cache_size,
                   "size of the cache above which what is worth least is removed, e.g. 5G, or none\n"
                   "(default: $BALLFLOW_CACHE_SIZE, else 20 GiB or a tenth of the disk, the smaller)")
      ->type_name("SIZE");
  command->add_flag("--no-cache", common.no_cache, "neither read nor write a cache");
  command
      ->add_option("--threads", arguments->threads,
                   "number of threads; 0: all cores (the result never depends on it)")
      ->check(CLI::Range(0u, 4096u));
  command->add_option("--seed", arguments->seed, "seed of the nodes that use random numbers");
  command->add_flag("--quiet", arguments->quiet, "print errors only");
  command->callback(
      [&common, &action, arguments] { action = [&common, arguments] { return run(common, *arguments); }; });
}

}  // namespace ballflow::cli
