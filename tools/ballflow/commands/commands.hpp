// The commands of the command line. Each adds itself to the parser; what it returns is the exit code.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ballflow/graph.hpp"
#include "ballflow/history.hpp"
#include "ballflow/registry.hpp"
#include "ballflow/run.hpp"
#include "ballflow/store.hpp"
#include "commands/command_line.hpp"
#include "commands/places.hpp"

namespace ballflow::cli {

/// Options that several commands share.
struct Common {
  std::string program = "ballflow";  // as it was called
  std::vector<std::string> plugins;
  std::string cache, cache_size;
  bool no_cache = false;
  // Of the commands that share results: --upstream, else $BALLFLOW_UPSTREAM.
  std::string upstream;
  bool upstream_read_only = false;
  // Everything below tells it what it reads; what a command writes it has to tell itself, before it begins.
  std::shared_ptr<Places> places = std::make_shared<Places>();

  std::shared_ptr<const Registry> registry() const;
  std::shared_ptr<Store> store() const;
  /// The store of a command with --upstream; `use`: how it uses it, the upstream itself aside.
  std::shared_ptr<Store> shared_store(UpstreamUse use = {}) const;
  /// The folder or address, empty when there is none. Throws Error (code usage) when it cannot be with
  /// --no-cache.
  std::string upstream_place() const;
  /// Bytes the cache may have: --cache-size, else $BALLFLOW_CACHE_SIZE, else the default of `store`.
  std::uint64_t cache_limit(Store& store) const;
};

/// The graph of a command and the values set for it.
struct GraphArguments {
  std::string graph;  // as it was written: a path, or the name of a graph that comes with ballflow
  std::vector<std::string> sets, axes, inputs;

  void add_to(const Command& command);
  /// The file of the graph. Throws Error (code usage) for what is neither a path nor such a name.
  std::string file() const;
  std::vector<Setting> settings() const;  // of --set
  /// Reads and checks the graph, with what was set; prints its warnings.
  Dag load(const Common& common, const Registry& registry) const;
  /// The words of a command line that give the same graph, quoted for a shell.
  std::string words() const;
};

/// What decides how a graph runs.
struct RunSettings {
  unsigned threads = 0;
  std::string memory;
  std::uint64_t seed = 0;
  bool keep_going = false, strict = false, check_determinism = false;
  std::vector<std::string> until, only, force;

  void add_to(const Command& command);
  /// Throws Error (code usage) for a name that `dag` does not have and for a size that is none.
  RunOptions options(const Dag& dag) const;
  /// The words of a command line for what decides the results: the seed and the nodes that run.
  std::string words() const;
};

/// Registered commands put what they do here; main runs it after parsing.
using Action = std::function<int()>;

/// All commands, and the options of the program itself.
void add_commands(const Command& program, Common& common, Action& action);

void add_run(const Command& app, Common& common, Action& action);
void add_sweep(const Command& app, Common& common, Action& action);
void add_compare(const Command& app, Common& common, Action& action);
void add_plan(const Command& app, Common& common, Action& action);
void add_runs(const Command& app, Common& common, Action& action);
void add_check(const Command& app, Common& common, Action& action);
void add_nodes(const Command& app, Common& common, Action& action);
void add_cache(const Command& app, Common& common, Action& action);
void add_report(const Command& app, Common& common, Action& action);
void add_export(const Command& app, Common& common, Action& action);
void add_graph(const Command& app, Common& common, Action& action);
void add_view(const Command& app, Common& common, Action& action);
void add_plugins(const Command& app, Common& common, Action& action);
void add_new_node(const Command& app, Common& common, Action& action);
void add_explain(const Command& app, Common& common, Action& action);
void add_render(const Command& app, Common& common, Action& action);
void add_spheres(const Command& app, Common& common, Action& action);
void add_look(const Command& app, Common& common, Action& action);
void add_submit(const Command& app, Common& common, Action& action);
void add_status(const Command& app, Common& common, Action& action);
void add_cancel(const Command& app, Common& common, Action& action);
void add_exec_node(const Command& app, Common& common, Action& action);
void add_completion(const Command& app, Common& common, Action& action);
void add_version(const Command& app, Common& common, Action& action);

/// Runs the unit in a file of a submission (units.hpp) and writes its status beside it. `patience`: for so
/// many seconds it looks again for what must be in the store. Returns the exit code; 75 when an input is not
/// there.
int exec_unit(const Common& common, const std::string& file, double patience);

/// "NAME=VALUE" of an option that is repeated; throws Error that shows how it is written.
std::pair<std::string, std::string> split_setting(const std::string& option, const std::string& text,
                                                  const std::string& example);

/// True when `name` means a run and not an artifact: a folder, a file that begins as JSON does, "latest",
/// "previous", the beginning of the id of a run, or what is no digest.
bool is_run(Store& store, const std::string& name);

/// The artifact of a digest, null when the cache does not have it. Throws Error (code store) when its file is
/// damaged.
ArtifactPtr cached_artifact(const Store& store, const Digest& digest);

/// find_run() for a name on the command line.
RunRecord named_run(const Common& common, Store& store, const std::string& name,
                    const std::string& graph_file = {});

/// A file of an artifact, of a model or of balls (see model_file.hpp), or the beginning of the digest of an
/// artifact in the cache. Throws Error when it is none of these.
/// `store`: where to look; null: in the cache of `common`.
ArtifactPtr find_artifact(const Common& common, const std::string& name,
                          const std::shared_ptr<Store>& store = {});

/// --upstream and --upstream-read-only.
void add_upstream_options(const Command& command, Common& common);

/// Prints what was odd about the upstream of a store as warnings, at most ten lines.
void tell_upstream(const Store& store);

/// A flag that becomes true at the first Ctrl-C or SIGTERM after this call; the second one ends the process.
const std::atomic<bool>& cancel_on_signals();
/// SIGUSR1 does the same from now on: so a scheduler says that the time of a job is nearly over.
const std::atomic<bool>& cancel_before_time_limit();
/// Whether it has said so.
bool is_out_of_time();

/// Prints rows as a table with aligned columns.
void print_table(const std::vector<std::vector<std::string>>& rows);

/// The text of a JSON value for people: strings without quotes.
std::string plain(const Json& value);

}  // namespace ballflow::cli
