#include "run/key_waits.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace ballflow {
namespace {

using namespace std::chrono_literals;
constexpr auto first_pause = 1ms, longest_pause = 20ms;

}  // namespace

KeyWaits::KeyWaits(Store& store, bool background, std::function<bool()> give_up)
    : store_(store), background_(background), give_up_(std::move(give_up)) {}

KeyWaits::~KeyWaits() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void KeyWaits::add(const Digest& key, std::function<void()> go_on) {
  const std::lock_guard lock(mutex_);
  if (background_ && !thread_.joinable()) thread_ = std::thread([this] { ask_in_background(); });
  waiting_.push_back({key, std::move(go_on)});
  changed_.notify_all();
}

bool KeyWaits::wait() {
  for (auto pause = first_pause;; pause = std::min(2 * pause, longest_pause)) {
    {
      const std::lock_guard lock(mutex_);
      if (waiting_.empty()) return false;
    }
    if (let_on()) return true;
    std::this_thread::sleep_for(pause);
  }
}

void KeyWaits::ask_in_background() {
  auto pause = first_pause;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      if (waiting_.empty()) {
        changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
        pause = first_pause;
      } else {
        changed_.wait_for(lock, pause, [this] { return ended_; });
        pause = std::min(2 * pause, longest_pause);
      }
      if (ended_) return;
    }
    let_on();
  }
}

/// Lets those on whose key is free; whether there were any. The lock is not handed over: who gets on looks
/// whether the other process has left a result, and takes the lock again when it has memory.
bool KeyWaits::let_on() {
  std::vector<Waiting> asked, on;
  {
    const std::lock_guard lock(mutex_);
    asked.swap(waiting_);
  }
  const bool all = give_up_();
  const auto busy = std::partition(asked.begin(), asked.end(),
                                   [&](const Waiting& one) { return all || !store_.try_lock(one.key).busy; });
  {
    const std::lock_guard lock(mutex_);
    std::move(busy, asked.end(), std::back_inserter(waiting_));
  }
  asked.erase(busy, asked.end());
  for (Waiting& one : asked) one.go_on();
  return !asked.empty();
}

}  // namespace ballflow
