// Names of files and folders that belong to a process while it lives: "<host>-<boot>-<pid>-<random>".
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "ballflow/file_system.hpp"

namespace ballflow {

struct Owner {
  std::string machine;  // "<host>-<boot>" (FileSystem::machine)
  std::string host;
  pid_t process = 0;
};

/// A new name for this process.
std::string owned_name(FileSystem& files);

/// Nothing when it is no such name.
std::optional<Owner> owner_of(const std::string& name);

/// The name of the host of this machine.
std::string host_of(const std::string& machine);

}  // namespace ballflow
