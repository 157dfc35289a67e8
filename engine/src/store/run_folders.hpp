// The folders of recorded runs, for those who remove them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "store/store_folders.hpp"

namespace ballflow {

struct RunFolder {
  std::string name;
  std::uint64_t bytes = 0;  // in blocks of 4 KiB
  std::int64_t ended = 0;   // nanoseconds since 1970
};

/// Everything in runs/, what ended first first.
std::vector<RunFolder> run_folders(const StoreFolders& folders);

void remove_run(const StoreFolders& folders, const std::string& name);

}  // namespace ballflow
