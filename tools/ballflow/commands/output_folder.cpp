#include "commands/output_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ballflow/output_file.hpp"
#include "export/export.hpp"
#include "terminal/terminal.hpp"

namespace ballflow::cli {
namespace {

namespace fs = std::filesystem;

constexpr const char* record_name = ".ballflow-outputs.json";

/// Size and time of a file, as recorded beside the digest it was made from.
nlohmann::json stamp(const std::string& path) {
  struct stat info {};
  if (stat(path.c_str(), &info) != 0) return nullptr;
  return {{"size", static_cast<std::int64_t>(info.st_size)},
          {"mtime_ns", static_cast<std::int64_t>(info.st_mtim.tv_sec) * 1000000000 + info.st_mtim.tv_nsec}};
}

nlohmann::json read_record(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  auto record = nlohmann::json::parse(text.str(), nullptr, false);  // keyed by the names of the files
  return record.is_object() ? record : nlohmann::json::object();
}

/// The name of the file of an output.
std::string file_name(const DagOutput& output, const std::string& type,
                      const std::map<std::string, std::string>& formats, std::string& format) {
  const auto chosen = formats.find(output.base_name());
  format = chosen != formats.end() ? chosen->second : default_format(type);
  return output.name + "." + extension_of(type, format);
}

}  // namespace

void claim_outputs(Places& places, const std::string& folder, const Dag& dag,
                   const std::map<std::string, std::string>& formats) {
  places.writes("--out", (fs::path(folder) / record_name).string());
  for (const DagOutput& output : dag.outputs) {
    std::string format;
    const std::string& type = dag.nodes[output.from.node].kind.output(output.from.port)->type;
    places.writes("the output " + output.name + " of --out",
                  (fs::path(folder) / file_name(output, type, formats, format)).string());
  }
}

void prepare_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && access(folder.c_str(), W_OK | X_OK) != 0) error.assign(errno, std::generic_category());
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (!error) return;
  throw Error(ExitCode::store, "cannot write to the folder " + folder + ": " + error.message(),
              "choose a folder that can be written with --out");
}

WrittenOutputs write_outputs(const std::string& folder, const Dag& dag, const RunResult& result,
                             const std::map<std::string, std::string>& formats,
                             const std::function<ArtifactPtr(const EdgeRef&)>& load) {
  const fs::path record_path = fs::path(folder) / record_name;
  const nlohmann::json before = read_record(record_path);
  nlohmann::json record = before;  // other graphs may write to this folder too
  WrittenOutputs written;
  for (const DagOutput& output : dag.outputs) {
    const OutputEntry* entry = nullptr;
    for (const OutputEntry& candidate : result.nodes[output.from.node].outputs) {
      if (candidate.port == output.from.port) entry = &candidate;
    }
    if (entry == nullptr) continue;  // its node failed
    std::string format;
    const std::string name = file_name(output, entry->type, formats, format);
    const std::string path = (fs::path(folder) / name).string();
    nlohmann::json made = {
        {"digest", entry->digest.hex()}, {"format", format}, {"version", BALLFLOW_VERSION}};
    if (const auto now = stamp(path); !now.is_null()) made.update(now);
    const bool current = before.contains(name) && before.at(name) == made && made.contains("size");
    try {
      if (!current) {
        record.erase(name);
        fs::create_directories(fs::path(path).parent_path());  // of a variant
        export_artifact(*load(output.from), path, format);
        if (const auto now = stamp(path); !now.is_null()) made.update(now);
        record[name] = std::move(made);
      }
      written.files.push_back({output.name, path, describe(*entry), !current});
    } catch (const Error& failure) {
      if (!written.failure) written.failure = failure;
    }
  }
  try {
    if (record != before)
      write_atomically(record_path.string(),
                       record.dump(1, ' ', false, nlohmann::json::error_handler_t::replace));
  } catch (const Error& failure) {
    if (!written.failure) written.failure = failure;
  }
  return written;
}

}  // namespace ballflow::cli
