// The progress of work that several threads share.
#pragma once

#include <cstddef>
#include <mutex>

#include "base/monitor.hpp"

namespace ballflow::geometry {

/// Shows how much of `total` is done as [begin, end] of the progress of `monitor`, which never goes back
/// whichever thread comes first.
class SharedProgress {
 public:
  SharedProgress(Monitor& monitor, std::size_t total, double begin = 0, double end = 1)
      : monitor_(monitor), total_(static_cast<double>(total)), begin_(begin), end_(end) {}

  /// `work` more is done; throws Cancelled when the result is no longer wanted.
  void advance(std::size_t work) {
    const std::lock_guard lock(mutex_);
    done_ += work;
    monitor_.step(begin_ + (end_ - begin_) * (static_cast<double>(done_) / total_));
  }

 private:
  Monitor& monitor_;
  double total_, begin_, end_;
  std::size_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace ballflow::geometry
