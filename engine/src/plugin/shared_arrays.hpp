// Arrays in memory that two processes see: a file in memory (memfd), and where in it which array is.
#pragma once

#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/json.hpp"
#include "ballflow/plugin.h"
#include "process/descriptor.hpp"

namespace ballflow {

/// Collects artifacts, then writes their arrays one behind the other. Descriptions and layout are those of
/// _worker.py: {"type", "version", "summary", "arrays": [{"name", "dtype", "shape", "offset"}]}.
class ArraysToShare {
 public:
  /// The artifact's description. Its arrays have to stay until `file` was called.
  Json add(const bf_artifact& artifact);
  /// A sealed file in memory with all arrays. Throws Error (code plugin) when there is no room.
  Descriptor file() const;

 private:
  struct Piece {
    const void* data;
    std::uint64_t size, offset;
  };
  std::vector<Piece> pieces_;
  std::uint64_t end_ = 0;
};

/// What another process has written and nobody can change any more.
class SharedArrays {
 public:
  /// Seals the file and maps it. Throws Error (code plugin) where that process still holds it open for
  /// writing, or it is no file in memory.
  explicit SharedArrays(Descriptor file);
  /// The arrays that `described` (a list as above) says are in it; each keeps the memory until it is
  /// released. Any JSON may be given: throws Error (code plugin) that says what is wrong with it, and what it
  /// returns lies within the file. Names point into `described`.
  std::vector<bf_array> arrays(const Json& described) const;

 private:
  std::shared_ptr<const void> memory_;
  std::uint64_t size_ = 0;
};

}  // namespace ballflow
