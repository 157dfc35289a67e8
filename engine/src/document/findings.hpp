// What is wrong with the files of a graph, or may be.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "ballflow/error.hpp"
#include "document/graph_file.hpp"

namespace ballflow {

/// Findings of all files of a graph, each once.
class Findings {
 public:
  /// `base`: findings that were made before; where they are errors this has failed, too.
  explicit Findings(const Findings* base = nullptr) : base_(base) {}
  void error(const GraphFile& file, Offset offset, std::string message, std::string hint = {});
  void warning(const GraphFile& file, Offset offset, std::string message, std::string hint = {});
  void add(Diagnostic finding);
  bool failed() const { return failed_ || (base_ != nullptr && base_->failed()); }
  std::size_t size() const { return all_.size(); }
  /// Sorted by file (in order of first reading) and place.
  std::vector<Diagnostic> take(const std::vector<std::string>& files);

 private:
  std::vector<Diagnostic> all_;
  std::set<std::string> keys_;
  bool failed_ = false;
  const Findings* base_;
};

}  // namespace ballflow
