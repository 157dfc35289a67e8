// What went wrong, where, and what to do next.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace ballflow {

/// Exit codes of the command line; the kinds of failure.
enum class ExitCode { ok = 0, usage = 2, node_failed = 3, cancelled = 4, store = 5, plugin = 6 };

/// One finding about an input text. Printed as
///   file:line:column: error: message (at /json/pointer)
///     the line, and below it a caret
///     hint
struct Diagnostic {
  enum class Severity { error, warning };
  Severity severity = Severity::error;
  std::string file;
  int line = 0;         // 1-based; 0 = the whole file
  int column = 0;       // 1-based, in bytes
  std::string pointer;  // RFC 6901
  std::string message;
  std::string hint;
  std::string source_line;  // the line in question, for the caret; may be empty

  /// Several lines without a newline at the end.
  std::string text() const;
};

/// The failure of one operation, with the exit code it leads to.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, std::string cause, std::string hint = {})
      : std::runtime_error(cause), code_(code), hint_(std::move(hint)) {}
  ExitCode code() const { return code_; }
  const std::string& hint() const { return hint_; }

 private:
  ExitCode code_;
  std::string hint_;
};

/// All findings about a graph at once. Exit code: usage.
class GraphError : public Error {
 public:
  explicit GraphError(std::vector<Diagnostic> findings);
  const std::vector<Diagnostic>& findings() const { return findings_; }

 private:
  std::vector<Diagnostic> findings_;
};

/// The candidate nearest to `name` by edit distance, or empty when none is near ("did you mean").
std::string nearest(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace ballflow
