#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "ballflow/gc.hpp"
#include "ballflow/history.hpp"
#include "ballflow/shipped_graphs.hpp"
#include "ballflow/text.hpp"
#include "commands/commands.hpp"
#include "commands/model_file.hpp"

namespace ballflow::cli {

namespace fs = std::filesystem;

std::shared_ptr<const Registry> Common::registry() const {
  const std::string root = no_cache ? "" : cache.empty() ? Store::default_root() : cache;
  std::shared_ptr<const Registry> registry = Registry::load(plugins, Registry::default_folder(), root);
  for (const PluginCandidate& candidate : registry->candidates())
    places->reads("a node library", candidate.path);
  return registry;
}

std::shared_ptr<Store> Common::store() const {
  StoreOptions options;
  if (!no_cache) options.root = cache.empty() ? Store::default_root() : cache;
  std::shared_ptr<Store> store = Store::open(options);
  places->has_cache(store->root());
  return store;
}

std::string Common::upstream_place() const {
  const char* const variable = std::getenv("BALLFLOW_UPSTREAM");
  if (!upstream.empty() && no_cache) {
    throw Error(ExitCode::usage, "--upstream needs the cache that --no-cache forbids",
                "what comes from an upstream lies in the cache before it is used; leave one of them out");
  }
  if (no_cache) return {};
  return !upstream.empty() ? upstream : variable != nullptr ? variable : "";
}

std::shared_ptr<Store> Common::shared_store(UpstreamUse use) const {
  const std::string place = upstream_place();
  if (place.empty()) return store();
  StoreOptions options;
  options.root = cache.empty() ? Store::default_root() : cache;
  use.upstream = Upstream::open(place);
  use.read_only = use.read_only || upstream_read_only;
  options.upstream = std::move(use);
  std::shared_ptr<Store> store = Store::open(options);
  places->has_cache(store->root());
  return store;
}

void add_upstream_options(const Command& command, Common& common) {
  command
      .option("--upstream", common.upstream,
              "results shared with others: a folder, or http://host/path of a cache server; what is not in "
              "the\ncache is looked for there, and results are published there (default: $BALLFLOW_UPSTREAM)")
      .type_name("DIR");
  command.flag("--upstream-read-only", common.upstream_read_only,
               "take results from the upstream and publish none");
}

void tell_upstream(const Store& store) {
  constexpr std::size_t most_lines = 10;
  const std::vector<std::string> notes = store.upstream_notes();
  for (std::size_t i = 0; i < std::min(notes.size(), most_lines); ++i)
    std::fprintf(stderr, "warning: %s\n", printable(notes[i]).c_str());
  if (notes.size() > most_lines)
    std::fprintf(stderr, "warning: upstream: %zu more like these\n", notes.size() - most_lines);
}

std::uint64_t Common::cache_limit(Store& store) const {
  const char* const variable = std::getenv("BALLFLOW_CACHE_SIZE");
  const bool given = !cache_size.empty();
  const std::string size = given ? cache_size : variable != nullptr ? variable : "";
  if (size.empty()) return default_limit(store);
  if (const auto limit = parse_size(size)) return *limit;
  throw Error(ExitCode::usage, (given ? "" : "BALLFLOW_CACHE_SIZE: ") + ("\"" + size + "\" is not a size"),
              "write it as 5G, 800M, 1.5T, a number of bytes, or none");
}

namespace {

std::atomic<bool> cancel_requested{false}, out_of_time{false};
static_assert(std::atomic<bool>::is_always_lock_free);

void on_interrupt(int signal_number) {
  cancel_requested.store(true);
  std::signal(signal_number, SIG_DFL);  // the second Ctrl-C ends the process at once; the store does not mind
}

void on_time_limit(int) {
  out_of_time.store(true);
  cancel_requested.store(true);
}

}  // namespace

const std::atomic<bool>& cancel_on_signals() {
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  return cancel_requested;
}

const std::atomic<bool>& cancel_before_time_limit() {
  std::signal(SIGUSR1, on_time_limit);
  return cancel_on_signals();
}

bool is_out_of_time() { return out_of_time.load(); }

bool is_run(Store& store, const std::string& name) {
  if (name == "latest" || name == "previous") return true;
  std::error_code ignored;
  if (fs::is_directory(name, ignored)) return true;
  if (fs::is_regular_file(name, ignored)) {
    std::ifstream file(name, std::ios::binary);
    char first = ' ';
    file >> first;  // skips white space
    return first == '{';
  }
  for (const RunInfo& run : list_runs(store)) {
    if (run.id.starts_with(name)) return true;
  }
  // What looks like no digest is more likely a mistyped run: its error names the nearest ones.
  return name.find_first_not_of("0123456789abcdef") != std::string::npos;
}

ArtifactPtr cached_artifact(const Store& store, const Digest& digest) {
  const std::string hex = digest.hex();
  const std::string path = (fs::path(store.root()) / "cas" / hex.substr(0, 2) / hex.substr(2)).string();
  std::error_code ignored;
  if (store.root().empty() || !fs::is_regular_file(path, ignored)) return nullptr;
  ArtifactPtr artifact = Artifact::map(path);
  if (artifact->digest() == digest) return artifact;
  throw Error(ExitCode::store, path + " is damaged: its content has another digest than its name",
              "delete it; the next run that needs it makes it again");
}

RunRecord named_run(const Common& common, Store& store, const std::string& name,
                    const std::string& graph_file) {
  RunRecord run = find_run(store, name, graph_file);
  std::error_code ignored;
  if (fs::is_regular_file(run.source, ignored)) common.places->reads("the report of a run", run.source);
  return run;
}

ArtifactPtr find_artifact(const Common& common, const std::string& name,
                          const std::shared_ptr<Store>& given) {
  std::error_code ignored;
  if (fs::is_regular_file(name, ignored)) {
    common.places->reads("an artifact", name);
    return is_model(name) ? artifact_of_model(name) : Artifact::map(name);
  }
  const bool hexadecimal = name.find_first_not_of("0123456789abcdef") == std::string::npos;
  if (hexadecimal && name.size() >= 6 && name.size() <= 64) {
    const auto store = given != nullptr ? given : common.store();
    if (store->root().empty()) {
      throw Error(ExitCode::usage, "there is no cache to look for " + name + " in: " + store->why(),
                  "name its folder with --cache or $BALLFLOW_CACHE, or give a file");
    }
    // Of a whole digest no folder has to be listed, and the upstream can be asked.
    const auto whole = Digest::from_hex(name);
    if (whole && store->fetch_blob(*whole)) {
      if (ArtifactPtr artifact = cached_artifact(*store, *whole)) return artifact;
    }
    const std::vector<Digest> found = find_artifacts(*store, name);
    if (found.size() == 1) {
      if (ArtifactPtr artifact = cached_artifact(*store, found.front())) return artifact;
    }
    if (found.size() > 1) {
      throw Error(ExitCode::usage, "\"" + name + "\" is the beginning of several digests",
                  "give more digits");
    }
  }
  throw Error(ExitCode::usage, "there is no artifact \"" + name + "\"",
              "give a file, or the digest of an artifact from a run report (6 digits or more)");
}

std::pair<std::string, std::string> split_setting(const std::string& option, const std::string& text,
                                                  const std::string& example) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw Error(ExitCode::usage, option + " " + text + ": no \"=\" between a name and a value",
                "write it as " + option + " " + example);
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void GraphArguments::add_to(const Command& command) {
  command
      .option("graph", graph,
              "graph file, or the name of a graph that comes with ballflow (\"ballflow graph --list\")")
      .required()
      .type_name("GRAPH");
  command
      .option("--set", sets,
              "set a parameter of the graph (epsilon=0.5) or of one node (prune/greedy.mode=until_covered)")
      .type_name("NAME=VALUE")
      .one_at_a_time();
  command
      .option("--axis", axes,
              "run the graph once for every one of these values (epsilon=0.1,0.3); several axes give every\n"
              "combination; replaces the axis of that name in the graph's \"sweep\"")
      .type_name("NAME=VALUES")
      .one_at_a_time();
  command
      .option("--inputs", inputs,
              "run the graph once for every file that matches ('scans/*.ply'); NAME=PATTERN chooses the\n"
              "parameter when the graph has several of kind file")
      .type_name("PATTERN...");
}

namespace {

std::vector<Setting> split(const char* option, const std::vector<std::string>& texts, const char* example) {
  std::vector<Setting> result;
  for (const std::string& text : texts) {
    auto [name, value] = split_setting(option, text, example);
    result.push_back({std::move(name), std::move(value)});
  }
  return result;
}

}  // namespace

std::string GraphArguments::file() const { return find_graph(graph); }

std::vector<Setting> GraphArguments::settings() const { return split("--set", sets, "epsilon=0.5"); }

Dag GraphArguments::load(const Common& common, const Registry& registry) const {
  Dag dag = load_graph(file(), registry, settings(), {split("--axis", axes, "epsilon=0.1,0.3"), inputs}, {},
                       [&common](const std::string& name) { return find_artifact(common, name); });
  for (const Diagnostic& warning : dag.warnings) std::fprintf(stderr, "%s\n", warning.text().c_str());
  common.places->reads(dag);
  return dag;
}

std::string GraphArguments::words() const {
  std::string text = shell_word(graph);
  for (const std::string& set : sets) text += " --set " + shell_word(set);
  for (const std::string& axis : axes) text += " --axis " + shell_word(axis);
  if (!inputs.empty()) text += " --inputs";
  for (const std::string& input : inputs) text += " " + shell_word(input);
  return text;
}

void print_table(const std::vector<std::vector<std::string>>& rows) {
  // One column per character, not per byte: continuation bytes take no room.
  const auto columns = [](const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
  };
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], columns(printable(row[i])));
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string cell = printable(row[i]);
      line += cell;
      if (i + 1 < row.size()) line += std::string(widths[i] - columns(cell) + 2, ' ');
    }
    std::printf("%s\n", line.c_str());
  }
}

std::string plain(const Json& value) {
  return value.is_string() ? value.get<std::string>()
                           : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace ballflow::cli
