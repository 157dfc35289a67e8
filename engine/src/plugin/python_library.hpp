// Nodes written in Python: a file of functions as a library of nodes. The functions run in processes of their
// own, which tools/python/ballflow/_worker.py describes; here is the other end.
#pragma once

#include <map>
#include <string>

#include "ballflow/node_decl.hpp"
#include "ballflow/plugin.h"

namespace ballflow {

struct PythonLibrary {
  // Owns everything below it; its `release` ends the processes.
  const bf_plugin* table = nullptr;
  // By id of the node: the digest of its function and of what that names, which counts as the file of its
  // library.
  std::map<std::string, std::string> digests;
};

/// Whether the path is that of a file with nodes in Python: "my_nodes.py".
bool is_python_file(const std::string& path);

/// Starts a process that imports the file and says which nodes it declares. `types` are those that functions
/// may name, `installed` the folder of node libraries, beside which the Python package is. The interpreter is
/// $BALLFLOW_PYTHON, else python3. Throws Error (code plugin) with the rest of the sentence "the node library
/// my_nodes.py ...".
PythonLibrary load_python(const std::string& path, const Declarations<TypeDeclaration>& types,
                          const std::string& installed);

}  // namespace ballflow
