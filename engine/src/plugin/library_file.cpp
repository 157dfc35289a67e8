#include "plugin/library_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>

#include "ballflow/error.hpp"
#include "ballflow/file_system.hpp"

namespace ballflow {

Digest library_digest(const std::string& real_path) {
  static std::mutex mutex;
  static std::map<std::string, Digest> known;
  const std::lock_guard lock(mutex);
  if (const auto found = known.find(real_path); found != known.end()) return found->second;
  const int file = ::open(real_path.c_str(), O_RDONLY | O_CLOEXEC);
  Digest digest;
  FileSystem files;
  const std::int64_t read =
      file < 0 ? -errno : sha256_of_file(files, file, std::numeric_limits<std::uint64_t>::max(), digest);
  if (file >= 0) ::close(file);
  if (read < 0) {
    throw Error(ExitCode::plugin,
                "cannot read the node library " + real_path + ": " + std::strerror(static_cast<int>(-read)));
  }
  return known[real_path] = digest;
}

}  // namespace ballflow
