// Runs the command line as a user does.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace ballflow::test {

struct ProcessResult {
  int exit_code = -1;  // 128 + signal when a signal ended it
  std::string out, err;
  double seconds = 0;
};

/// Runs a program with arguments; `environment` is added to this process's. `stop_after` > 0: sends `signal`
/// after so many seconds.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::map<std::string, std::string>& environment = {}, double stop_after = 0,
                          int signal = 9);

}  // namespace ballflow::test
