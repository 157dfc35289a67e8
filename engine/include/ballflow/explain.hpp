// Why a node ran, or would run: its key manifest of now against that of an earlier run, field by field, and
// which nodes upstream made its inputs other than they were.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "ballflow/run.hpp"

namespace ballflow {

/// What a run says about one node.
struct NodeRecord {
  std::string type;
  std::string manifest;                       // lacks inputs that are not known; empty when nothing is known
  std::map<std::string, std::string> inputs;  // port -> "path.port" of what it reads
  std::vector<std::string> body;              // of a loop: paths of the nodes of its body, as in the manifest
};
using NodeRecords = std::map<std::string, NodeRecord>;

/// Of a run that is planned. What depends on a node that has to run has unknown inputs.
NodeRecords records_of(const Dag& dag, const std::vector<NodePlan>& plans);
/// Of a run that was recorded (history.hpp).
NodeRecords records_of(const nlohmann::json& report, const Manifests& manifests);

struct Explanation {
  struct Input {
    std::string port;
    std::string from;  // "path.port", empty when not connected any more
    enum class State { same, other, unknown, added, removed } state = State::same;
  };
  struct Cause {
    std::string path;
    std::vector<std::string> differences;
  };
  std::string type;
  std::string loop;                      // whose body has the node: it has no key of its own, then
  bool ran_before = true;                // false: the earlier run has no such node
  std::vector<std::string> differences;  // of the node itself: "params.epsilon 0.3 -> 0.5"
  std::vector<Input> inputs;             // all of them, also those with the same content
  std::vector<Cause> causes;             // nodes upstream that changed themselves, nearest first

  bool same() const;  // nothing differs
};

/// Explains the node `path`, which may be in the body of a loop: then it is compared as a part of the loop's
/// manifest, and its inputs from outside the body are those of the loop. Throws Error (code usage) when `now`
/// has no such node.
Explanation explain(const NodeRecords& before, const NodeRecords& now, const std::string& path);

}  // namespace ballflow
