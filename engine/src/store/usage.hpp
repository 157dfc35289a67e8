// The file `usage`: how much is in the store, roughly, so that nobody has to count it after every run. Its
// grammar is in ballflow/store.hpp.
#pragma once

#include <atomic>
#include <cstdint>

#include "store/folders.hpp"
#include "store/owner.hpp"

namespace ballflow {

/// Counts what this process writes, and adds it to the file now and then and at the end.
class WrittenBytes {
 public:
  explicit WrittenBytes(const StoreFolders& folders) : folders_(folders) {}
  ~WrittenBytes() {
    if (maker_.is_this_process()) account();
  }
  WrittenBytes(const WrittenBytes&) = delete;
  WrittenBytes& operator=(const WrittenBytes&) = delete;

  void add(std::uint64_t file_bytes);
  void account();

 private:
  const StoreFolders& folders_;
  std::atomic<std::uint64_t> bytes_ = 0;  // written and not yet in the file
  Maker maker_;
};

struct Usage {
  bool known = false;
  std::uint64_t bytes = 0;
  bool written = false;      // since the count
  std::int64_t counted = 0;  // nanoseconds since 1970
};
Usage read_usage(const StoreFolders& folders);

/// The result of a count, under the lock of collectors. A reader that sees the file empty counts as if there
/// were none.
void write_usage(const StoreFolders& folders, std::uint64_t bytes);

}  // namespace ballflow
