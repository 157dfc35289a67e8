// The module ballflow._core: what the Python package is built on. It is not meant to be used directly; names
// and types of the package are in ballflow/*.py, where they are documented.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <unistd.h>

#include "artifacts.hpp"
#include "ballflow/error.hpp"
#include "ballflow/report.hpp"
#include "ballflow/schema.hpp"
#include "ballflow/shipped_graphs.hpp"
#include "export/export.hpp"
#include "python_nodes.hpp"
#include "runs.hpp"

namespace ballflow::python {
namespace {

std::string_view view(bf_bytes text) { return {text.data, static_cast<std::size_t>(text.size)}; }

const char* kind_name(ParamKind kind) {
  switch (kind) {
    case ParamKind::number:
      return "number";
    case ParamKind::integer:
      return "integer";
    case ParamKind::boolean:
      return "boolean";
    case ParamKind::string:
      return "string";
    case ParamKind::choice:
      return "choice";
    case ParamKind::file:
      return "file";
    case ParamKind::list:
      return "list";
    case ParamKind::files:
      return "files";
    case ParamKind::artifact:
      return "artifact";
  }
  return "";
}

using Registries = std::shared_ptr<Registry>;  // pybind11 knows no pointers to const

py::list type_declarations(const Registry& registry) {
  py::list all;
  for (const auto& [id, type] : registry.types()) {
    if (type.entry != nullptr) all.append(py::str(std::string(view(type.entry->declaration))));
  }
  return all;
}

py::list node_declarations(const Registry& registry) {
  py::list all;
  for (const auto& [id, node] : registry.nodes()) {
    if (node.entry != nullptr) all.append(py::str(std::string(view(node.entry->declaration))));
  }
  return all;
}

Registries load_registry(const std::vector<std::string>& extra, const std::string& installed) {
  return std::make_shared<Registry>(*Registry::load(extra, installed));
}

/// The same, and nodes written in Python: (declaration, file, digest, callable) each.
Registries with_nodes(const Registry& registry, const py::list& nodes) {
  const auto more = std::make_shared<Registry>(registry);
  for (const py::handle& node : nodes) {
    const auto parts = py::cast<py::tuple>(node);
    add_node(*more, py::cast<std::string>(parts[0]), py::cast<std::string>(parts[1]),
             py::cast<std::string>(parts[2]), parts[3]);
  }
  return more;
}

Handle make(const Registry& registry, const std::string& type, const py::dict& arrays) {
  const TypeDeclaration* const declaration = registry.type(type);
  if (declaration == nullptr) throw Error(ExitCode::usage, "there is no artifact type \"" + type + "\"");
  return {artifact_of(*declaration, arrays)};
}

Handle read_artifact(const std::string& path) {
  const py::gil_scoped_release release;
  return {Artifact::map(path)};
}

void save_artifact(const Handle& handle, const std::string& path, const std::string& format) {
  const py::gil_scoped_release release;
  export_artifact(*handle.artifact, path, format);
}

/// `upstream`: a place as of Upstream::open, or empty.
std::shared_ptr<Store> open_store(const std::string& root, const std::string& upstream,
                                  bool upstream_read_only) {
  StoreOptions options;
  options.root = root;
  const py::gil_scoped_release release;
  if (!upstream.empty()) {
    options.upstream.upstream = Upstream::open(upstream);
    options.upstream.read_only = upstream_read_only;
  }
  return Store::open(options);
}

std::shared_ptr<Plan> load_plan(const Registries& registry, const std::string& file,
                                const std::optional<std::string>& text,
                                const std::vector<std::pair<std::string, std::string>>& settings,
                                const std::vector<std::pair<std::string, std::string>>& axes,
                                const std::vector<std::string>& inputs,
                                const std::map<std::string, Handle>& given,
                                const std::shared_ptr<Store>& store) {
  const auto settings_of = [](const std::vector<std::pair<std::string, std::string>>& pairs) {
    std::vector<Setting> result;
    for (const auto& [name, value] : pairs) result.push_back({name, value});
    return result;
  };
  std::map<std::string, ArtifactPtr> artifacts;
  for (const auto& [name, handle] : given) artifacts.emplace(name, handle.artifact);
  const FindArtifact find = [&store](const std::string& name) -> ArtifactPtr {
    if (access(name.c_str(), F_OK) == 0) return Artifact::map(name);
    throw Error(ExitCode::usage, "there is no file \"" + name + "\"",
                "give an artifact of an earlier run, or the path of a safetensors file");
  };
  const py::gil_scoped_release release;
  const SweepOptions sweep{settings_of(axes), inputs};
  Dag dag = text ? parse_graph(*text, file, *registry, settings_of(settings), sweep, artifacts, find)
                 : load_graph(file, *registry, settings_of(settings), sweep, artifacts, find);
  return std::make_shared<Plan>(Plan{registry, std::move(dag)});
}

py::list outputs_of(const Dag& dag, const std::vector<DagOutput>& outputs) {
  py::list all;
  for (const DagOutput& output : outputs) {
    const PortDecl* const port = dag.nodes[output.from.node].kind.output(output.from.port);
    all.append(py::make_tuple(output.name, dag.nodes[output.from.node].path, output.from.port,
                              port == nullptr ? "" : port->type, output.doc));
  }
  return all;
}

py::list variants_of(const Dag& dag) {
  py::list all;
  for (const Variant& variant : dag.variants) {
    py::list values;
    for (const auto& [name, value] : variant.values) values.append(py::make_tuple(name, value.dump()));
    all.append(py::make_tuple(variant.name, values));
  }
  return all;
}

py::dict params_of(const Dag& dag) {
  py::dict params;
  for (const auto& [name, value] : dag.params) params[py::str(name)] = value.dump();
  return params;
}

/// (doc, [(name, kind, doc, default as JSON or None)], [(name, doc)])
py::tuple outline_of(const std::string& file, const std::optional<std::string>& text) {
  const GraphOutline outline = text ? parse_outline(*text, file) : load_outline(file);
  py::list params, outputs;
  for (const ParamDecl& param : outline.params) {
    const py::object value = param.required ? py::object(py::none()) : py::str(param.default_value.dump());
    params.append(py::make_tuple(param.name, kind_name(param.kind), param.doc, value));
  }
  for (const auto& [name, doc] : outline.outputs) outputs.append(py::make_tuple(name, doc));
  return py::make_tuple(outline.doc, params, outputs);
}

/// Errors of the engine become the exceptions of ballflow/_errors.py.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const Error& error, const std::vector<Diagnostic>& findings) {
    py::list texts;
    for (const Diagnostic& finding : findings) texts.append(py::str(finding.text()));
    const py::object exception = py::module_::import("ballflow._errors")
                                     .attr("of_engine")(std::string(ballflow::to_string(error.code())),
                                                        std::string(error.what()), error.hint(), texts);
    PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const GraphError& error) {
    raise(error, error.findings());
  } catch (const Error& error) {
    raise(error, {});
  }
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  module.attr("version") = BALLFLOW_VERSION;
  py::register_exception_translator(&translate);

  py::class_<Handle>(module, "Artifact")
      .def_property_readonly("type", [](const Handle& handle) { return handle.artifact->type(); })
      .def_property_readonly("version", [](const Handle& handle) { return handle.artifact->version(); })
      .def_property_readonly("summary", [](const Handle& handle) { return handle.artifact->summary(); })
      .def_property_readonly("bytes", [](const Handle& handle) { return handle.artifact->file_size(); })
      .def_property_readonly("digest",
                             [](const Handle& handle) {
                               const py::gil_scoped_release release;
                               return handle.artifact->digest().hex();
                             })
      .def("arrays", [](const Handle& handle) { return arrays_of(handle.artifact); })
      .def("save", &save_artifact);

  py::class_<Registry, Registries>(module, "Registry")
      .def("types", &type_declarations)
      .def("nodes", &node_declarations)
      .def("with_nodes", &with_nodes)
      .def("make", &make)
      .def("node_markdown", [](const Registry& registry, const std::string& id) {
        const NodeDeclaration* const node = registry.node(id);
        return node == nullptr ? std::string() : node_markdown(*node);
      });
  module.def("load_registry", &load_registry, py::call_guard<py::gil_scoped_release>());
  module.def("read_artifact", &read_artifact);
  module.def("export_formats", [](const std::string& type) { return export_formats(type); });
  module.def("extension", [](const std::string& type, const std::string& format) {
    return extension_of(type, format.empty() ? default_format(type) : format);
  });

  py::class_<Store, std::shared_ptr<Store>>(module, "Store")
      .def_property_readonly("root", &Store::root)
      .def_property_readonly("why", &Store::why)
      .def_property_readonly("upstream_notes", &Store::upstream_notes);
  module.def("open_store", &open_store);
  module.def("default_cache", &Store::default_root);

  py::class_<Plan, std::shared_ptr<Plan>>(module, "Plan")
      .def_property_readonly("doc", [](const Plan& plan) { return plan.dag.doc; })
      .def_property_readonly("file", [](const Plan& plan) { return plan.dag.file; })
      .def_property_readonly("params", [](const Plan& plan) { return params_of(plan.dag); })
      .def_property_readonly("outputs",
                             [](const Plan& plan) { return outputs_of(plan.dag, plan.dag.outputs); })
      .def_property_readonly("interfaces",
                             [](const Plan& plan) { return outputs_of(plan.dag, plan.dag.interfaces); })
      .def_property_readonly("variants", [](const Plan& plan) { return variants_of(plan.dag); })
      .def_property_readonly("nodes",
                             [](const Plan& plan) {
                               py::list all;
                               for (const DagNode& node : plan.dag.nodes)
                                 all.append(py::make_tuple(node.path, node.kind.type()));
                               return all;
                             })
      .def_property_readonly("warnings", [](const Plan& plan) {
        py::list all;
        for (const Diagnostic& warning : plan.dag.warnings) all.append(py::str(warning.text()));
        return all;
      });
  module.def("find_graph", &find_graph);
  module.def("shipped_graphs", [](const std::string& folder) {
    py::list all;
    for (const ShippedGraph& graph : shipped_graphs(folder))
      all.append(py::make_tuple(graph.name, graph.doc, graph.file));
    return all;
  });
  module.def("outline", &outline_of, py::arg("file"), py::arg("text") = py::none());
  module.def("load_plan", &load_plan, py::arg("registry"), py::arg("file"), py::arg("text"),
             py::arg("settings"), py::arg("axes"), py::arg("inputs"), py::arg("given"), py::arg("store"));

  py::class_<RunSettings>(module, "RunSettings")
      .def(py::init<>())
      .def_readwrite("threads", &RunSettings::threads)
      .def_readwrite("memory", &RunSettings::memory)
      .def_readwrite("seed", &RunSettings::seed)
      .def_readwrite("keep_going", &RunSettings::keep_going)
      .def_readwrite("strict", &RunSettings::strict)
      .def_readwrite("until", &RunSettings::until)
      .def_readwrite("only", &RunSettings::only)
      .def_readwrite("force", &RunSettings::force);

  py::class_<FinishedRun, std::shared_ptr<FinishedRun>>(module, "Run")
      .def_property_readonly("id", &FinishedRun::id)
      .def_property_readonly("recorded", &FinishedRun::recorded)
      .def_property_readonly("report", &FinishedRun::report)
      .def_property_readonly("trouble", &FinishedRun::trouble)
      .def("artifact", [](FinishedRun& run, const std::string& path, const std::string& port) {
        return Handle{run.artifact(path, port)};
      });
  module.def("run", [](const std::shared_ptr<Plan>& plan, const std::shared_ptr<Store>& store,
                       const RunSettings& settings, const std::string& cache_size, const std::string& command,
                       const py::object& progress) {
    return std::make_shared<FinishedRun>(plan, store, settings, cache_size, command, progress);
  });

  py::class_<NodeRun, std::shared_ptr<NodeRun>>(module, "NodeRun")
      .def("cancelled", &NodeRun::cancelled, py::call_guard<py::gil_scoped_release>())
      .def("progress", &NodeRun::progress, py::call_guard<py::gil_scoped_release>())
      .def("log", &NodeRun::log, py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("seed", &NodeRun::seed)
      .def_property_readonly("threads", &NodeRun::threads)
      .def_property_readonly("memory_bytes", &NodeRun::memory_bytes);
}

}  // namespace ballflow::python
