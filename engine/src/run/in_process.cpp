#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_scheduler_observer.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <memory>
#include <mutex>

#include "base/process_usage.hpp"
#include "run/loop.hpp"
#include "run/node_run.hpp"

namespace ballflow {
namespace {

double seconds_on(clockid_t clock) {
  timespec t{};
  if (clock_gettime(clock, &t) != 0) return 0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// CPU time of all threads while they work in one arena.
class CpuMeter : public tbb::task_scheduler_observer {
 public:
  explicit CpuMeter(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) { observe(true); }
  ~CpuMeter() override { observe(false); }

  void on_scheduler_entry(bool) override {
    const std::lock_guard lock(mutex_);
    inside_.emplace_back(pthread_self(), now(pthread_self()));
  }
  void on_scheduler_exit(bool) override {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = inside_.size(); i-- > 0;) {
      if (pthread_equal(inside_[i].first, pthread_self()) == 0) continue;
      total_ += now(pthread_self()) - inside_[i].second;
      inside_.erase(inside_.begin() + static_cast<std::ptrdiff_t>(i));
      return;
    }
  }
  double total() {
    const std::lock_guard lock(mutex_);
    double sum = total_;
    for (const auto& [thread, start] : inside_) sum += now(thread) - start;
    return sum;
  }

 private:
  static double now(pthread_t thread) {
    clockid_t clock{};
    return pthread_getcpuclockid(thread, &clock) == 0 ? seconds_on(clock) : 0;
  }
  std::mutex mutex_;
  std::vector<std::pair<pthread_t, double>> inside_;
  double total_ = 0;
};

/// Arenas and their meters, each used by one node at a time. They are kept for the next node: making one
/// costs more than running a small node.
class Arenas {
 public:
  struct Arena {
    // One place more than there are threads: a thread of the scheduler that enters an arena counts as one of
    // those that the arena has asked for, and with no other asked for nobody would come to help it.
    explicit Arena(unsigned count)
        : threads(count), arena(static_cast<int>(count > 1 ? count + 1 : 1)), meter(arena) {}
    unsigned threads;
    tbb::task_arena arena;
    CpuMeter meter;
  };

  std::unique_ptr<Arena> take(unsigned threads) {
    {
      const std::lock_guard lock(mutex_);
      for (std::unique_ptr<Arena>& free : free_) {
        if (free->threads != threads) continue;
        std::swap(free, free_.back());
        std::unique_ptr<Arena> arena = std::move(free_.back());
        free_.pop_back();
        return arena;
      }
    }
    return std::make_unique<Arena>(threads);
  }
  void give_back(std::unique_ptr<Arena> arena) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(arena));
  }
  /// Never destroyed: TBB's own threads may end later than static objects.
  static Arenas& instance() {
    static Arenas* const arenas = new Arenas;
    return *arenas;
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<Arena>> free_;
};

/// CPU seconds of this thread, to 50 us. Its clock is a system call, and a small node takes no longer than
/// two of them: up to 50 us after a reading the thread is taken to have worked all the time.
double thread_cpu_seconds() {
  constexpr double between_readings = 50e-6;
  thread_local std::chrono::steady_clock::time_point read_at;
  thread_local double reading = 0;
  const auto now = std::chrono::steady_clock::now();
  const double since = std::chrono::duration<double>(now - read_at).count();
  if (since < between_readings) return reading + since;
  read_at = now;
  return reading = seconds_on(CLOCK_THREAD_CPUTIME_ID);
}

/// Outputs are hashed here, where the node may use several threads and a cancellation is seen.
void execute_and_hash(const ExecutionRequest& request, ExecutionOutcome& outcome) {
  outcome = request.node->kind.loop() != nullptr ? execute_loop(request) : execute_node(request);
  for (const auto& [port, artifact] : outcome.outputs) {
    if (!artifact->hash(request.cancelled)) outcome.status = ExecutionOutcome::Status::cancelled;
  }
  if (outcome.status != ExecutionOutcome::Status::ok) outcome.outputs.clear();
}

class InProcess final : public Executor {
 public:
  ExecutionOutcome execute(const ExecutionRequest& request) override {
    const auto start = std::chrono::steady_clock::now();
    ExecutionOutcome outcome;
    const auto work = [&] { execute_and_hash(request, outcome); };
    if (request.threads == 1 && tbb::this_task_arena::max_concurrency() == 1) {
      // This thread is alone in its arena already: entering another one would cost more than a small node.
      const double cpu = thread_cpu_seconds();
      tbb::this_task_arena::isolate(work);
      outcome.cpu_seconds = std::max(0.0, thread_cpu_seconds() - cpu);
    } else {
      std::unique_ptr<Arenas::Arena> place = Arenas::instance().take(request.threads);
      const double cpu = place->meter.total();
      place->arena.execute(work);
      outcome.cpu_seconds = place->meter.total() - cpu;
      Arenas::instance().give_back(std::move(place));
    }
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    // Takes milliseconds for gigabytes, and the next node the page faults: small nodes keep what they have.
    if (outcome.seconds > 0.25) return_free_memory();
    return outcome;
  }
};

}  // namespace

std::shared_ptr<Executor> in_process_executor() { return std::make_shared<InProcess>(); }

}  // namespace ballflow
