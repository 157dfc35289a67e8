// What /proc says about the mounts of this machine, and what that means for locks.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ballflow/file_system.hpp"

namespace ballflow {

/// The mount of this number in the text of /proc/self/mountinfo (proc(5)); nothing when it is not there.
std::optional<Mount> find_mount(std::string_view mountinfo, long id);

/// The option of a mount ("local_lock=flock") because of which its flock excludes processes of this host
/// only, although other hosts may have the same files; empty when locks reach as far as the files.
std::string host_local_locks(const Mount& mount);

}  // namespace ballflow
