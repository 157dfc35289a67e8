#include "ballflow/registry.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "ballflow/error.hpp"
#include "base/quote.hpp"
#include "plugin/lazy_library.hpp"
#include "plugin/library_file.hpp"
#include "plugin/library_index.hpp"
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
    node.lists_files = entry->struct_size >= BALLFLOW_SIZE_UP_TO(bf_node, files) && entry->files != nullptr;
    tables.nodes.push_back(std::move(node));
  }
  return tables;
}

std::string origin(const std::string& path) { return path.empty() ? "this program" : path; }

template <class Declaration>
void add_once(Declarations<Declaration>& all, const std::string& id,
              std::shared_ptr<const Declared<Declaration>> declared, const char* what) {
  const auto [place, fresh] = all.unparsed().try_emplace(id, declared);
  if (fresh) return;
  const Declaration &other = place->second->get(), &added = declared->get();
  if (other.same_content(added)) return;  // the first of equal ones stays
  throw Error(ExitCode::plugin,
              std::string(what) + " " + in_quotes(added.id) + " is declared differently by " +
                  origin(other.plugin_path) + " (version " + std::to_string(other.version) + ") and by " +
                  origin(added.plugin_path) + " (version " + std::to_string(added.version) + ")",
              "remove one of the two libraries, or build both from the same sources");
}

template <class Declaration>
std::shared_ptr<const Declared<Declaration>> declared(Declaration parsed) {
  return std::make_shared<const Declared<Declaration>>(std::move(parsed));
}

std::shared_ptr<const LibraryOutline> outline_of(const bf_plugin& plugin, const PluginTables& tables,
                                                 std::optional<Digest> digest) {
  LibraryOutline outline{tables.name, tables.version, digest, {}, {}};
  for (std::size_t i = 0; i < tables.types.size(); ++i) {
    const TypeDeclaration& type = tables.types[i];
    outline.types.push_back({type.id, type.version, std::string(view(plugin.types[i]->declaration))});
  }
  for (std::size_t i = 0; i < tables.nodes.size(); ++i) {
    const NodeDeclaration& node = tables.nodes[i];
    outline.nodes.push_back({node.id, node.lists_files, std::string(view(plugin.nodes[i]->declaration)),
                             Declared<NodeDeclaration>(node).ports});
  }
  return std::make_shared<const LibraryOutline>(std::move(outline));
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
  const std::string id = node.id;
  add_node(id, declared(std::move(node)));
}

void Registry::add_node(const std::string& id, std::shared_ptr<const Declared<NodeDeclaration>> node) {
  const NodeDeclaration* const known = nodes_.find(id);
  if (known != nullptr && known->same_content(node->get()) && !same_file(*known, node->get())) {
    throw Error(ExitCode::plugin,
                "node " + in_quotes(id) + " is declared in the same words by two different files, " +
                    origin(known->plugin_path) + " and " + origin(node->plugin_path) +
                    ", and may compute different things",
                "remove one of the two libraries, or install the same build in both places");
  }
  add_once(nodes_, id, std::move(node), "node");
}

void Registry::add(TypeDeclaration type) {
  const std::string id = type.id;
  add_once(types_, id, declared(std::move(type)), "type");
}

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

/// What one call of Registry::load needs to know.
class RegistryLoader {
 public:
  RegistryLoader(Registry& registry, std::string own, const std::string& cache,
                 std::shared_ptr<FileSystem> files)
      : registry_(registry), own_(std::move(own)), index_(cache, std::move(files)) {
    std::error_code none;
    if (!own_.empty()) installed_ = fs::canonical(own_, none);
  }

  void load(const std::vector<std::string>& extra) {
    for (const std::string& path : extra) {
      std::error_code error;
      if (fs::is_directory(path, error)) {
        load_folder(path);
      } else if (is_python_file(path)) {
        // Functions name types, so their files come when all types are known.
        python_files_.push_back(path);
      } else if (const std::string why = load_file(path); !why.empty()) {
        throw Error(ExitCode::plugin, "the node library " + path + " " + why);
      }
    }
    if (const char* folders = std::getenv("BALLFLOW_PLUGIN_PATH")) {
      std::string_view rest = folders;
      while (!rest.empty()) {
        const std::string_view folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
        if (!folder.empty()) load_folder(std::string(folder));
      }
    }
    if (!own_.empty()) load_folder(own_);
    for (const std::string& path : python_files_) load_python_file(path);
    index_.save();
  }

 private:
  void load_folder(const std::string& folder) {
    registry_.folders_.push_back(folder);
    for (const std::string& file : libraries_in(folder)) load_file(file);
  }

  /// Empty when the library is in the registry now, or was before; else why it is not.
  std::string load_file(const std::string& path) {
    std::error_code error;
    const fs::path real = real_path(path, error);
    if (!error && !seen_.insert(real.string()).second) return {};
    struct stat status {};
    if (!error && ::stat(real.c_str(), &status) == 0 &&
        !was_opened_otherwise(real.string(), FileState(status))) {
      if (const auto outline = index_.find(real.string(), FileState(status));
          outline != nullptr && (outline->digest || is_installed(real))) {
        add_outline(path, real.string(), FileState(status), outline);
        return {};
      }
    }
    const std::string why = load_now(path, real, status);
    if (!why.empty()) registry_.candidates_.push_back({path, "", "", why});
    return why;
  }

  std::string load_now(const std::string& path, const fs::path& real, const struct stat& status) {
    std::string why = refuse_plugin_file(path);
    if (!why.empty()) return why;
    std::optional<Digest> digest;
    if (!is_installed(real)) digest = library_digest(real.string());
    const FileState state(status);
    const bf_plugin* const plugin = open_library(real.string(), state, why);
    if (plugin == nullptr) return why;
    try {
      PluginTables tables = read_tables(*plugin, path);
      // What a table gives back when it is released does not outlive its registry.
      if (plugin->release == nullptr && !was_opened_otherwise(real.string(), state))
        index_.add(real.string(), state, outline_of(*plugin, tables, digest));
    } catch (const Error& problem) {
      return problem.what();
    }
    registry_.add_plugin(*plugin, path, digest ? digest->hex() : std::string());
    return {};
  }

  void add_outline(const std::string& path, const std::string& real, const FileState& state,
                   const std::shared_ptr<const LibraryOutline>& outline) {
    const auto library = std::make_shared<const LazyLibrary>(real, state, outline);
    const std::string digest =
        outline->digest && !is_installed(real) ? outline->digest->hex() : std::string();
    for (std::size_t i = 0; i < outline->types.size(); ++i) {
      const TypeOutline& type = outline->types[i];
      const auto parse = [path, library, outline, i] {
        TypeDeclaration parsed = parse_type_declaration(outline->types[i].declaration);
        parsed.plugin_path = path;
        parsed.entry = {library, i};
        return parsed;
      };
      add_once(registry_.types_, type.id,
               std::make_shared<const Declared<TypeDeclaration>>(path, type.version,
                                                                 std::vector<PortOutline>(), parse),
               "type");
    }
    for (std::size_t i = 0; i < outline->nodes.size(); ++i) {
      const NodeOutline& node = outline->nodes[i];
      const auto parse = [path, library, outline, digest, i] {
        NodeDeclaration parsed = parse_node_declaration(outline->nodes[i].declaration);
        parsed.plugin_path = path;
        parsed.library_file = digest;
        parsed.lists_files = outline->nodes[i].lists_files;
        parsed.entry = {library, i};
        return parsed;
      };
      registry_.add_node(node.id,
                         std::make_shared<const Declared<NodeDeclaration>>(path, 0, node.ports, parse));
    }
    registry_.candidates_.push_back({path, outline->name, outline->version, ""});
  }

  void load_python_file(const std::string& path) {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    if (!error && !seen_.insert(real.string()).second) return;
    PythonLibrary library;
    try {
      library = load_python(path, registry_.types_, own_);
      read_tables(*library.table, path);
    } catch (const Error& problem) {
      if (library.table != nullptr) library.table->release(library.table->owner);
      throw Error(ExitCode::plugin, "the node library " + path + " " + problem.what(), problem.hint());
    }
    registry_.add_plugin(*library.table, path, library.digests);
  }

  bool is_installed(const fs::path& real) const { return real.parent_path() == installed_; }

  /// As fs::canonical, which asks for every folder above every file.
  fs::path real_path(const fs::path& path, std::error_code& error) {
    if (fs::is_symlink(path, error) || error || !path.has_parent_path()) return fs::canonical(path, error);
    const auto [place, fresh] = real_folders_.try_emplace(path.parent_path().string());
    if (fresh) place->second = fs::canonical(path.parent_path(), error);
    return place->second / path.filename();
  }

  Registry& registry_;
  std::string own_;
  fs::path installed_;
  LibraryIndex index_;
  std::set<std::string> seen_;
  std::map<std::string, fs::path> real_folders_;
  std::vector<std::string> python_files_;
};

std::shared_ptr<const Registry> Registry::load(const std::vector<std::string>& extra, const std::string& own,
                                               const std::string& cache, std::shared_ptr<FileSystem> files) {
  const auto registry = std::make_shared<Registry>();
  RegistryLoader(*registry, own, cache, std::move(files)).load(extra);
  registry->drop_nodes_of_unknown_types();
  return registry;
}

void Registry::drop_nodes_of_unknown_types() {
  const auto problem_of = [&](const std::string& id, const Declared<NodeDeclaration>& node) -> std::string {
    for (const PortOutline& port : node.ports) {
      const auto known = types_.unparsed().find(port.type);
      const bool there = known != types_.unparsed().end();
      if (there && known->second->version == port.type_version) continue;
      const std::string start = "node " + in_quotes(id) + ": port " + in_quotes(port.name) +
                                " has the type " + in_quotes(port.type) + " version " +
                                std::to_string(port.type_version);
      if (!there) return start + ", which no loaded library declares";
      return start + ", but version " + std::to_string(known->second->version) + " is declared by " +
             origin(known->second->plugin_path);
    }
    return {};
  };
  std::set<std::string> dropped;
  for (const auto& [id, node] : nodes_.unparsed()) {
    const std::string problem = problem_of(id, *node);
    if (problem.empty() || !dropped.insert(node->plugin_path).second) continue;
    for (PluginCandidate& candidate : candidates_) {
      if (candidate.path == node->plugin_path) candidate.refused = problem;
    }
  }
  if (dropped.empty()) return;
  std::erase_if(nodes_.unparsed(),
                [&](const auto& item) { return dropped.contains(item.second->plugin_path); });
}

const NodeDeclaration* Registry::node(const std::string& id) const { return nodes_.find(id); }

const TypeDeclaration* Registry::type(const std::string& id) const { return types_.find(id); }

}  // namespace ballflow
