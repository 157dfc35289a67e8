#include "plugin/python_library.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "ballflow/error.hpp"
#include "ballflow/json.hpp"
#include "base/quote.hpp"
#include "plugin/shared_arrays.hpp"
#include "plugin/text_view.hpp"
#include "process/child.hpp"

namespace ballflow {

namespace fs = std::filesystem;

namespace {

constexpr int look_around_ms = 20;   // how often a wait asks whether the run was cancelled
constexpr int time_to_end_ms = 300;  // between SIGTERM and SIGKILL: a function may remove its files
constexpr char interpreter[] = "python3";

[[noreturn]] void give_up(const std::string& why, const std::string& hint = {}) {
  throw Error(ExitCode::plugin, why, hint);
}

std::string dumped(const Json& json) { return json.dump(-1, ' ', true, Json::error_handler_t::replace); }

std::string text_in(const Json& json, const char* name) {
  return json.is_object() && json.contains(name) && json.at(name).is_string()
             ? json.at(name).get<std::string>()
             : std::string();
}

Json type_json(const TypeDeclaration& type) {
  Json arrays = Json::array(), summary = Json::array();
  for (const ArrayDecl& array : type.arrays) {
    arrays.push_back(
        {{"name", array.name}, {"dtype", array.dtype}, {"shape", array.shape}, {"doc", array.doc}});
    if (array.optional) arrays.back()["optional"] = true;
  }
  for (const auto& [name, doc] : type.summary) summary.push_back({{"name", name}, {"doc", doc}});
  return {{"id", type.id},
          {"version", type.version},
          {"doc", type.doc},
          {"arrays", std::move(arrays)},
          {"summary", std::move(summary)}};
}

/// The program of the processes: where ballflow is installed or built, in a Python wheel, in Debian's folder.
std::string worker_file(const std::string& installed) {
  const fs::path libraries = installed;
  const std::array<fs::path, 3> packages = {libraries / "../../share/ballflow/python/ballflow",
                                            libraries / "../..",
                                            libraries / "../python3/dist-packages/ballflow"};
  for (const fs::path& package : packages) {
    std::error_code error;
    const fs::path real = fs::canonical(package / "_worker.py", error);
    if (!error) return real.string();
  }
  give_up("needs the Python package of ballflow, and there is no " +
              (packages[0] / "_worker.py").lexically_normal().string(),
          "install ballflow again, as a whole");
}

/// What stands for a run that has ended: the node is to return `status`.
struct Ended {
  int status;
};

/// A file of nodes and the processes that run them: one for each node that runs at the time, started when
/// there is none that waits.
class PythonFile {
 public:
  PythonFile(const std::string& path, const Declarations<TypeDeclaration>& types,
             const std::string& installed)
      : name_(fs::path(path).stem().string()) {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (error) give_up("cannot be read: " + error.message());
    Json declared = Json::array();
    for (const auto& [id, type] : types) declared.push_back(type_json(type));
    setup_ = dumped({{"file", real.string()}, {"types", std::move(declared)}});

    const char* const named = std::getenv("BALLFLOW_PYTHON");
    const std::string python = named != nullptr && *named != 0 ? named : interpreter;
    command_.arguments = {python, worker_file(installed)};
    // Results must not depend on the machine: no random order of sets, no sums in parallel.
    command_.environment = {{"PYTHONHASHSEED", "0"},
                            {"OMP_NUM_THREADS", "1"},
                            {"OPENBLAS_NUM_THREADS", "1"},
                            {"MKL_NUM_THREADS", "1"}};
    hello_ = start(first_, {});
    make_table();
  }
  PythonFile(const PythonFile&) = delete;
  PythonFile& operator=(const PythonFile&) = delete;

  const bf_plugin* table() const { return &table_; }
  std::map<std::string, std::string> digests() const {
    std::map<std::string, std::string> all;
    for (const Json& node : hello_.at("nodes")) {
      const Json& declaration = node.at("declaration");
      all[text_in(declaration, "id")] = text_in(node, "digest");
    }
    return all;
  }

  /// One execution; the status to return.
  int run(const bf_run& run) {
    std::unique_ptr<Child> child = take(run);
    const int status = talk(*child, run);
    if (status != BF_CANCELLED && !child->has_ended()) give_back(std::move(child));
    return status;
  }

 private:
  /// Starts a process and hears what it declares.
  Json start(std::unique_ptr<Child>& child, const std::function<bool()>& cancelled) {
    try {
      child = std::make_unique<Child>(command_);
    } catch (const Error& error) {
      give_up(std::string("needs Python with numpy: ") + error.what(),
              "install python3 and python3-numpy, or name an interpreter in $BALLFLOW_PYTHON");
    }
    child->send(setup_);
    for (;;) {
      if (const std::optional<std::string> line = child->receive(look_around_ms)) {
        Json said = Json::parse(*line, nullptr, false);
        if (const std::string why = text_in(said, "refused"); !why.empty()) {
          give_up(why, why.find("numpy, which") != std::string::npos
                           ? "install python3-numpy, or name another interpreter in $BALLFLOW_PYTHON"
                           : "");
        }
        if (said.is_object() && said.contains("nodes") && said.at("nodes").is_array()) return said;
        give_up("made its process say " + in_quotes(*line));
      }
      if (cancelled && cancelled()) {
        child->end(time_to_end_ms);
        throw Ended{BF_CANCELLED};
      }
      if (child->has_ended()) {
        const std::vector<std::string> printed = child->printed(true);
        give_up("made " + command_.arguments[0] + " end while it was imported: it " + child->how_it_ended() +
                (printed.empty() ? "" : "; the last that it printed: " + printable(printed.back())));
      }
    }
  }

  void make_table() {
    for (const Json& node : hello_.at("nodes")) {
      if (!node.is_object() || !node.contains("declaration")) give_up("made its process declare no node");
      declarations_.push_back(dumped(node.at("declaration")));
    }
    version_ = text_in(hello_, "version");
    for (const std::string& declaration : declarations_) {
      bf_node entry{};
      entry.struct_size = sizeof entry;
      entry.declaration = as_bytes(declaration);
      entry.self = this;
      entry.run = [](void* self, const bf_run* run) noexcept -> int {
        return static_cast<PythonFile*>(self)->guarded(*run);
      };
      entries_.push_back(entry);
    }
    for (const bf_node& entry : entries_) nodes_.push_back(&entry);
    table_.struct_size = sizeof table_;
    table_.abi_version = BALLFLOW_ABI_VERSION;
    table_.name = as_bytes(name_);
    table_.version = as_bytes(version_);
    table_.nodes = nodes_.data();
    table_.node_count = nodes_.size();
    table_.owner = this;
    table_.release = [](void* self) { delete static_cast<PythonFile*>(self); };
  }

  int guarded(const bf_run& host) noexcept {
    try {
      return run(host);
    } catch (const Ended& ended) {
      return ended.status;
    } catch (const Error& error) {
      host.fail(host.host, as_bytes(error.what()), as_bytes(error.hint()));
    } catch (const std::exception& error) {
      host.fail(host.host, as_bytes(error.what()), {});
    }
    return BF_FAILED;
  }

  /// A process that waits, else a new one.
  std::unique_ptr<Child> take(const bf_run& run) {
    for (;;) {
      std::unique_ptr<Child> child;
      {
        const std::lock_guard lock(mutex_);
        if (first_ != nullptr) {
          child = std::move(first_);
        } else if (!waiting_.empty()) {
          child = std::move(waiting_.back());
          waiting_.pop_back();
        }
      }
      if (child == nullptr) break;
      if (!child->has_ended()) return child;
    }
    std::unique_ptr<Child> child;
    Json hello;
    try {
      hello = start(child, [&] { return run.cancelled(run.host) != 0; });
    } catch (const Error& error) {
      throw Error(error.code(), "its file " + std::string(error.what()), error.hint());
    }
    // The key says what the function was when the run began.
    if (hello != hello_) {
      give_up("its file " + name_ + ".py, or one that it imports, was changed while the run went on",
              "run again: the result would not be that of its key");
    }
    return child;
  }

  void give_back(std::unique_ptr<Child> child) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(std::move(child));
  }

  /// What a node wants to know, and a file with its inputs.
  static std::string request(const bf_run& run, const Json& declaration, std::uint64_t number,
                             Descriptor& file) {
    Json inputs = Json::object();
    ArraysToShare arrays;
    for (const Json& port : declaration.value("inputs", Json::array())) {
      const std::string name = text_in(port, "name");
      const std::uint64_t count = run.input_count(run.host, as_bytes(name));
      for (std::uint64_t i = 0; i < count; ++i) {
        bf_artifact artifact{};
        artifact.struct_size = sizeof artifact;
        if (run.input(run.host, as_bytes(name), i, &artifact) != 0)
          inputs[name].push_back(arrays.add(artifact));
      }
    }
    file = arrays.file();
    return dumped(
        {{"number", number},
         {"run", std::string(view(run.node))},
         {"params", Json::parse(view(run.params), nullptr, false)},
         {"seed", run.seed},
         {"threads", run.max_threads},
         {"memory", run.struct_size >= BALLFLOW_SIZE_UP_TO(bf_run, memory_bytes) ? run.memory_bytes : 0},
         {"inputs", std::move(inputs)}});
  }

  const Json& declaration_of(std::string_view id) const {
    for (const Json& node : hello_.at("nodes")) {
      if (text_in(node.at("declaration"), "id") == id) return node.at("declaration");
    }
    give_up("its file does not declare it");
  }

  static void tell(const bf_run& run, Child& child, bool all) {
    for (const std::string& line : child.printed(all)) run.log(run.host, BF_INFO, as_bytes(line));
  }

  int talk(Child& child, const bf_run& run) {
    Descriptor inputs;
    const std::uint64_t number = ++executions_;
    const std::string wanted = request(run, declaration_of(view(run.node)), number, inputs);
    child.send(wanted, inputs.get());  // where it is not there any more, that is seen below
    inputs.close();
    for (;;) {
      const std::optional<std::string> line = child.receive(look_around_ms);
      tell(run, child, false);
      if (line) {
        const Json said = Json::parse(*line, nullptr, false);
        const bool with_file = said.is_object() && said.contains("outputs");
        Descriptor outputs = with_file ? child.take_file() : Descriptor();
        // Threads of a function may go on when it has returned: what they say then is nobody's.
        if (said.is_object() && said.value("of", Json()) == Json(number)) {
          if (with_file || said.contains("error")) tell(run, child, true);
          if (with_file) return hand_over(run, said.at("outputs"), std::move(outputs));
          if (said.contains("error")) return failed(run, said);
          heard(run, said);
        }
      }
      if (run.cancelled(run.host) != 0) {
        child.end(time_to_end_ms);
        return BF_CANCELLED;
      }
      if (!line && child.has_ended()) return died(run, child);
    }
  }

  static void heard(const bf_run& run, const Json& said) {
    if (said.contains("progress") && said.at("progress").is_number()) {
      run.progress(run.host, std::clamp(said.at("progress").get<double>(), 0.0, 1.0));
    }
    for (const auto& [name, level] : {std::pair{"log", BF_INFO}, std::pair{"warn", BF_WARNING}}) {
      if (const std::string text = text_in(said, name); !text.empty())
        run.log(run.host, level, as_bytes(text));
    }
  }

  int failed(const bf_run& run, const Json& said) const {
    // The traceback is for who watches; the cause names the line.
    for (const Json& line : said.value("trace", Json::array())) {
      if (line.is_string()) run.log(run.host, BF_INFO, as_bytes(line.get_ref<const std::string&>()));
    }
    run.fail(run.host, as_bytes(text_in(said, "error")), as_bytes(text_in(said, "hint")));
    return BF_FAILED;
  }

  int died(const bf_run& run, Child& child) const {
    tell(run, child, true);
    const std::string how = child.how_it_ended();
    const std::string cause = "its Python process " + how + " before the function returned";
    const std::string hint =
        how.find("(Killed)") != std::string::npos
            ? "where nobody has ended it, memory ran out: use a smaller input, or fewer --threads"
            : "what it printed last is among the messages of the node; look for os._exit, and for what its "
              "libraries do";
    run.fail(run.host, as_bytes(cause), as_bytes(hint));
    return BF_FAILED;
  }

  static int hand_over(const bf_run& run, const Json& outputs, Descriptor file) {
    const SharedArrays shared(std::move(file));
    if (!outputs.is_object()) give_up("its process handed over no outputs");
    for (const auto& [port, artifact] : outputs.items()) {
      if (!artifact.is_object() || !artifact.contains("arrays")) give_up("its process handed over no arrays");
      const std::vector<bf_array> arrays = shared.arrays(artifact.at("arrays"));
      // No summary: the type makes it, as it does for nodes in C++.
      if (run.output(run.host, as_bytes(port), arrays.data(), arrays.size(), {}) != 0)
        return BF_FAILED;  // the engine has recorded why it refused the output
    }
    return BF_OK;
  }

  std::string name_, version_, setup_;
  ChildCommand command_;
  Json hello_;
  std::vector<std::string> declarations_;
  std::vector<bf_node> entries_;
  std::vector<const bf_node*> nodes_;
  bf_plugin table_{};
  std::atomic<std::uint64_t> executions_ = 0;
  std::mutex mutex_;
  std::unique_ptr<Child> first_;  // that has said what there is
  std::vector<std::unique_ptr<Child>> waiting_;
};

}  // namespace

bool is_python_file(const std::string& path) { return path.ends_with(".py"); }

PythonLibrary load_python(const std::string& path, const Declarations<TypeDeclaration>& types,
                          const std::string& installed) {
  auto file = std::make_unique<PythonFile>(path, types, installed);
  PythonLibrary library{file->table(), file->digests()};
  file.release();  // owned by the table
  return library;
}

}  // namespace ballflow
