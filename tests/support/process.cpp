#include "process.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>
#include <thread>

#include "test_data.hpp"

namespace ballflow::test {

ProcessResult run_process(const std::vector<std::string>& command,
                          const std::map<std::string, std::string>& environment, double stop_after,
                          int signal) {
  const TempFolder folder;
  const std::string out = folder.file("out"), err = folder.file("err");
  for (const std::string& file : {out, err})
    write_file(file, "");  // a child may be killed before it opens them
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("cannot fork");
  if (child == 0) {
    for (const auto& [name, value] : environment) setenv(name.c_str(), value.c_str(), 1);
    const int null = open("/dev/null", O_RDONLY);
    const int o = open(out.c_str(), O_WRONLY);
    const int e = open(err.c_str(), O_WRONLY);
    dup2(null, 0);
    dup2(o, 1);
    dup2(e, 2);
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  if (stop_after > 0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(stop_after));
    kill(child, signal);  // a child that is already a zombie ignores it
  }
  waitpid(child, &status, 0);
  ProcessResult result;
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_file(out);
  result.err = read_file(err);
  return result;
}

}  // namespace ballflow::test
