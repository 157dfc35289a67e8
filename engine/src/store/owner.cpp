#include "store/owner.hpp"

#include <unistd.h>

#include <charconv>

#include "base/draft.hpp"

namespace ballflow {

std::string owned_name(FileSystem& files) {
  return files.machine() + '-' + std::to_string(::getpid()) + '-' + random_hex();
}

std::optional<Owner> owner_of(const std::string& name) {
  // Taken apart from the end: names of hosts may contain '-'.
  const std::size_t random = name.rfind('-');
  if (random == std::string::npos || random == 0) return std::nullopt;
  const std::size_t pid = name.rfind('-', random - 1);
  if (pid == std::string::npos || pid == 0) return std::nullopt;
  Owner owner;
  owner.machine = name.substr(0, pid);
  owner.host = host_of(owner.machine);
  const char* const end = name.data() + random;
  const auto parsed = std::from_chars(name.data() + pid + 1, end, owner.process);
  if (parsed.ec != std::errc() || parsed.ptr != end || owner.process <= 0) return std::nullopt;
  if (owner.machine.find('-') == std::string::npos) return std::nullopt;
  return owner;
}

std::string host_of(const std::string& machine) { return machine.substr(0, machine.rfind('-')); }

Maker::Maker() : process_(::getpid()) {}
bool Maker::is_this_process() const { return ::getpid() == process_; }

}  // namespace ballflow
