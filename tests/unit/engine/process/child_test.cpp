#include "process/child.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <thread>

#include "ballflow/error.hpp"

namespace ballflow {
namespace {

Child shell(const std::string& script, std::map<std::string, std::string> environment = {}) {
  return Child({{"sh", "-c", script, "sh"}, std::move(environment)});
}

/// The next line that it sends; a test that waits longer than half a minute has failed.
std::string next(Child& child) {
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (std::chrono::steady_clock::now() < until) {
    if (auto line = child.receive(20)) return *line;
    if (child.has_ended()) return "(ended)";
  }
  return "(nothing)";
}

bool ends(Child& child) { return next(child) == "(ended)"; }

/// Whether a process is there; one that has ended and that nobody has waited for is not.
bool is_alive(const std::string& pid) {
  std::ifstream stat("/proc/" + pid + "/stat");
  std::string line;
  std::getline(stat, line);
  const std::size_t state = line.rfind(") ");
  return state != std::string::npos && line[state + 2] != 'Z';
}

TEST(child, talks_in_lines_and_says_how_it_ended) {
  Child child = shell("echo hello; echo oops >&2; read line <&3; echo \"got $line\" >&3; exit 4");
  EXPECT_TRUE(child.send("a line"));
  EXPECT_EQ(next(child), "got a line");
  ASSERT_TRUE(ends(child));
  EXPECT_EQ(child.how_it_ended(), "ended with exit status 4");
  EXPECT_EQ(child.printed(true), (std::vector<std::string>{"hello", "oops"}));
  EXPECT_FALSE(child.send("too late"));
  EXPECT_FALSE(child.take_file().is_open());
}

TEST(child, what_it_said_before_it_ended_is_not_lost) {
  Child child = shell("echo one >&3; echo two >&3; printf 'last words'");
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_EQ(next(child), "one");
  EXPECT_FALSE(child.has_ended());
  EXPECT_EQ(next(child), "two");
  ASSERT_TRUE(ends(child));
  EXPECT_TRUE(child.printed(false).empty()) << "no newline has come";
  EXPECT_EQ(child.printed(true), (std::vector<std::string>{"last words"}));
}

TEST(child, that_prints_without_end_is_not_held_up) {
  Child child = shell(
      "i=0; while [ $i -lt 25000 ]; do echo 'a line of some fifty characters, so that it fills up'; "
      "i=$((i + 1)); done; echo done >&3");
  EXPECT_EQ(next(child), "done");
  EXPECT_LT(child.printed(true).size(), 25000u) << "the middle of so much is lost";
}

TEST(child, a_long_line_arrives_whole) {
  const std::string line(300'000, 'x');
  Child child = shell("read line <&3; printf '%s\\n' \"$line$line\" >&3");
  EXPECT_TRUE(child.send(line));
  EXPECT_EQ(next(child).size(), 600'000u);
}

TEST(child, a_program_that_is_not_there_is_named) {
  try {
    Child child({{"no_such_program_anywhere"}, {}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::plugin);
    EXPECT_STREQ(error.what(), "cannot start no_such_program_anywhere: No such file or directory");
  }
}

TEST(child, is_asked_to_end_and_then_forced) {
  Child asked = shell("echo ready >&3; while :; do sleep 0.01; done");
  EXPECT_EQ(next(asked), "ready");
  asked.end(30'000);
  EXPECT_EQ(asked.how_it_ended(), "was ended by signal 15 (Terminated)");
  Child deaf = shell("trap '' TERM; echo ready >&3; while :; do sleep 0.01; done");
  EXPECT_EQ(next(deaf), "ready");
  deaf.end(50);
  EXPECT_EQ(deaf.how_it_ended(), "was ended by signal 9 (Killed)");
}

TEST(child, takes_with_it_what_it_has_started) {
  std::string grandchild;
  {
    Child child = shell("sleep 1000 & echo $! >&3; wait");
    grandchild = next(child);
    ASSERT_TRUE(is_alive(grandchild));
  }
  for (int i = 0; i < 1500 && is_alive(grandchild); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(is_alive(grandchild));
}

TEST(child, is_left_alone_by_a_fork_of_its_parent) {
  auto child =
      std::make_unique<Child>(ChildCommand{{"sh", "-c", "read line <&3; echo still here >&3", "sh"}, {}});
  const pid_t fork_of_this = fork();
  if (fork_of_this == 0) {
    child.reset();
    _exit(0);
  }
  int status = 0;
  waitpid(fork_of_this, &status, 0);
  EXPECT_EQ(status, 0);
  child->send("");
  EXPECT_EQ(next(*child), "still here");
}

TEST(child, gets_defaults_of_its_environment_and_the_number_of_this_process) {
  setenv("BALLFLOW_TEST_SAID", "by the user", 1);
  Child child = shell("echo \"$BALLFLOW_TEST_SAID, $BALLFLOW_TEST_OTHER\" >&3; echo $1 >&3",
                      {{"BALLFLOW_TEST_SAID", "by default"}, {"BALLFLOW_TEST_OTHER", "by default"}});
  EXPECT_EQ(next(child), "by the user, by default");
  EXPECT_EQ(next(child), std::to_string(getpid()));
}

TEST(child, many_at_once_are_started_from_many_threads) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&right, i] {
      Child child = shell("read line <&3; echo $line >&3");
      child.send(std::to_string(i));
      if (next(child) == std::to_string(i)) ++right;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 8);
}

}  // namespace
}  // namespace ballflow
