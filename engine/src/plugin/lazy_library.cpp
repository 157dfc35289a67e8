#include "plugin/lazy_library.hpp"

#include <dlfcn.h>

#include <cstdint>
#include <map>
#include <mutex>

#include "ballflow/error.hpp"
#include "plugin/text_view.hpp"

namespace ballflow {
namespace {

template <class Table, class Outlines>
bool same_declarations(const Table* const* tables, std::uint64_t count, std::uint32_t smallest,
                       const Outlines& outlines) {
  if (count != outlines.size() || (count > 0 && tables == nullptr)) return false;
  for (std::size_t i = 0; i < outlines.size(); ++i) {
    if (tables[i] == nullptr || tables[i]->struct_size < smallest) return false;
    if (view(tables[i]->declaration) != outlines[i].declaration) return false;
  }
  return true;
}

bool is_in_state(const std::string& path, const FileState& state) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && FileState(status) == state;
}

/// In which state libraries were when this process opened them.
struct OpenedLibraries {
  std::mutex mutex;
  std::map<std::string, FileState> states;
};

OpenedLibraries& opened_libraries() {
  static OpenedLibraries opened;
  return opened;
}

}  // namespace

bool was_opened_otherwise(const std::string& real_path, const FileState& state) {
  OpenedLibraries& opened = opened_libraries();
  const std::lock_guard lock(opened.mutex);
  const auto found = opened.states.find(real_path);
  return found != opened.states.end() && found->second != state;
}

const bf_plugin* open_library(const std::string& real_path, const FileState& state, std::string& why) {
  constexpr const char* changed = "was written while it was loaded: try again";
  if (!is_in_state(real_path, state)) {
    why = changed;
    return nullptr;
  }
  void* const handle = dlopen(real_path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (handle == nullptr) {
    const char* const reason = dlerror();
    why = std::string("cannot be loaded: ") + (reason != nullptr ? reason : "unknown reason");
    return nullptr;
  }
  const auto entry = reinterpret_cast<bf_plugin_entry>(dlsym(handle, "ballflow_plugin"));
  if (entry == nullptr) {
    why = "exports no function ballflow_plugin";
    return nullptr;
  }
  if (!is_in_state(real_path, state)) {
    why = changed;
    return nullptr;
  }
  {
    OpenedLibraries& opened = opened_libraries();
    const std::lock_guard lock(opened.mutex);
    opened.states.try_emplace(real_path, state);
  }
  const bf_plugin* const table = entry();
  if (table == nullptr) why = "could not make its tables of nodes and types";
  return table;
}

const bf_plugin& LazyLibrary::table() const {
  const std::lock_guard lock(mutex_);
  if (table_ == nullptr) table_ = &opened();
  return *table_;
}

const bf_plugin& LazyLibrary::opened() const {
  std::string why;
  const bf_plugin* const table = open_library(path_, state_, why);
  if (was_opened_otherwise(path_, state_)) why = "was loaded by this program before, and has changed since";
  if (table != nullptr &&
      (table->struct_size < BF_PLUGIN_MIN_SIZE || table->abi_version != BALLFLOW_ABI_VERSION ||
       !same_declarations(table->types, table->type_count, BF_TYPE_MIN_SIZE, outline_->types) ||
       !same_declarations(table->nodes, table->node_count, BF_NODE_MIN_SIZE, outline_->nodes))) {
    why = "declares other nodes or types than when it was loaded last";
  }
  if (why.empty()) return *table;
  throw Error(ExitCode::plugin, "the node library " + path_ + " " + why,
              "start again; if that does not help, remove the file \"libraries\" from the cache folder");
}

template <>
const bf_node* TableOf<bf_node>::opened() const {
  return library_->table().nodes[place_];
}

template <>
const bf_type* TableOf<bf_type>::opened() const {
  return library_->table().types[place_];
}

}  // namespace ballflow
