// runs/: one folder for each recorded run, as files; what is in them is the history's business.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "store/folders.hpp"
#include "store/publisher.hpp"

namespace ballflow {

inline constexpr const char* report_name = "report.json";  // written last: without it there is no record

/// What Store::put_run promises.
bool put_run_record(const StoreFolders& folders, Publisher& publisher, const std::string& id,
                    const std::vector<std::pair<std::string, std::string>>& files);

struct RunFolder {
  std::string name;
  std::uint64_t bytes = 0;  // in blocks of 4 KiB
  std::int64_t ended = 0;   // nanoseconds since 1970
};

/// Everything in runs/, what ended first first.
std::vector<RunFolder> run_folders(const StoreFolders& folders);

void remove_run(const StoreFolders& folders, const std::string& name);

/// A file of a run, at most `limit` bytes of it; false when it is not there or cannot be trusted.
bool read_run_file(const StoreFolders& folders, const std::string& id, const char* name, std::size_t limit,
                   std::string& text);

}  // namespace ballflow
