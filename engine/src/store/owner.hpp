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

/// Who made something on disk. A process that was forked from it has it in memory as well, and is not to
/// remove it.
class Maker {
 public:
  Maker();
  bool is_this_process() const;

 private:
  pid_t process_;
};

/// The name of the host of this machine.
std::string host_of(const std::string& machine);

}  // namespace ballflow
