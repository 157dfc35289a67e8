// The tables of a node library, and the one line that makes a shared object one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballflow/plugin.h"
#include "ballflow/sdk/node.hpp"
#include "ballflow/sdk/type.hpp"

namespace ballflow {

namespace detail {

/// Entries that live as long as the process; `self` is what their functions get.
const bf_node* keep_node(const AnyNodeDecl& decl);
const bf_type* keep_type(const AnyTypeDecl& decl,
                         std::string (*broken)(const AnyTypeDecl& decl, const bf_artifact& artifact),
                         std::string (*summary)(const AnyTypeDecl& decl, const bf_artifact& artifact));

/// Makes the table of a library, which lives as long as the process. Null when `nodes` or `types` throws.
const bf_plugin* keep_plugin(std::string_view name, std::string_view version,
                             std::vector<const bf_node*> (*nodes)(),
                             std::vector<const bf_type*> (*types)()) noexcept;

template <class T>
const bf_type* type_entry() {
  static const bf_type* const entry = keep_type(
      type_decl<T>(),
      [](const AnyTypeDecl& any, const bf_artifact& artifact) {
        const auto& decl = static_cast<const TypeDecl<T>&>(any);
        return decl.broken(decl.read(artifact));
      },
      [](const AnyTypeDecl& any, const bf_artifact& artifact) {
        const auto& decl = static_cast<const TypeDecl<T>&>(any);
        return decl.summary_of(decl.read(artifact)).text();
      });
  return entry;
}

}  // namespace detail

/// The table entry of one node; a plugin of several files collects one per file.
template <class N>
const bf_node* node_entry() {
  static const bf_node* const entry = detail::keep_node(node_decl<N>());
  return entry;
}
template <class... N>
std::vector<const bf_node*> node_entries() {
  return {node_entry<N>()...};
}
template <class... T>
std::vector<const bf_type*> type_entries() {
  return {detail::type_entry<T>()...};
}

}  // namespace ballflow

/// The one line that makes a shared object a plugin. `nodes_expression` and `types_expression` are
/// expressions of type std::vector<const bf_node*> and std::vector<const bf_type*>; they are evaluated once,
/// when the engine asks for the tables.
#define BALLFLOW_PLUGIN(plugin_name, plugin_version, nodes_expression, types_expression)                     \
  extern "C" __attribute__((visibility("default"), used, section(BALLFLOW_ABI_SECTION)))                     \
  const bf_abi_note ballflow_abi_note = {{'B', 'A', 'L', 'L', 'F', 'L', 'O', 'W'}, BALLFLOW_ABI_VERSION, 0}; \
  extern "C" __attribute__((visibility("default"))) const bf_plugin* ballflow_plugin(void) {                 \
    static const bf_plugin* const plugin = ::ballflow::detail::keep_plugin(                                  \
        plugin_name, plugin_version, [] { return std::vector<const bf_node*>(nodes_expression); },           \
        [] { return std::vector<const bf_type*>(types_expression); });                                       \
    return plugin;                                                                                           \
  }
