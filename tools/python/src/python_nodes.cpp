#include "python_nodes.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "artifacts.hpp"

namespace ballflow::python {
namespace {

bf_bytes bytes(const std::string& text) { return {text.data(), text.size()}; }

/// A plugin of one node.
struct Library {
  std::string name, declaration;
  std::vector<std::string> inputs;
  py::object call;
  bf_node node{};
  const bf_node* nodes[1] = {&node};
  bf_plugin plugin{};
};

py::dict inputs_of(const Library& library, const bf_run& run) {
  py::dict inputs;
  for (const std::string& port : library.inputs) {
    py::list connected;
    const std::uint64_t count = run.input_count(run.host, bytes(port));
    for (std::uint64_t i = 0; i < count; ++i) {
      bf_artifact artifact{};
      artifact.struct_size = sizeof artifact;
      if (run.input(run.host, bytes(port), i, &artifact) != 0)
        connected.append(Handle{artifact_of(artifact)});
    }
    inputs[py::str(port)] = connected;
  }
  return inputs;
}

int hand_over(const bf_run& run, const std::string& port, const ArtifactPtr& artifact) {
  const std::vector<bf_array> arrays = handed_over(artifact);
  return run.output(run.host, bytes(port), arrays.data(), arrays.size(), bytes(artifact->summary()));
}

int failed(const bf_run& run, const std::string& cause, const std::string& hint) {
  run.fail(run.host, bytes(cause), bytes(hint));
  return BF_FAILED;
}

/// With the GIL.
int run_with_python(const Library& library, const bf_run& run) {
  const auto told = std::make_shared<NodeRun>(&run);
  const py::object told_object = py::cast(told);
  const py::object result =
      library.call(inputs_of(library, run), std::string(run.params.data, run.params.size), told_object);
  told->end();
  const auto answer = py::cast<py::tuple>(result);
  const auto status = py::cast<std::string>(answer[0]);
  if (status == "cancelled") return BF_CANCELLED;
  if (status == "failed")
    return failed(run, py::cast<std::string>(answer[1]), py::cast<std::string>(answer[2]));
  std::vector<std::pair<std::string, ArtifactPtr>> outputs;
  for (const auto& [port, handle] : py::cast<py::dict>(answer[1]))
    outputs.emplace_back(py::cast<std::string>(port), py::cast<Handle&>(handle).artifact);
  const py::gil_scoped_release release;
  for (const auto& [port, artifact] : outputs) {
    if (hand_over(run, port, artifact) != 0) return BF_FAILED;  // which has said why
  }
  return BF_OK;
}

int run_node(void* self, const bf_run* run) noexcept {
  try {
    const py::gil_scoped_acquire gil;
    try {
      return run_with_python(*static_cast<const Library*>(self), *run);
    } catch (const std::exception& error) {
      return failed(*run, error.what(), "");
    }
  } catch (...) {
    return BF_FAILED;
  }
}

}  // namespace

bool NodeRun::cancelled() const { return run_ == nullptr || run_->cancelled(run_->host) != 0; }

void NodeRun::progress(double fraction) const {
  if (run_ != nullptr) run_->progress(run_->host, fraction);
}

void NodeRun::log(const std::string& text, bool warning) const {
  if (run_ != nullptr) run_->log(run_->host, warning ? BF_WARNING : BF_INFO, bytes(text));
}

void add_node(Registry& registry, const std::string& declaration, const std::string& file,
              const std::string& digest, const py::object& call) {
  const NodeDeclaration parsed = parse_node_declaration(declaration);
  auto library = std::make_unique<Library>();
  library->name = parsed.id;
  library->declaration = declaration;
  for (const PortDecl& port : parsed.inputs) library->inputs.push_back(port.name);
  library->call = call;
  library->node = {sizeof(bf_node), 0, bytes(library->declaration), library.get(), &run_node, nullptr};
  library->plugin = {sizeof(bf_plugin),
                     BALLFLOW_ABI_VERSION,
                     bytes(library->name),
                     {"", 0},
                     nullptr,
                     0,
                     library->nodes,
                     1,
                     library.get(),
                     [](void* owner) {
                       if (Py_IsInitialized() == 0) return;
                       const py::gil_scoped_acquire gil;
                       delete static_cast<Library*>(owner);
                     }};
  registry.add_plugin(library.release()->plugin, file, digest);  // which is the owner from now on
}

}  // namespace ballflow::python
