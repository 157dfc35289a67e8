#include "cluster/submission.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "ballflow/output_file.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

constexpr int format = 1;

std::optional<std::string> text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

Json to_json(const Submission& submission) {
  Json arrays = Json::array(), grown = Json::object();
  for (const SubmittedArray& array : submission.arrays) {
    arrays.push_back({{"units", array.units},
                      {"memory", array.memory},
                      {"minutes", array.minutes},
                      {"threads", array.threads},
                      {"seconds", array.seconds},
                      {"job", array.job}});
  }
  for (const auto& [path, growth] : submission.grown) grown[path] = {growth.memory, growth.time};
  return {{"format", format},
          {"run", submission.run},
          {"command", submission.command},
          {"folder", submission.folder},
          {"graph", submission.graph},
          {"same", submission.same},
          {"known", submission.known},
          {"types", submission.types},
          {"arrays", std::move(arrays)},
          {"grown", std::move(grown)}};
}

Submission from_json(const Json& json) {
  Submission submission;
  submission.run = json.at("run");
  submission.command = json.at("command");
  submission.folder = json.at("folder");
  submission.graph = json.at("graph");
  submission.same = json.at("same");
  submission.known = json.at("known");
  for (const auto& [type, count] : json.at("types").items()) submission.types[type] = count;
  for (const Json& from : json.at("arrays")) {
    SubmittedArray& to = submission.arrays.emplace_back();
    to.units = from.at("units");
    to.memory = from.at("memory");
    to.minutes = from.at("minutes");
    to.threads = from.at("threads");
    to.seconds = from.at("seconds");
    to.job = from.at("job");
  }
  for (const auto& [path, growth] : json.at("grown").items())
    submission.grown[path] = {growth.at(0), growth.at(1)};
  return submission;
}

std::optional<Submission> read_file(const std::string& path) {
  const auto text = text_of(path);
  if (!text) return std::nullopt;
  try {
    return from_json(Json::parse(*text));
  } catch (const Json::exception& error) {
    throw Error(ExitCode::store, path + " is damaged: " + error.what(),
                "results are not in it: remove its folder and submit the graph again");
  }
}

}  // namespace

std::vector<std::string> Submission::jobs() const {
  std::vector<std::string> all;
  for (const SubmittedArray& array : arrays) {
    if (!array.job.empty()) all.push_back(array.job);
  }
  return all;
}

Submissions::Submissions(const std::string& store)
    : root_((fs::absolute(store) / "submissions").lexically_normal().string()) {}

void Submissions::make(const std::string& run) const {
  struct stat status {};
  const std::string store = fs::path(root_).parent_path().string();
  const mode_t mode = ::stat(store.c_str(), &status) == 0 ? status.st_mode & 07777 : 0755;
  // The others of the group submit here, too, whatever the umask.
  if (::mkdir(root_.c_str(), mode) == 0) ::chmod(root_.c_str(), mode);
  for (const char* name : {"", "/units", "/status", "/log"}) {
    std::error_code error;
    fs::create_directory(folder(run) + name, error);
    if (!error) continue;
    throw Error(ExitCode::store, "cannot make " + folder(run) + name + ": " + error.message(),
                "choose a store that can be written");
  }
}

void Submissions::write(const Submission& submission) const {
  write_atomically(folder(submission.run) + "/submission.json", to_json(submission).dump(1) + '\n');
  if (!submission.same.empty()) write_atomically(root_ + "/of-" + submission.same, submission.run);
}

Submission Submissions::read(const std::string& run) const {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(root_, ignored)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory(ignored) && (run == "latest" || name.starts_with(run))) found.push_back(name);
  }
  std::sort(found.begin(), found.end());
  if (run == "latest" && !found.empty()) found.erase(found.begin(), found.end() - 1);
  if (found.size() > 1 && found.front() == run) found.erase(found.begin() + 1, found.end());
  if (found.size() == 1) {
    if (auto submission = read_file(folder(found[0]) + "/submission.json")) return *submission;
  }
  throw Error(ExitCode::usage,
              found.size() > 1 ? "\"" + run + "\" is the beginning of several runs below " + root_
                               : "there is no run \"" + run + "\" below " + root_,
              "\"ballflow submit\" prints the names of runs; --store is the one of the submission");
}

Unit Submissions::unit(const std::string& run, const std::string& name, const Registry& registry) const {
  const std::string path = folder(run) + "/units/" + name + ".json";
  if (const auto text = text_of(path)) return read_unit(*text, registry);
  throw Error(ExitCode::store, "cannot read the unit " + path, "submit the graph again");
}

std::optional<Submission> Submissions::latest_of(const std::string& same) const {
  const auto run = text_of(root_ + "/of-" + same);
  return run ? read_file(folder(*run) + "/submission.json") : std::nullopt;
}

std::map<std::string, double> Submissions::usual_seconds() const {
  constexpr std::size_t most_runs = 8;
  std::size_t files = 100;
  std::vector<std::string> runs;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(root_, ignored)) {
    if (entry.is_directory(ignored)) runs.push_back(entry.path().filename().string());
  }
  std::sort(runs.rbegin(), runs.rend());  // names begin with the time
  if (runs.size() > most_runs) runs.resize(most_runs);
  std::map<std::string, std::pair<double, double>> sums;  // seconds, nodes
  const auto add = [&](const std::string& run, std::size_t array, std::size_t task) {
    if (files == 0) return;
    --files;
    const auto status = read_status(folder(run), unit_name(array, task));
    for (const NodeState& node : status ? status->nodes : std::vector<NodeState>()) {
      if (node.status != "run") continue;
      auto& [seconds, nodes] = sums[node.type];
      seconds += node.seconds;
      ++nodes;
    }
  };
  for (const std::string& run : runs) {
    try {
      const auto submission = read_file(folder(run) + "/submission.json");
      for (std::size_t a = 0; submission && a < submission->arrays.size(); ++a) {
        const std::size_t units = std::max<std::size_t>(submission->arrays[a].units, 1);
        for (const std::size_t task : std::set<std::size_t>{0, units / 2, units - 1}) add(run, a, task);
      }
    } catch (const Error&) {  // a damaged record says nothing
    }
  }
  std::map<std::string, double> usual;
  for (const auto& [type, sum] : sums) usual[type] = sum.first / sum.second;
  return usual;
}

namespace {

/// Files of jobs make their folders younger, so that no task's file has to be looked at.
fs::file_time_type last_written(const fs::path& run) {
  fs::file_time_type latest = fs::file_time_type::min();
  for (const char* name : {"", "submission.json", "units", "status", "log"}) {
    std::error_code failed;
    const fs::file_time_type written = fs::last_write_time(run / name, failed);
    if (!failed) latest = std::max(latest, written);
  }
  return latest;
}

}  // namespace

SubmissionsCollected Submissions::collect(std::int64_t older_than, bool dry_run,
                                          const std::function<bool(const Submission&)>& is_active) const {
  SubmissionsCollected done;
  const fs::file_time_type older = fs::file_time_type::clock::now() - std::chrono::seconds(older_than);
  const auto may_go = [&](const fs::path& run) {
    if (last_written(run) >= older) return false;
    try {
      const auto submission = read_file((run / "submission.json").string());
      return !submission || !is_active(*submission);
    } catch (const Error&) {  // damaged: of no use to anybody
      return true;
    }
  };
  std::vector<fs::path> runs, pointers;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(root_, failed)) {
    const fs::file_status status = entry.symlink_status(failed);
    if (fs::is_directory(status)) runs.push_back(entry.path());
    if (fs::is_regular_file(status) && entry.path().filename().string().starts_with("of-"))
      pointers.push_back(entry.path());
  }
  std::sort(runs.begin(), runs.end());
  for (const fs::path& run : runs) {
    if (!may_go(run)) {
      ++done.left;
      continue;
    }
    failed.clear();
    if (!dry_run) fs::remove_all(run, failed);
    ++(failed ? done.left : done.removed);
    if (failed && done.why.empty()) done.why = run.string() + ": " + failed.message();
  }
  for (const fs::path& pointer : pointers) {
    const auto run = text_of(pointer.string());
    if (!dry_run && run && !fs::exists(folder(*run), failed)) fs::remove(pointer, failed);
  }
  return done;
}

std::string unit_name(std::size_t array, std::size_t task) {
  return std::to_string(array) + '-' + std::to_string(task);
}

namespace {

std::string status_file(const std::string& run_folder, const std::string& unit, const char* extension) {
  return run_folder + "/status/" + unit + extension;
}

void write_status_file(const std::string& path, const std::string& unit, const UnitStatus& status) {
  Json nodes = Json::array();
  for (const NodeState& node : status.nodes) {
    Json json{{"path", node.path}, {"type", node.type}, {"status", node.status}};
    if (node.key) json["key"] = node.key->hex();
    if (!node.cause.empty()) json["cause"] = node.cause;
    if (!node.text.empty()) json["text"] = node.text;
    if (node.seconds > 0) json["seconds"] = node.seconds;
    nodes.push_back(std::move(json));
  }
  const Json json{{"format", format},
                  {"unit", unit},
                  {"exit_code", status.exit_code},
                  {"seconds", status.seconds},
                  {"out_of_time", status.out_of_time},
                  {"host", status.host},
                  {"job", status.job},
                  {"of", status.of},
                  {"nodes", std::move(nodes)}};
  write_atomically(path, json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n');
}

std::optional<UnitStatus> read_status_file(const std::string& path) {
  const auto text = text_of(path);
  if (!text) return std::nullopt;
  try {
    const Json json = Json::parse(*text);
    UnitStatus status;
    status.exit_code = json.at("exit_code");
    status.seconds = json.at("seconds");
    status.out_of_time = json.value("out_of_time", false);
    status.host = json.at("host");
    status.job = json.at("job");
    status.of = json.value("of", std::size_t{0});
    for (const Json& from : json.at("nodes")) {
      NodeState& to = status.nodes.emplace_back();
      to.path = from.at("path");
      to.type = from.at("type");
      to.status = from.at("status");
      if (from.contains("key")) to.key = Digest::from_hex(from.at("key").get<std::string>());
      to.cause = from.value("cause", "");
      to.text = from.value("text", "");
      to.seconds = from.value("seconds", 0.0);
    }
    return status;
  } catch (const Json::exception&) {  // a hint only, and a bad one: as good as none
    return std::nullopt;
  }
}

}  // namespace

void write_status(const std::string& run_folder, const std::string& unit, const UnitStatus& status) {
  write_status_file(status_file(run_folder, unit, ".json"), unit, status);
  std::error_code ignored;
  fs::remove(status_file(run_folder, unit, ".part"), ignored);
}

std::optional<UnitStatus> read_status(const std::string& run_folder, const std::string& unit) {
  return read_status_file(status_file(run_folder, unit, ".json"));
}

void write_progress(const std::string& run_folder, const std::string& unit, const UnitStatus& status) {
  write_status_file(status_file(run_folder, unit, ".part"), unit, status);
}

std::optional<UnitStatus> read_progress(const std::string& run_folder, const std::string& unit) {
  std::error_code ignored;
  if (fs::exists(status_file(run_folder, unit, ".json"), ignored)) return std::nullopt;
  return read_status_file(status_file(run_folder, unit, ".part"));
}

std::string log_tail(const std::string& run_folder, const std::string& unit, std::size_t lines) {
  const auto text = text_of(run_folder + "/log/" + unit + ".out");
  if (!text) return {};
  std::size_t at = text->size();
  if (at > 0 && text->back() == '\n') --at;
  while (lines-- > 0 && at != std::string::npos && at > 0) at = text->rfind('\n', at - 1);
  return text->substr(at == std::string::npos || at == 0 ? 0 : at + 1);
}

}  // namespace ballflow
