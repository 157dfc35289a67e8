#include "run/node_run.hpp"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <memory>
#include <mutex>

#include "ballflow/artifact_view.hpp"
#include "ballflow/error.hpp"
#include "ballflow/plugin.h"
#include "run/named_files.hpp"

namespace ballflow {
namespace {

/// Releases an array that a node handed over.
class HandedOver {
 public:
  explicit HandedOver(const bf_array& array) : array_(array) {}
  ~HandedOver() {
    if (array_.release != nullptr) array_.release(array_.owner);
  }
  HandedOver(const HandedOver&) = delete;
  HandedOver& operator=(const HandedOver&) = delete;

 private:
  bf_array array_;
};

class Host {
 public:
  explicit Host(const ExecutionRequest& request) : request_(request) {
    for (const PortDecl& port : request.node->kind.inputs()) {
      std::vector<ArtifactView>& views = views_[port.name];
      const auto take = [&](const std::string& slot) {
        const auto found = request.inputs.find(slot);
        if (found != request.inputs.end()) views.emplace_back(found->second);
        return found != request.inputs.end();
      };
      if (port.list) {
        for (std::size_t i = 0; take(list_slot(port.name, i));) ++i;
      } else {
        take(port.name);
      }
    }
    params_ = params_text(*request.node);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bf_run table() {
    bf_run run{};
    run.struct_size = sizeof run;
    run.max_threads = request_.threads;
    run.seed = request_.seed;
    run.memory_bytes = request_.memory_bytes;
    const std::string& id = request_.node->kind.type();
    run.node = {id.data(), id.size()};
    run.params = {params_.data(), params_.size()};
    run.host = this;
    run.cancelled = [](void* self) noexcept -> int { return host(self).cancelled() ? 1 : 0; };
    run.progress = [](void* self, double fraction) noexcept {
      host(self).guarded([&] { host(self).request_.progress(fraction); });
    };
    run.log = [](void* self, std::uint32_t level, bf_bytes text) noexcept {
      host(self).guarded([&] { host(self).log(level, text); });
    };
    run.input_count = [](void* self, bf_bytes port) noexcept -> std::uint64_t {
      const auto& views = host(self).views_;
      const auto found = views.find(view(port));
      return found == views.end() ? 0 : found->second.size();
    };
    run.input = [](void* self, bf_bytes port, std::uint64_t index, bf_artifact* artifact) noexcept -> int {
      return host(self).input(port, index, artifact);
    };
    run.output = [](void* self, bf_bytes port, const bf_array* arrays, std::uint64_t count,
                    bf_bytes summary) noexcept -> int {
      int refused = 1;
      host(self).guarded([&] { refused = host(self).output(port, arrays, count, summary); });
      return refused;
    };
    run.fail = [](void* self, bf_bytes cause, bf_bytes hint) noexcept {
      host(self).guarded([&] { host(self).fail(text(cause), text(hint)); });
    };
    return run;
  }

  /// What a function of the host threw instead of throwing it through the node.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

  ExecutionOutcome outcome;

  void fail(std::string cause, std::string hint) {
    const std::lock_guard lock(mutex_);
    if (!outcome.cause.empty()) return;  // the first cause is the one to tell
    outcome.cause = std::move(cause);
    outcome.hint = std::move(hint);
  }

 private:
  static Host& host(void* self) { return *static_cast<Host*>(self); }
  static std::string_view view(bf_bytes bytes) { return {bytes.data, static_cast<std::size_t>(bytes.size)}; }
  static std::string text(bf_bytes bytes) { return std::string(view(bytes)); }

  void log(std::uint32_t level, bf_bytes message) {
    const std::string line = text(message);
    if (level == BF_WARNING) {
      const std::lock_guard lock(mutex_);
      outcome.warnings.push_back(line);
    }
    request_.message(level == BF_WARNING, line);
  }

  template <class Work>
  void guarded(Work&& work) noexcept {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!thrown_) thrown_ = std::current_exception();
      has_thrown_ = true;
    }
  }

  bool cancelled() noexcept {
    bool stop = false;
    guarded([&] { stop = request_.cancelled(); });
    return stop || has_thrown_;
  }

  int input(bf_bytes port, std::uint64_t index, bf_artifact* artifact) noexcept {
    const auto found = views_.find(view(port));
    if (found == views_.end() || index >= found->second.size() ||
        artifact->struct_size < BF_ARTIFACT_MIN_SIZE)
      return 0;
    const std::uint32_t size = std::min<std::uint32_t>(artifact->struct_size, sizeof(bf_artifact));
    std::memcpy(artifact, &found->second[index].raw(), size);
    artifact->struct_size = size;
    return 1;
  }

  int output(bf_bytes port_name, const bf_array* arrays, std::uint64_t count, bf_bytes summary) {
    const std::string port = text(port_name);
    if (count > 0 && arrays->struct_size < BF_ARRAY_MIN_SIZE) {
      fail("output \"" + port + "\" was handed over in structs that are too small",
           "this is a bug of the node; please report it");
      return 1;
    }
    std::vector<bf_array> handed;
    std::vector<std::shared_ptr<const void>> keepers;
    handed.reserve(count);
    keepers.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      bf_array array{};
      std::memcpy(&array, reinterpret_cast<const char*>(arrays) + i * arrays->struct_size,
                  std::min<std::size_t>(arrays->struct_size, sizeof array));
      handed.push_back(array);
      keepers.push_back(std::make_shared<HandedOver>(array));
    }
    try {
      const PortDecl* decl = request_.node->kind.output(port);
      if (decl == nullptr)
        throw Error(ExitCode::plugin, "the node gave an output \"" + port + "\" that it does not declare");
      std::vector<NamedArray> named;
      for (std::size_t i = 0; i < handed.size(); ++i) {
        const bf_array& array = handed[i];
        if (array.rank > BALLFLOW_MAX_RANK)
          throw Error(ExitCode::plugin, "an array has more than 4 dimensions");
        named.push_back(
            {text(array.name), array.dtype, {array.shape, array.shape + array.rank}, array.data, keepers[i]});
        keep_little(named.back());
      }
      keepers.clear();
      const TypeDeclaration* type = request_.registry->type(decl->type);
      ArtifactPtr artifact;
      if (summary.size == 0 && type != nullptr) {
        try {
          artifact = make_artifact(*type, named, nullptr);
        } catch (const Error& error) {
          throw Error(ExitCode::plugin, "output \"" + port + "\" is " + error.what());
        }
      } else {
        artifact = Artifact::seal(decl->type, decl->type_version, std::move(named), text(summary), nullptr);
        const std::string broken = type == nullptr ? std::string() : check_artifact(*type, *artifact);
        if (!broken.empty()) {
          throw Error(ExitCode::plugin, "output \"" + port + "\" is no valid " + decl->type + ": " + broken);
        }
      }
      const std::lock_guard lock(mutex_);
      outcome.outputs[port] = artifact;
      return 0;
    } catch (const Error& error) {
      fail(error.what(), error.hint().empty() ? "this is a bug of the node; please report it" : error.hint());
    } catch (const std::bad_alloc&) {
      fail("out of memory while output \"" + port + "\" was sealed",
           "use a smaller input or a machine with more memory");
    } catch (const std::exception& error) {  // none may cross the boundary
      fail("output \"" + port + "\" cannot be sealed: " + error.what(),
           "this is a bug of the node; please report it");
    }
    return 1;
  }

  /// What a node gives back for an array of an input, as it got it, keeps all of that input. The keeper of
  /// that array alone will do, and of an array without elements none.
  void keep_little(NamedArray& array) const {
    static constexpr double nothing = 0;
    if (array.bytes() == 0) {
      array.data = &nothing;
      array.keeper = nullptr;
      return;
    }
    for (const auto& [slot, input] : request_.inputs) {
      if (input == nullptr) continue;
      for (const NamedArray& other : input->arrays()) {
        if (other.data != array.data || other.bytes() < array.bytes() || other.keeper == nullptr) continue;
        array.keeper = other.keeper;
        return;
      }
    }
  }

  const ExecutionRequest& request_;
  std::map<std::string, std::vector<ArtifactView>, std::less<>> views_;  // by input port, in order
  std::string params_;
  std::mutex mutex_;
  std::exception_ptr thrown_;
  std::atomic<bool> has_thrown_ = false;
};

/// What a node gets is as its type says, wherever it comes from: a node trusts the declaration and would read
/// beyond the end of an array that is too short. Empty when all is well.
std::string wrong_input(const ExecutionRequest& request) {
  for (const auto& [port, artifact] : request.inputs) {
    const PortDecl* decl = find_input(request.node->kind.inputs(), port);
    const TypeDeclaration* type = decl == nullptr ? nullptr : request.registry->type(decl->type);
    if (type == nullptr) continue;
    const std::string wrong = check_arrays(*type, *artifact);
    if (!wrong.empty()) return ("input \"" + port).append("\" ").append(wrong);
  }
  return {};
}

}  // namespace

ExecutionOutcome execute_node(const ExecutionRequest& request) {
  if (std::string wrong = wrong_input(request); !wrong.empty()) {
    ExecutionOutcome refused;
    refused.cause = std::move(wrong);
    refused.hint =
        "it comes from a cache or file of another version of the library that declares its type: compute it "
        "again";
    return refused;
  }
  const bf_node* opened = nullptr;
  try {
    opened = request.node->kind.declared()->entry;
    // The checks of outputs must not fail for want of the library that has them.
    for (const PortDecl& port : request.node->kind.outputs()) {
      const TypeDeclaration* const type = request.registry->type(port.type);
      if (type != nullptr) static_cast<void>(static_cast<const bf_type*>(type->entry));
    }
  } catch (const Error& error) {
    ExecutionOutcome refused;
    refused.cause = error.what();
    refused.hint = error.hint();
    return refused;
  }
  Host host(request);
  const bf_run table = host.table();
  const bf_node& entry = *opened;
  const int status = entry.run(entry.self, &table);
  host.rethrow();
  ExecutionOutcome outcome = std::move(host.outcome);

  // An output that the engine refused reaches the node as a cancellation; the recorded cause decides.
  if (!outcome.cause.empty()) {
    outcome.status = ExecutionOutcome::Status::failed;
  } else if (status == BF_OK) {
    outcome.status = ExecutionOutcome::Status::ok;
    for (const PortDecl& port : request.node->kind.outputs()) {
      if (outcome.outputs.count(port.name) != 0) continue;
      outcome.status = ExecutionOutcome::Status::failed;
      outcome.cause = "the node did not give its output \"" + port.name + "\"";
      outcome.hint = "this is a bug of the node; please report it";
    }
  } else if (status == BF_CANCELLED && request.cancelled()) {
    outcome.status = ExecutionOutcome::Status::cancelled;
  } else {
    outcome.status = ExecutionOutcome::Status::failed;
    outcome.cause = "the node failed without giving a cause";
    outcome.hint = "this is a bug of the node; please report it";
  }
  if (outcome.status != ExecutionOutcome::Status::ok) outcome.outputs.clear();
  return outcome;
}

}  // namespace ballflow
