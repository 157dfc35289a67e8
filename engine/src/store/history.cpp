#include "ballflow/history.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include "ballflow/error.hpp"
#include "base/draft.hpp"
#include "base/json_text.hpp"
#include "base/quote.hpp"
#include "store/parts.hpp"
#include "store/run_records.hpp"

namespace ballflow {
namespace {

namespace fs = std::filesystem;

constexpr const char* manifests_name = "manifests.json";
constexpr std::size_t kept_runs = 200,
                      most_runs = 220;  // removed in bunches: looking at 200 folders takes time
constexpr std::size_t time_size = std::string_view("20261122T141503.482").size();
constexpr std::size_t graph_size = 8, random_size = 4;

/// The part of an id that names the graph file.
std::string graph_mark(const std::string& graph_file) {
  std::error_code error;
  const fs::path absolute = fs::weakly_canonical(graph_file, error);
  return sha256(error ? graph_file : absolute.string()).hex().substr(0, graph_size);
}

bool is_run_id(const std::string& name) {
  if (name.size() != time_size + graph_size + random_size + 2) return false;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (i == 8                                              ? c != 'T'
        : i == 15                                           ? c != '.'
        : i == time_size || i == time_size + 1 + graph_size ? c != '-'
        : i < time_size                                     ? c < '0' || c > '9'
                                                            : (c < '0' || c > '9') && (c < 'a' || c > 'f')) {
      return false;
    }
  }
  return true;
}

/// Names of runs, newest first; also of those that are being recorded.
std::vector<std::string> run_ids(const StoreFolders& folders) {
  std::vector<std::string> names = names_in(folders, folders.runs);
  names.erase(std::remove_if(names.begin(), names.end(), [](const auto& name) { return !is_run_id(name); }),
              names.end());
  std::reverse(names.begin(), names.end());
  return names;
}

/// Reads the members before "nodes" and "variants", so that a list of runs need not read reports of
/// megabytes.
class HeaderReader final : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit HeaderReader(RunInfo& info) : info_(info) {}
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return number(value); }
  bool string(string_t& value) override {
    if (depth_ != 1) return true;
    if (key_ == "run") info_.id = value;
    if (key_ == "graph") info_.graph = value;
    if (key_ == "status") info_.status = value;
    return true;
  }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return ++depth_ < 100; }
  bool key(string_t& value) override {
    if (depth_ == 1) key_ = value;
    return depth_ != 1 || (key_ != "nodes" && key_ != "variants");
  }
  bool end_object() override { return --depth_ > 0; }
  bool start_array(std::size_t) override { return ++depth_ < 100; }
  bool end_array() override { return --depth_ > 0; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  bool number(double value) {
    if (depth_ == 1 && key_ == "seconds") info_.seconds = value;
    return true;
  }

  RunInfo& info_;
  int depth_ = 0;
  std::string key_;
};

/// Nothing when the run was not recorded as a whole.
std::optional<RunInfo> read_info(const StoreFolders& folders, const std::string& id) {
  std::string text;
  RunInfo info;
  if (!read_run_file(folders, id, report_name, 1 << 16, text)) return std::nullopt;
  HeaderReader reader(info);
  nlohmann::json::sax_parse(text, &reader);
  if (info.id != id || info.status.empty()) return std::nullopt;
  return info;
}

RunRecord record_of(const std::string& source, const std::string& text) {
  RunRecord record;
  record.source = source;
  record.report = nlohmann::json::parse(text, nullptr, false);
  const auto is_text = [&](const char* key) {
    return record.report.contains(key) && record.report[key].is_string();
  };
  if (!record.report.is_object() || !is_text("run") || !is_text("graph") ||
      !record.report.contains("nodes") || !record.report["nodes"].is_object()) {
    throw Error(ExitCode::store, source + " is no run report", "name a file that --report has written");
  }
  record.id = record.report["run"].get<std::string>();
  return record;
}

std::optional<RunRecord> load_record(Store& store, const StoreFolders& folders, const std::string& id) {
  std::string text;
  if (!read_run_file(folders, id, report_name, SIZE_MAX, text)) return std::nullopt;
  return record_of(store.root() + "/runs/" + id + "/" + report_name, text);
}

std::optional<RunRecord> load_file(const std::string& name) {
  std::error_code ignored;
  fs::path path = name;
  if (fs::is_directory(path, ignored)) path /= report_name;
  if (!fs::exists(path, ignored)) return std::nullopt;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  if (in) text << in.rdbuf();
  if (!in) {
    throw Error(ExitCode::store, "cannot read " + path.string(),
                "check the path and the permissions of the file");
  }
  return record_of(path.string(), text.str());
}

Manifests read_manifests(const StoreFolders& folders, const std::string& id) {
  Manifests manifests;
  std::string text;
  if (!read_run_file(folders, id, manifests_name, SIZE_MAX, text)) return manifests;
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return manifests;
  for (const auto& [path, manifest] : json.items()) {
    if (manifest.is_string()) manifests[path] = manifest.get<std::string>();
  }
  return manifests;
}

/// Foreign text (warnings of nodes, names of files) need not be UTF-8; it must not cost the record.
template <class AnyJson>
std::string text_of(const AnyJson& json, int indent) {
  return json.dump(indent, ' ', false, AnyJson::error_handler_t::replace);
}

}  // namespace

std::string new_run_id(const std::string& graph_file) {
  using namespace std::chrono;
  const auto now = duration_cast<milliseconds>(system_clock::now().time_since_epoch()).count();
  const std::time_t seconds = static_cast<std::time_t>(now / 1000);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%dT%H%M%S.", &utc);
  const std::string milli = std::to_string(1000 + now % 1000).substr(1);
  return text + milli + "-" + graph_mark(graph_file) + "-" + random_hex().substr(0, random_size);
}

std::string start_of_run(const std::string& id) {
  if (!is_run_id(id)) return {};
  return id.substr(0, 4) + "-" + id.substr(4, 2) + "-" + id.substr(6, 2) + "T" + id.substr(9, 2) + ":" +
         id.substr(11, 2) + ":" + id.substr(13, 6) + "Z";
}

bool save_run(Store& store, const std::string& id, const Manifests& manifests, const Json& report) {
  if (store.read_only() || !is_run_id(id)) return false;
  const nlohmann::json by_path = manifests;  // not ordered_json: that looks a name up by linear search
  const bool saved =
      store.put_run(id, {{manifests_name, text_of(by_path, -1)}, {report_name, text_of(report, 1)}});
  const StoreFolders& folders = store.parts().folders;
  if (names_in(folders, folders.runs).size() <= most_runs) return saved;
  const std::vector<RunFolder> all = run_folders(folders);
  for (std::size_t i = 0; i + kept_runs < all.size(); ++i) remove_run(folders, all[i].name);
  return saved;
}

std::vector<RunInfo> list_runs(Store& store, std::size_t limit) {
  const StoreFolders& folders = store.parts().folders;
  std::vector<RunInfo> runs;
  for (const std::string& id : run_ids(folders)) {
    if (runs.size() >= limit) break;
    if (auto info = read_info(folders, id)) runs.push_back(std::move(*info));
  }
  return runs;
}

RunRecord find_run(Store& store, const std::string& name, const std::string& graph_file) {
  const StoreFolders& folders = store.parts().folders;
  std::vector<std::string> ids = run_ids(folders);
  const auto recorded = [&](const std::string& id) { return read_info(folders, id).has_value(); };
  const std::string where = store.root().empty() ? "there is no cache" : "the history of " + store.root();
  if (name == "latest" || name == "previous") {
    const std::string mark = graph_file.empty() ? "" : "-" + graph_mark(graph_file) + "-";
    std::size_t older = name == "latest" ? 0 : 1;
    for (const std::string& id : ids) {
      if (!mark.empty() && id.compare(time_size, mark.size(), mark) != 0) continue;
      if (!recorded(id) || older-- != 0) continue;
      if (auto record = load_record(store, folders, id)) return std::move(*record);
    }
    const std::string what = graph_file.empty() ? "run" : "run of " + graph_file;
    throw Error(ExitCode::usage,
                store.root().empty() ? "no " + name + " " + what + ": " + where
                                     : "there is no " + name + " " + what + " in " + where,
                "\"ballflow runs\" lists what was recorded; a report file can be named instead");
  }

  std::vector<std::string> matches;
  if (!name.empty()) {
    for (const std::string& id : ids) {
      if (id.compare(0, name.size(), name) == 0 && recorded(id)) matches.push_back(id);
    }
  }
  if (matches.size() == 1) {
    if (auto record = load_record(store, folders, matches.front())) return std::move(*record);
  }
  if (auto record = load_file(name)) return std::move(*record);
  if (matches.size() > 1) {
    throw Error(ExitCode::usage,
                "\"" + printable(name) + "\" is the beginning of " + std::to_string(matches.size()) +
                    " runs: " + listed(matches, 3),
                "give more of the id");
  }
  ids.erase(std::remove_if(ids.begin(), ids.end(), [&](const auto& id) { return !recorded(id); }), ids.end());
  std::vector<std::string> known = ids;
  known.insert(known.end(), {"latest", "previous"});
  std::string hint = did_you_mean(name, known);
  if (hint.empty() && !ids.empty())
    hint = "the newest are " + listed(ids, 3) + "; \"ballflow runs\" lists all";
  if (hint.empty()) hint = "name a report file, or run something first";
  throw Error(ExitCode::usage,
              "there is no run and no report file " + in_quotes(name) +
                  (store.root().empty() ? " (" + where + ")"
                                        : " (" + where + " has " + std::to_string(ids.size()) + " runs)"),
              hint);
}

Manifests run_manifests(Store& store, const std::string& id) {
  return is_run_id(id) ? read_manifests(store.parts().folders, id) : Manifests();
}

Manifests latest_manifests(Store& store, const std::string& graph_file) {
  const StoreFolders& folders = store.parts().folders;
  const std::string mark = "-" + graph_mark(graph_file) + "-";
  for (const std::string& id : run_ids(folders)) {
    if (id.compare(time_size, mark.size(), mark) != 0) continue;
    Manifests manifests = read_manifests(folders, id);
    if (!manifests.empty()) return manifests;
  }
  return {};
}

}  // namespace ballflow
