#include "cluster/slurm.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>

#include "ballflow/error.hpp"
#include "cluster/program.hpp"

namespace ballflow::slurm {
namespace {

/// Throws Error when the program is not there or fails.
std::string answer(const std::vector<std::string>& words) {
  ProgramResult result = run_program(words);
  if (result.exit_code == 0) return std::move(result.out);
  if (result.exit_code == 127) {
    throw Error(ExitCode::store, words[0] + " is not on the path",
                "submit where Slurm is installed, on a login node of the cluster");
  }
  while (!result.err.empty() && result.err.back() == '\n') result.err.pop_back();
  throw Error(ExitCode::store, words[0] + " failed: " + result.err,
              "see whether \"sinfo\" shows a cluster that is up, and what it allows");
}

std::string joined(const std::vector<std::string>& words, char separator) {
  std::string text;
  for (const std::string& word : words) {
    if (!text.empty()) text.push_back(separator);
    text.append(word);
  }
  return text;
}

struct Line {
  std::string id, state, reason;
};

/// Of tasks that have not ended, or with `all` of ended ones, too.
std::vector<Line> lines_of(const std::vector<std::string>& jobs, bool all = false) {
  std::vector<Line> lines;
  if (jobs.empty()) return lines;
  // Jobs that ended long ago are forgotten; squeue knows none of these ids then and says so as an error.
  std::vector<std::string> words{"squeue", "--noheader", "--array", "--jobs=" + joined(jobs, ','),
                                 "--format=%i|%T|%r"};
  if (all) words.push_back("--states=all");
  ProgramResult result = run_program(words);
  if (result.exit_code != 0) {
    if (result.err.find("Invalid job id") != std::string::npos) return lines;
    answer(words);  // throws, unless it answers the second time
    result = run_program(words);
  }
  std::istringstream in(result.out);
  for (std::string text; std::getline(in, text);) {
    const std::size_t first = text.find('|'), second = text.find('|', first + 1);
    if (second == std::string::npos) continue;
    lines.push_back(
        {text.substr(0, first), text.substr(first + 1, second - first - 1), text.substr(second + 1)});
  }
  return lines;
}

bool is_held(const Line& line) {
  return line.state == "PENDING" &&
         (line.reason.find("held") != std::string::npos || line.reason.find("Held") != std::string::npos);
}

bool is_hopeless(const Line& line) {
  return line.state == "PENDING" && line.reason == "DependencyNeverSatisfied";
}

}  // namespace

Limits limits() {
  const std::string text = answer({"scontrol", "show", "config"});
  const auto number = [&text](const std::string& name, std::uint64_t otherwise) {
    const std::size_t at = text.find("\n" + name);
    const std::size_t equals = at == std::string::npos ? at : text.find('=', at);
    if (equals == std::string::npos) return otherwise;
    const std::uint64_t value = std::strtoull(text.c_str() + equals + 1, nullptr, 10);
    return value == 0 ? otherwise : value;
  };
  const Limits otherwise;
  return {number("MaxArraySize", otherwise.array_size), number("MaxJobCount", otherwise.jobs)};
}

std::vector<std::string> submit_words(const Array& array) {
  std::vector<std::string> words{"sbatch",
                                 "--parsable",
                                 "--array=0-" + std::to_string(array.tasks - 1),
                                 "--job-name=" + array.name,
                                 "--comment=" + array.comment,
                                 "--chdir=" + array.folder,
                                 "--output=" + array.log,
                                 "--open-mode=append",
                                 "--requeue",
                                 "--kill-on-invalid-dep=yes",
                                 "--signal=B:USR1@60",
                                 "--cpus-per-task=" + std::to_string(array.threads),
                                 "--mem=" + std::to_string(array.memory >> 20) + "M",
                                 "--time=" + std::to_string(array.minutes)};
  if (!array.after.empty()) {
    words.push_back("--dependency=" + std::string(array.one_to_one ? "aftercorr:" : "afterany:") +
                    joined(array.after, ':'));
  }
  words.insert(words.end(), array.more.begin(), array.more.end());
  words.push_back(array.script);
  words.insert(words.end(), array.script_arguments.begin(), array.script_arguments.end());
  return words;
}

std::string submit(const Array& array) {
  std::string id = answer(submit_words(array));
  return id.substr(0, id.find_first_of(";\n"));  // "<id>;<cluster>" where there are several
}

std::map<std::string, std::string> ends(const std::vector<std::string>& jobs) {
  std::map<std::string, std::string> states;
  try {
    for (const Line& line : lines_of(jobs, true)) states[line.id] = line.state;
  } catch (const Error&) {  // a hint only: logs say it, too
  }
  return states;
}

Tasks tasks(const std::vector<std::string>& jobs) {
  Tasks tasks;
  for (const Line& line : lines_of(jobs)) {
    if (is_held(line)) {
      ++tasks.held;
    } else if (is_hopeless(line)) {
      ++tasks.hopeless;
    } else if (line.state == "PENDING") {
      ++tasks.pending;
    } else {
      ++tasks.running;
    }
  }
  return tasks;
}

void release(const std::vector<std::string>& jobs) {
  std::vector<std::string> hopeless;
  for (const Line& line : lines_of(jobs)) {
    if (is_held(line)) run_program({"scontrol", "release", line.id});
    if (is_hopeless(line)) hopeless.push_back(line.id);
  }
  if (!hopeless.empty()) cancel(hopeless);
}

void cancel(const std::vector<std::string>& jobs) {
  std::vector<std::string> words{"scancel"};
  words.insert(words.end(), jobs.begin(), jobs.end());
  if (!jobs.empty()) answer(words);
}

}  // namespace ballflow::slurm
