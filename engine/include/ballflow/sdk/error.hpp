// How a node fails.
#pragma once

#include <exception>
#include <stdexcept>
#include <string>

namespace ballflow {

/// Thrown by RunContext::check_cancelled and by Monitor adapters; ends the run quietly.
struct RunCancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// A failure with a cause (place and number) and a hint (the next step). Any exception fails a node: its
/// what() is "cause\nhint".
struct NodeError : std::runtime_error {
  NodeError(const std::string& cause, const std::string& hint)
      : std::runtime_error(hint.empty() ? cause : cause + "\n" + hint) {}
};

}  // namespace ballflow
