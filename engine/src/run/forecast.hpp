// What executions of the past say about those to come.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "ballflow/gc.hpp"
#include "ballflow/node_decl.hpp"

namespace ballflow {

class Past {
 public:
  /// Reads the action entries of `store` when first asked.
  explicit Past(Store& store) : store_(store) {}

  struct Guess {
    double seconds = 0;
    std::string from;                            // "same parameters, 12 MB of input instead of 3 MB"
    std::map<std::string, std::uint64_t> bytes;  // of the outputs, by port
  };
  /// A guess from the most recently used executions for the node with this key manifest (its inputs do not
  /// matter) and so many bytes of inputs (0: not known).
  std::optional<Guess> guess(const std::string& manifest, std::uint64_t input_bytes);

 private:
  struct Execution {
    const CachedAction* action = nullptr;
    std::string identity;           // of the node: parameters, version and body
    std::uint64_t input_bytes = 0;  // 0: not known
  };
  const std::vector<Execution>& executions_of(const std::string& node);

  Store& store_;
  std::optional<CacheContents> contents_;
  std::map<std::string, std::uint64_t> size_of_;  // by digest
  std::map<std::string, std::vector<Execution>> executions_;
};

/// How large the outputs of nodes of a type become, by those that have ended in this run: as many times the
/// inputs as at most so far, or the most bytes of a node without inputs.
class OutputSizes {
 public:
  void add(const std::string& type, std::uint64_t input_bytes, std::uint64_t output_bytes);
  /// Nothing when there was none.
  std::optional<std::uint64_t> expect(const std::string& type, std::uint64_t input_bytes) const;

 private:
  struct Most {
    double per_input_byte = 0;
    std::uint64_t without_inputs = 0;
  };
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Most> most_;
};

}  // namespace ballflow
