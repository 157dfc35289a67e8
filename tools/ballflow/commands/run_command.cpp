#include "commands/run_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <set>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/output_file.hpp"
#include "ballflow/report.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/failure.hpp"
#include "commands/output_folder.hpp"
#include "commands/shard.hpp"
#include "export/export.hpp"
#include "report/compare.hpp"
#include "terminal/event_lines.hpp"
#include "terminal/facts.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

/// Hands every event to several sinks.
class Sinks final : public EventSink {
 public:
  void add(std::unique_ptr<EventSink> sink) { sinks_.push_back(std::move(sink)); }
  void on(const Event& event) override {
    for (const auto& sink : sinks_) sink->on(event);
  }

 private:
  std::vector<std::unique_ptr<EventSink>> sinks_;
};

/// The command that runs the graph again; what was finished comes from the cache.
std::string again(const Common& common, const RunArguments& arguments) {
  std::string line = shell_word(common.program);
  for (const std::string& plugin : common.plugins) line += " --plugin " + shell_word(plugin);
  line += " run " + arguments.graph.words();
  if (!common.cache.empty()) line += " --cache " + shell_word(common.cache);
  if (common.no_cache) line += " --no-cache";
  if (!common.upstream.empty()) line += " --upstream " + shell_word(common.upstream);
  if (common.upstream_read_only) line += " --upstream-read-only";
  if (arguments.settings.seed != 0) line += " --seed " + std::to_string(arguments.settings.seed);
  return line;
}

/// How many nodes ran, and how many came from the cache. Apart from these: nodes that share their key, and so
/// their result, with another one that counts; artifacts that were given.
void print_totals(const RunResult& result) {
  std::set<std::string> keys;
  std::size_t run = 0, cached = 0, shared = 0, given = 0;
  for (const NodeResult& node : result.nodes) {
    if (node.status != NodeStatus::run) continue;
    ++run;
    keys.insert(node.manifest);
  }
  for (const NodeResult& node : result.nodes) {
    if (node.status != NodeStatus::hit) continue;
    ++(node.manifest.empty() ? given : keys.insert(node.manifest).second ? cached : shared);
  }
  std::string line = std::to_string(run) + " run, " + std::to_string(cached) + " from the cache";
  if (shared > 0) line += ", " + std::to_string(shared) + " shared";
  if (given > 0) line += ", " + std::to_string(given) + " given";
  std::printf("\n%s, %s (%s CPU), %s MB at most\n", line.c_str(), duration(result.seconds).c_str(),
              duration(result.cpu_seconds).c_str(),
              grouped(static_cast<std::int64_t>(result.peak_rss_bytes >> 20)).c_str());
}

void print_result(const Dag& dag, const RunResult& result) {
  std::vector<std::vector<std::string>> rows = {{"node", "", "seconds", "result"}};
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    const NodeResult& node = result.nodes[i];
    std::string status, seconds;
    switch (node.status) {
      case NodeStatus::hit:
        status = "HIT";
        break;
      case NodeStatus::run:
        status = "RUN";
        seconds = duration(node.seconds);
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
  print_totals(result);
}

/// What matters of a run that went well, and where there is more.
void print_facts(const Dag& dag, const RunResult& result, const Json& report, const std::string& id,
                 bool recorded) {
  NamedOutputs outputs;
  for (const DagOutput& output : dag.outputs) {
    for (const OutputEntry& entry : result.nodes[output.from.node].outputs) {
      if (entry.port == output.from.port) outputs.emplace_back(output.name, entry);
    }
  }
  const std::vector<std::string> facts = key_facts(outputs, report.at("params"));
  std::size_t warnings = 0;
  for (const NodeResult& node : result.nodes) warnings += node.warnings.size();
  if (facts.empty() && warnings == 0) return;
  std::printf("\n");
  for (const std::string& fact : facts) std::printf("%s\n", printable(fact).c_str());
  if (warnings > 0) std::printf("%zu warning%s\n", warnings, warnings == 1 ? "" : "s");
  if (recorded) std::printf("more: ballflow report %s, ballflow view %s\n", id.c_str(), id.c_str());
}

/// The table of "ballflow compare", or its beginning.
void print_variants(const std::string& id, const Json& report) {
  constexpr std::size_t most_rows = 100;
  RunRecord record;
  record.report = nlohmann::json(report);
  Comparison table = compare({record}, {});
  const std::size_t rows = table.rows.size();
  table.rows.resize(std::min(rows, most_rows));
  std::printf("\n%s", render(table, "text").c_str());
  if (rows > most_rows)
    std::printf("and %zu variants more: ballflow compare %s\n", rows - most_rows, id.c_str());
}

void check_formats(const Dag& dag, const std::map<std::string, std::string>& formats) {
  for (const auto& [name, format] : formats) {
    const std::string option = "--format " + name + "=" + format + ": ";
    const auto output =
        std::find_if(dag.outputs.begin(), dag.outputs.end(),
                     [&name = name](const DagOutput& known) { return known.base_name() == name; });
    if (output == dag.outputs.end()) {
      std::vector<std::string> names;
      for (const DagOutput& known : dag.outputs) names.push_back(known.base_name());
      const std::string near = nearest(name, names);
      throw Error(ExitCode::usage, option + "the graph has no output \"" + name + "\"",
                  near.empty() ? "" : "did you mean \"" + near + "\"?");
    }
    const std::string& type = dag.nodes[output->from.node].kind.output(output->from.port)->type;
    const std::vector<std::string> known = export_formats(type);
    if (std::find(known.begin(), known.end(), format) != known.end()) continue;
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    throw Error(ExitCode::usage, option + "a " + type + " cannot be written as \"" + format + "\"",
                "use one of " + all);
  }
}

void check_writable(const std::string& option, const std::string& path) {
  if (path.empty()) return;
  namespace fs = std::filesystem;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status)) return;  // a device
  const fs::path parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  const int code = fs::is_directory(status) ? EISDIR : access(folder.c_str(), W_OK | X_OK) != 0 ? errno : 0;
  if (code == 0) return;
  throw Error(ExitCode::store, "cannot write " + option + " " + path + ": " + std::strerror(code),
              "choose a file in a folder that exists and can be written");
}

/// Parts of a sweep may write to one folder.
std::string report_name(const std::string& shard) {
  std::string name = shard;
  std::replace(name.begin(), name.end(), '/', '-');
  return name.empty() ? "report.json" : "report-" + name + ".json";
}

/// Which nodes a run is about; as Dag::nodes.
std::vector<bool> looked_at(const Dag& dag, const RunOptions& options) {
  if (options.only.empty()) {
    return options.until.empty() ? needed_nodes(dag) : needed_nodes(dag, options.until);
  }
  std::vector<bool> nodes(dag.nodes.size(), false);
  for (const std::size_t node : options.only) nodes[node] = true;
  return nodes;
}

}  // namespace

int run_graph(const Common& common, const RunArguments& arguments, const AfterRun& after) {
  std::map<std::string, std::string> formats;
  for (const std::string& format : arguments.formats) {
    auto [output, name] = split_setting("--format", format, "balls=csv");
    formats[output] = std::move(name);
  }
  const auto registry = common.registry();
  const Dag dag = arguments.graph.load(common, *registry);
  if (arguments.sweep && dag.variants.empty()) {
    throw Error(ExitCode::usage, arguments.graph.graph + " has no \"sweep\"",
                "say what to sweep over: --axis NAME=VALUE,VALUE, or --inputs 'PATTERN' for files");
  }
  const std::vector<Setting> settings = arguments.graph.settings();
  check_formats(dag, formats);
  // A folder of results says what they are results of.
  const std::string report_path = !arguments.report.empty() || arguments.out.empty() || dag.variants.empty()
                                      ? arguments.report
                                      : arguments.out + "/" + report_name(arguments.shard);
  const auto store = common.shared_store();
  // Before hours of computing, not after them.
  common.places->writes("--report", report_path);
  common.places->writes("--trace", arguments.trace);
  if (!arguments.out.empty()) {
    claim_outputs(*common.places, arguments.out, dag, formats);
    prepare_folder(arguments.out);
  }
  check_writable("--report", report_path);
  check_writable("--trace", arguments.trace);
  RunOptions options = arguments.settings.options(dag);
  if (!arguments.shard.empty()) options.until = nodes_of_shard(dag, arguments.shard);
  if (!dag.variants.empty()) options.keep_going = true;  // one that fails must not void the others
  if (!common.no_cache && !store->why().empty()) {
    std::fprintf(stderr, "warning: the cache is not written: %s\n", store->why().c_str());
  }
  const std::string id = new_run_id(arguments.graph.file());
  const KeepWithin collect_at_the_end(store, common.cache_limit(*store));

  const std::atomic<bool>& cancel = cancel_on_signals();
  // Who reads the progress may go; the results are wanted nevertheless.
  const auto on_broken_pipe = std::signal(SIGPIPE, SIG_IGN);
  options.cancel = &cancel;
  const Manifests earlier = latest_manifests(*store, arguments.graph.file());
  Sinks sinks;  // after what they use
  if (!arguments.quiet && (arguments.table || isatty(STDERR_FILENO) != 0)) {
    Expectations expectations;
    expectations.needed = looked_at(dag, options);
    expectations.plan = [&dag, store, &options, &earlier] {
      std::vector<NodePlan> plans = plan(dag, *store, options.seed, earlier);
      for (const std::size_t node : options.force) plans[node].verdict = NodePlan::Verdict::run;
      return plans;
    };
    sinks.add(progress_display(dag, isatty(STDERR_FILENO) != 0, std::move(expectations)));
  }
  if (arguments.json) sinks.add(event_lines(dag));
  Trace* timeline = nullptr;
  if (!arguments.trace.empty()) {
    auto sink = trace(dag);
    timeline = sink.get();
    sinks.add(std::move(sink));
  }
  Runner runner(dag, *registry, store, options, sinks, earlier);
  const RunResult& result = runner.run();

  WrittenOutputs written;
  const bool usable =
      result.status == ExitCode::ok || (result.status == ExitCode::node_failed && options.keep_going);
  if (!arguments.out.empty() && usable) {
    written = write_outputs(arguments.out, dag, result, formats,
                            [&runner](const EdgeRef& edge) { return runner.artifact(edge); });
  }
  if (const std::string trouble = store->trouble(); !trouble.empty()) {
    std::fprintf(stderr, "warning: not everything could be cached: %s\n", trouble.c_str());
  }
  tell_upstream(*store);
  Json report = run_report(id, dag, result);
  report["version"] = BALLFLOW_VERSION;
  report["command"] = "ballflow run " + arguments.graph.words() + arguments.settings.words();
  const bool recorded = !arguments.no_record && save_run(*store, id, manifests_of(dag, result), report);
  std::vector<std::string> records;  // written beside the outputs
  const auto record = [&](const char* what, const std::string& path, const auto& text) {
    if (path.empty()) return;
    try {
      write_atomically(path, text());
      records.push_back(std::string(what) + " " + path);
    } catch (const Error& failure) {
      if (!written.failure) written.failure = failure;
    }
  };
  record("report", report_path,
         [&report] { return report.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; });
  if (timeline != nullptr) record("trace", arguments.trace, [timeline] { return timeline->text(); });
  if (arguments.json) {
    Json files = Json::object();
    for (const WrittenFile& file : written.files) files[file.output] = file.path;
    print_line({{"event", "run_reported"},
                {"run", id},
                {"status", report["status"]},
                {"seconds", result.seconds},
                {"cpu_seconds", result.cpu_seconds},
                {"peak_rss_bytes", result.peak_rss_bytes},
                {"files", std::move(files)}});
  }
  std::signal(SIGPIPE, on_broken_pipe);

  if (after && usable) after(dag, result, [&runner](const EdgeRef& edge) { return runner.artifact(edge); });
  if (!arguments.quiet && !arguments.json) {
    if (!arguments.table) {
      print_totals(result);
    } else if (dag.variants.empty()) {
      print_result(dag, result);
    } else {
      print_variants(id, report);
      print_totals(result);
    }
    if (options.check_determinism && result.status == ExitCode::ok)
      std::printf("same results with 1 and with %u threads\n", several_threads(options));
    if (!dag.variants.empty() && !written.files.empty()) {
      const auto fresh = std::count_if(written.files.begin(), written.files.end(),
                                       [](const WrittenFile& file) { return file.written; });
      std::printf("wrote %s of %s files below %s\n", grouped(fresh).c_str(),
                  grouped(static_cast<std::int64_t>(written.files.size())).c_str(),
                  printable(arguments.out).c_str());
      written.files.clear();
    }
    for (const WrittenFile& file : written.files) {
      std::printf("%s %s: %s\n", file.written ? "wrote" : "kept ", printable(file.path).c_str(),
                  printable(file.what).c_str());
    }
    for (const std::string& line : records) std::printf("%s\n", printable(line).c_str());
    if (arguments.table && dag.variants.empty() && result.status == ExitCode::ok)
      print_facts(dag, result, report, id, recorded);
  }
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (result.nodes[i].status != NodeStatus::failed) continue;
    const FailedRun failed{common, *registry, dag, *store, arguments.settings.seed, settings};
    std::fprintf(stderr, "\n%s  again, from this node on: %s\n", failure_text(failed, result, i).c_str(),
                 again(common, arguments).c_str());
  }
  for (std::size_t i = 0; i < dag.nodes.size(); ++i) {
    if (result.nodes[i].deterministic || result.nodes[i].status == NodeStatus::failed) continue;
    std::fprintf(stderr,
                 "\nwarning: node %s (%s) is NOT DETERMINISTIC: it gave another result than before for equal "
                 "inputs and parameters\n  its entry was replaced and what depends on it computed anew; find "
                 "out what differs with --check-determinism\n",
                 dag.nodes[i].path.c_str(), dag.nodes[i].kind.type().c_str());
  }
  if (result.status == ExitCode::cancelled) {
    std::fprintf(stderr,
                 "cancelled; what was finished is in the cache, the same command goes on from there\n");
  }
  if (written.failure) throw Error(*written.failure);
  return static_cast<int>(result.status);
}

namespace {

void add_command(const Command& app, Common& common, Action& action, bool sweep) {
  const Command command =
      sweep ? app.subcommand("sweep", "run all variants of a graph; what they have in common runs once")
            : app.subcommand("run", "run a graph; what is in the cache is not computed again");
  const auto arguments = std::make_shared<RunArguments>();
  arguments->sweep = sweep;
  arguments->graph.add_to(command);
  command.option("--out", arguments->out, "folder that receives the outputs of the graph").type_name("DIR");
  command
      .option("--format", arguments->formats,
              "format of an output file, e.g. balls=csv; see \"ballflow export --help\" for the formats")
      .type_name("OUTPUT=FORMAT")
      .one_at_a_time();
  command.option("--report", arguments->report, "file that receives the report of the run (JSON)")
      .type_name("FILE");
  command.option("--cache", common.cache, "cache folder").type_name("DIR");
  command
      .option("--cache-size", common.cache_size,
              "size of the cache above which what is worth least is removed, e.g. 5G, or none\n"
              "(default: $BALLFLOW_CACHE_SIZE, else 20 GiB or a tenth of the disk, the smaller)")
      .type_name("SIZE");
  command.flag("--no-cache", common.no_cache, "neither read nor write a cache");
  add_upstream_options(command, common);
  arguments->settings.add_to(command);
  command
      .option("--trace", arguments->trace,
              "file that receives a time line of the run, to be opened in ui.perfetto.dev")
      .type_name("FILE");
  command.flag("--json", arguments->json,
               "write events as lines of JSON (schemas/run_events.schema.json) to the standard output");
  command.flag("--quiet", arguments->quiet, "print errors only");
  if (sweep) {
    command
        .option("--shard", arguments->shard,
                "run a part of the variants: 2/5 is the second of five; with --upstream parts share what "
                "they have in "
                "common")
        .type_name("K/N");
    command.flag("--no-record", arguments->no_record, "leave no record in the history of runs");
    command.footer(
        "Outputs go to a folder per variant, DIR/epsilon=0.1,strategy=greedy/, the report to "
        "DIR/report.json.\n"
        "\"ballflow compare\" prints the table again, with other columns and formats.");
  }
  command.callback([&common, &action, arguments] {
    action = [&common, arguments] { return run_graph(common, *arguments); };
  });
}

}  // namespace

void add_run(const Command& app, Common& common, Action& action) { add_command(app, common, action, false); }
void add_sweep(const Command& app, Common& common, Action& action) { add_command(app, common, action, true); }

}  // namespace ballflow::cli
