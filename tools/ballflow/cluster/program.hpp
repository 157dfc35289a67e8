// Other programs, run without a shell.
#pragma once

#include <string>
#include <vector>

namespace ballflow {

struct ProgramResult {
  int exit_code = -1;  // 127: there is no such program
  std::string out, err;
};

/// Looks for the program in $PATH and waits for its end.
ProgramResult run_program(const std::vector<std::string>& words);

}  // namespace ballflow
