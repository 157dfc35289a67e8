#include "run/node_run.hpp"

#include <atomic>
#include <exception>
#include <memory>
#include <mutex>

#include "ballflow/error.hpp"
#include "ballflow/plugin.h"
#include "base/canonical_json.hpp"

namespace ballflow {
namespace {

/// An artifact as the boundary shows it; lives until the last reader lets go.
struct InputView {
  ArtifactPtr artifact;
  std::vector<bf_array> arrays;
  std::atomic<int> references{1};

  explicit InputView(ArtifactPtr a) : artifact(std::move(a)) {
    for (const NamedArray& array : artifact->arrays()) {
      bf_array view{};
      view.name = {array.name.data(), array.name.size()};
      view.dtype = array.dtype;
      view.rank = static_cast<std::uint32_t>(array.shape.size());
      for (std::size_t i = 0; i < array.shape.size() && i < BALLFLOW_MAX_RANK; ++i)
        view.shape[i] = array.shape[i];
      view.data = array.data;
      arrays.push_back(view);
    }
  }
  static void retain(void* self) {
    static_cast<InputView*>(self)->references.fetch_add(1, std::memory_order_relaxed);
  }
  static void release(void* self) {
    auto* view = static_cast<InputView*>(self);
    if (view->references.fetch_sub(1, std::memory_order_acq_rel) == 1) delete view;
  }
};

/// Releases the arrays that a node handed over.
struct HandedOver {
  std::vector<bf_array> arrays;
  ~HandedOver() {
    for (const bf_array& array : arrays) {
      if (array.release != nullptr) array.release(array.owner);
    }
  }
};

class Host {
 public:
  explicit Host(const ExecutionRequest& request) : request_(request) {
    for (const auto& [port, artifact] : request.inputs) views_[port] = new InputView(artifact);
    for (const auto& [name, value] : request.node->params) {
      params_ += params_.empty() ? '{' : ',';
      write_string(name, params_);
      params_ += ':';
      write_value(value, params_);
    }
    params_ += params_.empty() ? "{}" : "}";
  }
  ~Host() {
    for (const auto& [port, view] : views_) InputView::release(view);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;

  bf_run table() {
    bf_run run{};
    run.struct_size = sizeof run;
    run.max_threads = request_.threads;
    run.seed = request_.seed;
    run.params = {params_.data(), params_.size()};
    run.self = this;
    run.cancelled = [](void* self) -> int { return host(self).request_.cancelled() ? 1 : 0; };
    run.progress = [](void* self, double fraction) { host(self).request_.progress(fraction); };
    run.log = [](void* self, std::uint32_t level, bf_bytes text) { host(self).log(level, text); };
    run.input = [](void* self, bf_bytes port, bf_artifact* artifact) -> int {
      return host(self).input(port, artifact);
    };
    run.output = [](void* self, bf_bytes port, const bf_array* arrays, std::uint64_t count,
                    bf_bytes summary) -> int { return host(self).output(port, arrays, count, summary); };
    run.fail = [](void* self, bf_bytes cause, bf_bytes hint) { host(self).fail(text(cause), text(hint)); };
    return run;
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
  static std::string text(bf_bytes bytes) { return {bytes.data, static_cast<std::size_t>(bytes.size)}; }

  void log(std::uint32_t level, bf_bytes message) {
    const std::string line = text(message);
    if (level == BF_WARNING) {
      const std::lock_guard lock(mutex_);
      outcome.warnings.push_back(line);
    }
    request_.message(level == BF_WARNING, line);
  }

  int input(bf_bytes port, bf_artifact* artifact) {
    const auto found = views_.find(text(port));
    if (found == views_.end()) return 0;
    InputView* view = found->second;
    *artifact = {view->arrays.data(), view->arrays.size(), view, &InputView::retain, &InputView::release};
    return 1;
  }

  int output(bf_bytes port_name, const bf_array* arrays, std::uint64_t count, bf_bytes summary) {
    const std::string port = text(port_name);
    auto owner = std::make_shared<HandedOver>();
    owner->arrays.assign(arrays, arrays + count);
    try {
      const PortDecl* decl = request_.node->kind.output(port);
      if (decl == nullptr)
        throw Error(ExitCode::plugin, "the node gave an output \"" + port + "\" that it does not declare");
      std::vector<NamedArray> named;
      for (const bf_array& array : owner->arrays) {
        if (array.rank > BALLFLOW_MAX_RANK)
          throw Error(ExitCode::plugin, "an array has more than 4 dimensions");
        named.push_back({text(array.name), array.dtype, {array.shape, array.shape + array.rank}, array.data});
      }
      const ArtifactPtr artifact =
          Artifact::seal(decl->type, decl->type_version, std::move(named), text(summary), std::move(owner));
      const TypeDeclaration* type = request_.registry->type(decl->type);
      const std::string broken = type == nullptr ? std::string() : check_artifact(*type, *artifact);
      if (!broken.empty()) {
        throw Error(ExitCode::plugin, "output \"" + port + "\" is no valid " + decl->type + ": " + broken);
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

  const ExecutionRequest& request_;
  std::map<std::string, InputView*> views_;
  std::string params_;
  std::mutex mutex_;
};

}  // namespace

ExecutionOutcome execute_node(const ExecutionRequest& request) {
  Host host(request);
  const bf_run table = host.table();
  const int status = request.node->kind.declared()->entry->run(&table);
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
