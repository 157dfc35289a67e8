#include "run/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace ballflow {
namespace {

std::string megabytes(std::uint64_t bytes) {
  char text[32];
  const double value = static_cast<double>(bytes) / 1e6;
  std::snprintf(text, sizeof text, value < 10 ? "%.2g MB" : "%.0f MB", value);
  return text;
}

std::string identity_of(const Json& manifest) {
  std::string text;
  for (const char* field : {"version", "params", "body"}) text += manifest.value(field, Json()).dump() + '\n';
  return text;
}

}  // namespace

const std::vector<Past::Execution>& Past::executions_of(const std::string& node) {
  constexpr std::size_t most = 200;
  if (!contents_) {
    contents_ = read_contents(store_);
    for (const CachedAction& action : contents_->actions) {
      for (const OutputEntry& output : action.outputs) size_of_[output.digest.hex()] = output.bytes;
    }
  }
  const auto [found, first] = executions_.try_emplace(node);
  std::vector<Execution>& executions = found->second;
  if (!first) return executions;
  for (auto action = contents_->actions.rbegin(); action != contents_->actions.rend(); ++action) {
    if (action->node != node || executions.size() == most) continue;
    const auto entry = store_.peek_action(action->key);
    const Json manifest = entry ? Json::parse(entry->manifest, nullptr, false) : Json();
    if (!manifest.is_object() || !manifest.contains("inputs")) continue;
    Execution execution{&*action, identity_of(manifest), 0};
    for (const auto& [port, input] : manifest["inputs"].items()) {
      const auto size = size_of_.find(input.value("digest", ""));
      execution.input_bytes += size == size_of_.end() ? 0 : size->second;
    }
    executions.push_back(std::move(execution));
  }
  return executions;
}

std::optional<Past::Guess> Past::guess(const std::string& text, std::uint64_t input_bytes) {
  const Json manifest = Json::parse(text, nullptr, false);
  if (!manifest.is_object()) return std::nullopt;
  const std::string identity = identity_of(manifest);
  const auto alike = [&identity](const Execution& execution) { return execution.identity == identity; };
  const auto distance = [input_bytes](const Execution& execution) {
    if (input_bytes == 0 || execution.input_bytes == 0) return 1e9;
    return std::abs(std::log(static_cast<double>(input_bytes) / static_cast<double>(execution.input_bytes)));
  };
  const Execution* best = nullptr;
  for (const Execution& execution : executions_of(manifest.value("node", ""))) {
    const auto rank = [&](const Execution& e) {
      return std::tuple(!alike(e), distance(e), -e.action->last_use, e.action->key);
    };
    if (best == nullptr || rank(execution) < rank(*best)) best = &execution;
  }
  if (best == nullptr) return std::nullopt;
  const double ratio = input_bytes == 0 || best->input_bytes == 0
                           ? 1
                           : static_cast<double>(input_bytes) / static_cast<double>(best->input_bytes);
  Guess guess;
  guess.seconds = best->action->seconds * ratio;
  guess.from = alike(*best) ? "same parameters" : "other parameters";
  if (ratio != 1)
    guess.from += ", scaled from " + megabytes(best->input_bytes) + " of input to " + megabytes(input_bytes);
  for (const OutputEntry& output : best->action->outputs)
    guess.bytes[output.port] = static_cast<std::uint64_t>(static_cast<double>(output.bytes) * ratio);
  return guess;
}

void OutputSizes::add(const std::string& type, std::uint64_t input_bytes, std::uint64_t output_bytes) {
  const std::lock_guard lock(mutex_);
  Most& most = most_[type];
  if (input_bytes == 0) {
    most.without_inputs = std::max(most.without_inputs, output_bytes);
  } else {
    most.per_input_byte =
        std::max(most.per_input_byte, static_cast<double>(output_bytes) / static_cast<double>(input_bytes));
  }
}

std::optional<std::uint64_t> OutputSizes::expect(const std::string& type, std::uint64_t input_bytes) const {
  const std::lock_guard lock(mutex_);
  const auto found = most_.find(type);
  if (found == most_.end()) return std::nullopt;
  if (input_bytes == 0) return found->second.without_inputs;
  return static_cast<std::uint64_t>(
      std::ceil(found->second.per_input_byte * static_cast<double>(input_bytes)));
}

}  // namespace ballflow
