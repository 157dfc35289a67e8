// "ballflow export GRAPH --to snakemake": the units of a graph as the jobs of a Snakefile.
#include <cstdio>
#include <filesystem>

#include "ballflow/output_file.hpp"
#include "ballflow/text.hpp"
#include "commands/submit_command.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

// One rule for all units: Snakemake takes seconds for some thousand rules, and none for a table.
constexpr const char* snakefile =
    R"(# Units of a graph of ballflow; made by "ballflow export --to snakemake". Results are in the store that jobs.json names:
# what is there is not computed again, whatever becomes of the files in done/.
import json

with open(workflow.basedir + "/jobs.json") as file:
    JOBS = json.load(file)
UNITS = JOBS["units"]

rule all:
    input: expand(workflow.basedir + "/done/{unit}.ok", unit=UNITS)

rule unit:
    wildcard_constraints: unit="[0-9]+-[0-9]+"
    input: lambda wildcards: [f"{workflow.basedir}/done/{unit}.ok" for unit in UNITS[wildcards.unit]["needs"]]
    output: workflow.basedir + "/done/{unit}.ok"
    log: workflow.basedir + "/log/{unit}.out"
    threads: lambda wildcards: UNITS[wildcards.unit]["threads"]
    resources:
        mem_mb=lambda wildcards: UNITS[wildcards.unit]["mem_mb"],
        runtime=lambda wildcards: UNITS[wildcards.unit]["minutes"],
    params:
        run=lambda wildcards: JOBS["run"],
        unit=lambda wildcards: f"{workflow.basedir}/units/{wildcards.unit}.json",
    shell: "{params.run} --unit {params.unit:q} >> {log:q} 2>&1 && touch {output:q}"
)";

// The polling of Snakemake 7 sleeps 10 s between looks unless $CI is set.
constexpr const char* slurm_profile =
    R"(# snakemake --profile profile; Snakemake 7, jobs by sbatch. CI=true polls every second in place of ten.
cluster: "sbatch --parsable --requeue --cpus-per-task={threads} --mem={resources.mem_mb}M --time={resources.runtime}"
cluster-status: "./status.sh"
cluster-cancel: "scancel"
jobs: 100
keep-going: true
latency-wait: 60
rerun-triggers: mtime
)";

constexpr const char* slurm_status = R"(#!/bin/sh
# What Snakemake asks of a job: running, success or failed. A job that Slurm has forgotten has ended; whether well, its
# output says.
state=$(squeue --noheader --states=all --jobs="$1" --format=%T 2>/dev/null | head -n 1)
case $state in
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | RESIZING) echo running ;;
  COMPLETED) echo success ;;
  *) echo failed ;;
esac
)";

}  // namespace

int export_snakemake(Common& common, const SubmitArguments& arguments, const std::string& folder) {
  common.upstream = arguments.store;
  const auto registry = common.registry();
  const Dag dag = arguments.graph.load(common, *registry);
  Submitter submitter(common, arguments, *registry, dag, common.shared_store());
  if (!submitter.plan_round()) {
    std::printf("nothing to export: %zu nodes are done\n", submitter.done());
    return 0;
  }
  submitter.pack_round({});
  std::error_code error;
  for (const char* name : {"", "/units", "/status", "/log", "/done", "/profile"}) {
    fs::create_directories(folder + name, error);
    if (error) {
      throw Error(ExitCode::store, "cannot make " + folder + name + ": " + error.message(),
                  "choose a folder that can be written");
    }
  }
  if (!fs::is_empty(folder + "/done", error)) {
    throw Error(ExitCode::usage, folder + " holds a workflow that has run",
                "units have numbers that mean others now: choose a new folder, or remove this one; results "
                "are in the store");
  }
  submitter.write_units(folder);
  Json units = Json::object();
  const std::vector<UnitArray>& arrays = submitter.arrays();
  std::map<std::string, std::string> unit_of;  // by path
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    for (std::size_t u = 0; u < arrays[a].units.size(); ++u) {
      for (const std::size_t i : arrays[a].units[u].nodes) unit_of[dag.nodes[i].path] = unit_name(a, u);
    }
  }
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    const SubmittedArray& resources = submitter.current().arrays[a];
    for (std::size_t u = 0; u < arrays[a].units.size(); ++u) {
      std::set<std::string> needs;
      for (const std::size_t i : arrays[a].units[u].nodes) {
        for (const auto& [slot, edge] : dag.nodes[i].inputs) {
          const auto unit = unit_of.find(dag.nodes[edge.node].path);
          if (unit != unit_of.end() && unit->second != unit_name(a, u)) needs.insert(unit->second);
        }
      }
      units[unit_name(a, u)] = {{"needs", needs},
                                {"threads", resources.threads},
                                {"mem_mb", resources.memory >> 20},
                                {"minutes", resources.minutes}};
    }
  }
  // In the folder of who exports: files of the graph may be relative to it.
  const std::string run = "cd " + shell_word(submitter.current().folder) +
                          " && BALLFLOW_CACHE=\"${BALLFLOW_CACHE:-${TMPDIR:-/tmp}/ballflow-$(id -u)}\" " +
                          submitter.unit_command();
  const Json jobs{{"run", run}, {"units", std::move(units)}};
  write_atomically(folder + "/jobs.json", jobs.dump(1) + '\n');
  write_atomically(folder + "/Snakefile", snakefile);
  write_atomically(folder + "/profile/config.yaml", slurm_profile);
  write_atomically(folder + "/profile/status.sh", slurm_status);
  fs::permissions(folder + "/profile/status.sh", fs::perms::owner_exec, fs::perm_options::add, error);
  std::printf("wrote %s: snakemake -s %s/Snakefile -j8, or with --profile %s/profile\n",
              printable(folder).c_str(), shell_word(folder).c_str(), shell_word(folder).c_str());
  return 0;
}

}  // namespace ballflow::cli
