// Work in a process of its own, to be interrupted or to compete.
#pragma once

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

namespace ballflow {

template <class Body>
pid_t start(Body body) {
  const pid_t child = ::fork();
  if (child == 0) {
    body();
    ::_exit(0);
  }
  return child;
}

/// Waits for the end of a child; its wait status.
inline int finish(pid_t child) {
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

}  // namespace ballflow
