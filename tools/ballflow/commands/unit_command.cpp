// "ballflow exec-node --unit FILE": what a job of a cluster does.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "ballflow/gc.hpp"
#include "cluster/submission.hpp"
#include "cluster/unit_progress.hpp"
#include "commands/commands.hpp"
#include "commands/failure.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// As in sysexits.h: what it needs is not there yet; try again later.
constexpr int input_missing = 75;

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw Error(ExitCode::store, "cannot read the unit " + path,
                "it lies in the store that the graph was submitted with; is that mounted here?");
  }
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

std::string host_name() {
  char name[256] = {};
  return ::gethostname(name, sizeof name - 1) == 0 ? name : "";
}

std::string job_name() {
  const std::string array = variable("SLURM_ARRAY_JOB_ID");
  return array.empty() ? variable("SLURM_JOB_ID") : array + '_' + variable("SLURM_ARRAY_TASK_ID");
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class UnitRun {
 public:
  UnitRun(const Common& common, const std::string& file, double patience)
      : common_(common),
        registry_(common.registry()),
        unit_(read_unit(text_of(file), *registry_)),
        folder_(fs::absolute(file).parent_path().parent_path().string()),
        patience_(patience) {
    if (common.upstream_place().empty()) {
      throw Error(ExitCode::usage, "a unit needs --upstream: what it reads and makes goes no other way",
                  "name the store that the graph was submitted with");
    }
    UpstreamUse use;
    use.transport = true;
    use.patience = patience;
    store_ = common.shared_store(use);
  }

  int run() {
    const auto start = Clock::now();
    build_dag();
    RunOptions options;
    options.threads = unit_.threads;
    options.seed = unit_.seed;
    options.keep_going = true;
    options.cancel = &cancel_before_time_limit();
    for (std::size_t i = given_; i < dag_.nodes.size(); ++i) options.until.insert(i);
    UnitStatus status;
    status.host = host_name();
    status.job = job_name();
    status.of = unit_.nodes.size();
    for (const auto& [path, reason] : missing_) {
      const DagNode& node = unit_.nodes[path];
      status.nodes.push_back({node.path, node.kind.type(), "missing", std::nullopt, reason, {}, 0});
      std::fprintf(stderr, "%s is not run: %s\n", node.path.c_str(), reason.c_str());
    }
    if (!missing_.empty()) status.exit_code = input_missing;
    if (!options.until.empty()) {
      const UnitStatus begun = status;
      const KeepWithin collect_at_the_end(store_, common_.cache_limit(*store_));
      const auto display = progress_display(dag_, false);
      UnitProgress progress(*display, dag_, given_, [&](const std::vector<NodeState>& ended) {
        UnitStatus so_far = begun;
        so_far.nodes.insert(so_far.nodes.end(), ended.begin(), ended.end());
        so_far.seconds = seconds_since(start);
        write_progress(folder_, unit_.name, so_far);
      });
      Runner runner(dag_, *registry_, store_, options, progress);
      tell(runner.run(), status);
    }
    tell_upstream(*store_);
    status.seconds = seconds_since(start);
    status.out_of_time = is_out_of_time();
    write_status(folder_, unit_.name, status);
    return status.exit_code;
  }

 private:
  /// Where a result from outside is: its entry says. Empty when it is not there.
  const std::optional<ActionEntry>& entry_of(std::size_t outside) {
    const auto [found, first] = entries_.try_emplace(outside);
    if (!first) return found->second;
    const OutsideNode& node = unit_.outside[outside];
    const std::optional<Digest> key = node.key ? node.key : key_from_status(node);
    if (key) found->second = store_->await_action(*key);
    return found->second;
  }

  std::optional<Digest> key_from_status(const OutsideNode& outside) {
    const auto [found, first] = keys_.try_emplace(outside.unit);
    if (first) {
      const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                            std::chrono::duration<double>(patience_));
      auto status = read_status(folder_, outside.unit);
      while (!status && Clock::now() < until) {
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        // Listing a folder renews what this machine remembers of it, on NFS.
        std::error_code ignored;
        for (const auto& entry : fs::directory_iterator(folder_ + "/status", ignored)) (void)entry;
        status = read_status(folder_, outside.unit);
      }
      // One that was killed has said how far it got.
      if (!status) status = read_progress(folder_, outside.unit);
      for (const NodeState& node : status ? status->nodes : std::vector<NodeState>()) {
        if (node.key && (node.status == "run" || node.status == "hit")) found->second[node.path] = *node.key;
      }
    }
    const auto key = found->second.find(outside.path);
    return key == found->second.end() ? std::nullopt : std::optional(key->second);
  }

  ArtifactPtr artifact_of(std::size_t outside, const std::string& port) {
    const OutsideNode& node = unit_.outside[outside];
    if (node.artifact) return store_->load(*node.artifact);
    const auto& entry = entry_of(outside);
    if (!entry) return nullptr;
    for (const OutputEntry& output : entry->outputs) {
      if (output.port == port) return store_->load(output);
    }
    return nullptr;
  }

  /// What is read from outside as given artifacts, then the nodes that have all they need.
  void build_dag() {
    std::map<std::pair<std::size_t, std::string>, std::size_t> given;
    const std::size_t n = unit_.nodes.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (const auto& [slot, edge] : unit_.nodes[i].inputs) {
        if (edge.node < n && missing_.count(edge.node) != 0)
          missing_.emplace(i, "it needs " + unit_.nodes[edge.node].path);
        if (edge.node < n || given.count({edge.node, edge.port}) != 0) continue;
        const OutsideNode& outside = unit_.outside[edge.node - n];
        ArtifactPtr artifact = artifact_of(edge.node - n, edge.port);
        if (artifact == nullptr) {
          missing_.emplace(i, outside.path + "." + edge.port + " is not in the store");
          continue;
        }
        PortDecl port;
        port.name = edge.port;
        port.type = artifact->type();
        port.type_version = artifact->version();
        given[{edge.node, edge.port}] = dag_.nodes.size();
        dag_.nodes.push_back({outside.path + '.' + edge.port, Given{{port}, artifact}});
      }
    }
    given_ = dag_.nodes.size();
    dag_.file = unit_.name;
    std::vector<std::size_t> place(n);
    for (std::size_t i = 0; i < n; ++i) {
      if (missing_.count(i) != 0) continue;
      place[i] = dag_.nodes.size();
      DagNode node = unit_.nodes[i];
      for (auto& [slot, edge] : node.inputs)
        edge.node = edge.node < n ? place[edge.node] : given.at({edge.node, edge.port});
      dag_.nodes.push_back(std::move(node));
    }
  }

  void tell(const RunResult& result, UnitStatus& status) {
    if (result.status != ExitCode::ok) status.exit_code = static_cast<int>(result.status);
    for (std::size_t i = given_; i < dag_.nodes.size(); ++i) {
      const NodeResult& node = result.nodes[i];
      NodeState state{dag_.nodes[i].path,
                      dag_.nodes[i].kind.type(),
                      std::string(to_string(node.status)),
                      std::nullopt,
                      node.cause,
                      {},
                      0};
      if (node.status == NodeStatus::run || node.status == NodeStatus::hit) state.key = key_of(node.manifest);
      if (node.status == NodeStatus::run) state.seconds = node.cost_seconds;
      if (node.status == NodeStatus::failed) {
        state.text = failure_text({common_, *registry_, dag_, *store_, unit_.seed, {}}, result, i);
        std::fprintf(stderr, "%s", state.text.c_str());
      }
      status.nodes.push_back(std::move(state));
    }
  }

  const Common& common_;
  std::shared_ptr<const Registry> registry_;
  Unit unit_;
  std::string folder_;  // of the submission
  double patience_;
  std::shared_ptr<Store> store_;
  Dag dag_;
  std::size_t given_ = 0;                       // of its nodes
  std::map<std::size_t, std::string> missing_;  // nodes of the unit that cannot run, and why
  std::map<std::size_t, std::optional<ActionEntry>> entries_;
  std::map<std::string, std::map<std::string, Digest>> keys_;  // by unit and path
};

}  // namespace

int exec_unit(const Common& common, const std::string& file, double patience) {
  return UnitRun(common, file, patience).run();
}

}  // namespace ballflow::cli
