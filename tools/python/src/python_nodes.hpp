// Nodes whose function is a Python callable of this process.
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "ballflow/registry.hpp"

namespace ballflow::python {

namespace py = pybind11;

/// What a running node may ask of the engine and tell it; of no use once its function has returned.
class NodeRun {
 public:
  explicit NodeRun(const bf_run* run) : run_(run) {}
  void end() { run_ = nullptr; }

  bool cancelled() const;
  void progress(double fraction) const;
  void log(const std::string& text, bool warning) const;
  std::uint64_t seed() const { return run_ == nullptr ? 0 : run_->seed; }
  unsigned threads() const { return run_ == nullptr ? 1 : run_->max_threads; }
  std::uint64_t memory_bytes() const {
    return run_ == nullptr || run_->struct_size < BALLFLOW_SIZE_UP_TO(bf_run, memory_bytes)
               ? 0
               : run_->memory_bytes;
  }

 private:
  const bf_run* run_;
};

/// Adds one node to a registry. `declaration`: JSON as of node_decl.hpp. `digest`: of what the function is
/// made of, part of the key. `call` is called with (inputs: dict of lists of Handle, params: str, run:
/// NodeRun), any number of times at once; it returns ("ok", dict of Handle), ("failed", cause, hint) or
/// ("cancelled",). Throws Error (code plugin) for a declaration that is wrong.
void add_node(Registry& registry, const std::string& declaration, const std::string& file,
              const std::string& digest, const py::object& call);

}  // namespace ballflow::python
