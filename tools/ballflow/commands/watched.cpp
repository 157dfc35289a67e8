#include "commands/watched.hpp"

#include <algorithm>
#include <string>

#include "commands/commands.hpp"

namespace ballflow::cli {
namespace {

class SignalMonitor final : public geometry::Monitor {
 public:
  bool cancelled() override { return flag_.load(); }

 private:
  const std::atomic<bool>& flag_ = cancel_on_signals();
};

}  // namespace

void watched(const char* unfinished, const std::function<void(geometry::Monitor&)>& compute) {
  SignalMonitor monitor;
  try {
    compute(monitor);
  } catch (const geometry::Cancelled&) {
    throw Error(ExitCode::cancelled, std::string("cancelled; ") + unfinished);
  } catch (const geometry::InputError& error) {
    const std::string text = error.what();
    const std::size_t end = std::min(text.find('\n'), text.size());
    throw Error(ExitCode::usage, text.substr(0, end), text.substr(std::min(end + 1, text.size())));
  }
}

}  // namespace ballflow::cli
