// A program that this process has started, and talks with in lines of text.
#pragma once

#include <sys/types.h>

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "process/descriptor.hpp"

namespace ballflow {

struct ChildCommand {
  // The program, looked for on the PATH, and its arguments. The process id of this process is added as the
  // last one: a child asks the kernel to be ended with it (PR_SET_PDEATHSIG), and can tell whether it was in
  // time.
  std::vector<std::string> arguments;
  std::map<std::string, std::string> environment;  // what this process's does not say already
};

/// The child has descriptor 3 for messages, writes what it prints to a pipe, reads nothing from the terminal,
/// and leads a process group of its own, so that Ctrl-C does not reach it and what it starts ends with it.
/// Used by one thread at a time.
class Child {
 public:
  /// Throws Error (code plugin) when the program cannot be started.
  explicit Child(const ChildCommand& command);
  /// Ends it at once, and all of its group; in a fork of the process that has started it, nothing.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Sends a line, and with it a file where there is one. False when the child is not there any more.
  bool send(std::string line, int file = -1);

  /// Waits for the next line, at most so long. While it waits it takes in what the child prints.
  std::optional<std::string> receive(int milliseconds);
  /// The file that came with a line; not open when none did. Files are there no later than their lines.
  Descriptor take_file();
  /// Lines that the child has printed since the last call. `all`: takes the last one also where no newline
  /// has come yet.
  std::vector<std::string> printed(bool all);
  /// Whether it has ended and all its lines were received.
  bool has_ended();
  /// "was ended by signal 11 (Segmentation fault)", "ended with exit status 3".
  std::string how_it_ended() const;

  /// Asks it to end (SIGTERM), and forces it where it does not within so long.
  void end(int milliseconds);

 private:
  bool reap(bool wait);
  void read_messages();
  void read_output();

  pid_t owner_ = -1;  // the process that has started it: a fork of that has a copy of this, and no child
  pid_t pid_ = -1;
  Descriptor channel_, output_;
  bool closed_ = false;  // the channel, by the child
  bool reaped_ = false;
  int status_ = 0;
  std::string text_;               // of the channel, without a newline yet
  std::deque<std::string> lines_;  // of the channel
  std::deque<Descriptor> files_;   // of the lines, in order
  std::string printed_;            // of the pipe
};

}  // namespace ballflow
