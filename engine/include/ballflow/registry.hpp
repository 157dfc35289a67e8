// Which nodes and types exist: node libraries are found, checked and loaded here.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "ballflow/artifact.hpp"
#include "ballflow/node_decl.hpp"

namespace ballflow {

class FileSystem;
class RegistryLoader;

/// A file that was looked at while searching for node libraries.
struct PluginCandidate {
  std::string path;
  std::string name, version;  // of an accepted library
  std::string refused;        // why it was not loaded; empty when it was
};

class Registry {
 public:
  /// Looks for *.so in `extra` (files or folders), the folders of $BALLFLOW_PLUGIN_PATH, and in `installed`:
  /// unless told otherwise next to the executable (../lib/ballflow). Reads the ABI note of each file before
  /// it is loaded. A library that cannot be used is a refused candidate, not an error, unless it is a file of
  /// `extra`; a node or type declared twice with different content throws Error (code plugin) that names both
  /// files, and so does a node that two different files declare in equal words: nothing says that they
  /// compute the same. Of copies of one file, and of equal declarations of a type, the first found stays. A
  /// file that is found twice is loaded once. A file *.py of `extra` is a library of nodes in Python: see
  /// docs/python_nodes.md.
  ///
  /// `cache`: a cache folder (store.hpp), whose file "libraries" keeps what libraries declare. One that is in
  /// it and has not changed since is opened only when one of its nodes runs, and its declarations are parsed
  /// when they are asked for; what is missing there is added. Empty: every library is opened.
  static std::shared_ptr<const Registry> load(const std::vector<std::string>& extra = {},
                                              const std::string& installed = default_folder(),
                                              const std::string& cache = {},
                                              std::shared_ptr<FileSystem> files = {});
  /// The default folder of node libraries of this executable.
  static std::string default_folder();

  /// For tests and tools: an empty registry to which declarations are added.
  Registry() = default;
  void add(NodeDeclaration node);
  void add(TypeDeclaration type);
  /// `library_file` as in NodeDeclaration. Throws Error (code plugin) that says what is wrong with the
  /// tables. They are released with the registry.
  void add_plugin(const bf_plugin& plugin, const std::string& path, const std::string& library_file = {});
  /// Of a library each node of which has a `library_file` of its own, by id: the digest of its function.
  void add_plugin(const bf_plugin& plugin, const std::string& path,
                  const std::map<std::string, std::string>& digests);

  const NodeDeclaration* node(const std::string& id) const;
  const TypeDeclaration* type(const std::string& id) const;
  const Declarations<NodeDeclaration>& nodes() const { return nodes_; }
  const Declarations<TypeDeclaration>& types() const { return types_; }
  const std::vector<PluginCandidate>& candidates() const { return candidates_; }
  /// The folders that were searched, in order; some may not exist.
  const std::vector<std::string>& folders() const { return folders_; }

 private:
  friend class RegistryLoader;
  void add_tables(const bf_plugin& plugin, const std::string& path,
                  const std::function<std::string(const std::string&)>& library_file);
  void add_node(const std::string& id, std::shared_ptr<const Declared<NodeDeclaration>> node);
  void drop_nodes_of_unknown_types();

  Declarations<NodeDeclaration> nodes_;
  Declarations<TypeDeclaration> types_;
  std::vector<PluginCandidate> candidates_;
  std::vector<std::string> folders_;
  std::vector<std::shared_ptr<void>> owners_;  // of the tables of plugins
};

/// Reads the ABI note of an ELF file without loading it. Returns an empty string when the library fits,
/// else the reason why it does not.
std::string refuse_plugin_file(const std::string& path);

/// Compares type, version and arrays (presence, dtype, rank, lengths) with the declaration. Returns an empty
/// string when all is well, else what is wrong.
std::string check_arrays(const TypeDeclaration& type, const Artifact& artifact);

/// The same, and runs the type's own check.
std::string check_artifact(const TypeDeclaration& type, const Artifact& artifact);

/// An artifact of these arrays, as a node of a library would give it: checked, and with the summary that its
/// type makes of them ({} where it makes none). `owner` as in Artifact::seal. Throws Error (code plugin) that
/// says what is wrong with the arrays.
ArtifactPtr make_artifact(const TypeDeclaration& type, const std::vector<NamedArray>& arrays,
                          const std::shared_ptr<const void>& owner);

}  // namespace ballflow
