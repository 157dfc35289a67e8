#include "output_folder.hpp"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "ballflow/report.hpp"
#include "export/export.hpp"
#include "terminal.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = ".ballflow-outputs.json";

/// Size and time of a file, as recorded beside the digest it was made from.
Json stamp(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return nullptr;
  return {{"size", static_cast<std::int64_t>(info.st_size)},
          {"mtime_ns", static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec}};
}

Json read_record(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  Json record = Json::parse(text.str(), nullptr, false);
  return record.is_object() ? record : Json::object();
}

}  // namespace

std::vector<WrittenFile> write_outputs(const std::string& folder, const Dag& dag, const RunResult& result,
                                       const std::map<std::string, std::string>& formats,
                                       const std::function<ArtifactPtr(const EdgeRef&)>& load) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw Error(ExitCode::store, "cannot create the folder " + folder + ": " + error.message(),
                "choose a folder that can be written with --out; what was computed is in the cache");
  }
  const fs::path record_path = fs::path(folder) / record_name;
  const Json before = read_record(record_path);
  Json record = Json::object();
  std::vector<WrittenFile> files;
  for (const DagOutput& output : dag.outputs) {
    const OutputEntry* entry = nullptr;
    for (const OutputEntry& candidate : result.nodes[output.from.node].outputs) {
      if (candidate.port == output.from.port) entry = &candidate;
    }
    if (entry == nullptr) continue;  // its node failed
    const auto chosen = formats.find(output.name);
    const std::string format = chosen != formats.end() ? chosen->second : default_format(entry->type);
    const std::string path = (fs::path(folder) / (output.name + "." + format)).string();
    Json made = {{"digest", entry->digest.hex()}, {"format", format}};
    if (const Json now = stamp(path); !now.is_null()) made.update(now);
    const bool current = before.contains(path) && before.at(path) == made && made.contains("size");
    if (!current) {
      export_artifact(*load(output.from), path, format);
      made.update(stamp(path));
    }
    record[path] = std::move(made);
    files.push_back({output.name, path, describe(*entry), !current});
  }
  if (record != before) write_atomically(record_path.string(), record.dump(1));
  return files;
}

}  // namespace ballflow::cli
