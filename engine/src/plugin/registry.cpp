#include "ballflow/registry.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "ballflow/error.hpp"
#include "base/quote.hpp"
#include "plugin/library_file.hpp"
#include "plugin/python_library.hpp"
#include "plugin/text_view.hpp"

namespace ballflow {

namespace fs = std::filesystem;

namespace {

struct PluginTables {
  std::string name, version;
  std::vector<TypeDeclaration> types;
  std::vector<NodeDeclaration> nodes;
};

[[noreturn]] void refuse(const std::string& why) { throw Error(ExitCode::plugin, why); }

/// Reads the tables of a loaded library; throws Error that says what is wrong with them.
PluginTables read_tables(const bf_plugin& plugin, const std::string& path) {
  constexpr std::uint64_t most_entries = 100'000;
  if (plugin.struct_size < BF_PLUGIN_MIN_SIZE) refuse("hands over a plugin table that is too small");
  if (plugin.abi_version != BALLFLOW_ABI_VERSION) {
    refuse("says plugin ABI " + std::to_string(plugin.abi_version) + ", this program has plugin ABI " +
           std::to_string(BALLFLOW_ABI_VERSION));
  }
  if (plugin.node_count > most_entries || plugin.type_count > most_entries)
    refuse("claims more than 100000 nodes or types");
  if ((plugin.node_count > 0 && plugin.nodes == nullptr) ||
      (plugin.type_count > 0 && plugin.types == nullptr)) {
    refuse("hands over a null table of nodes or types");
  }
  PluginTables tables;
  tables.name = printable(view(plugin.name));
  tables.version = printable(view(plugin.version));
  for (std::uint64_t i = 0; i < plugin.type_count; ++i) {
    const bf_type* entry = plugin.types[i];
    if (entry == nullptr || entry->struct_size < BF_TYPE_MIN_SIZE)
      refuse("type " + std::to_string(i) + " is null or too small");
    TypeDeclaration type = parse_type_declaration(view(entry->declaration));
    type.plugin_path = path;
    type.entry = entry;
    tables.types.push_back(std::move(type));
  }
  for (std::uint64_t i = 0; i < plugin.node_count; ++i) {
    const bf_node* entry = plugin.nodes[i];
    if (entry == nullptr || entry->struct_size < BF_NODE_MIN_SIZE)
      refuse("node " + std::to_string(i) + " is null or too small");
    NodeDeclaration node = parse_node_declaration(view(entry->declaration));
    if (entry->run == nullptr) refuse("node " + in_quotes(node.id) + " has no run function");
    node.plugin_path = path;
    node.entry = entry;
    tables.nodes.push_back(std::move(node));
  }
  return tables;
}

std::string origin(const std::string& path) { return path.empty() ? "this program" : path; }

template <class Declaration>
void add_once(std::map<std::string, Declaration>& all, Declaration added, const char* what) {
  const auto [place, fresh] = all.try_emplace(added.id, added);
  if (fresh || place->second.same_content(added)) return;  // the first of equal ones stays
  const Declaration& other = place->second;
  throw Error(ExitCode::plugin,
              std::string(what) + " " + in_quotes(added.id) + " is declared differently by " +
                  origin(other.plugin_path) + " (version " + std::to_string(other.version) + ") and by " +
                  origin(added.plugin_path) + " (version " + std::to_string(added.version) + ")",
              "remove one of the two libraries, or build both from the same sources");
}

/// Nodes that a program adds itself have no file, and are told apart by their declarations only.
bool same_file(const NodeDeclaration& a, const NodeDeclaration& b) {
  if (a.plugin_path == b.plugin_path) return true;
  const auto digest = [](const NodeDeclaration& node) {
    if (!node.library_file.empty()) return node.library_file;
    std::error_code error;
    const fs::path real = fs::canonical(node.plugin_path, error);
    return error ? std::string() : library_digest(real.string()).hex();
  };
  const std::string of_a = digest(a), of_b = digest(b);
  return of_a.empty() || of_b.empty() || of_a == of_b;
}

/// The *.so files of a folder by name; a folder that is absent has none.
std::vector<std::string> libraries_in(const fs::path& folder) {
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() == ".so") files.push_back(entry->path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string Registry::default_folder() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? std::string() : (self.parent_path().parent_path() / "lib" / "ballflow").string();
}

void Registry::add(NodeDeclaration node) {
  const auto known = nodes_.find(node.id);
  if (known != nodes_.end() && known->second.same_content(node) && !same_file(known->second, node)) {
    throw Error(ExitCode::plugin,
                "node " + in_quotes(node.id) + " is declared in the same words by two different files, " +
                    origin(known->second.plugin_path) + " and " + origin(node.plugin_path) +
                    ", and may compute different things",
                "remove one of the two libraries, or install the same build in both places");
  }
  add_once(nodes_, std::move(node), "node");
}
void Registry::add(TypeDeclaration type) { add_once(types_, std::move(type), "type"); }

void Registry::add_plugin(const bf_plugin& plugin, const std::string& path, const std::string& library_file) {
  add_tables(plugin, path, [&](const std::string&) { return library_file; });
}

void Registry::add_plugin(const bf_plugin& plugin, const std::string& path,
                          const std::map<std::string, std::string>& digests) {
  add_tables(plugin, path, [&](const std::string& id) {
    const auto found = digests.find(id);
    return found == digests.end() ? std::string() : found->second;
  });
}

void Registry::add_tables(const bf_plugin& plugin, const std::string& path,
                          const std::function<std::string(const std::string&)>& library_file) {
  PluginTables tables = read_tables(plugin, path);
  if (plugin.release != nullptr) owners_.emplace_back(plugin.owner, plugin.release);
  for (TypeDeclaration& type : tables.types) add(std::move(type));
  for (NodeDeclaration& node : tables.nodes) {
    node.library_file = library_file(node.id);
    add(std::move(node));
  }
  candidates_.push_back({path, tables.name, tables.version, ""});
}

std::shared_ptr<const Registry> Registry::load(const std::vector<std::string>& extra,
                                               const std::string& own) {
  const auto registry = std::make_shared<Registry>();
  std::set<std::string> seen;
  std::error_code none;
  const fs::path installed = own.empty() ? fs::path() : fs::canonical(own, none);

  const auto load_file = [&](const std::string& path) -> std::string {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (!error && !seen.insert(real.string()).second) return {};
    std::string why = refuse_plugin_file(path);
    const bf_plugin* plugin = nullptr;
    std::string library_file;
    if (why.empty()) {
      const fs::file_time_type written = fs::last_write_time(real, error);
      if (real.parent_path() != installed) library_file = library_digest(real.string()).hex();
      // Never closed: artifacts, declarations and thread-local destructors point into it.
      void* const handle = dlopen(real.c_str(), RTLD_NOW | RTLD_LOCAL);
      if (handle == nullptr) {
        const char* const reason = dlerror();
        why = std::string("cannot be loaded: ") + (reason != nullptr ? reason : "unknown reason");
      } else if (const auto entry = reinterpret_cast<bf_plugin_entry>(dlsym(handle, "ballflow_plugin"));
                 entry == nullptr) {
        why = "exports no function ballflow_plugin";
      } else if (fs::last_write_time(real, error) != written) {
        why = "was written while it was loaded: try again";
      } else if (plugin = entry(); plugin == nullptr) {
        why = "could not make its tables of nodes and types";
      }
    }
    if (plugin != nullptr) {
      try {
        read_tables(*plugin, path);
      } catch (const Error& problem) {
        why = problem.what();
      }
    }
    if (why.empty()) {
      registry->add_plugin(*plugin, path, library_file);
    } else {
      registry->candidates_.push_back({path, "", "", why});
    }
    return why;
  };

  // Functions name types, so their files come when all types are known.
  std::vector<std::string> python_files;
  const auto load_python_file = [&](const std::string& path) {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (!error && !seen.insert(real.string()).second) return;
    PythonLibrary library;
    try {
      library = load_python(path, registry->types_, own);
      read_tables(*library.table, path);
    } catch (const Error& problem) {
      if (library.table != nullptr) library.table->release(library.table->owner);
      throw Error(ExitCode::plugin, "the node library " + path + " " + problem.what(), problem.hint());
    }
    registry->add_plugin(*library.table, path, library.digests);
  };

  const auto load_folder = [&](const std::string& folder) {
    registry->folders_.push_back(folder);
    for (const std::string& file : libraries_in(folder)) load_file(file);
  };

  for (const std::string& path : extra) {
    std::error_code error;
    if (fs::is_directory(path, error)) {
      load_folder(path);
      continue;
    }
    if (is_python_file(path)) {
      python_files.push_back(path);
      continue;
    }
    const std::string why = load_file(path);
    if (!why.empty()) throw Error(ExitCode::plugin, "the node library " + path + " " + why);
  }
  if (const char* folders = std::getenv("BALLFLOW_PLUGIN_PATH")) {
    std::string_view rest = folders;
    while (!rest.empty()) {
      const std::string_view folder = rest.substr(0, rest.find(':'));
      rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
      if (!folder.empty()) load_folder(std::string(folder));
    }
  }
  if (!own.empty()) load_folder(own);
  for (const std::string& path : python_files) load_python_file(path);

  registry->drop_nodes_of_unknown_types();
  return registry;
}

void Registry::drop_nodes_of_unknown_types() {
  const auto problem_of = [&](const NodeDeclaration& node) -> std::string {
    for (const std::vector<PortDecl>* ports : {&node.inputs, &node.outputs}) {
      for (const PortDecl& port : *ports) {
        const TypeDeclaration* known = type(port.type);
        const std::string start = "node " + in_quotes(node.id) + ": port " + in_quotes(port.name) +
                                  " has the type " + in_quotes(port.type) + " version " +
                                  std::to_string(port.type_version);
        if (known == nullptr) return start + ", which no loaded library declares";
        if (known->version != port.type_version) {
          return start + ", but version " + std::to_string(known->version) + " is declared by " +
                 origin(known->plugin_path);
        }
      }
    }
    return {};
  };
  std::set<std::string> dropped;
  for (const auto& [id, node] : nodes_) {
    const std::string problem = problem_of(node);
    if (problem.empty() || !dropped.insert(node.plugin_path).second) continue;
    for (PluginCandidate& candidate : candidates_) {
      if (candidate.path == node.plugin_path) candidate.refused = problem;
    }
  }
  std::erase_if(nodes_, [&](const auto& item) { return dropped.contains(item.second.plugin_path); });
}

const NodeDeclaration* Registry::node(const std::string& id) const {
  const auto found = nodes_.find(id);
  return found == nodes_.end() ? nullptr : &found->second;
}

const TypeDeclaration* Registry::type(const std::string& id) const {
  const auto found = types_.find(id);
  return found == types_.end() ? nullptr : &found->second;
}

}  // namespace ballflow
