// How a long computation reports progress and learns that nobody wants its result any more, without
// knowing who runs it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>

namespace ballflow::geometry {

/// Thrown by Monitor::step when the computation was cancelled.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// Bad input or an impossible request. what() is "cause\nhint": one line that names the place and the
/// number, one line that says what to do next.
struct InputError : std::runtime_error {
  InputError(const std::string& cause, const std::string& hint)
      : std::runtime_error(hint.empty() ? cause : cause + "\n" + hint) {}
};

/// Safe to call from several threads at once. The default does nothing.
class Monitor {
 public:
  virtual ~Monitor() = default;

  /// `fraction` in [0, 1] of the work is done; call it often (thousands of times a second are cheap).
  virtual void progress(double fraction) { (void)fraction; }
  virtual bool cancelled() { return false; }
  /// How far a long computation has come, in words. Who shows it leaves most of them out.
  virtual void note(const std::string& text) { (void)text; }
  /// Something the user should know although the result is valid.
  virtual void warn(const std::string& text) { (void)text; }
  /// Bytes that the computation may take; 0 when nobody has said (memory.hpp). Results must not depend on it:
  /// only whether the computation is refused.
  virtual std::uint64_t memory_bytes() { return 0; }

  /// Reports progress; throws Cancelled when the result is no longer wanted.
  void step(double fraction) {
    if (cancelled()) throw Cancelled();
    progress(fraction);
  }
};

/// Shows a step of a computation, whose progress runs from 0 to 1, as the part [begin, end] of the whole.
class PartMonitor final : public Monitor {
 public:
  PartMonitor(Monitor& whole, double begin, double end) : whole_(whole), begin_(begin), end_(end) {}
  void progress(double fraction) override { whole_.progress(begin_ + (end_ - begin_) * fraction); }
  bool cancelled() override { return whole_.cancelled(); }
  void note(const std::string& text) override { whole_.note(text); }
  void warn(const std::string& text) override { whole_.warn(text); }
  std::uint64_t memory_bytes() override { return whole_.memory_bytes(); }

 private:
  Monitor& whole_;
  double begin_, end_;
};

/// Looks at a monitor from a loop of many small steps: at once, then about every millisecond, however large
/// the data. Each thread, or task, has one of its own.
class Lookout {
 public:
  explicit Lookout(Monitor& monitor) : monitor_(monitor) { look(); }

  /// `work` array elements more have been visited; throws Cancelled when the result is no longer wanted.
  void operator()(std::size_t work) {
    if (due(work)) look();
  }
  /// For loops that report progress: true when it is time for a step.
  bool due(std::size_t work) {
    if ((work_ += work) < elements_between_looks) return false;
    work_ = 0;
    return true;
  }

 private:
  void look() {
    if (monitor_.cancelled()) throw Cancelled();
  }

  static constexpr std::size_t elements_between_looks = std::size_t{1} << 20;
  Monitor& monitor_;
  std::size_t work_ = 0;
};

/// The monitor of callers that watch nothing.
inline Monitor& no_monitor() {
  static Monitor monitor;
  return monitor;
}

}  // namespace ballflow::geometry
