// leases/: which runs are alive. The promises are in ballflow/gc.hpp.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ballflow/gc.hpp"
#include "store/folders.hpp"

namespace ballflow {

struct LiveRuns {
  std::uint64_t count = 0;
  std::int64_t since = INT64_MAX;  // the start of the oldest, in nanoseconds since 1970
  std::vector<UnseenRun> unseen;   // counted, but perhaps dead
};

/// Under the lock of leases. `remove_dead`: also the files of those that are dead.
LiveRuns live_runs(const StoreFolders& folders, bool remove_dead);

/// The name of the lock, in locks/, under which leases are taken and files are removed.
inline constexpr const char* leases_lock = "leases";

}  // namespace ballflow
