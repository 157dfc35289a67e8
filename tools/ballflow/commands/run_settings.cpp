#include "ballflow/text.hpp"
#include "commands/commands.hpp"

namespace ballflow::cli {

void RunSettings::add_to(const Command& command) {
  command
      .option("--threads", threads,
              "number of threads; 0: all processors that it may use (the result never depends on it)")
      .between(0, 4096);
  command
      .option("--memory", memory,
              "what running nodes and results that are still needed may take together, by estimates of the "
              "nodes:\n"
              "8G, a number of bytes, or 50% of the memory that may be used (default: 80%)")
      .type_name("SIZE");
  command.option("--seed", seed, "seed of the nodes that use random numbers");
  command.flag("--keep-going", keep_going, "after a failure, go on with what does not need the failed node");
  const auto nodes = [&command](const char* name, std::vector<std::string>& list, const char* doc) {
    return command.option(name, list, doc).type_name("NODE").one_at_a_time();
  };
  const Option to = nodes("--until", until, "run this node (or subgraph) and what it needs; may be repeated");
  nodes("--only", only,
        "run this node (or subgraph) alone: what it needs has to be in the cache; may be repeated")
      .excludes(to);
  nodes("--force", force, "compute this node (or subgraph) although it is in the cache; may be repeated");
  command.flag("--strict", strict,
               "exit 3 when a node that is computed again gives another result than before\n"
               "(otherwise a warning: the new result replaces the old one)");
  command.flag("--check-determinism", check_determinism,
               "run every node again, with one thread and with several, and say where the results differ");
}

RunOptions RunSettings::options(const Dag& dag) const {
  RunOptions result;
  result.threads = threads;
  result.seed = seed;
  result.keep_going = keep_going;
  result.strict = strict;
  result.check_determinism = check_determinism;
  if (!memory.empty()) {
    const auto bytes = parse_memory(memory);
    if (!bytes) {
      throw Error(ExitCode::usage, "--memory " + memory + ": not a size",
                  "write it as 8G, 800M, a number of bytes, or 50%");
    }
    result.memory_bytes = *bytes;
  }
  for (const std::string& name : until) result.until.merge(nodes_named(dag, name));
  for (const std::string& name : only) result.only.merge(nodes_named(dag, name));
  for (const std::string& name : force) result.force.merge(nodes_named(dag, name));
  return result;
}

std::string RunSettings::words() const {
  std::string text;
  if (seed != 0) text += " --seed " + std::to_string(seed);
  for (const std::string& name : until) text += " --until " + shell_word(name);
  for (const std::string& name : only) text += " --only " + shell_word(name);
  return text;
}

}  // namespace ballflow::cli
