// Starting programs from a thread that stays.
#pragma once

#include <sys/types.h>

#include <functional>

namespace ballflow {

/// Calls `start` in a thread that lives as long as this process, and gives what it returns. The kernel ends a
/// child with the *thread* that has started it (PR_SET_PDEATHSIG), and those of a thread pool come and go.
pid_t start_in_lasting_thread(const std::function<pid_t()>& start);

}  // namespace ballflow
