// Nodes whose key another process computes.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "ballflow/store.hpp"

namespace ballflow {

/// Keeps what is to go on when the lock of a key is free. Those that wait hold no thread, no memory and no
/// lock: all of them are asked for now and then, by one thread that sleeps in between.
class KeyWaits {
 public:
  /// `background`: a thread of its own asks, from the first add() on. Otherwise wait() does. When `give_up`
  /// holds, everything goes on at once.
  KeyWaits(Store& store, bool background, std::function<bool()> give_up);
  ~KeyWaits();
  KeyWaits(const KeyWaits&) = delete;
  KeyWaits& operator=(const KeyWaits&) = delete;

  void add(const Digest& key, std::function<void()> go_on);
  /// Without a background: sleeps until something went on. False when nothing waits.
  bool wait();

 private:
  struct Waiting {
    Digest key;
    std::function<void()> go_on;
  };
  bool let_on();
  void ask_in_background();

  Store& store_;
  const bool background_;
  const std::function<bool()> give_up_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Waiting> waiting_;  // guarded by mutex_
  bool ended_ = false;            // guarded by mutex_
  std::thread thread_;
};

}  // namespace ballflow
