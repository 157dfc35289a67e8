#include "run/loop.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>
#include <utility>

#include "base/quote.hpp"
#include "document/until.hpp"
#include "run/node_run.hpp"

namespace ballflow {
namespace {

/// Thrown to end the loop with the outcome that was prepared.
struct Ended {};

class LoopRun {
 public:
  explicit LoopRun(const ExecutionRequest& request)
      : request_(request), loop_(*request.node->kind.loop()), states_(request.inputs) {}

  ExecutionOutcome run() {
    try {
      if (request_.resume != nullptr) resume(*request_.resume);
      while (!until_holds(loop_, states_)) {
        if (request_.cancelled()) end(ExecutionOutcome::Status::cancelled);
        if (iteration_ == loop_.max_iterations) {
          reach_limit();
          break;
        }
        ++iteration_;
        iterate();
        ++whole_;
        request_.progress(progress());
      }
      outcome_.status = ExecutionOutcome::Status::ok;
      for (const DagOutput& output : loop_.body.outputs)
        outcome_.outputs[output.name] = states_.at(output.name);
    } catch (const Ended&) {
    } catch (const Error& error) {
      outcome_.status = ExecutionOutcome::Status::failed;
      outcome_.cause = "after iteration " + std::to_string(iteration_) + ": " + error.what();
      outcome_.hint = error.hint();
    }
    outcome_.iterations = iteration_;
    if (outcome_.status != ExecutionOutcome::Status::failed) outcome_.reached = reached();
    return std::move(outcome_);
  }

 private:
  [[noreturn]] void end(ExecutionOutcome::Status status) {
    outcome_.status = status;
    throw Ended();
  }

  void resume(const LoopState& from) {
    iteration_ = whole_ = from.iterations;
    for (const auto& [name, artifact] : from.states) states_[name] = artifact;
    for (const std::string& warning : from.warnings) pass_on(true, warning);
  }

  /// Nothing before the first iteration has ended: that is what the loop was given.
  std::optional<LoopState> reached() const {
    if (whole_ == 0) return std::nullopt;
    LoopState state{whole_, {}, outcome_.warnings};
    for (const DagOutput& output : loop_.body.outputs) state.states[output.name] = states_.at(output.name);
    return state;
  }

  void reach_limit() {
    const std::string what = std::to_string(iteration_) + (iteration_ == 1 ? " iteration" : " iterations") +
                             " ended before " + loop_.until;
    if (loop_.stop_at_limit) return pass_on(true, "stopped at the limit: " + what);
    outcome_.cause = what;
    outcome_.hint = "raise \"max_iterations\", or keep what was reached with \"at_limit\": \"stop\"";
    end(ExecutionOutcome::Status::failed);
  }

  void iterate() {
    std::vector<std::map<std::string, ArtifactPtr>> made(loop_.body.nodes.size());
    const auto artifact = [&](const EdgeRef& edge) {
      if (edge.node != loop_input) return made[edge.node].at(edge.port);
      const auto found = states_.find(edge.port);
      return found == states_.end() ? nullptr : found->second;  // an optional input that is not connected
    };
    for (std::size_t i = 0; i < loop_.body.nodes.size(); ++i) {
      ExecutionRequest request = request_;
      request.node = &loop_.body.nodes[i];
      request.resume = nullptr;
      request.inputs.clear();
      for (const auto& [port, edge] : request.node->inputs) {
        if (ArtifactPtr input = artifact(edge)) request.inputs[port] = std::move(input);
      }
      request.progress = [](double) {};
      request.message = [&](bool warning, const std::string& text) {
        pass_on(warning, request.node->path + ": " + text);
      };
      ExecutionOutcome step =
          request.node->kind.loop() != nullptr ? execute_loop(request) : execute_node(request);
      if (step.status != ExecutionOutcome::Status::ok) {
        if (step.status == ExecutionOutcome::Status::failed) {
          outcome_.cause = request.node->path + " (" + request.node->kind.type() + ") failed in iteration " +
                           std::to_string(iteration_) + ": " + step.cause;
          outcome_.hint = step.hint;
          outcome_.failed_call =
              step.failed_call ? std::move(step.failed_call) : InnerCall{request.node, request.inputs};
        }
        end(step.status);
      }
      made[i] = std::move(step.outputs);
    }
    std::map<std::string, ArtifactPtr> next = states_;
    for (const DagOutput& output : loop_.body.outputs) next[output.name] = artifact(output.from);
    states_ = std::move(next);
  }

  /// How far the field that is compared first has come from its first value to the wanted one.
  double progress() {
    if (loop_.conditions.empty()) return 0;
    const Loop::Comparison& goal = loop_.conditions[0][0];
    const std::optional<double> value = summary_number(*states_.at(goal.state), goal);
    if (!value) return 0;
    const double distance = std::abs(*value - goal.number);
    farthest_ = std::max(farthest_, distance);
    return farthest_ == 0 ? 1 : 1 - distance / farthest_;
  }

  void pass_on(bool warning, const std::string& text) {
    constexpr std::size_t most = 20;
    const std::lock_guard lock(messages_mutex_);
    std::set<std::string>& seen = warning ? warnings_ : messages_;
    if (seen.size() > most || !seen.insert(text).second) return;
    const std::string line = seen.size() > most ? "there were more messages in this loop" : text;
    if (warning) outcome_.warnings.push_back(line);
    request_.message(warning, line);
  }

  const ExecutionRequest& request_;
  const Loop& loop_;
  std::map<std::string, ArtifactPtr> states_;  // and the inputs that stay
  std::int64_t iteration_ = 0, whole_ = 0;     // the one that runs, and how many have ended
  double farthest_ = 0;
  ExecutionOutcome outcome_;
  std::mutex messages_mutex_;
  std::set<std::string> warnings_, messages_;  // passed on so far
};

}  // namespace

ExecutionOutcome execute_loop(const ExecutionRequest& request) { return LoopRun(request).run(); }

std::optional<std::string> file_read_by(const DagNode& node) {
  for (const ParamDecl& param : node.kind.params()) {
    if (param.kind == ParamKind::file && param.hashed) return plain_text(node.params.at(param.name));
  }
  if (const Loop* loop = node.kind.loop()) {
    for (const DagNode& inner : loop->body.nodes) {
      if (std::optional<std::string> file = file_read_by(inner)) return file;
    }
  }
  return std::nullopt;
}

}  // namespace ballflow
