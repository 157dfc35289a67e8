#include "terminal/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "ballflow/text.hpp"

namespace ballflow::cli {
namespace {

using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Running {
  Clock::time_point start = Clock::now();
  double fraction = 0;
  double last_line = 0;  // seconds after the start at which a plain line was last printed
};

class Display final : public EventSink {
 public:
  Display(const Dag& dag, bool live, Expectations expectations)
      : dag_(dag), live_(live), expectations_(std::move(expectations)), finished_(dag.nodes.size(), false) {
    if (live_) ticker_ = std::thread([this] { tick(); });
  }
  ~Display() override {
    {
      const std::lock_guard lock(mutex_);
      over_ = true;
    }
    wake_.notify_all();
    if (ticker_.joinable()) ticker_.join();
  }

  void on(const Event& event) override {
    const std::lock_guard lock(mutex_);
    const std::string& path = event.node < dag_.nodes.size() ? dag_.nodes[event.node].path : dag_.file;
    switch (event.kind) {
      case Event::Kind::node_started:
        running_[event.node] = Running();
        break;
      case Event::Kind::node_progress: {
        const auto found = running_.find(event.node);
        if (found == running_.end()) break;
        Running& running = found->second;
        running.fraction = event.fraction;
        const double elapsed = since(running.start);
        if (!live_ && elapsed - running.last_line > 2) {
          running.last_line = elapsed;
          say(path + ": " + state_of(event.node, running));
        }
        break;
      }
      case Event::Kind::node_message:
        say(path + ": " + (event.warning ? "warning: " : "") + event.text);
        break;
      case Event::Kind::node_finished:
        if (event.node < finished_.size()) finished_[event.node] = true;
        if (running_.erase(event.node) != 0 && event.result != nullptr &&
            event.result->status == NodeStatus::run) {
          say(path + ": " + describe(event.result->outputs) + " (" + duration(event.result->seconds) + ")");
        }
        break;
      case Event::Kind::run_finished:
        erase_block();
        break;
      case Event::Kind::run_started:
      case Event::Kind::node_waiting:
      case Event::Kind::cache_read:
      case Event::Kind::cache_write:
        break;
    }
  }

 private:
  /// Seconds that a node will still take: from its past, which counts less the further it has come, and from
  /// its own progress.
  std::optional<double> seconds_left(std::size_t node, const Running& running) const {
    const double elapsed = since(running.start);
    std::optional<double> total;
    if (node < plans_.size()) total = plans_[node].seconds;
    if (running.fraction > 0.02 && elapsed > 0.5) {
      const double projected = elapsed / running.fraction, weight = std::min(1.0, 2 * running.fraction);
      total = total ? weight * projected + (1 - weight) * *total : projected;
    }
    if (!total || *total <= elapsed) return std::nullopt;
    return *total - elapsed;
  }

  std::string state_of(std::size_t node, const Running& running) const {
    std::string state = duration(since(running.start));
    if (running.fraction > 0) {
      char part[32];
      std::snprintf(part, sizeof part, "%3.0f %%, ", 100 * running.fraction);
      state = part + state;
    }
    const auto left = seconds_left(node, running);
    return left && running.fraction < 1 ? state + ", " + duration(*left) + " left" : state;
  }

  /// "7 of 13 nodes done, 1.2 GB, ~25 s of computing left"
  std::string whole_run() const {
    std::size_t needed = 0, done = 0, unknown = 0;
    double left = 0;
    for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
      if (i < expectations_.needed.size() && !expectations_.needed[i]) continue;
      ++needed;
      if (finished_[i]) {
        ++done;
        continue;
      }
      const auto running = running_.find(i);
      std::optional<double> seconds;
      if (running != running_.end()) {
        seconds = seconds_left(i, running->second);
      } else if (i < plans_.size()) {
        const bool hit = plans_[i].verdict == NodePlan::Verdict::hit;
        seconds = hit ? std::optional<double>(0) : plans_[i].seconds;
      }
      unknown += seconds ? 0 : 1;
      left += seconds.value_or(0);
    }
    std::string line = std::to_string(done) + " of " + std::to_string(needed) + " nodes done";
    if (const std::uint64_t bytes = resident_bytes(); bytes != 0) {
      line += ", " + grouped(static_cast<std::int64_t>(bytes >> 20)) + " MB";
    }
    if (left > 0) line += ", ~" + duration(left) + " of computing left";
    if (left > 0 && unknown > 0) {
      line += " and " + std::to_string(unknown) + (unknown == 1 ? " node" : " nodes") + " of unknown length";
    }
    return line;
  }

  void say(const std::string& line) {
    erase_block();
    std::fprintf(stderr, "%s\n", printable(line).c_str());
  }

  void erase_block() {
    for (; drawn_ > 0; --drawn_) std::fputs("\033[A\033[2K", stderr);
  }

  void draw(const std::string& line, std::size_t width) {
    std::fprintf(stderr, "%s\n", line.substr(0, width - 1).c_str());
    ++drawn_;
  }

  void draw_block() {
    erase_block();
    winsize size{};
    const std::size_t width =
        ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80u;
    const int height = size.ws_row > 1 ? size.ws_row : 24;  // what has scrolled away cannot be erased
    for (const auto& [node, running] : running_) {
      if (drawn_ + 2 >= height) break;
      const double elapsed = since(running.start);
      if (elapsed < 0.3) continue;  // quick nodes would only flicker
      constexpr std::size_t bar_width = 24;
      // Without progress of its own a node moves along the time that it took before, never to the end.
      const auto left = seconds_left(node, running);
      const bool guessed = running.fraction <= 0 && left;
      const double fraction = guessed ? elapsed / (elapsed + *left) : running.fraction;
      const auto full = std::min(static_cast<std::size_t>(fraction * bar_width), bar_width);
      std::string line = printable(dag_.nodes[node].path);
      line.resize(std::max<std::size_t>(line.size(), 20), ' ');
      line += " [" + std::string(full, guessed ? '-' : '#') + std::string(bar_width - full, '.') + "] ";
      draw(line + state_of(node, running), width);
    }
    if (drawn_ > 0) draw(whole_run(), width);
    std::fflush(stderr);
  }

  void tick() {
    constexpr double patience = 0.5;  // short runs need no prediction
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return over_; })) {
      draw_block();
      if (!expectations_.plan || since(start_) < patience) continue;
      const auto predict = std::exchange(expectations_.plan, nullptr);
      lock.unlock();
      std::vector<NodePlan> plans;
      try {
        plans = predict();
      } catch (const std::exception&) {
        // No prediction; the run will say what is wrong.
      }
      lock.lock();
      plans_ = std::move(plans);
    }
    erase_block();
  }

  const Dag& dag_;
  const bool live_;
  const Clock::time_point start_ = Clock::now();
  Expectations expectations_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::map<std::size_t, Running> running_;
  std::vector<bool> finished_;
  std::vector<NodePlan> plans_;  // empty until they are known
  int drawn_ = 0;
  std::thread ticker_;
};

class Nothing final : public EventSink {
 public:
  void on(const Event&) override {}
};

}  // namespace

std::uint64_t resident_bytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0, resident = 0;
  return file >> all >> resident ? resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) : 0;
}

std::unique_ptr<EventSink> progress_display(const Dag& dag, bool live, Expectations expectations) {
  return std::make_unique<Display>(dag, live, std::move(expectations));
}
std::unique_ptr<EventSink> no_display() { return std::make_unique<Nothing>(); }

}  // namespace ballflow::cli
