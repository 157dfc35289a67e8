// A node library of which only the declarations are known yet.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "ballflow/plugin.h"
#include "base/file_state.hpp"
#include "plugin/outline.hpp"

namespace ballflow {

/// Opens the library at `real_path` (absolute, no link), never to close it: artifacts, declarations and
/// thread-local destructors point into it. `state` is what the file must be in before and afterwards. Gives
/// the table, or says in `why` what is wrong. A file that was replaced after this process opened it: the
/// loader gives what it has, as for library_digest.
const bf_plugin* open_library(const std::string& real_path, const FileState& state, std::string& why);

/// Whether this process opened the library in another state of its file, whose code it keeps.
bool was_opened_otherwise(const std::string& real_path, const FileState& state);

class LazyLibrary {
 public:
  LazyLibrary(std::string real_path, const FileState& state, std::shared_ptr<const LibraryOutline> outline)
      : path_(std::move(real_path)), state_(state), outline_(std::move(outline)) {}
  LazyLibrary(const LazyLibrary&) = delete;
  LazyLibrary& operator=(const LazyLibrary&) = delete;

  /// Opens the library when that has not been done. May be called from several threads at once. Throws Error
  /// (code plugin) when the library cannot be opened, or is not the one whose outline this is.
  const bf_plugin& table() const;

 private:
  const bf_plugin& opened() const;

  std::string path_;
  FileState state_;
  std::shared_ptr<const LibraryOutline> outline_;
  mutable std::mutex mutex_;
  mutable const bf_plugin* table_ = nullptr;
};

}  // namespace ballflow
