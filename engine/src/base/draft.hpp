// A file that nobody sees before it is whole: written under a temporary name, then moved into its place. All
// files that appear at once are written by this: those of the store and the user's.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>

#include "base/open_file.hpp"

namespace ballflow {

/// 16 hexadecimal digits from the system's source of randomness.
std::string random_hex();

/// "<name>.tmp-<host>-<random>", at most 255 bytes long: no other process and no other host that shares the
/// folder takes the same.
std::string temporary_name(FileSystem& files, const std::string& name);

/// Results are 0 or a negative errno value.
class Draft {
 public:
  /// Makes the file `name` in an open folder, which outlives the draft. Exclusively: what is there under this
  /// name, a link too, is neither followed nor changed (-EEXIST).
  Draft(FileSystem& files, int folder, std::string name, mode_t mode);
  /// Removes the file unless it was published.
  ~Draft();
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;

  /// How making it went.
  int made() const { return file_.is_open() ? 0 : file_.get(); }
  /// All bytes. `give_up` is polled every few megabytes; -ECANCELED when it said so.
  int write(std::span<const std::byte> bytes, const std::function<bool()>& give_up = {});
  /// Flushes to the disk.
  int sync();
  /// Moves it into another open folder, once, last. Without `replace`, -EEXIST when something is there.
  int publish(int folder, const std::string& name, bool replace);

 private:
  FileSystem& files_;
  int folder_;
  std::string name_;
  OpenFile file_;
  bool there_ = false;  // under its temporary name
};

}  // namespace ballflow
