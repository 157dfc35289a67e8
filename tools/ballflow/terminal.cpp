#include "terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <thread>

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
  Display(const Dag& dag, bool live) : dag_(dag), live_(live) {
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
          say(path + ": " + state_of(running));
        }
        break;
      }
      case Event::Kind::node_message:
        say(path + ": " + (event.warning ? "warning: " : "") + event.text);
        break;
      case Event::Kind::node_finished:
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
  static std::string state_of(const Running& running) {
    const double elapsed = since(running.start);
    char text[64];
    if (running.fraction <= 0) return duration(elapsed);
    std::snprintf(text, sizeof text, "%3.0f %%, %s", 100 * running.fraction, duration(elapsed).c_str());
    std::string state = text;
    if (running.fraction > 0.02 && running.fraction < 1 && elapsed > 0.5) {
      state += ", " + duration(elapsed * (1 - running.fraction) / running.fraction) + " left";
    }
    return state;
  }

  void say(const std::string& line) {
    erase_block();
    std::fprintf(stderr, "%s\n", printable(line).c_str());
  }

  void erase_block() {
    for (; drawn_ > 0; --drawn_) std::fputs("\033[A\033[2K", stderr);
  }

  void tick() {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return over_; })) {
      erase_block();
      winsize size{};
      const std::size_t width =
          ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80u;
      const int height = size.ws_row > 1 ? size.ws_row : 24;  // what has scrolled away cannot be erased
      for (const auto& [node, running] : running_) {
        if (drawn_ + 1 >= height) break;
        if (since(running.start) < 0.3) continue;  // quick nodes would only flicker
        constexpr std::size_t bar_width = 24;
        const auto full = static_cast<std::size_t>(running.fraction * bar_width);
        std::string line = dag_.nodes[node].path;
        line.resize(std::max<std::size_t>(line.size(), 20), ' ');
        line += " [" + std::string(full, '#') + std::string(bar_width - full, '.') + "] " + state_of(running);
        if (line.size() >= width) line.resize(width - 1);
        std::fprintf(stderr, "%s\n", line.c_str());
        ++drawn_;
      }
      std::fflush(stderr);
    }
    erase_block();
  }

  const Dag& dag_;
  bool live_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool over_ = false;
  std::map<std::size_t, Running> running_;
  int drawn_ = 0;
  std::thread ticker_;
};

class Nothing final : public EventSink {
 public:
  void on(const Event&) override {}
};

}  // namespace

std::unique_ptr<EventSink> progress_display(const Dag& dag, bool live) {
  return std::make_unique<Display>(dag, live);
}
std::unique_ptr<EventSink> no_display() { return std::make_unique<Nothing>(); }

}  // namespace ballflow::cli
