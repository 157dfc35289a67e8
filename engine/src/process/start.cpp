#include "process/start.hpp"

#include <unistd.h>

#include <condition_variable>
#include <deque>
#include <future>
#include <mutex>
#include <thread>

namespace ballflow {
namespace {

class Starter {
 public:
  Starter() : process_(getpid()) {
    std::thread([this] { work(); }).detach();
  }
  Starter(const Starter&) = delete;
  Starter& operator=(const Starter&) = delete;

  /// In a copy of the process that fork() has made there is no thread.
  bool is_here() const { return process_ == getpid(); }

  pid_t start(const std::function<pid_t()>& what) {
    std::packaged_task<pid_t()> task(what);
    std::future<pid_t> result = task.get_future();
    {
      const std::lock_guard lock(mutex_);
      tasks_.push_back(std::move(task));
    }
    added_.notify_one();
    return result.get();
  }

 private:
  [[noreturn]] void work() {
    for (;;) {
      std::unique_lock lock(mutex_);
      added_.wait(lock, [this] { return !tasks_.empty(); });
      std::packaged_task<pid_t()> task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
    }
  }

  const pid_t process_;
  std::mutex mutex_;
  std::condition_variable added_;
  std::deque<std::packaged_task<pid_t()>> tasks_;
};

}  // namespace

pid_t start_in_lasting_thread(const std::function<pid_t()>& start) {
  static std::mutex mutex;
  static Starter* starter = nullptr;  // never destroyed: its thread ends with the process
  Starter* mine = nullptr;
  {
    const std::lock_guard lock(mutex);
    if (starter == nullptr || !starter->is_here()) starter = new Starter;
    mine = starter;
  }
  return mine->start(start);
}

}  // namespace ballflow
