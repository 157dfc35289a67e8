#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "base/usable.hpp"
#include "run/runner.hpp"

namespace ballflow {
namespace {

std::string element_text(std::uint32_t dtype, const void* data, std::uint64_t i) {
  const auto number = [&]<class T>(T) {
    T value{};
    std::memcpy(&value, static_cast<const char*>(data) + i * sizeof value, sizeof value);
    char text[40];
    if constexpr (std::is_floating_point_v<T>) {
      std::snprintf(text, sizeof text, "%.17g", static_cast<double>(value));
    } else {
      std::snprintf(text, sizeof text, "%lld", static_cast<long long>(value));
    }
    return std::string(text);
  };
  switch (dtype) {
    case BF_F64:
      return number(double{});
    case BF_F32:
      return number(float{});
    case BF_I64:
      return number(std::int64_t{});
    case BF_I32:
      return number(std::int32_t{});
    case BF_U32:
      return number(std::uint32_t{});
    case BF_U16:
      return number(std::uint16_t{});
    default:
      return number(std::uint8_t{});
  }
}

std::string shape_text(const NamedArray& array) {
  std::string text;
  for (const std::uint64_t extent : array.shape) text += (text.empty() ? "" : " x ") + std::to_string(extent);
  return text.empty() ? "one number" : text;
}

/// "[12, 0]"; nothing for a single number.
std::string index_text(const NamedArray& array, std::uint64_t element) {
  if (array.shape.empty()) return "";
  std::string text;
  for (std::size_t d = array.shape.size(); d-- > 0;) {
    text = std::to_string(element % array.shape[d]) + (text.empty() ? "" : ", ") + text;
    element /= array.shape[d];
  }
  return "[" + text + "]";
}

std::string first_difference(const Artifact& a, const Artifact& b) {
  for (const NamedArray& one : a.arrays()) {
    const NamedArray* other = b.find(one.name);
    if (other == nullptr) return "array " + one.name + " is in one of them only";
    if (one.dtype != other->dtype || one.shape != other->shape) {
      return "array " + one.name + " is " + shape_text(one) + " and " + shape_text(*other);
    }
    const std::size_t size = dtype_size(one.dtype);
    if (one.bytes() == 0 || std::memcmp(one.data, other->data, one.bytes()) == 0) continue;
    std::uint64_t i = 0;
    while (std::memcmp(static_cast<const char*>(one.data) + i * size,
                       static_cast<const char*>(other->data) + i * size, size) == 0) {
      ++i;
    }
    return "array " + one.name + index_text(one, i) + " is " + element_text(one.dtype, one.data, i) +
           " and " + element_text(one.dtype, other->data, i);
  }
  for (const NamedArray& other : b.arrays()) {
    if (a.find(other.name) == nullptr) return "array " + other.name + " is in one of them only";
  }
  return "the summary is " + a.summary() + " and " + b.summary();
}

}  // namespace

std::string first_difference(const std::map<std::string, ArtifactPtr>& a,
                             const std::map<std::string, ArtifactPtr>& b) {
  for (const auto& [port, artifact] : a) {
    const auto other = b.find(port);
    if (other == b.end()) return "output " + port + " is in one of them only";
    if (artifact->digest() == other->second->digest()) continue;
    return "output " + port + ": " + first_difference(*artifact, *other->second);
  }
  return "";
}

unsigned several_threads(const RunOptions& options) {
  const unsigned threads = options.threads == 0 ? usable_processors() : options.threads;
  return std::max(2u, threads);
}

void Runner::Impl::check_determinism() {
  for (std::size_t i = 0; i < dag_.nodes.size(); ++i) {
    NodeResult& result = result_.nodes[i];
    if (result.status != NodeStatus::hit && result.status != NodeStatus::run) continue;
    if (!may_run(i) || dag_.nodes[i].kind.given() != nullptr) continue;
    if (result_.nodes[i].reason.rfind("same computation as ", 0) == 0) continue;
    emit({Event::Kind::node_started, i});
    try {
      result.cause = compare_executions(i);
      if (!result.cause.empty()) {
        result.deterministic = false;
        result.hint =
            "results must not depend on the number of threads, on addresses, or on the order of a hash table";
      }
    } catch (const Stopped&) {
      result.status = NodeStatus::cancelled;
      result.reason = "the run was cancelled";
    } catch (const PlanIsVoid&) {
      result.cause = "a result that it needs came out different when it was computed again";
      result.hint = "see the warnings above";
    } catch (const Error& error) {
      result.cause = error.what();
      result.hint = error.hint();
    }
    if (!result.cause.empty()) {
      result.status = NodeStatus::failed;
      result.reason = "";
    }
    Event event{Event::Kind::node_finished, i};
    event.result = &result;
    emit(std::move(event));
    if (result.status == NodeStatus::cancelled || (!result.cause.empty() && !options_.keep_going)) return;
  }
}

/// What differs between executions of the node with different numbers of threads, or from its entry in the
/// cache; empty when nothing does.
std::string Runner::Impl::compare_executions(std::size_t i) {
  const NodeResult& result = result_.nodes[i];
  const auto execute_with = [&](unsigned threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    ExecutionOutcome outcome = execute(i, threads);
    if (outcome.status == ExecutionOutcome::Status::cancelled) throw Stopped();
    if (outcome.status != ExecutionOutcome::Status::ok)
      throw Error(ExitCode::node_failed, outcome.cause, outcome.hint);
    return outcome;
  };
  const unsigned many = several_threads(options_);
  const ExecutionOutcome one = execute_with(1), several = execute_with(many);
  const std::string with_many = std::to_string(many) + " threads";
  if (const std::string difference = first_difference(one.outputs, several.outputs); !difference.empty()) {
    return "not deterministic: with 1 thread and with " + with_many + " " + difference;
  }
  std::map<std::string, ArtifactPtr> before;
  bool equal = true;
  for (const OutputEntry& entry : result.outputs) {
    const ArtifactPtr& now = one.outputs.at(entry.port);
    equal = equal && now->digest() == entry.digest;
    ArtifactPtr stored = now->digest() == entry.digest ? now : store_->load(entry);
    if (stored != nullptr) before[entry.port] = std::move(stored);
  }
  if (equal) return "";
  std::string difference = first_difference(before, one.outputs);
  if (difference.empty()) difference = "the digest differs, and the earlier artifact is not stored";
  return "not deterministic: before and now " + difference;
}

}  // namespace ballflow
