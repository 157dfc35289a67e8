#include "store/run_records.hpp"

#include <algorithm>

#include "ballflow/error.hpp"

namespace ballflow {
namespace {

OpenFile open_run(const StoreFolders& folders, const std::string& name) {
  return {*folders.files, folders.files->open(folders.runs.get(), name, folder_flags)};
}

}  // namespace

bool put_run_record(const StoreFolders& folders, Publisher& publisher, const std::string& id,
                    const std::vector<std::pair<std::string, std::string>>& files) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
           c == '_' || c == '-';
  };
  if (id.empty() || id.front() == '.' || !std::all_of(id.begin(), id.end(), plain)) {
    throw Error(ExitCode::store, "\"" + id + "\" cannot be the name of a run folder");
  }
  if (!folders.writing || folders.files->make_folder(folders.runs.get(), id, folder_mode) < 0) return false;
  {
    const OpenFile folder = open_run(folders, id);
    const auto publish = [&](const auto& file) { return publisher.publish(folder, file.first, file.second); };
    if (folder.is_open() && std::all_of(files.begin(), files.end(), publish)) return true;
  }
  remove_run(folders, id);
  return false;
}

std::vector<RunFolder> run_folders(const StoreFolders& folders) {
  std::vector<RunFolder> found;
  for (const std::string& name : names_in(folders, folders.runs)) {
    const OpenFile folder = open_run(folders, name);
    struct stat status {};
    if (!folder.is_open() || folders.files->status(folder.get(), status) < 0) continue;
    RunFolder& run = found.emplace_back();
    run.name = name;
    run.ended = nanoseconds(status.st_mtim);
    for (const std::string& file : names_in(folders, folder)) {
      if (folders.files->status(folder.get(), file, status) == 0)
        run.bytes += disk_bytes(static_cast<std::uint64_t>(status.st_size));
    }
  }
  std::sort(found.begin(), found.end(), [](const RunFolder& a, const RunFolder& b) {
    return a.ended != b.ended ? a.ended < b.ended : a.name < b.name;
  });
  return found;
}

void remove_run(const StoreFolders& folders, const std::string& name) {
  {
    const OpenFile folder = open_run(folders, name);
    if (!folder.is_open()) return;
    // The report first: without it the run does not count.
    folders.files->remove(folder.get(), report_name);
    for (const std::string& file : names_in(folders, folder)) folders.files->remove(folder.get(), file);
  }
  folders.files->remove_folder(folders.runs.get(), name);
}

bool read_run_file(const StoreFolders& folders, const std::string& id, const char* name, std::size_t limit,
                   std::string& text) {
  const OpenFile folder = open_run(folders, id);
  if (!folder.is_open()) return false;
  struct stat status {};
  if (folders.files->status(folder.get(), status) < 0 || !distrust(status).empty()) return false;
  const OpenFile file(*folders.files, folders.files->open(folder.get(), name, file_flags));
  if (!file.is_open() || folders.files->status(file.get(), status) < 0) return false;
  if (!S_ISREG(status.st_mode) || !distrust(status).empty()) return false;
  text.assign(std::min(limit, static_cast<std::size_t>(status.st_size)), '\0');
  for (std::size_t have = 0; have < text.size();) {
    const ssize_t got = folders.files->read(file.get(), text.data() + have, text.size() - have);
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace ballflow
